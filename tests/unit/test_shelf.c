/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Boxes that stand side by side, as books on a shelf: on a floor or a slope, face to face or apart, pushed, at an end of
 * the shelf or without one. They slide, tip, lean on each other and stand, and many of their contacts are redundant:
 * all corners on the floor are on one line, and so are the faces that touch. With smooth sides against a time stepping
 * that knows no events (moreau.h); with rough ones a box may jam in itself, between the friction under a corner and the push
 * of its neighbour at the next one, or not: there all that is asked for is that the run comes to its end. FBD_SHELF=1000
 * tries so many, FBD_SHELF_SEED=17 begins there, FBD_SHELF_SHOW=1 prints the models, FBD_SHELF_UNTIL is when to look.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "gallery.h"
#include "moreau.h"
#include "random_numbers.h"
#include "thorough.h"
#include "written.h"

enum { most_boxes = 3, first_steps = 1000, most_steps = 16000 };

static const double g = 9.81, pi = 3.14159265358979323846;

/* Lengths along and across the shelf. */
struct box {
    double a, b, m, q[3], v[3];
    struct vec push, at; /* and where it acts, in the box; a push keeps its direction */
};

struct shelf {
    int count;
    bool ends; /* on the left */
    bool
        strikes; /* bodies are apart or move: then faces are parallel, or which corner strikes first would decide */
    double slope, mu, mu_sides, e, until;
    struct box box[most_boxes];
    struct written text;
};

/* ---- scenes */

/* A rounding of what is drawn, or one of what others had computed: less than is seen as a gap. */
static double hardly(struct random_numbers *numbers, const struct shelf *shelf)
{
    double size = pow(10, random_between(numbers, -14, -10.3));
    if (shelf->strikes || random_chance(numbers, 0.5)) return 0;
    return random_chance(numbers, 0.5) ? size : -size;
}

static void draw_box(struct random_numbers *numbers, const struct shelf *shelf, struct box *box, double *left)
{
    const double side[] = {-0.5, 0, 0.5};
    double angle = random_between(numbers, -pi, pi), push = random_perhaps(numbers, 0.6, 0, 25);
    box->a = random_between(numbers, 0.2, 1);
    box->b = random_between(numbers, 0.2, 1.2);
    box->m = random_between(numbers, 0.5, 3);
    if (shelf->strikes) *left += random_between(numbers, 0.0005, 0.01);
    box->q[0] = *left + box->a / 2 + hardly(numbers, shelf);
    box->q[1] = box->b / 2 + hardly(numbers, shelf);
    box->q[2] = hardly(numbers, shelf);
    if (shelf->strikes) box->v[0] = random_perhaps(numbers, 0.5, -1, 1);
    *left += box->a;
    box->push = (struct vec){push * cos(angle), push * sin(angle)};
    box->at = (struct vec){box->a * side[random_bits(numbers) % 3], box->b * side[random_bits(numbers) % 3]};
}

static void write_box(struct shelf *shelf, int i)
{
    const struct box *box = &shelf->box[i];
    const double s = shelf->slope, c = cos(s), n = sin(s);
    add(&shelf->text,
        "  b%d: {shape: prism, a: %.17g, b: %.17g, c: 1, mass: %.17g, motion: planar, initial: {x: %.17g, y: "
        "%.17g, "
        "theta: %.17g, vx: %.17g, vy: %.17g}, forces: [gravity",
        i, box->a, box->b, box->m, c * box->q[0] - n * box->q[1], n * box->q[0] + c * box->q[1],
        s + box->q[2], c * box->v[0], n * box->v[0]);
    if (vec_norm(box->push) > 0)
        add(&shelf->text, ", {applied: {value: %.17g, angle: %.17g, at: [%.17g, %.17g]}}",
            vec_norm(box->push), s + atan2(box->push.y, box->push.x), box->at.x, box->at.y);
    add(&shelf->text, "]}\n");
}

static void write_contact(struct shelf *shelf, const char *name, int i, const char *with, double mu)
{
    add(&shelf->text,
        "  - {name: c%d_%s, between: [b%d, %s], static: %.17g, restitution: %.17g, law: moreau}\n", i, name,
        i, with, mu, shelf->e);
}

static void draw_shelf(uint64_t seed, struct shelf *shelf)
{
    struct random_numbers numbers = {seed};
    double left = 0;
    *shelf = (struct shelf){.count = 1 + (int)(random_bits(&numbers) % most_boxes)};
    shelf->ends = random_chance(&numbers, 0.2);
    shelf->strikes = random_chance(&numbers, 0.3);
    shelf->slope = random_perhaps(&numbers, 0.8, -0.7, 0.7);
    shelf->mu = random_between(&numbers, 0.1, 0.9);
    shelf->mu_sides = random_chance(&numbers, 0.5) ? shelf->mu : 0;
    shelf->e = random_perhaps(&numbers, 0.3, 0, 0.6);
    shelf->until = random_between(&numbers, 0.01, 0.15);
    if (getenv("FBD_SHELF_UNTIL")) shelf->until = strtod(getenv("FBD_SHELF_UNTIL"), NULL);
    for (int i = 0; i < shelf->count; i++) draw_box(&numbers, shelf, &shelf->box[i], &left);
    add(&shelf->text, "fbd: 1\nground: {lines: {floor: {along: %.17g}, end: {along: %.17g}}}\nbodies:\n",
        shelf->slope, shelf->slope - pi / 2);
    for (int i = 0; i < shelf->count; i++) write_box(shelf, i);
    add(&shelf->text, "contacts:\n");
    for (int i = 0; i < shelf->count; i++) write_contact(shelf, "floor", i, "ground.floor", shelf->mu);
    for (int i = 0; i < shelf->count && shelf->ends; i++)
        write_contact(shelf, "end", i, "ground.end", shelf->mu_sides);
    for (int i = 1; i < shelf->count; i++) {
        char with[16];
        snprintf(with, sizeof with, "b%d", i - 1);
        write_contact(shelf, with, i, with, shelf->mu_sides);
    }
    add(&shelf->text, "simulate: {until: %.17g}\n", shelf->until);
}

/* ---- time stepping, along and across the shelf */

static void forces(const void *scene, double t, const double *q, const double *v, double *f)
{
    const struct shelf *shelf = scene;
    (void)t;
    (void)v;
    for (int i = 0; i < shelf->count; i++) {
        const struct box *box = &shelf->box[i];
        const double c = cos(q[3 * i + 2]), s = sin(q[3 * i + 2]);
        struct vec arm = {c * box->at.x - s * box->at.y, s * box->at.x + c * box->at.y};
        f[3 * i] = -box->m * g * sin(shelf->slope) + box->push.x;
        f[3 * i + 1] = -box->m * g * cos(shelf->slope) + box->push.y;
        f[3 * i + 2] = vec_cross(arm, box->push);
    }
}

static void solve(const void *scene, const double *q, double *b)
{
    const struct shelf *shelf = scene;
    (void)q;
    for (int i = 0; i < shelf->count; i++) {
        const struct box *box = &shelf->box[i];
        b[3 * i] /= box->m;
        b[3 * i + 1] /= box->m;
        b[3 * i + 2] /= box->m * (box->a * box->a + box->b * box->b) / 12;
    }
}

/* A point of box i in the frame of the shelf: `x`, `y` in halves of the sides. */
static struct vec point_of(const struct shelf *shelf, const double *q, int i, double x, double y)
{
    const struct box *box = &shelf->box[i];
    double c = cos(q[3 * i + 2]), s = sin(q[3 * i + 2]);
    x *= box->a / 2;
    y *= box->b / 2;
    return (struct vec){q[3 * i] + c * x - s * y, q[3 * i + 1] + s * x + c * y};
}

/* What the velocity of box i at P is along n. */
static void set_share(const double *q, int i, struct vec P, struct vec n, double sign, double *w)
{
    w[3 * i] = sign * n.x;
    w[3 * i + 1] = sign * n.y;
    w[3 * i + 2] = sign * vec_cross((struct vec){P.x - q[3 * i], P.y - q[3 * i + 1]}, n);
}

/* Box i at P on box j, or on what is fixed (-1), whose normal is n. */
static void add_touch(const struct shelf *shelf, const double *q, int i, int j, struct vec P, struct vec n,
                      double mu, struct moreau_rows *rows)
{
    struct moreau_row gap = {.kind = moreau_gap, .e = shelf->e, .normal = -1},
                      rub = {.kind = moreau_rub, .mu = mu, .normal = rows->count};
    set_share(q, i, P, n, 1, gap.w);
    set_share(q, i, P, vec_perp(n), 1, rub.w);
    if (j >= 0) set_share(q, j, P, n, -1, gap.w);
    if (j >= 0) set_share(q, j, P, vec_perp(n), -1, rub.w);
    rows->row[rows->count++] = gap;
    rows->row[rows->count++] = rub;
}

/* The corners of box i on the face of box j that looks to the `side`. */
static void find_on_face(const struct shelf *shelf, const double *q, int i, int j, double side,
                         struct moreau_rows *rows)
{
    const double closed = 1e-12, beyond = 1e-6;
    double angle = q[3 * j + 2], half = shelf->box[j].b / 2;
    struct vec n = {side * cos(angle), side * sin(angle)}, middle = point_of(shelf, q, j, side, 0);
    for (int up = -1; up <= 1; up += 2) {
        struct vec P = point_of(shelf, q, i, -side, up), d = vec_sub(P, middle);
        bool on = fabs(d.y * cos(angle) - d.x * sin(angle)) <= half + beyond;
        if (on && vec_dot(d, n) <= closed) add_touch(shelf, q, i, j, P, n, shelf->mu_sides, rows);
    }
}

static void find_rows(const void *scene, double t, const double *q, struct moreau_rows *rows)
{
    const struct shelf *shelf = scene;
    const double closed = 1e-12;
    (void)t;
    for (int i = 0; i < shelf->count; i++)
        for (int k = 0; k < 4; k++) {
            struct vec P = point_of(shelf, q, i, k % 2 ? 1 : -1, k / 2 ? 1 : -1);
            if (P.y <= closed) add_touch(shelf, q, i, -1, P, (struct vec){0, 1}, shelf->mu, rows);
            if (shelf->ends && P.x <= closed)
                add_touch(shelf, q, i, -1, P, (struct vec){1, 0}, shelf->mu_sides, rows);
        }
    for (int i = 1; i < shelf->count; i++) {
        find_on_face(shelf, q, i, i - 1, 1, rows);
        find_on_face(shelf, q, i - 1, i, -1, rows);
    }
}

/* Places, and a tenth of the velocities. */
static void step_through(const struct shelf *shelf, int steps, double *end)
{
    const struct moreau_system system = {3 * shelf->count, shelf, forces, solve, find_rows, NULL};
    double q[moreau_most] = {0}, v[moreau_most] = {0};
    for (int i = 0; i < 3 * shelf->count; i++)
        q[i] = shelf->box[i / 3].q[i % 3], v[i] = shelf->box[i / 3].v[i % 3];
    moreau_run(&system, shelf->until, steps, q, v);
    for (int i = 0; i < 3 * shelf->count; i++) end[2 * i] = q[i], end[2 * i + 1] = v[i] / 10;
}

/* ---- both */

static double apart(int count, const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < 6 * count; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

static double read_value(const struct trial *trial, int i, const char *of)
{
    char name[24];
    snprintf(name, sizeof name, "b%d.%s", i, of);
    return trial_get(trial, name);
}

static void read_pair(const struct trial *trial, const struct shelf *shelf, int i, const char *const names[3],
                      double *end)
{
    const double c = cos(shelf->slope), s = sin(shelf->slope);
    double x = read_value(trial, i, names[0]), y = read_value(trial, i, names[1]);
    end[0] = c * x + s * y;
    end[2] = c * y - s * x;
    end[4] = read_value(trial, i, names[2]);
}

/* More than one motion agrees with the forces, or two different things strike within a step of the stepping, which takes that
 * for one impact. */
static bool is_open(const struct trial *trial, const struct shelf *shelf)
{
    const double step = shelf->until / most_steps;
    fbd_event last = {.t = -1, .name = ""};
    for (size_t i = 0; i < fbd_simulation_event_count(trial->simulation); i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind == FBD_EVENT_SEVERAL) return true;
        if (event.kind != FBD_EVENT_IMPACT) continue;
        bool near = event.t != last.t && event.t - last.t < 2 * step;
        if (shelf->strikes && near && strcmp(event.name, last.name) != 0) return true;
        last = event;
    }
    return false;
}

static bool run_shelf(const struct shelf *shelf, double *end, bool *open)
{
    static const char *const places[] = {"x", "y", "theta"}, *const rates[] = {"vx", "vy", "omega"};
    struct trial trial = trial_parse(shelf->text.all);
    trial_run(&trial, NULL);
    bool done = trial.outcome == FBD_DONE;
    if (!done) printf("# %s\n", fbd_simulation_reason(trial.simulation));
    for (int i = 0; i < shelf->count; i++) {
        read_pair(&trial, shelf, i, places, end + 6 * i);
        read_pair(&trial, shelf, i, rates, end + 6 * i + 1);
        end[6 * i + 4] -= shelf->slope;
        for (int k = 1; k < 6; k += 2) end[6 * i + k] /= 10;
    }
    *open = is_open(&trial, shelf);
    trial_close(&trial);
    return done;
}

/* Does the run end where small steps do? Steps and half steps may agree by chance: then smaller ones are asked. */
static bool agrees(uint64_t seed, bool *sensitive)
{
    enum { values = 6 * most_boxes };
    const double most = 3e-3, least = 1e-4;
    static struct shelf shelf;
    double end[values], fine[values], coarse[values], off = 0, difference = 0;
    bool open;
    draw_shelf(seed, &shelf);
    if (getenv("FBD_SHELF_SHOW")) puts(shelf.text.all);
    *sensitive = false;
    bool done = run_shelf(&shelf, end, &open);
    if (done && shelf.mu_sides > 0) return true;
    step_through(&shelf, first_steps / 2, coarse);
    for (int steps = first_steps; steps <= most_steps; steps *= 2) {
        step_through(&shelf, steps, fine);
        off = apart(shelf.count, fine, coarse);
        difference = apart(shelf.count, end, fine);
        *sensitive = off > most;
        if (done && (*sensitive || open || difference <= fmax(10 * off, least))) return true;
        memcpy(coarse, fine, sizeof fine);
    }
    printf("# seed %llu: %g apart, where the steps are off by %g\n%s\n", (unsigned long long)seed, difference,
           off, shelf.text.all);
    for (int i = 0; i < 3 * shelf.count; i++)
        printf("# %d: %.10g, by steps %.10g; %.10g, %.10g\n", i, end[2 * i], fine[2 * i], 10 * end[2 * i + 1],
               10 * fine[2 * i + 1]);
    return false;
}

static void time_stepping_says_the_same(void **unused)
{
    (void)unused;
    moreau_compare("FBD_SHELF", 20, 5, agrees);
}

/* Scenes that went wrong, and why. */
static void what_went_wrong_does_not(void **unused)
{
    static const uint64_t seeds[] = {
        30012, 30075, 20406,               /* half of a turning speed was lost as feet came to stick */
        20493, 10342, 30169, 30571, 20230, /* redundant contacts let a box turn: other modes at once */
        31429, 31485, 31706, 30362, 30710, 20694, 10277, /* what holds barely was not let go */
        31047, 31314, 31545, /* what opens a moment later was open where it closes */
        30673, 31373,        /* what was in the floor and at rest was seen to come into it, again and again */
        30009, 20221, 20612, 31463, /* a corner leaves a side over its end, which comes on that of the corner */
    };
    (void)unused;
    for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i += thorough() ? 1 : 4) {
        bool sensitive;
        assert_true(agrees(seeds[i], &sensitive) && !sensitive);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_went_wrong_does_not),
        cmocka_unit_test(time_stepping_says_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

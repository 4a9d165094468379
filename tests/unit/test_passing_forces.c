/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces and moments that begin and end: against closed forms, and random ones against an integration of their own
 * equations with the same conditions.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_view.h"
#include "random_numbers.h"
#include "run_checks.h"

/* ---- closed forms */

/* A block on a spring, m = 2, k = 200, v_0 = 3: omega = 10, and the spring breaks at k x = 40, where v^2 = 9 - 4. */
static void a_spring_breaks(void **unused)
{
    static const char *const scenes[] = {
        "forces: [spring: {name: band, stiffness: 200, until: force > 40 N}]}}\n",
        "forces: [spring: {name: band, stiffness: 200, until: x > 0.2 m}]}}\n",
        "forces: [spring: {name: band, stiffness: 200, to: [-1, 0], free_length: 1, until: tension > 40 "
        "N}]}}\n",
        "forces: [spring: {name: band, stiffness: 200, to: [-1, 0], free_length: 1, until: -40 N > "
        "-tension}]}}\n",
        "}}\ncouplings: [spring: {name: band, between: [b, ground.A], stiffness: 200, free_length: 1, until: "
        "tension > 40 N}]\n",
        "}}\ncouplings: [spring: {name: band, between: [ground.A, b], stiffness: 200, free_length: 1, until: "
        "force > 40 N}]\n"};
    const double t_end = asin(2.0 / 3) / 10;
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char text[text_room];
        snprintf(
            text, sizeof text,
            "fbd: 1\nground: {points: {A: [-1, 0]}}\nbodies: {b: {mass: 2, motion: slide, initial: {v: 3}, "
            "%ssimulate: {until: 1}\n",
            scenes[i]);
        struct trial trial = run_of(text);
        const double t = trial_event(&trial, FBD_EVENT_FORCE_ENDS, "band", 0);
        check_close(&checks, "t", t, t_end, same);
        check_close(&checks, "v", trial_get(&trial, "v"), sqrt(5), same);
        check_close(&checks, "x", trial_get(&trial, "x"), 0.2 + sqrt(5) * (1 - t_end), same);
        check_close(&checks, "work", fbd_result_work(trial.result, "b", "band"), -4, same);
        const fbd_energy energy = fbd_result_energy(trial.result);
        check_close(&checks, "V", energy.potential, 0, same);
        check_close(&checks, "lost", energy.work, -4, same);
        check_energy(&checks, &trial);
        check_that(&checks, "detail",
                   strstr(fbd_simulation_event(trial.simulation, 0).detail, "it takes 4 J") != NULL);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A torsional spring of 8 N m/rad on I = 2 breaks at 4 N m: omega_0 = 3, omega^2 = 9 - 8/2 0.25. */
static void a_torsional_spring_breaks(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial =
        run_of("fbd: 1\nbodies: {b: {mass: 1, inertia: 2, motion: pivot, initial: {omega: 3}, "
               "moments: [spring: {stiffness: 8, until: moment > 4 N*m}]}}\n"
               "simulate: {until: 1}\n");
    check_close(&checks, "t", trial_event(&trial, FBD_EVENT_FORCE_ENDS, NULL, 0), asin(0.5 * 2 / 3) / 2,
                same);
    check_close(&checks, "omega", trial_get(&trial, "omega"), sqrt(8), same);
    check_close(&checks, "lost", fbd_result_energy(trial.result).work, -1, same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* A brake of 3 N from x = 1 on, until v = 0.5; m = 1.5, v_0 = 2. */
static void a_brake_begins_and_ends(void **unused)
{
    static const char *const brakes[] = {
        "applied: {name: brake, value: -3, from: x > 1 m, until: v < 0.5 m/s}",
        "applied: {name: brake, fx: -3, fy: 0, from: x > 1, until: v < 0.5}",
        "applied: {name: brake, value: 3, angle: 180 deg, from: x > 1, until: 0.5 > v}"};
    const double first = 0.5, last = first + 1.5 * 1.5 / 3;
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof brakes / sizeof *brakes; i++) {
        char text[text_room];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies: {b: {mass: 1.5, motion: slide, initial: {v: 2}, forces: [%s]}}\n"
                 "simulate: {until: 2}\n",
                 brakes[i]);
        struct trial trial = run_of(text);
        check_close(&checks, "begins", trial_event(&trial, FBD_EVENT_FORCE_BEGINS, "brake", 0), first, same);
        check_close(&checks, "ends", trial_event(&trial, FBD_EVENT_FORCE_ENDS, "brake", 0), last, same);
        check_close(&checks, "v", trial_get(&trial, "v"), 0.5, same);
        check_close(&checks, "x", trial_get(&trial, "x"), 1 + (2 + 0.5) / 2 * 0.75 + 0.5 * (2 - last), same);
        check_close(&checks, "work", fbd_result_work(trial.result, "b", "brake"), 1.5 / 2 * (0.25 - 4), same);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Friction holds a block until a force begins that is above its limit: 2 N more than 0.3 m g accelerate 2 kg. The weight
 * of a second force, across the floor, ends at the same time and takes its share of friction with it. */
static void a_force_breaks_a_block_away(void **unused)
{
    const double limit = 0.3 * 2 * g;
    char text[text_room];
    struct checks checks = {0};
    (void)unused;
    snprintf(
        text, sizeof text,
        "fbd: 1\nbodies: {b: {mass: 2, motion: slide, forces: [gravity, normal, friction: 0.3, applied: "
        "{name: "
        "push, value: %.17g, from: t > 0.5 s}, applied: {name: press, value: 100, angle: -90 deg, until: t > "
        "0.5 s}]}}\nsimulate: {until: 1.5}\n",
        limit + 2);
    struct trial trial = run_of(text);
    check_close(&checks, "v", trial_get(&trial, "v"), 1, same);
    check_close(&checks, "x", trial_get(&trial, "x"), 0.5, same);
    check_close(&checks, "breakaway", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), 0.5, same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* A force toward another body and its reaction are there together: the momentum remains. */
static void a_reaction_ends_with_its_force(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_of(
        "fbd: 1\nbodies:\n  a: {mass: 1, motion: particle, forces: [applied: {value: 6, toward: b.G, from: t "
        "> 0.25 s, until: t > 0.75 s}]}\n  b: {mass: 2, motion: particle, initial: {x: 9}}\n"
        "simulate: {until: 1}\n");
    check_close(&checks, "a.vx", get(&trial, "a.vx"), 3, same);
    check_close(&checks, "b.vx", get(&trial, "b.vx"), -1.5, same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* Statics of the start: a force with `until` is there, one with `from` is not. */
static void statics_show_the_start(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial =
        trial_parse("fbd: 1\nbodies: {b: {mass: 1, motion: slide, initial: {x: 0.5}, forces: [spring: "
                    "{stiffness: 8, until: t > 1 s}, applied: {name: late, value: 5, from: t > 1 s}]}}\n");
    check_close(&checks, "a", trial_acceleration(&trial, "x"), -4, same);
    check_close(&checks, "late", trial_term(&trial, "x", "late"), 0, same);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- random forces on particles */

enum { most_bodies = 3, most_forces = 6, of_spring = 0, of_damper, of_applied, of_drag, force_kinds };

enum { by_nothing, by_time, by_place, by_speed, by_tension, condition_kinds };

struct condition {
    int kind, body; /* whose x or vx is above or below `value` */
    bool above;
    double value;
};

struct force {
    int kind, body, other; /* the other end of a spring or damper: a body, or -1 for a point of the ground */
    bool coupling;
    double end[2], k, l0, c, f[2], omega, quadratic;
    struct condition from, until;
};

struct scene {
    int bodies, forces;
    double mass[most_bodies], start[4 * most_bodies];
    struct force force[most_forces];
    int life[most_forces]; /* -1 before, 0 there, 1 after */
};

static struct condition draw_condition(struct random_numbers *numbers, int bodies, bool tension)
{
    struct condition condition = {.kind = (int)random_between(numbers, 0, condition_kinds - !tension),
                                  .body = (int)random_between(numbers, 0, bodies),
                                  .above = random_chance(numbers, 0.5),
                                  .value = random_between(numbers, -1, 1)};
    if (condition.kind == by_time) condition.value += 1;
    if (condition.kind == by_tension) condition.value *= 10;
    if (condition.kind == by_time) condition.above = true;
    return condition;
}

static struct scene draw_scene(struct random_numbers *numbers)
{
    struct scene scene = {.bodies = 1 + (int)random_between(numbers, 0, most_bodies),
                          .forces = 1 + (int)random_between(numbers, 0, most_forces)};
    for (int b = 0; b < scene.bodies; b++) scene.mass[b] = random_between(numbers, 0.5, 2);
    for (int i = 0; i < 4 * scene.bodies; i++) scene.start[i] = random_between(numbers, -2, 2);
    for (int k = 0; k < scene.forces; k++) {
        struct force *force = &scene.force[k];
        force->kind = (int)random_between(numbers, 0, force_kinds);
        force->body = (int)random_between(numbers, 0, scene.bodies);
        force->other = (int)random_between(numbers, -1, scene.bodies);
        if (force->other == force->body || force->kind >= of_applied) force->other = -1;
        force->coupling = force->kind < of_applied && (force->other >= 0 || random_chance(numbers, 0.3));
        for (int i = 0; i < 2; i++)
            force->end[i] = random_between(numbers, 3, 5), force->f[i] = random_between(numbers, -3, 3);
        if (force->kind == of_spring)
            force->k = random_between(numbers, 0, 10), force->l0 = random_between(numbers, 0, 4);
        if (force->kind == of_damper) force->c = random_between(numbers, 0, 2);
        if (force->kind == of_drag)
            force->c = random_between(numbers, 0, 0.5),
            force->quadratic = random_perhaps(numbers, 0.5, 0, 0.3);
        if (force->kind == of_applied) force->omega = random_perhaps(numbers, 0.5, 1, 5);
        if (random_chance(numbers, 0.5)) force->from = draw_condition(numbers, scene.bodies, false);
        force->until = draw_condition(numbers, scene.bodies, force->kind < of_applied);
        scene.life[k] = force->from.kind == by_nothing ? 0 : -1;
    }
    return scene;
}

/* The force on its body; the tension of a spring or damper. */
static double force_now(const struct force *force, double t, const double *y, double f[2])
{
    const double *own = y + (ptrdiff_t)4 * force->body,
                 *other = force->other < 0 ? NULL : y + (ptrdiff_t)4 * force->other;
    double d[2], w[2];
    for (int i = 0; i < 2; i++) {
        d[i] = (other ? other[i] : force->end[i]) - own[i];
        w[i] = (other ? other[2 + i] : 0) - own[2 + i];
        f[i] = force->f[i] * (force->omega > 0 ? sin(force->omega * t) : 1);
    }
    if (force->kind == of_applied) return 0;
    const double l = hypot(d[0], d[1]), speed = hypot(own[2], own[3]),
                 tension = force->k * (l - force->l0) + force->c * (d[0] * w[0] + d[1] * w[1]) / l;
    for (int i = 0; i < 2; i++)
        f[i] =
            force->kind == of_drag ? -(force->c + force->quadratic * speed) * own[2 + i] : tension * d[i] / l;
    return tension;
}

/* y: x, y, vx, vy of each body, then the work of each force. */
static int motion(double t, const double *y, double *dydt, void *context)
{
    const struct scene *scene = context;
    double *work = dydt + (ptrdiff_t)4 * scene->bodies;
    for (int b = 0; b < scene->bodies; b++)
        for (int i = 0; i < 2; i++) dydt[4 * b + i] = y[4 * b + 2 + i], dydt[4 * b + 2 + i] = 0;
    for (int k = 0; k < scene->forces; k++) {
        const struct force *force = &scene->force[k];
        double f[2];
        work[k] = 0;
        if (scene->life[k] != 0) continue;
        force_now(force, t, y, f);
        for (int i = 0; i < 2; i++) {
            dydt[4 * force->body + 2 + i] += f[i] / scene->mass[force->body];
            work[k] += f[i] * y[4 * force->body + 2 + i];
            if (force->other < 0) continue;
            dydt[4 * force->other + 2 + i] -= f[i] / scene->mass[force->other];
            work[k] -= f[i] * y[4 * force->other + 2 + i];
        }
    }
    return GSL_SUCCESS;
}

/* Above zero where the next condition of a force is met; negative without one. */
static double excess(const struct scene *scene, int k, double t, const double *y)
{
    const struct force *force = &scene->force[k];
    const struct condition *condition = scene->life[k] < 0 ? &force->from : &force->until;
    if (scene->life[k] > 0 || condition->kind == by_nothing) return -1;
    double f[2], value = t;
    if (condition->kind == by_place) value = y[4 * condition->body];
    if (condition->kind == by_speed) value = y[4 * condition->body + 2];
    if (condition->kind == by_tension) value = force_now(force, t, y, f);
    return condition->above ? value - condition->value : condition->value - value;
}

static int first_met(const struct scene *scene, double t, const double *y)
{
    for (int k = 0; k < scene->forces; k++)
        if (excess(scene, k, t, y) > 0) return k;
    return -1;
}

struct happened {
    int count, force[2 * most_forces];
    double t[2 * most_forces];
    double slowest; /* the least speed at which a condition was met: times are as much less accurate */
};

static void step_to(struct scene *scene, gsl_odeiv2_driver *driver, double from, double to, double *y)
{
    (void)scene;
    if (!(to > from)) return;
    gsl_odeiv2_driver_reset_hstart(driver, (to - from) / 4);
    assert_int_equal(gsl_odeiv2_driver_apply(driver, &from, to, y), GSL_SUCCESS);
}

/* By short steps; a step in which a condition is met is halved to find the first time at which one is. */
static void run_alone(struct scene *scene, double end, double *y, struct happened *happened)
{
    enum { most_numbers = 4 * most_bodies + most_forces };
    const double step = 0.005;
    const size_t size = (size_t)(4 * scene->bodies + scene->forces);
    gsl_odeiv2_system system = {motion, NULL, size, scene};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-13, 1e-13);
    assert_non_null(driver);
    happened->slowest = HUGE_VAL;
    double t = 0;
    while (t < end) {
        const double bytes = sizeof(double);
        double next = fmin(t + step, end), trial[most_numbers];
        int met = first_met(scene, t, y);
        if (met < 0) {
            memcpy(trial, y, size * (size_t)bytes);
            step_to(scene, driver, t, next, trial);
            double low = t, high = next;
            if (first_met(scene, next, trial) >= 0) {
                for (int i = 0; i < 60 && high - low > 1e-15; i++) {
                    const double middle = low + (high - low) / 2;
                    memcpy(trial, y, size * (size_t)bytes);
                    step_to(scene, driver, t, middle, trial);
                    if (first_met(scene, middle, trial) >= 0)
                        high = middle;
                    else
                        low = middle;
                }
                memcpy(trial, y, size * (size_t)bytes);
                step_to(scene, driver, t, high, trial);
                met = first_met(scene, high, trial);
            }
            if (met >= 0) {
                double before[most_numbers];
                memcpy(before, y, size * (size_t)bytes);
                const double past = fmax(t, high - 1e-4);
                step_to(scene, driver, t, past, before);
                if (high > past)
                    happened->slowest = fmin(happened->slowest, (excess(scene, met, high, trial) -
                                                                 excess(scene, met, past, before)) /
                                                                    (high - past));
            }
            t = high;
            memcpy(y, trial, size * (size_t)bytes);
        }
        if (met < 0) continue;
        happened->force[happened->count] = met;
        happened->t[happened->count++] = t;
        scene->life[met]++;
    }
    gsl_odeiv2_driver_free(driver);
}

static size_t write_condition(const struct condition *condition, const char *key, char *text, size_t size)
{
    static const char *const names[] = {[by_place] = "x", [by_speed] = "vx"};
    char name[20] = "t";
    if (condition->kind == by_nothing) return 0;
    if (condition->kind == by_place || condition->kind == by_speed)
        snprintf(name, sizeof name, "b%d.%s", condition->body, names[condition->kind]);
    if (condition->kind == by_tension) snprintf(name, sizeof name, "tension");
    return (size_t)snprintf(text, size, ", %s: %s %c %.17g", key, name, condition->above ? '>' : '<',
                            condition->value);
}

static size_t write_force(const struct force *force, int k, char *text, size_t size)
{
    static const char *const names[] = {"spring", "damper", "applied", "drag"};
    size_t used = (size_t)snprintf(text, size, "%s: {name: f%d", names[force->kind], k);
    if (force->coupling && force->other >= 0)
        used +=
            (size_t)snprintf(text + used, size - used, ", between: [b%d, b%d]", force->body, force->other);
    else if (force->coupling)
        used += (size_t)snprintf(text + used, size - used, ", between: [b%d, ground.P%d]", force->body, k);
    else if (force->kind < of_applied)
        used +=
            (size_t)snprintf(text + used, size - used, ", to: [%.17g, %.17g]", force->end[0], force->end[1]);
    if (force->kind == of_spring)
        used += (size_t)snprintf(text + used, size - used, ", stiffness: %.17g, free_length: %.17g", force->k,
                                 force->l0);
    if (force->kind == of_damper)
        used += (size_t)snprintf(text + used, size - used, ", coefficient: %.17g", force->c);
    if (force->kind == of_drag)
        used += (size_t)snprintf(text + used, size - used, ", linear: %.17g, quadratic: %.17g", force->c,
                                 force->quadratic);
    for (int i = 0; force->kind == of_applied && i < 2; i++)
        used += (size_t)snprintf(text + used, size - used, ", f%c: \"%.17g[N]*sin(%.17g[rad/s]*t + %.17g)\"",
                                 'x' + i, force->f[i], force->omega, force->omega > 0 ? 0 : asin(1));
    used += write_condition(&force->from, "from", text + used, size - used);
    used += write_condition(&force->until, "until", text + used, size - used);
    return used + (size_t)snprintf(text + used, size - used, "}");
}

static void write_scene(const struct scene *scene, double end, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "fbd: 1\nground: {points: {");
    for (int k = 0; k < scene->forces; k++)
        used += (size_t)snprintf(text + used, size - used, "P%d: [%.17g, %.17g], ", k, scene->force[k].end[0],
                                 scene->force[k].end[1]);
    used += (size_t)snprintf(text + used, size - used, "Z: [0, 0]}}\nbodies:\n");
    for (int b = 0; b < scene->bodies; b++) {
        const double *q = &scene->start[4 * b];
        used += (size_t)
            snprintf(text + used, size - used,
                     "  b%d: {mass: %.17g, motion: particle, initial: {x: %.17g, y: %.17g, vx: %.17g, "
                     "vy: %.17g}, forces: [",
                     b, scene->mass[b], q[0], q[1], q[2], q[3]);
        for (int k = 0; k < scene->forces; k++)
            if (scene->force[k].body == b && !scene->force[k].coupling) {
                used += write_force(&scene->force[k], k, text + used, size - used);
                used += (size_t)snprintf(text + used, size - used, ", ");
            }
        used += (size_t)snprintf(text + used, size - used, "applied: {name: none, fx: 0, fy: 0}]}\n");
    }
    bool any = false;
    for (int k = 0; k < scene->forces; k++)
        if (scene->force[k].coupling) {
            used += (size_t)snprintf(text + used, size - used, "%s  - ", any ? "" : "couplings:\n");
            used += write_force(&scene->force[k], k, text + used, size - used);
            used += (size_t)snprintf(text + used, size - used, "\n");
            any = true;
        }
    snprintf(text + used, size - used, "simulate: {until: %.17g, tolerance: 1e-12}\n", end);
}

static void check_scene(struct checks *checks, struct scene *scene, int seed)
{
    enum { room = 6000 };
    const double end = 2;
    char text[room], name[20], body[20];
    double y[4 * most_bodies + most_forces] = {0};
    struct happened happened = {0};
    write_scene(scene, end, text, sizeof text);
    memcpy(y, scene->start, sizeof scene->start);
    memset(y + (ptrdiff_t)4 * scene->bodies, 0, most_forces * sizeof *y);
    run_alone(scene, end, y, &happened);
    /* Errors of some 1e-12 of both, over the speed at which conditions are met. */
    const double accuracy = 1e-9 / fmin(1, happened.slowest);
    const size_t failed = checks->failed;
    struct trial trial = run_of(text);
    size_t passed = 0;
    for (size_t i = 0; i < fbd_simulation_event_count(trial.simulation); i++) {
        const fbd_event event = fbd_simulation_event(trial.simulation, i);
        if (event.kind != FBD_EVENT_FORCE_BEGINS && event.kind != FBD_EVENT_FORCE_ENDS) continue;
        if (passed < (size_t)happened.count) check_close(checks, "t", event.t, happened.t[passed], accuracy);
        passed++;
    }
    check_close(checks, "events", (double)passed, happened.count, 0);
    for (int b = 0; b < scene->bodies; b++)
        for (int i = 0; i < 4; i++) {
            static const char *const names[] = {"x", "y", "vx", "vy"};
            snprintf(name, sizeof name, "b%d.%s", b, names[i]);
            check_close(checks, name, get(&trial, name), y[4 * b + i], accuracy * (1 + fabs(y[4 * b + i])));
        }
    for (int k = 0; k < scene->forces; k++) {
        const double work = y[4 * scene->bodies + k];
        snprintf(name, sizeof name, "f%d", k);
        snprintf(body, sizeof body, "b%d", scene->force[k].body);
        check_close(checks, "work", fbd_result_work(trial.result, body, name), work,
                    accuracy * 10 * (1 + fabs(work)));
    }
    check_energy(checks, &trial);
    trial_close(&trial);
    if (checks->failed > failed) printf("with FBD_SEED=%d FBD_SCENES=1:\n%s", seed, text);
}

static void random_forces_pass(void **unused)
{
    const int first = number_of("FBD_SEED", 1), count = number_of("FBD_SCENES", 150);
    struct checks checks = {0};
    (void)unused;
    for (int seed = first; seed < first + count; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct scene scene = draw_scene(&numbers);
        check_scene(&checks, &scene, seed);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_spring_breaks),
        cmocka_unit_test(a_torsional_spring_breaks),
        cmocka_unit_test(a_brake_begins_and_ends),
        cmocka_unit_test(a_force_breaks_a_block_away),
        cmocka_unit_test(a_reaction_ends_with_its_force),
        cmocka_unit_test(statics_show_the_start),
        cmocka_unit_test(random_forces_pass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

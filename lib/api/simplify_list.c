/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The removable effects of a scene, and the reasons why others are not removable.
 */
#include <math.h>
#include <string.h>

#include "api/simplify.h"
#include "base/diag.h"
#include "dynamics/state.h"

/* ---- entries */

static void add(struct fbd_simplifications *list, struct edit edit, const char *name, const char *change)
{
    if (list->count == list->room || !change) return;
    edit.model = list->model;
    list->edits[list->count] = edit;
    bool whole = edit.kind == edit_linear_scene;
    list->items[list->count++] =
        (fbd_simplification){.body = whole ? "" : list->model->bodies[edit.body].name,
                             .name = name,
                             .change = change,
                             .reason = edit.refusal ? edit.refusal : ""};
}

/* ---- loads */

static const struct load *friction_of(const struct body *body)
{
    for (size_t i = 0; i < body->load_count; i++)
        if (body->loads[i].kind == load_friction) return &body->loads[i];
    return NULL;
}

static void add_load(struct fbd_simplifications *list, int b, int i)
{
    const struct body *body = &list->model->scene->bodies[b];
    const struct load *load = &body->loads[i], *friction = friction_of(body);
    struct edit edit = {.kind = edit_leave_out, .body = b, .index = i};
    if (load->reaction) return; /* removed with its counterpart */
    if (load->kind == load_normal && friction)
        edit.refusal =
            arena_printf(&list->arena, "`%s` needs it: no other force presses the surfaces together",
                         friction->name);
    add(list, edit, load->name, "left out");
}

static bool same_constant(const struct value *a, const struct value *b)
{
    if (!a->expr || !b->expr) return true;
    bool one_law = a->at.line == b->at.line && a->at.column == b->at.column; /* of rest and motion */
    return one_law || (expr_is_constant(a->expr) && expr_is_constant(b->expr) &&
                       expr_value(a->expr) == expr_value(b->expr));
}

static void add_friction(struct fbd_simplifications *list, int b, int i)
{
    const struct load *load = &list->model->scene->bodies[b].loads[i];
    if (!same_constant(&load->mu_s, &load->mu_k))
        add(list, (struct edit){.kind = edit_static, .body = b, .index = i}, load->name,
            load->kind == load_friction ? "static as kinetic: mu_s = mu_k"
                                        : "static limit as the kinetic one");
    if (load->surface_speed.expr)
        add(list, (struct edit){.kind = edit_surface, .body = b, .index = i}, load->name,
            "the surface at rest");
}

/* ---- equilibria */

static const double *copy_of(struct fbd_simplifications *list, const double *numbers, size_t count)
{
    double *copy = ARENA_ARRAY(&list->arena, count + 1, double);
    if (copy) memcpy(copy, numbers, count * sizeof *copy);
    return copy;
}

/* The equilibrium near the start, or (`at_rest`) the one where the scene comes to rest; NULLs when there is
 * none, or friction permits a range of equilibria. Returns false when memory is out. */
static bool find_equilibrium(struct fbd_simplifications *list, bool at_rest, struct equilibrium *about)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_state *state = fbd_state_new(list->model);
    bool found = errors && state && (!at_rest || fbd_find_equilibrium(state, errors));
    fbd_linearization *linear = found ? fbd_linearize(state, errors) : NULL;
    size_t size = 2 * fbd_model_coordinate_count(list->model);
    *about = (struct equilibrium){NULL, NULL};
    if (linear && fbd_linearization_size(linear) == size)
        *about = (struct equilibrium){copy_of(list, state->y, size),
                                      copy_of(list, fbd_linearization_matrix(linear), size * size)};
    bool done = errors && state && !errors->out_of_memory && !list->arena.failed;
    fbd_linearization_free(linear);
    fbd_state_free(state);
    fbd_errors_free(errors);
    return done;
}

/* ---- nonlinearities */

/* True if no joint connects the body to another one: its equation of motion contains no other mass. */
static bool stands_alone(const struct scene *scene, int b)
{
    bool alone = scene->bodies[b].motion.parent == ground_body;
    for (size_t i = 0; i < scene->body_count; i++) alone = alone && scene->bodies[i].motion.parent != b;
    return alone;
}

/* Linearise gravity on a pivot about the angle at which G is below the axis, modulo full turns the one
 * nearest to the start. */
static void add_linear_gravity(struct fbd_simplifications *list, int b, int i)
{
    const struct fbd_model *model = list->model;
    const struct model_body *body = &model->bodies[b];
    struct vec g = model->scene->gravity;
    double size = body->inertia.mass * vec_norm(g) * body->L, turn = 2 * acos(-1);
    if (!body->joint->has_axis || !(size > 0)) return;
    double hangs = atan2(g.y, g.x) - atan2(body->arm.y, body->arm.x),
           start = model->scene->coordinates[body->first].initial;
    hangs += turn * round((start - hangs) / turn);
    if (fabs(hangs) < 1e-12) hangs = 0;
    const char *change = hangs == 0 ? "linear: sin(theta) -> theta"
                                    : arena_printf(&list->arena, "linear: sin -> angle from %.4g rad", hangs);
    add(list,
        (struct edit){.kind = edit_linear_gravity, .body = b, .index = i, .value = size, .value2 = hangs},
        body->source->loads[i].name, change);
}

/* The largest speed of the body in the run; for a pivot, of the point where the drag acts. */
static double largest_speed(const struct fbd_simplifications *list, const struct model_body *body,
                            struct vec point)
{
    const fbd_motion *motion = &list->motion;
    double most = 0;
    for (size_t k = 0; k < motion->count; k++) {
        const double *v = motion->values + k * list->size + body->first_rate;
        most = fmax(most, body->count > 1 ? hypot(v[0], v[1]) : fabs(v[0]));
    }
    return body->joint->has_axis ? most * vec_norm(vec_sub(point, body->pin)) : most;
}

static void add_linear_drag(struct fbd_simplifications *list, int b, int i)
{
    const struct model_body *body = &list->model->bodies[b];
    const struct load *load = &body->source->loads[i];
    if (load->quadratic == 0 || load_has_wind(load)) return;
    double speed = largest_speed(list, body, list->model->loads[body->first_load + i].point);
    fbd_coordinate coordinate = fbd_model_coordinate(list->model, (size_t)body->first);
    const char *unit = body->joint->has_axis ? "" : coordinate.rate_unit;
    add(list, (struct edit){.kind = edit_linear_drag, .body = b, .index = i, .value = speed}, load->name,
        arena_printf(&list->arena, "linear: |v| v -> %.4g %s v", speed, unit));
}

/* True if a second derivative is nonzero at a sample of the run. */
static bool is_nonlinear(const struct fbd_simplifications *list, const struct expr *expr)
{
    enum { looks = 12 };
    const fbd_motion *motion = &list->motion;
    const int *slots;
    size_t count = expr ? expr_variables(expr, &slots) : 0;
    for (size_t look = 0; count > 0 && look < looks && motion->count > 0; look++) {
        size_t k = look * (motion->count - 1) / (looks - 1);
        const double *y = motion->values + k * list->size;
        for (size_t a = 0; a < count; a++)
            for (size_t c = a; c < count; c++) {
                double by_a, by_c, both;
                expr_eval_second(expr, motion->t[k], y, slots[a], slots[c], NULL, &by_a, &by_c, &both);
                if (both != 0) return true;
            }
    }
    return false;
}

/* True if a potential is not quadratic, so that its force is not linear: the second derivatives differ along
 * the run. */
static bool is_beyond_quadratic(const struct fbd_simplifications *list, const struct expr *expr)
{
    const fbd_motion *motion = &list->motion;
    const int *slots;
    size_t count = expr ? expr_variables(expr, &slots) : 0;
    for (size_t a = 0; a < count; a++) {
        double first = NAN, by_a, by_c, both;
        for (size_t k = 0; k < motion->count; k += 1 + motion->count / 12) {
            expr_eval_second(expr, motion->t[k], motion->values + k * list->size, slots[a], slots[a], NULL,
                             &by_a, &by_c, &both);
            if (isnan(first)) first = both;
            if (fabs(both - first) > 1e-9 * fmax(fabs(both), fabs(first))) return true;
        }
    }
    return false;
}

/* True if the expression contains a position in the world, which is no coordinate: the Taylor polynomial does
 * not cover it. */
static bool reads_places(const struct fbd_simplifications *list, const struct expr *expr)
{
    const int *slots;
    size_t count = expr ? expr_variables(expr, &slots) : 0;
    return count > 0 && slots[count - 1] > 2 * list->model->plan.n;
}

static void add_wind(struct fbd_simplifications *list, int b, int i)
{
    const struct load *load = &list->model->scene->bodies[b].loads[i];
    if (load_has_wind(load))
        add(list, (struct edit){.kind = edit_wind, .body = b, .index = i}, load->name, "in still air");
}

static void add_linear_formula(struct fbd_simplifications *list, int b, int i, struct equilibrium about)
{
    const struct load *load = &list->model->scene->bodies[b].loads[i];
    const struct expr *all[] = {load->value.expr, load->fx.expr, load->fy.expr, load->potential.expr};
    for (int k = 0; k < 4; k++)
        if (reads_places(list, all[k])) return;
    if (load->toward || load_is_placed(load)) return; /* directions and moments are not linearised */
    bool nonlinear = is_beyond_quadratic(list, load->potential.expr), timed = false;
    for (int k = 0; k < 3; k++) nonlinear = nonlinear || is_nonlinear(list, all[k]);
    for (int k = 0; k < 4; k++) timed = timed || (all[k] && expr_uses_time(all[k]));
    if (!nonlinear) return;
    struct edit edit = {.kind = edit_linear_formula, .body = b, .index = i, .about = about};
    if (timed)
        edit.refusal = "it depends on time: there is no one linear law in its place";
    else if (!about.at)
        edit.refusal = "there is no equilibrium near the start to take it about";
    add(list, edit, load->name, "linear about the equilibrium");
}

static bool any_uses_time(const struct scene *scene)
{
    for (size_t b = 0; b < scene->body_count; b++)
        for (size_t i = 0; i < scene->bodies[b].load_count; i++) {
            const struct load *load = &scene->bodies[b].loads[i];
            const struct expr *all[] = {
                load->value.expr,         load->fx.expr,    load->fy.expr,    load->potential.expr,
                load->surface_speed.expr, load->angle.expr, load->couple.expr};
            for (size_t k = 0; k < sizeof all / sizeof *all; k++)
                if (all[k] && expr_uses_time(all[k])) return true;
        }
    return false;
}

/* Linearise the whole scene. In jointed scenes no single nonlinearity can be removed: every term contains
 * sines of sums of angles. Returns false when memory is out. */
static bool add_linear_scene(struct fbd_simplifications *list)
{
    const struct scene *scene = list->model->scene;
    bool jointed = false;
    for (size_t b = 0; b < scene->body_count; b++)
        jointed = jointed || scene->bodies[b].motion.parent != ground_body;
    if (!jointed) return true;
    struct edit edit = {.kind = edit_linear_scene};
    if (!find_equilibrium(list, true, &edit.about)) return false;
    if (list->model->tree->coupling_count > 0)
        edit.refusal = "couplings close loops: its coordinates are not independent";
    else if (any_uses_time(scene))
        edit.refusal = "forces depend on time: there is no place of rest";
    else if (!edit.about.at)
        edit.refusal = "there is no place of rest to take it about";
    add(list, edit, "all", "linear about the place of rest");
    return true;
}

/* ---- inertia */

static void add_inertia(struct fbd_simplifications *list, int b)
{
    const struct model_body *body = &list->model->bodies[b];
    const struct body *source = body->source;
    for (size_t p = 0; source->part_count > 1 && p < source->part_count; p++) {
        const char *name = source->parts[p].name ? source->parts[p].name : "part";
        add(list, (struct edit){.kind = edit_part, .body = b, .index = (int)p}, name,
            source->parts[p].mass < 0 ? "the hole filled" : "its mass left out");
    }
    if (body->joint->angle >= 0 && body->inertia.I_G > 0)
        add(list, (struct edit){.kind = edit_rotary, .body = b}, "I_G",
            body->joint->has_axis ? "all its mass in G" : "no moment of inertia about G");
}

/* ---- couplings: a row of the first body that is not the ground */

static void add_couplings(struct fbd_simplifications *list)
{
    const struct scene *scene = list->model->scene;
    for (int i = 0; i < (int)scene->force_coupling_count; i++) {
        const struct force_coupling *coupling = &scene->force_couplings[i];
        int body = coupling->body[coupling->body[0] == ground_body];
        add(list, (struct edit){.kind = edit_uncouple, .body = body, .index = i}, coupling->load.name,
            "left out");
    }
}

/* ---- the whole */

bool simplify_list(struct fbd_simplifications *list)
{
    const struct scene *scene = list->model->scene;
    enum { kinds_of_a_load = 4 };
    size_t room = 2 + scene->force_coupling_count;
    for (size_t b = 0; b < scene->body_count; b++)
        room += kinds_of_a_load * scene->bodies[b].load_count + scene->bodies[b].part_count + 1;
    list->items = ARENA_ARRAY(&list->arena, room, fbd_simplification);
    list->edits = ARENA_ARRAY(&list->arena, room, struct edit);
    if (list->arena.failed) return false;
    list->room = room;
    struct equilibrium about;
    if (!find_equilibrium(list, false, &about)) return false;
    for (int b = 0; b < (int)scene->body_count; b++) {
        bool alone = stands_alone(scene, b);
        for (int i = 0; i < (int)scene->bodies[b].load_count; i++) {
            const struct load *load = &scene->bodies[b].loads[i];
            bool rubs = load->kind == load_friction || load->kind == moment_friction;
            add_load(list, b, i);
            if (rubs) add_friction(list, b, i);
            add_wind(list, b, i);
            if (load->kind == load_gravity && alone) add_linear_gravity(list, b, i);
            if (load->kind == load_drag && alone) add_linear_drag(list, b, i);
            if (!rubs) add_linear_formula(list, b, i, about);
        }
        add_inertia(list, b);
    }
    add_couplings(list);
    return add_linear_scene(list) && !list->arena.failed;
}

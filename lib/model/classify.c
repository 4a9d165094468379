/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which forces are conservative, and why.
 *
 * A force of one coordinate that depends on that coordinate alone is conservative: V(q) = -integral Q dq. A
 * constant force fixed in the world is so for any motion. A force that depends on time, on a rate or on
 * another body is not; its work is integrated along the motion.
 */
#include "model/builder.h"

#include <string.h>

bool slots_find_constant(struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    const size_t first = 1 + scene_size(scene) + hand_slots;
    if (!scene_holds_inputs(scene)) return true;
    bool *constant = model->constant_slots = ARENA_ARRAY(&model->arena, first + model->absolute_count, bool);
    for (size_t k = 0; constant && k < model->absolute_count; k++)
        constant[first + k] = model->absolutes[k].kind == absolute_input &&
                              scene->parameters[model->absolutes[k].coordinate].call.held;
    return constant != NULL;
}

unsigned formula_slot_depends(const struct model_body *body, int slot)
{
    int index = slot - 1;
    bool own = index >= body->first && index < body->first + body->count;
    bool own_rate = index >= body->first_rate && index < body->first_rate + body->count;
    return own ? depends_place : own_rate ? depends_rate : depends_other;
}

unsigned formula_depends(const struct model_body *body, const struct formula *formula)
{
    if (formula_is_constant(formula)) return 0;
    const int *slots;
    size_t count = expr_variables(formula->expr, &slots);
    unsigned on = expr_uses_time(formula->expr) ? depends_time : 0;
    for (size_t i = 0; i < count; i++) on |= formula_slot_depends(body, slots[i]);
    return on;
}

struct verdict {
    enum potential_kind kind;
    const char *why;
};

static const char *why_not(unsigned on)
{
    if (on & depends_time) return "not conservative: it depends on time";
    if (on & depends_rate) return "not conservative: it depends on velocity";
    return "not conservative: it depends on the motion of another body";
}

/* Classify a constant force on a jointed body: fixed in the world, or turning with the body. */
static struct verdict judge_jointed(const struct model_body *body, const struct model_load *load)
{
    const struct load *source = load->source;
    const enum joint_path path = body->joint->path;
    bool along = path != path_none && !source->angle.expr && !source->fx.expr && !source->fy.expr;
    bool fixed = path == path_line && body->parent == ground_body; /* its frame does not turn */
    if ((along || source->body_frame) && !fixed)
        return (struct verdict){potential_none, "not conservative: it turns with the body"};
    return (struct verdict){potential_constant, "conservative: a constant force, V = -f . p"};
}

/* Switches of the force that exclude a potential by quadrature: relays and tables. */
struct odd_switches {
    bool relay, table;
};

static struct odd_switches odd_switches(const struct model_load *load)
{
    const struct formula *formulas[] = {&load->value, &load->angle, &load->fx, &load->fy};
    struct odd_switches odd = {false, false};
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++) {
        const struct expr *expr = formulas[i]->expr;
        size_t switches = expr ? expr_switches(expr) : 0;
        for (size_t k = 0; k < switches; k++) {
            odd.relay |= expr_switch_remembers(expr, k);
            odd.table |= expr_switch_table(expr, k) != NULL;
        }
    }
    return odd;
}

static struct verdict judge_applied(const struct model_body *body, const struct model_load *load)
{
    unsigned on = formula_depends(body, &load->value) | formula_depends(body, &load->angle) |
                  formula_depends(body, &load->fx) | formula_depends(body, &load->fy);
    bool moment = load->source->kind == moment_applied, jointed = !body->alone;
    bool on_curve = body->joint->path == path_curve, one_coordinate = body->count == 1 && !on_curve;
    if (on & ~(unsigned)depends_place && !load->source->toward)
        return (struct verdict){potential_none, why_not(on)};
    if (on == 0 && !load->source->conservative && !load->source->toward)
        return (struct verdict){
            potential_none,
            "counted as work: a given force (`conservative: true` counts it as potential energy)"};
    if (load->source->toward)
        return (struct verdict){potential_none, "counted as work: it points to a place"};
    if (load_is_placed(load->source) && !body_never_turns(body))
        return (struct verdict){potential_none, "counted as work: its place does not turn with the body"};
    if (moment && on_curve)
        return (struct verdict){potential_none, "counted as work: its angle is no coordinate"};
    struct odd_switches odd = odd_switches(load);
    if (odd.relay)
        return (struct verdict){potential_none, "not conservative: it depends on where the motion came from"};
    if (odd.table && on & depends_place)
        return (struct verdict){potential_none, "counted as work: it depends on the place by a table"};
    if (on & depends_place)
        return one_coordinate && !(jointed && body->parent != ground_body)
                   ? (struct verdict){potential_quadrature,
                                      "conservative: it depends on the one coordinate alone; V by quadrature"}
                   : (struct verdict){potential_none,
                                      "not known to be conservative: it depends on the place in the "
                                      "plane (write it as a `potential` if it has one)"};
    if (jointed && !moment) return judge_jointed(body, load);
    if (moment || body->joint->path == path_line || (load->source->body_frame && one_coordinate))
        return (struct verdict){potential_linear, moment
                                                      ? "conservative: a constant moment, V = -M theta"
                                                      : "conservative: constant along the motion, V = -f x"};
    if (load->source->body_frame && body->joint->angle >= 0)
        return (struct verdict){potential_none, "not conservative: it turns with the body"};
    return (struct verdict){potential_constant, "conservative: a constant force, V = -f . p"};
}

static struct verdict judge(const struct model_body *body, const struct model_load *load)
{
    static const char linear_spring[] = "conservative: V = k (stretch)^2 / 2";
    const char *work = load_law(load->source)->work;
    if (work) return (struct verdict){potential_none, work};
    switch (load->source->kind) {
    case load_gravity:
        if (body->varies)
            return (struct verdict){potential_none, "counted as work: the mass of the body varies"};
        return (struct verdict){potential_gravity, "conservative: V = m g h"};
    case load_rope:
        if (load->source->reels)
            return (struct verdict){potential_none,
                                    "not conservative: the work of its length, a function of t"};
        return (struct verdict){potential_none, "does no work, except when it snaps taut"};
    case load_normal: return (struct verdict){potential_workless, "does no work: it acts across the motion"};
    case load_spring:
        return (struct verdict){load->linked ? potential_link : potential_spring, linear_spring};
    case moment_spring: return (struct verdict){potential_spring, linear_spring};
    case load_drag:
        if (load_has_wind(load->source))
            return (struct verdict){potential_none,
                                    "not conservative: it depends on velocity and on the wind"};
        return (struct verdict){potential_none, "not conservative: it depends on velocity"};
    case load_potential:
    case moment_potential: {
        unsigned on = formula_depends(body, &load->potential);
        if (on & (depends_time | depends_other)) return (struct verdict){potential_none, why_not(on)};
        return (struct verdict){potential_given, "conservative: V is given"};
    }
    default: return judge_applied(body, load);
    }
}

/* In all models of a file, also where the input is a constant: works go on past its changes. */
static struct verdict judge_by_inputs(const struct model_body *body, const struct model_load *load)
{
    struct verdict verdict = judge(body, load);
    struct load source = *load->source;
    struct value *formulas[most_formulas_of_a_load];
    load_formulas(&source, formulas);
    for (size_t k = 0; verdict.kind > potential_workless && k < most_formulas_of_a_load; k++)
        if (formulas[k]->by_input)
            verdict =
                (struct verdict){potential_none, "counted as work: an input may change during the motion"};
    return verdict;
}

/* The coordinate where V = 0: 0, or the start where the force is not finite at 0. `origin` is a state of
 * zeros. */
static double reference_of(const struct fbd_model *model, const struct model_load *load, const double *origin)
{
    const struct formula *formulas[] = {&load->value, &load->angle, &load->fx, &load->fy};
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++)
        if (!formula_is_constant(formulas[i]) && !isfinite(expr_eval(formulas[i]->expr, 0, origin, NULL)))
            return model->scene->coordinates[model->bodies[load->body].first].initial;
    return 0;
}

bool classify_loads(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    const double *origin = ARENA_ARRAY(&model->arena, scene_size(model->scene), double);
    if (!origin) return false;
    for (size_t i = 0; i < model->load_count; i++) {
        struct model_load *load = &model->loads[i];
        struct verdict verdict = judge_by_inputs(&model->bodies[load->body], load);
        load->potential_kind = verdict.kind;
        load->why = verdict.why;
        if (verdict.kind == potential_workless && i >= model->coupled_count) /* of a circle that rolls */
            load->why = "does no work, except when it lands";
        if (verdict.kind == potential_quadrature) load->reference = reference_of(model, load, origin);
    }
    return true;
}

void model_note_potentials(const struct fbd_model *model, fbd_errors *errors)
{
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        const char *reason = strchr(load->why, ':');
        if (!load->source->conservative || load->potential_kind != potential_none || !reason) continue;
        diag_add(errors, FBD_WARNING, "no-potential", load->source->at,
                 "leave `conservative` out: the work of the force is counted as work",
                 "`%s` of `%s` is declared `conservative`, but has no potential energy%s", load->source->name,
                 model->bodies[load->body].name, reason);
    }
}

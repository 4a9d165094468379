/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Enclosures of event functions over a stretch of the motion; watchers_values.c has their values at an
 * instant.
 *
 * They exist for functions of expressions: switches, user events, the speed of a pair on its surface, and the
 * forces on a body with a scalar equation (plan.h).
 */

#include "dynamics/world_refs.h"
#include "events/enclosure.h"
#include "numeric/tolerances.h"

struct enclosure enclose_formula(const struct enclosure_input *input, const struct formula *formula)
{
    if (!formula->expr) return enclosure_point(formula->constant);
    int slides;
    const struct slide *slide = enclose_filippov(input->state, formula, &slides);
    if (slides > 1) return enclosure_everything();
    if (slide) {
        struct enclosure high = enclose_branch(input, formula, slide, 1),
                         low = enclose_branch(input, formula, slide, -1);
        struct enclosure share = enclosure_scale(slide->sign, input->shares[slide->unit]);
        return enclosure_add(enclosure_scale(0.5, enclosure_add(high, low)),
                             enclosure_multiply(share, enclosure_subtract(high, low)));
    }
    const int *branch =
        formula->branch < 0 || !input->state->branch ? NULL : input->state->branch + formula->branch;
    return expr_enclose(formula->expr, input->stretch, input->y, branch);
}

struct enclosure enclose_centred(const struct enclosure_input *input, struct enclosure f)
{
    enclosure_centre(&f, stretch_radius(input->stretch));
    return f;
}

/* ---- sums of forces */

static struct enclosure enclose_sine(const struct enclosure *q, const struct scalar_equation *equation)
{
    const double s = equation->s, c = equation->c;
    struct interval sine = interval_sin(q->value), cosine = interval_cos(q->value);
    struct interval slope = interval_subtract(interval_scale(s, cosine), interval_scale(c, sine));
    return (struct enclosure){interval_add(interval_scale(s, sine), interval_scale(c, cosine)),
                              interval_multiply(slope, q->rate),
                              interval_add(interval_scale(s, interval_sin(q->middle)),
                                           interval_scale(c, interval_cos(q->middle)))};
}

static double signed_square(double v)
{
    return fabs(v) * v;
}

/* -k |v| v, which falls with the slope -2 k |v|. */
static struct enclosure enclose_square(const struct enclosure *v, double k)
{
    struct interval size = interval_hypot(v->value, interval_point(0));
    struct enclosure f = {interval_rising(signed_square, v->value, -HUGE_VAL, HUGE_VAL),
                          interval_multiply(interval_scale(2, size), v->rate),
                          interval_rising(signed_square, v->middle, -HUGE_VAL, HUGE_VAL)};
    return enclosure_scale(-k, f);
}

static struct enclosure add_formulas(const struct enclosure_input *input, struct range list,
                                     struct enclosure sum)
{
    const struct plan *plan = &input->state->model->plan;
    for (int i = list.first; i < list.first + list.count; i++) {
        const struct formula_term *term = &plan->formulas[i];
        struct enclosure value = enclose_formula(input, &term->value);
        sum = enclosure_add(sum, enclosure_scale(term->scale, value));
    }
    return enclose_centred(input, sum);
}

struct enclosure enclose_force(const struct enclosure_input *input, int coordinate)
{
    const struct fbd_model *model = input->state->model;
    const struct scalar_equation *equation = &model->plan.equations[coordinate];
    const struct enclosure *q = &input->y[coordinate], *v = &input->y[model->plan.n + coordinate];
    struct enclosure f = enclosure_point(equation->c0);
    if (equation->kq != 0) f = enclosure_subtract(f, enclosure_scale(equation->kq, *q));
    if (equation->kv != 0) f = enclosure_subtract(f, enclosure_scale(equation->kv, *v));
    if (equation->s != 0 || equation->c != 0) f = enclosure_add(f, enclose_sine(q, equation));
    if (equation->square != 0) f = enclosure_add(f, enclose_square(v, equation->square));
    return add_formulas(input, equation->formulas, f);
}

/* Across the line of a body towards the outside of its surface. */
static struct enclosure enclose_force_across(const struct enclosure_input *input, int body)
{
    const struct fbd_model *model = input->state->model;
    const struct scalar_equation *equation = &model->plan.equations[model->bodies[body].first];
    return add_formulas(input, equation->across_formulas, enclosure_point(equation->across));
}

/* ---- friction */

static bool stays_zero(const struct enclosure_input *input, const struct formula *mu)
{
    const struct enclosure f = enclose_formula(input, mu);
    return f.value.low == 0 && f.value.high == 0;
}

/* Slip velocity of a pair. Friction that is idle throughout (friction_is_idle) has no event. */
static struct enclosure slip_stop(const struct enclosure_input *input, int pair)
{
    const struct fbd_model *model = input->state->model;
    const struct mode *mode = &model->plan.modes[pair];
    if (mode_friction_varies(mode) && stays_zero(input, &mode->mu_s) && stays_zero(input, &mode->mu_k))
        return enclosure_point(HUGE_VAL);
    struct enclosure speed = enclose_formula(input, &mode->surface_speed);
    struct enclosure slip = enclosure_subtract(input->y[model->plan.n + mode->coordinate], speed);
    return enclose_centred(input, enclosure_scale(input->state->slip[pair], slip));
}

struct enclosure enclose_normal_force(const struct enclosure_input *input, int pair)
{
    const struct mode *mode = &input->state->model->plan.modes[pair];
    if (mode->normal_slot < 0) return enclosure_point(1);
    return enclosure_scale(-input->state->pull[pair], enclose_force_across(input, mode->body));
}

/* max(f, g): the rate is that of one of them, or between both. */
static struct enclosure larger_of(struct enclosure f, struct enclosure g)
{
    if (f.value.low >= g.value.high) return f;
    if (g.value.low >= f.value.high) return g;
    return (struct enclosure){{fmax(f.value.low, g.value.low), fmax(f.value.high, g.value.high)},
                              interval_hull(f.rate, g.rate),
                              {fmax(f.middle.low, g.middle.low), fmax(f.middle.high, g.middle.high)}};
}

/* Distances to both friction limits, which share the limit and the friction force. */
static void enclose_stick_limits(const struct enclosure_input *input, const struct watcher *watchers,
                                 size_t count, struct enclosure *out)
{
    int pair = watchers->index;
    const struct mode *mode = &input->state->model->plan.modes[pair];
    for (size_t i = 0; i < count; i++) out[i] = enclosure_point(HUGE_VAL);
    if (input->state->slip[pair] != stick) return;
    struct enclosure press = larger_of(enclose_normal_force(input, pair), enclosure_point(0));
    struct enclosure at_rest = enclosure_multiply(enclose_formula(input, &mode->mu_s), press);
    struct enclosure moving = enclosure_multiply(enclose_formula(input, &mode->mu_k), press);
    struct enclosure limit = larger_of(enclose_centred(input, at_rest), enclose_centred(input, moving));
    struct enclosure push = enclose_force(input, mode->coordinate);
    /* The same tolerance as by friction_rounding. */
    double rounding = round_off(8, interval_size(push.value) + interval_size(limit.value));
    for (size_t i = 0; i < count; i++) {
        struct enclosure f = enclosure_add(limit, enclosure_scale(watchers[i].end == 0 ? 1 : -1, push));
        f.value.high += rounding;
        f.middle.high += rounding;
        out[i] = enclose_centred(input, f);
    }
}

/* ---- by kind */

static bool has_equation(const struct fbd_model *model, int body)
{
    return model->bodies[body].count > 0 && model->plan.equations[model->bodies[body].first].known;
}

bool watchers_can_enclose(const struct fbd_model *model, const struct watcher *watcher)
{
    const struct plan *plan = &model->plan;
    if (watcher->kind == watch_kink) return !plan->kinks[watcher->index].reacts;
    if (watcher->kind == watch_user) return !plan->watches[watcher->index].reacts;
    if (watcher->kind == watch_share) return true;
    if (watcher->kind == watch_gap) return affine_mark_gap(model, watcher->index, NULL);
    if (watcher->kind == watch_lift || watcher->kind == watch_edge) return false;
    if (watcher->kind == watch_contact) return has_equation(model, plan->contacts[watcher->index].body);
    const struct mode *mode = &plan->modes[watcher->index];
    if (mode->coupling >= 0) return false;
    if (watcher->kind == watch_slip_stop) return true;
    bool known = watcher->kind != watch_stick_limit ||
                 !mode->surface_speed.expr; /* it would need the second derivative of the surface speed */
    return known && mode->kind == mode_single && has_equation(model, mode->body);
}

static void enclose_kink(const struct watchers *watchers, const struct watcher_set *set,
                         const struct root_group *group, const struct enclosure_input *input,
                         struct enclosure *out)
{
    const struct watcher *first = &set->watchers[group->first];
    const struct kink *kink = &input->state->model->plan.kinks[first->index];
    const int *branch = input->state->branch + kink->formula.branch;
    expr_enclose_margins(kink->formula.expr, input->stretch, input->y, branch, watchers->margins);
    for (size_t i = 0; i < group->count; i++) {
        bool slid_on = state_sliding(input->state) &&
                       input->state->sliding->slide_at[kink->formula.branch + first[i].part] > 0;
        bool held = watchers->held[kink->formula.branch + first[i].part];
        out[i] =
            slid_on || held ? enclosure_point(HUGE_VAL) : watchers->margins[2 * first[i].part + first[i].end];
    }
}

static struct enclosure enclose_user(const struct watchers *watchers, int index,
                                     const struct enclosure_input *input)
{
    const struct watch *watch = &input->state->model->plan.watches[index];
    int armed = watchers->armed[index];
    if (armed == 0) return enclosure_point(HUGE_VAL);
    struct enclosure difference =
        enclosure_subtract(enclose_formula(input, &watch->left), enclose_formula(input, &watch->right));
    struct enclosure band = enclosure_point(watchers->band[index]);
    return enclose_centred(input, enclosure_add(enclosure_scale(armed, difference), band));
}

/* The weight s of the upper branch, or 1 - s. */
static struct enclosure enclose_share(const struct enclosure_input *input, const struct watcher *watcher)
{
    const struct fbd_state *state = input->state;
    int branch = state->model->plan.kinks[watcher->index].formula.branch + watcher->part;
    int index = state_sliding(state) ? state->sliding->slide_at[branch] : 0;
    if (index == 0) return enclosure_point(HUGE_VAL);
    const struct slide *slide = &state->sliding->slides[index - 1];
    struct enclosure share =
        enclosure_scale(watcher->end == 0 ? slide->sign : -slide->sign, input->shares[slide->unit]);
    return enclosure_add(enclosure_point(0.5 + slide->slack), share);
}

static struct enclosure enclose_one(const struct watchers *watchers, const struct watcher *watcher,
                                    const struct enclosure_input *input)
{
    const struct fbd_model *model = input->state->model;
    int index = watcher->index;
    switch (watcher->kind) {
    case watch_user: return enclose_user(watchers, index, input);
    case watch_contact: {
        const struct contact *contact = &model->plan.contacts[index];
        struct enclosure slack = enclosure_point(watchers_contact_slack(model, NULL, contact));
        return enclose_centred(input, enclosure_subtract(slack, enclose_force_across(input, contact->body)));
    }
    case watch_normal_turns: return enclose_normal_force(input, index);
    case watch_slip_stop:
        return input->state->slip[index] == stick ? enclosure_point(HUGE_VAL) : slip_stop(input, index);
    case watch_share: return enclose_share(input, watcher);
    case watch_gap: return affine_over(&watchers->affine[watcher - watchers->moving.watchers], input->y);
    case watch_lift:
    case watch_edge:
    case watch_kink:
    case watch_stick_limit:
    case watch_one_sided: break;
    }
    return enclosure_everything();
}

/* Do functions of this kind contain forces, and with them weights of sliding modes? */
static bool asks_shares(enum watcher_kind kind)
{
    return kind == watch_share || kind == watch_contact || kind == watch_stick_limit ||
           kind == watch_normal_turns;
}

void watchers_enclose(const struct watchers *watchers, const struct watcher_set *set, size_t group,
                      const struct fbd_state *state, const struct stretch *stretch, const struct enclosure *y,
                      struct enclosure *out)
{
    const struct root_group *those = &set->groups[group];
    struct enclosure_input input = {.state = state, .stretch = stretch, .y = y};
    const struct watcher *first = &set->watchers[those->first];
    if (asks_shares(first->kind) && state_sliding(state)) enclosure_find_weights(&input);
    if (first->kind == watch_kink)
        enclose_kink(watchers, set, those, &input, out);
    else if (first->kind == watch_stick_limit)
        enclose_stick_limits(&input, first, those->count, out);
    else
        for (size_t i = 0; i < those->count; i++) out[i] = enclose_one(watchers, &first[i], &input);
}

/* ---- the components that they read */

static void mark_formula(const struct formula *formula, bool *used)
{
    const int *slots;
    size_t count = formula->expr ? expr_variables(formula->expr, &slots) : 0;
    for (size_t k = 0; k < count; k++) used[slots[k] - 1] = true;
}

static void mark_formulas(const struct plan *plan, struct range list, bool *used)
{
    for (int i = list.first; i < list.first + list.count; i++) mark_formula(&plan->formulas[i].value, used);
}

static void mark_body(const struct fbd_model *model, int body, bool *used)
{
    const struct plan *plan = &model->plan;
    if (!has_equation(model, body)) return;
    for (int i = model->bodies[body].first; i < model->bodies[body].first + model->bodies[body].count; i++) {
        const struct scalar_equation *equation = &plan->equations[i];
        used[i] |= equation->kq != 0 || equation->s != 0 || equation->c != 0;
        used[plan->n + i] |= equation->kv != 0 || equation->square != 0;
        mark_formulas(plan, equation->formulas, used);
        mark_formulas(plan, equation->across_formulas, used);
    }
}

static void mark_friction(const struct fbd_model *model, const struct watcher *watcher, bool *used)
{
    const struct plan *plan = &model->plan;
    const struct mode *mode = &plan->modes[watcher->index];
    mark_formula(&mode->mu_s, used);
    mark_formula(&mode->mu_k, used);
    if (watcher->kind == watch_slip_stop) {
        used[plan->n + mode->coordinate] = true;
        mark_formula(&mode->surface_speed, used);
        return;
    }
    mark_body(model, mode->body, used);
}

/* Mark the variables of a sliding mode's switch, and the forces on the bodies of these coordinates. */
static void mark_share(const struct fbd_model *model, const struct formula *formula, bool *used)
{
    const int *slots;
    size_t count = expr_variables(formula->expr, &slots);
    int n = model->plan.n;
    mark_formula(formula, used);
    for (size_t k = 0; k < count; k++) {
        if (slots[k] > 2 * n) continue;
        int coordinate = (slots[k] - 1) % n;
        used[n + coordinate] = true;
        mark_body(model, model->scene->coordinates[coordinate].body, used);
    }
}

void watchers_mark_used(const struct fbd_model *model, const struct watcher_set *set, bool *used)
{
    const struct plan *plan = &model->plan;
    for (size_t i = 0; i < set->count; i++) {
        const struct watcher *watcher = &set->watchers[i];
        if (!watchers_can_enclose(model, watcher)) continue;
        switch (watcher->kind) {
        case watch_kink: mark_formula(&plan->kinks[watcher->index].formula, used); break;
        case watch_user:
            mark_formula(&plan->watches[watcher->index].left, used);
            mark_formula(&plan->watches[watcher->index].right, used);
            break;
        case watch_contact: mark_body(model, plan->contacts[watcher->index].body, used); break;
        case watch_slip_stop:
        case watch_stick_limit:
        case watch_normal_turns: mark_friction(model, watcher, used); break;
        case watch_gap: affine_mark_gap(model, watcher->index, used); break;
        case watch_lift:
        case watch_edge:
        case watch_one_sided: break;
        case watch_share: mark_share(model, &plan->kinks[watcher->index].formula, used); break;
        }
    }
}

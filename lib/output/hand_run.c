/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/hand_run.h"

#include <math.h>
#include <string.h>

#include "loop/options.h"
#include "output/hand.h"
#include "output/hand_run_judge.h"

enum { most_steps = 400, most_shots = most_steps + most_run_impacts };

/* ---- the bodies and forces that are recorded */

void hand_run_mark(const struct fbd_model *model, const struct expr *expr, bool *bodies)
{
    const struct scene *scene = model->scene;
    const int *slots;
    const size_t n = scene->coordinate_count, first = scene_size(scene) + hand_slots,
                 count = expr ? expr_variables(expr, &slots) : 0;
    for (size_t i = 0; i < count; i++) {
        const size_t k = (size_t)(slots[i] - 1) % hand_sense_size(scene);
        if (k < 2 * n) bodies[scene->coordinates[k % n].body] = true;
        if (k >= first) bodies[model->absolutes[k - first].body] = true;
    }
}

static void mark_lines(struct hand_run *run)
{
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct body *body = &run->model->scene->bodies[b];
        run->place[b] = -1;
        for (size_t i = 0; i < body->hand_count; i++) {
            if (body->hands[i].kind == hand_of_states) continue;
            if (run->place[b] < 0) run->place[b] = (int)run->bodies++;
            run->named_bodies[b] = true;
            hand_run_mark(run->model, body->hands[i].left, run->named_bodies);
            hand_run_mark(run->model, body->hands[i].right, run->named_bodies);
        }
    }
}

static bool list_agents(struct hand_run *run)
{
    const struct fbd_model *model = run->model;
    size_t room = 0;
    for (size_t b = 0; b < model->body_count; b++)
        if (run->named_bodies[b]) room += diagram_arrows(model, (int)b);
    run->agents = ARENA_ARRAY(&run->arena, room + 1, struct agent);
    struct instant at = state_instant(run->state);
    for (size_t b = 0; run->agents && b < model->body_count; b++) {
        if (!run->named_bodies[b]) continue;
        const size_t count = diagram_fill(model, (int)b, &at, run->state->slots, run->named.arrows);
        for (size_t i = 0; i < count; i++)
            run->agents[run->agent_count++] = (struct agent){(int)b, i, run->named.arrows[i].name};
    }
    return run->agents != NULL;
}

/* ---- works and impulses */

const struct arrow *hand_run_arrow(struct hand_run *run, const struct hand_force *force)
{
    struct instant at = state_instant(run->state);
    diagram_fill(run->model, force->name.body, &at, run->state->slots, run->named.arrows);
    return &run->named.arrows[force->arrow];
}

/* True if a load acts on one moving body only. */
static bool is_of_one_body(const struct fbd_model *model, int load)
{
    if (load < 0) return false;
    if ((size_t)load < model->coupled_count)
        return model->loads[load].in_joint ? model->bodies[model->loads[load].body].parent < 0
                                           : model->loads[load].partner < 0;
    for (int i = 0; i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        int moving = 0;
        for (int end = 0; end < coupling->end_count; end++) moving += coupling->end[end].body != ground_body;
        if (coupling->load == load) return moving == 1;
    }
    return false;
}

bool hand_run_is_impulsive(const struct fbd_model *model, int load)
{
    if (load < 0 || (size_t)load >= model->coupled_count) return true;
    const struct load *source = model->loads[load].source;
    return source->kind == load_normal || source->kind == load_friction || source->kind == moment_friction;
}

enum { covered = -2 };

/* The number of arrows of a body that belong to a load: a contact with two points is one load. */
static size_t count_arrows(struct hand_run *run, int body, int load)
{
    struct instant at = state_instant(run->state);
    const size_t arrows = diagram_fill(run->model, body, &at, run->state->slots, run->named.arrows);
    size_t count = 0;
    for (size_t i = 0; i < arrows; i++) count += run->named.arrows[i].load == load;
    return count;
}

/* The load with the work of force i of a sum: `covered` if that work is counted with another force of the
 * sum, -1 if there is none, or if it includes forces that are not in the sum. */
static int load_of(struct hand_run *run, const struct hand_sum *sum, size_t i)
{
    struct coupling_place place;
    const struct hand_force *force = sum->forces[i];
    const struct arrow *arrow = hand_run_arrow(run, force);
    const int load = arrow->load;
    const bool of_coupling = coupling_of_force(run->model, force->name.body, arrow->name, &place);
    const int of_all = load < 0 && of_coupling ? run->model->tree->couplings[place.coupling].load : load;
    size_t own = 0, before = 0;
    for (size_t k = 0; of_all >= 0 && k < sum->count; k++) {
        const bool same = hand_run_arrow(run, sum->forces[k])->load == of_all;
        own += same;
        before += same && k < i;
    }
    if (own == 0 || own < count_arrows(run, force->name.body, of_all)) return -1;
    return load < 0 || before > 0 ? covered : load;
}

static void choose_ledger(struct hand_run *run)
{
    for (size_t k = 0; k < run->model->absolute_count; k++) {
        const struct hand_sum *sum = &run->named.of[k];
        run->by_ledger[k] = run->model->absolutes[k].kind == absolute_work;
        for (size_t i = 0; i < sum->count; i++) {
            const int load = load_of(run, sum, i);
            run->by_ledger[k] &= load == covered || is_of_one_body(run->model, load);
        }
    }
}

/* Add `weight` times the rates of all integrals at a state. */
static void add_rates(struct hand_run *run, double weight)
{
    const struct fbd_model *model = run->model;
    struct instant at = state_instant(run->state);
    int body = -1;
    for (size_t k = 0; k < model->absolute_count; k++)
        if (is_integral(run->model, k) && !run->by_ledger[k])
            run->integrals[k] += weight * hand_named_rate(run->state, &run->named, k);
    for (size_t i = 0; i < run->agent_count; i++) {
        const struct agent *agent = &run->agents[i];
        const struct arrow *arrow = &run->named.arrows[agent->arrow];
        double *sums = run->integrals + model->absolute_count + i * agent_parts;
        if (agent->body != body) diagram_fill(model, agent->body, &at, run->state->slots, run->named.arrows);
        body = agent->body;
        sums[by_work] += weight * arrow->power;
        sums[by_x] += weight * arrow->force.x;
        sums[by_y] += weight * arrow->force.y;
        for (int c = 0; c < model->bodies[body].count; c++)
            sums[by_coordinate + c] += weight * arrow->share[c];
    }
}

/* Integrate by Gauss's rule with five points over a part of the last step, as in the ledger. */
static bool integrate(struct hand_run *run, double from, double to)
{
    static const double point[] = {-0.90617984593866396, -0.53846931010568311, 0, 0.53846931010568311,
                                   0.90617984593866396};
    static const double gauss[] = {0.23692688505618908, 0.47862867049936647, 0.56888888888888889,
                                   0.47862867049936647, 0.23692688505618908};
    const double half = (to - from) / 2;
    for (int k = 0; half > 0 && k < 5; k++) {
        if (!ensemble_look(run->ensemble, from + half * (1 + point[k]), run->state)) return false;
        add_rates(run, half * gauss[k]);
    }
    return true;
}

/* ---- shots */

/* The works of a sum from the ledger; `without`: works of impacts to be excluded, or NULL. */
static double ledger_sum(struct hand_run *run, size_t k, const double *without)
{
    const struct hand_sum *sum = &run->named.of[k];
    double work = 0;
    for (size_t i = 0; i < sum->count; i++) {
        const int load = load_of(run, sum, i);
        if (load == covered) continue;
        work += ledger_work(&run->ledger, run->state, (size_t)load, run->works);
        if (without && run->ledger.counted[load]) work -= run->ledger.struck[load] - without[load];
    }
    return work;
}

/* Write the values of all names in lines, at run->state. */
static void write_names(struct hand_run *run, const double *without, double *y)
{
    const struct fbd_model *model = run->model;
    const size_t room = hand_room(model), first = plan_size(&model->plan) + hand_slots;
    for (size_t b = 0; b < model->body_count; b++) {
        if (run->place[b] < 0) continue;
        double *own = y + (size_t)run->place[b] * room;
        hand_extend(run->state, (int)b, &run->named, own);
        for (size_t k = 0; k < model->absolute_count; k++)
            if (is_integral(run->model, k))
                own[first + k] = run->by_ledger[k] ? ledger_sum(run, k, without) : run->integrals[k];
    }
}

/* Set run->state to the end of the last step before its impacts. */
static bool look_before(struct hand_run *run)
{
    const struct ensemble *ensemble = run->ensemble;
    if (!ensemble_look_before(run->ensemble, ensemble->t, run->state)) return false;
    for (size_t g = 0; g < ensemble->count; g++) {
        const struct group *group = &ensemble->groups[g];
        if (group->run->state->t != ensemble->t) continue;
        for (size_t i = 0; i < plan_size(&group->model->plan); i++)
            run->state->y[group_component(run->model, group, i)] = group->run->work.y[i];
    }
    state_evaluate(run->state);
    return true;
}

/* Drop every second shot of steps. */
static void thin_out(struct hand_run *run)
{
    size_t kept = 1, step = 0;
    for (size_t i = 1; i < run->count; i++) {
        struct run_shot free_one = run->shots[kept];
        if (!run->shots[i].impact && step++ % 2 == 0) continue;
        run->shots[kept] = run->shots[i];
        run->shots[i] = free_one;
        kept++;
    }
    run->count = kept;
    run->every *= 2;
}

/* Works and impulses of impacts before the present ones. */
static const double *struck_before(struct hand_run *run)
{
    double *struck = run->struck + run->model->load_count;
    for (size_t g = 0; g < run->ensemble->count; g++) {
        const struct group *group = &run->ensemble->groups[g];
        const bool now = group->run->state->t == run->ensemble->t;
        for (size_t i = 0; i < group->model->load_count; i++) {
            int load = group_load(group, (int)i);
            struck[load] = now ? run->struck[load] : run->ledger.struck[load];
        }
    }
    return struck;
}

/* What stands before the impacts at the end of the last step, and their impulses. */
static bool add_impact(struct hand_run *run, struct run_shot *shot)
{
    const size_t n = run->model->scene->coordinate_count;
    const struct ensemble *ensemble = run->ensemble;
    if (!look_before(run)) return false;
    write_names(run, struck_before(run), shot->before);
    memcpy(run->before, run->state->y + n, n * sizeof *run->before);
    return ensemble_look(run->ensemble, ensemble->t, run->state) &&
           hand_run_add_impact(run, run->before, ensemble_state(run->ensemble)->y + n);
}

/* At the end of the last step, or within it. */
static bool take_shot(struct hand_run *run, double t, bool impact, size_t event)
{
    if (run->count + 1 >= most_shots) thin_out(run);
    struct run_shot *shot = &run->shots[run->count++];
    run->skipped = 0;
    shot->t = t;
    shot->impact = impact;
    shot->event = event;
    if (!ledger_within(&run->ledger, run->ensemble, t, run->works)) return false;
    if (impact && !add_impact(run, shot)) return false;
    if (!ensemble_look(run->ensemble, t, run->state)) return false;
    write_names(run, NULL, shot->y);
    memcpy(shot->done, run->integrals + run->model->absolute_count,
           run->agent_count * agent_parts * sizeof *shot->done);
    return true;
}

/* True if velocities jump at the end of the last step. */
static bool jumps(struct hand_run *run)
{
    const size_t n = run->model->scene->coordinate_count;
    const double *after = ensemble_state(run->ensemble)->y + n;
    if (!look_before(run)) return false;
    return memcmp(run->state->y + n, after, n * sizeof *after) != 0;
}

/* The number of parts of the last step, at whose ends the lines are judged: as required by the integrals. */
static int parts_of_step(const struct hand_run *run)
{
    enum { parts_of_run = 50 };
    const struct ensemble *ensemble = run->ensemble;
    const double part = ensemble->options.until / parts_of_run;
    int parts = part > 0 ? (int)ceil((ensemble->t - ensemble->from) / part) : 1;
    for (size_t g = 0; g < ensemble->count; g++) {
        const int own = run_panels(ensemble->groups[g].run);
        if (own > parts) parts = own;
    }
    return parts;
}

static bool advance(struct hand_run *run)
{
    struct ensemble *ensemble = run->ensemble;
    size_t event = ensemble->event_count;
    ensemble_advance(ensemble);
    run->steps++;
    if (ensemble->outcome == FBD_OUT_OF_MEMORY) return false;
    while (event < ensemble->event_count && !run_event_is_impact(&ensemble->events[event])) event++;
    bool impact = event < ensemble->event_count && jumps(run) && run->impacts++ < most_run_impacts;
    const int parts = parts_of_step(run);
    double from = ensemble->from;
    for (int i = 1; i <= parts; i++) {
        const bool end = i == parts, last = end && ensemble->outcome != FBD_GOING;
        const double to = end ? ensemble->t : ensemble->from + (ensemble->t - ensemble->from) * i / parts;
        if (!integrate(run, from, to)) return false;
        from = to;
        run->skipped++;
        if (!(end && impact) && !last && run->skipped < run->every) continue;
        if (!take_shot(run, to, end && impact, event)) return false;
    }
    return true;
}

/* ---- the run */

static bool observe(void *context, struct ensemble *ensemble, size_t group)
{
    struct hand_run *run = context;
    const struct group *of = &ensemble->groups[group];
    for (size_t i = 0; i < of->model->load_count; i++) {
        int load = group_load(of, (int)i);
        run->struck[load] = run->ledger.struck[load];
    }
    ledger_note(&run->ledger, of);
    return !run->ledger.any || !ledger_counts(&run->ledger, of) || ledger_step(&run->ledger, ensemble, group);
}

static void observe_again(void *context, struct ensemble *ensemble, size_t group)
{
    struct hand_run *run = context;
    if (run->ledger.any) ledger_restart(&run->ledger, ensemble, group);
}

static bool make_shots(struct hand_run *run)
{
    const struct fbd_model *model = run->model;
    run->width = run->bodies * hand_room(model);
    const size_t size = 2 * run->width + run->agent_count * agent_parts;
    run->shots = ARENA_ARRAY(&run->arena, most_shots, struct run_shot);
    run->integrals =
        ARENA_ARRAY(&run->arena, model->absolute_count + run->agent_count * agent_parts + 1, double);
    double *numbers = ARENA_ARRAY(&run->arena, most_shots * size + 1, double);
    for (size_t i = 0; run->shots && numbers && i < most_shots; i++) {
        double *y = numbers + i * size;
        run->shots[i].y = y;
        run->shots[i].before = y + run->width;
        run->shots[i].done = y + 2 * run->width;
    }
    return !run->arena.failed;
}

static bool make_room(struct hand_run *run)
{
    const struct fbd_model *model = run->model;
    run->named_bodies = ARENA_ARRAY(&run->arena, model->body_count, bool);
    run->place = ARENA_ARRAY(&run->arena, model->body_count, int);
    run->by_ledger = ARENA_ARRAY(&run->arena, model->absolute_count + 1, bool);
    run->works = ARENA_ARRAY(&run->arena, 3 * model->load_count + 1, double);
    run->before = ARENA_ARRAY(&run->arena, model->scene->coordinate_count + 1, double);
    run->state = state_new(model);
    if (run->arena.failed || !run->state || !hand_named_find(model, &run->arena, &run->named)) return false;
    run->struck = run->works + model->load_count;
    if (!ensemble_look(run->ensemble, run->ensemble->t, run->state)) return false;
    mark_lines(run);
    return list_agents(run) && make_shots(run) && ledger_init(&run->ledger, model, run->state, true);
}

bool hand_run_make(struct hand_run *run, const struct fbd_model *model, fbd_errors *errors)
{
    const double coarsest = 1e-10; /* a false line may be within the error of a coarser run */
    fbd_options given = FBD_OPTIONS_DEFAULT;
    struct run_options options;
    const double tolerance = model->scene->simulate.tolerance;
    *run = (struct hand_run){.model = model, .every = 1};
    given.method = "auto";
    given.tolerance = tolerance > 0 ? fmin(tolerance, coarsest) : coarsest;
    if (!options_choose(model, &given, &options, errors)) return false;
    options.step = 0; /* steps of given size have no tolerance */
    run->ensemble = ensemble_new(model, &options);
    bool done = run->ensemble && make_room(run);
    if (done) {
        choose_ledger(run);
        run->ensemble->observer = (struct observer){run, observe, observe_again};
        done = take_shot(run, run->ensemble->t, false, 0);
    }
    while (done && run->ensemble->outcome == FBD_GOING) done = advance(run);
    run->no_memory = !done;
    if (!done) diag_out_of_memory(errors);
    return done;
}

void hand_run_free(struct hand_run *run)
{
    if (run->ledger.model) ledger_free(&run->ledger);
    state_free(run->state);
    if (run->ensemble) ensemble_free(run->ensemble);
    arena_free(&run->arena);
    *run = (struct hand_run){.model = NULL};
}

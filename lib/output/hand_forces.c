/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/hand_forces.h"

#include <string.h>

#include "base/diag.h"
#include "dynamics/constraint_view.h"
#include "dynamics/mass.h"
#include "section/name.h"

/* ---- sizes */

static const struct model_load *load_of(const struct fbd_model *model, const struct arrow *arrow)
{
    return arrow->load >= 0 ? &model->loads[arrow->load] : NULL;
}

/* True if the rows are the normal and tangential components at a surface. */
static bool is_surface(const struct coupling *coupling)
{
    return coupling->law->surface || coupling->kind == constraint_slot;
}

/* True if the force of a coupling has a direction of its own there, as that of a coordinate; false for a rope that
 * passes over a point of the body. */
static bool coupling_has_size(const struct coupling *coupling, int end)
{
    bool corner = coupling->law->way && !coupling->law->strands && end > 0 && end + 1 < coupling->end_count;
    if (coupling->kind == constraint_ratio) return true;
    return coupling->law->strands || (coupling->law->length && !corner) || is_surface(coupling);
}

static double coupling_size(const struct fbd_model *model, const struct coupling_place *place,
                            const struct instant *at, const struct arrow *arrow)
{
    const struct coupling *coupling = &model->tree->couplings[place->coupling];
    const struct row *row = &at->tree->rows[coupling->first_row];
    if (coupling->law->strands) {
        double tension[2];
        constraint_forms[coupling->kind].tensions(model, at->tree, place->coupling, tension);
        return tension[place->strand];
    }
    if (coupling->law->length) return -row->lambda;
    if (coupling->kind == constraint_ratio) return row->lambda * coupling->source->terms[place->end].factor;
    struct vec normal = {0, 0};
    for (int i = 0; i < row->port_count; i++)
        if (row->ports[i].end == place->end) normal = vec_add(normal, row->ports[i].force);
    if (place->part == 0) return row->lambda * vec_norm(normal);
    const double length = vec_norm(normal); /* zero where bodies are apart */
    return length > 0 ? vec_cross(normal, arrow->force) / length : 0;
}

/* Tension of a spring or damper between points. */
static double pull_of(const struct fbd_model *model, int body, const struct arrow *arrow,
                      const struct instant *at)
{
    const struct model_load *load = load_of(model, arrow);
    if (load->source->guided) /* along its direction on the first body */
        return formula_value(&load->value, at);
    struct vec other =
        load->body == body ? other_end(model, load, at).p : load_arrow(model, arrow->load, at, NULL).point;
    struct vec away = vec_sub(other, arrow->point);
    return vec_dot(arrow->force, away) / vec_norm(away);
}

static bool acts_along(const struct fbd_model *model, int body)
{
    return model->bodies[body].joint->path != path_none;
}

/* True if the force has a size, with a sign. */
static bool has_size(const struct fbd_model *model, const struct arrow *arrow,
                     const struct force_symbol *symbol, int body)
{
    struct coupling_place place;
    const struct model_load *load = load_of(model, arrow);
    if (symbol->moment) return true;
    if (coupling_of_force(model, body, arrow->name, &place))
        return coupling_has_size(&model->tree->couplings[place.coupling], place.end);
    if (!load) return acts_along(model, symbol->joint);
    return load->linked || acts_along(model, load->body);
}

static double size_of(const struct fbd_model *model, const struct hand_force *force, const struct instant *at,
                      const struct arrow *arrow)
{
    struct coupling_place place;
    const struct model_load *load = load_of(model, arrow);
    const double sign = force->symbol->opposite ? -1 : 1;
    const bool rubs = load && (load->source->kind == load_friction || load->source->kind == moment_friction);
    if (force->symbol->moment) return (rubs ? -sign : sign) * arrow->couple;
    if (coupling_of_force(model, force->name.body, arrow->name, &place))
        return coupling_size(model, &place, at, arrow);
    if (force->symbol->joint >= 0)
        return sign * vec_dot(arrow->force, surface_normal(model, &model->bodies[force->symbol->joint], at));
    if (!load) return 0; /* has no size */
    if (load->linked) return pull_of(model, force->name.body, arrow, at);
    return (rubs ? -sign : sign) * vec_dot(arrow->force, body_direction(&model->bodies[load->body], at));
}

double hand_force_value(const struct fbd_model *model, const struct hand_force *force,
                        const struct instant *at, const struct arrow *arrows)
{
    const struct arrow *arrow = &arrows[force->arrow];
    switch (force->part) {
    case hand_force_x: return force->sign * arrow->force.x;
    case hand_force_y: return force->sign * arrow->force.y;
    case hand_force_couple: return force->sign * arrow->couple;
    case hand_force_at_x: return arrow->point.x;
    case hand_force_at_y: return arrow->point.y;
    case hand_force_size: break;
    }
    return size_of(model, force, at, arrow);
}

/* ---- names */

struct naming {
    const struct fbd_model *model;
    struct arena *arena;
    struct hand_forces *forces;
    const struct force_symbol *symbols; /* of the current body, and its arrows */
    const struct arrow *arrows;
    size_t count;
    int body;
};

static const struct dim dim_moment = DIM_INIT(1, 2, -2), dim_force = DIM_INIT(1, 1, -2),
                        dim_length = DIM_INIT(0, 1, 0);

static void add(const struct naming *naming, size_t i, enum hand_force_part part, bool letter, double sign,
                const char *name)
{
    const struct force_symbol *symbol = &naming->symbols[i];
    const bool moment = part == hand_force_couple || (part == hand_force_size && symbol->moment);
    const bool place = part == hand_force_at_x || part == hand_force_at_y;
    const struct dim dim = place ? dim_length : moment ? dim_moment : dim_force;
    if (!name) return;
    naming->forces->list[naming->forces->count++] = (struct hand_force){
        .name = {naming->body, name, letter, dim}, .arrow = i, .part = part, .sign = sign, .symbol = symbol};
}

/* True if its arrow may have a couple beside the force. A weld and a joint that keeps the body from turning have; the
 * couple of a slide on the ground is not computed. */
static bool has_couple(const struct naming *naming, size_t i)
{
    const int joint = naming->symbols[i].joint;
    struct coupling_place place;
    if (naming->symbols[i].moment) return true;
    if (coupling_of_force(naming->model, naming->body, naming->arrows[i].name, &place))
        return coupling_has_couple(&naming->model->tree->couplings[place.coupling]);
    return joint >= 0 && !naming->model->bodies[joint].joint->has_axis && !naming->model->bodies[joint].alone;
}

static void add_letter(const struct naming *naming, size_t i, const char *letter)
{
    const struct force_symbol *symbol = &naming->symbols[i];
    const double sign = symbol->opposite ? -1 : 1;
    if (has_size(naming->model, &naming->arrows[i], symbol, naming->body))
        add(naming, i, hand_force_size, true, 1, letter);
    if (symbol->moment) return;
    add(naming, i, hand_force_x, true, sign, arena_printf(naming->arena, "%s_x", letter));
    add(naming, i, hand_force_y, true, sign, arena_printf(naming->arena, "%s_y", letter));
}

/* True if no other force of the body has this letter. */
static bool is_alone(const struct naming *naming, size_t i)
{
    for (size_t k = 0; k < naming->count; k++)
        if (k != i && strcmp(naming->symbols[k].letter, naming->symbols[i].letter) == 0) return false;
    return true;
}

enum { most_names = 12 }; /* of an arrow */

static void add_names(const struct naming *naming, size_t i)
{
    const struct arrow *arrow = &naming->arrows[i];
    const struct force_symbol *symbol = &naming->symbols[i];
    if (has_size(naming->model, arrow, symbol, naming->body))
        add(naming, i, hand_force_size, false, 1, arrow->name);
    if (!symbol->moment) {
        add(naming, i, hand_force_x, false, 1, arena_printf(naming->arena, "%s.x", arrow->name));
        add(naming, i, hand_force_y, false, 1, arena_printf(naming->arena, "%s.y", arrow->name));
        add(naming, i, hand_force_at_x, false, 1, arena_printf(naming->arena, "%s.at.x", arrow->name));
        add(naming, i, hand_force_at_y, false, 1, arena_printf(naming->arena, "%s.at.y", arrow->name));
    }
    if (has_couple(naming, i))
        add(naming, i, hand_force_couple, false, 1, arena_printf(naming->arena, "%s.moment", arrow->name));
    if (strchr(symbol->text, ' ')) return; /* m g */
    if (strcmp(symbol->text, arrow->name) != 0) add_letter(naming, i, symbol->text);
    if (strcmp(symbol->text, symbol->letter) != 0 && is_alone(naming, i))
        add_letter(naming, i, symbol->letter);
}

bool hand_forces_make(const struct fbd_model *model, struct arena *arena, struct hand_forces *forces)
{
    size_t room = 0;
    for (size_t b = 0; b < model->body_count; b++) room += diagram_arrows(model, (int)b);
    forces->count = 0;
    forces->list = ARENA_ARRAY(arena, most_names * room + 1, struct hand_force);
    struct arrow *arrows = ARENA_ARRAY(arena, diagram_most_arrows(model), struct arrow);
    fbd_state *state = state_new(model);
    if (state) state_evaluate(state);
    const struct force_symbol *const *symbols = state ? symbols_of_forces(state, arena) : NULL;
    bool done = symbols && arrows && forces->list;
    for (size_t b = 0; done && b < model->body_count; b++) {
        struct instant at = state_instant(state);
        struct naming naming = {.model = model,
                                .arena = arena,
                                .forces = forces,
                                .symbols = symbols[b],
                                .arrows = arrows,
                                .body = (int)b};
        naming.count = diagram_fill(model, (int)b, &at, state->slots, arrows);
        for (size_t i = 0; i < naming.count; i++) add_names(&naming, i);
    }
    state_free(state);
    return done && !arena->failed;
}

/* ---- named forces */

static const struct hand_force *find(const struct hand_forces *forces, int body, const char *name)
{
    for (size_t i = 0; i < forces->count; i++)
        if (forces->list[i].name.body == body && strcmp(forces->list[i].name.name, name) == 0)
            return &forces->list[i];
    return NULL;
}

/* Find a force, or those of a symbol. */
static bool find_sum(const struct hand_forces *forces, const struct absolute *absolute, struct arena *arena,
                     struct hand_sum *sum)
{
    const struct signed_force one = {absolute->body, absolute->force, 1};
    const size_t count = absolute->sum ? absolute->sum->count : 1;
    const struct signed_force *list = absolute->sum ? absolute->sum->forces : &one;
    sum->forces = ARENA_ARRAY(arena, count, const struct hand_force *);
    sum->signs = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; sum->forces && sum->signs && i < count; i++) {
        const struct hand_force *force = find(forces, list[i].body, list[i].name);
        if (!force) continue;
        sum->forces[sum->count] = force;
        sum->signs[sum->count++] = list[i].sign;
    }
    return sum->forces && sum->signs;
}

static bool is_of_forces(enum absolute_kind kind)
{
    return kind == absolute_force || kind == absolute_work || kind == absolute_impulse;
}

bool hand_named_find(const struct fbd_model *model, struct arena *arena, struct hand_named *named)
{
    struct hand_forces forces = {0};
    bool any = false;
    for (size_t k = 0; k < model->absolute_count; k++)
        any = any || is_of_forces(model->scene->absolutes[k].kind);
    named->of = ARENA_ARRAY(arena, model->absolute_count + 1, struct hand_sum);
    named->arrows = ARENA_ARRAY(arena, diagram_most_arrows(model), struct arrow);
    named->sizes = ARENA_ARRAY(arena, model->absolute_count + 1, double);
    if (any && !hand_forces_make(model, arena, &forces)) return false;
    for (size_t k = 0; any && named->of && k < model->absolute_count; k++)
        if (is_of_forces(model->scene->absolutes[k].kind) &&
            !find_sum(&forces, &model->scene->absolutes[k], arena, &named->of[k]))
            return false;
    return !arena->failed;
}

/* The value of an acceleration or moment of inertia. */
static double place_value(const struct fbd_state *state, const struct model_absolute *absolute)
{
    const struct model_body *body = &state->model->bodies[absolute->body];
    struct instant at = state_instant(state);
    if (absolute->kind == absolute_acceleration) return state->a[absolute->coordinate];
    if (absolute->kind == absolute_alpha) return body_angular_acceleration(body, &at);
    if (absolute->kind == absolute_inertia) {
        const struct inertia inertia = body_inertia(body, &at);
        struct vec arm = vec_sub(inertia.G, absolute->point);
        return inertia.I_G + inertia.mass * vec_dot(arm, arm);
    }
    struct vec a = point_acceleration(body, absolute->point, &at);
    return absolute->kind == absolute_ax ? a.x : a.y;
}

bool hand_writes(enum absolute_kind kind)
{
    return kind == absolute_acceleration || (kind >= absolute_force && kind <= absolute_section);
}

/* The largest force on a body, and the largest moment about G. */
struct forces_size {
    double force, moment;
};

static struct forces_size size_of_forces(const struct fbd_state *state, int b, const struct hand_named *named)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    struct instant at = state_instant(state);
    struct pose pose = body_pose(body, &at);
    struct vec G = point_motion(body, &pose, body->inertia.G).p;
    struct forces_size size = {0, 0};
    size_t count = diagram_list(model, b, &at, state->slots, named->arrows);
    for (size_t i = 0; i < count; i++) {
        const struct arrow *arrow = &named->arrows[i];
        double force = vec_norm(arrow->force);
        size.force = fmax(size.force, force);
        size.moment = fmax(size.moment, fabs(arrow->couple) + force * vec_norm(vec_sub(arrow->point, G)));
    }
    return size;
}

/* Of an acceleration of body b. */
static double size_of_acceleration(const struct fbd_state *state, int b, bool turns, struct forces_size size)
{
    struct instant at = state_instant(state);
    const struct inertia inertia = body_inertia(&state->model->bodies[b], &at);
    double by = turns ? inertia.I_G : inertia.mass;
    return by > 0 ? (turns ? size.moment : size.force) / by : 0;
}

static double size_of_name(const struct fbd_state *state, const struct model_absolute *absolute,
                           struct forces_size size)
{
    if (absolute->kind == absolute_inertia) return 0;
    return size_of_acceleration(state, absolute->body, absolute->kind == absolute_alpha, size);
}

double hand_slot_size(const struct fbd_state *state, int b, int slot, const struct hand_named *named)
{
    const struct model_body *body = &state->model->bodies[b];
    int part = slot - hand_acceleration;
    if (part < 0 || part >= body->count) return 0;
    return size_of_acceleration(state, b, state->model->scene->coordinates[body->first + part].angle,
                                size_of_forces(state, b, named));
}

static double size_of_force(const struct hand_force *force, struct forces_size size)
{
    if (force->name.dim.mass == 0) return 0; /* a position */
    return force->name.dim.length == dim_moment.length ? size.moment : size.force;
}

/* The section forces of a body, those of `last` if it is of that body. */
static fbd_section *section_of(const struct fbd_state *state, int body, fbd_section *last)
{
    struct diag_call call;
    if (last && last->body == &state->model->bodies[body]) return last;
    fbd_section_free(last);
    fbd_section *section = section_new(state, false, body, diag_begin(&call, NULL));
    diag_end(&call);
    return section;
}

static void write_section(const struct fbd_section *section, const struct absolute *absolute, double *value,
                          double *size)
{
    const double x = absolute->point.where.x;
    *value = section ? section_force_at(section, (enum section_force)absolute->part, x, false) : NAN;
    *size = section ? section->size[absolute->part] : NAN;
}

void hand_named_write(const struct fbd_state *state, const struct hand_named *named, double *places)
{
    const struct fbd_model *model = state->model;
    struct instant at = state_instant(state);
    fbd_section *section = NULL;
    for (size_t k = 0; k < model->absolute_count; k++) {
        const struct model_absolute *absolute = &model->absolutes[k];
        const struct hand_sum *sum = &named->of[k];
        if (!hand_writes(absolute->kind)) continue;
        if (absolute->kind == absolute_section) {
            section = section_of(state, absolute->body, section);
            write_section(section, &model->scene->absolutes[k], &places[k], &named->sizes[k]);
            continue;
        }
        places[k] = named->sizes[k] = 0;
        for (size_t i = 0; i < sum->count; i++) {
            struct forces_size size = size_of_forces(state, sum->forces[i]->name.body, named);
            named->sizes[k] += size_of_force(sum->forces[i], size);
            places[k] += sum->signs[i] * hand_force_value(model, sum->forces[i], &at, named->arrows);
        }
        if (absolute->kind == absolute_force) continue;
        named->sizes[k] = size_of_name(state, absolute, size_of_forces(state, absolute->body, named));
        places[k] = place_value(state, absolute);
    }
    fbd_section_free(section);
}

double hand_named_rate(const struct fbd_state *state, const struct hand_named *named, size_t k)
{
    const struct fbd_model *model = state->model;
    const struct hand_sum *sum = &named->of[k];
    struct instant at = state_instant(state);
    double rate = 0;
    for (size_t i = 0; i < sum->count; i++) {
        const struct hand_force *force = sum->forces[i];
        diagram_fill(model, force->name.body, &at, state->slots, named->arrows);
        rate += model->absolutes[k].kind == absolute_work
                    ? named->arrows[force->arrow].power
                    : sum->signs[i] * hand_force_value(model, force, &at, named->arrows);
    }
    return rate;
}

/* ---- reading */

static struct fbd_model *compile(const struct document *document, const struct override *overrides,
                                 size_t count, fbd_errors *errors)
{
    struct scene *scene = scene_make(document, overrides, count, errors);
    struct fbd_model *model = scene ? model_compile(scene, errors) : NULL;
    if (model) model_note_potentials(model, errors);
    return model;
}

/* The sections that derivations name exist. */
static struct fbd_model *with_sections(struct fbd_model *model, fbd_errors *errors)
{
    bool fine = true;
    for (size_t k = 0; model && k < model->absolute_count; k++) {
        const struct absolute *one = &model->scene->absolutes[k];
        if (one->kind == absolute_section)
            fine = section_exists(model, one->body, one->point.where.x, one->at, errors) && fine;
    }
    if (fine) return model;
    model_free(model);
    return NULL;
}

bool hand_forces_list(const struct fbd_model *model, struct arena *arena, struct document *document)
{
    struct hand_forces forces;
    struct force_name *names = NULL;
    if (hand_forces_make(model, arena, &forces))
        names = ARENA_ARRAY(arena, forces.count + 1, struct force_name);
    for (size_t i = 0; names && i < forces.count; i++) {
        const char *name = forces.list[i].name.name; /* owned by the model */
        names[i] = forces.list[i].name;
        names[i].name = arena_text(arena, name, strlen(name));
    }
    if (arena->failed) names = NULL;
    document->force_names = names;
    document->force_name_count = names ? forces.count : 0;
    return names != NULL;
}

struct fbd_model *hands_compile(const struct document *document, const struct override *overrides,
                                size_t count, fbd_errors *errors)
{
    const struct diag_mark mark = diag_mark(errors);
    struct fbd_model *model = compile(document, overrides, count, errors);
    if (!model || !model->scene->hands_left) return with_sections(model, errors);
    struct document again = *document;
    struct arena arena = {0};
    bool listed = hand_forces_list(model, &arena, &again);
    model_free(model);
    model = NULL;
    diag_take_back(errors, mark);
    if (listed)
        model = compile(&again, overrides, count, errors);
    else
        diag_out_of_memory(errors);
    arena_free(&arena);
    return with_sections(model, errors);
}

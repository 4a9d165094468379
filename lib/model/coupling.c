/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/coupling.h"

#include "model/model.h"

struct coupling_end coupling_end_of(const struct fbd_model *model, int index, int k)
{
    const struct constraint *source = &model->scene->constraints[index];
    struct coupling_end end = {.body = source->body[k], .radius = source->radius[k]};
    const struct point *point = &source->point[k];
    end.point = point->where;
    if (end.body == ground_body) return end;
    const struct model_body *body = &model->bodies[end.body];
    struct vec own = point->kind == point_fixed ? point->where : body->inertia.G;
    end.link = body->place.link;
    end.point = placement_point(&body->place, own);
    return end;
}

static void add_roots(const struct tree *tree, struct coupling *coupling)
{
    for (int k = 0; k < coupling->end_count; k++) {
        int root = tree->links[coupling->end[k].link].root;
        bool known = root == 0;
        for (int i = 0; i < coupling->root_count; i++) known |= coupling->root[i] == root;
        if (!known) coupling->root[coupling->root_count++] = root;
    }
}

double coupling_extent(const struct coupling *coupling)
{
    double extent = 0;
    for (int k = 0; k < coupling->end_count; k++)
        extent = fmax(extent, vec_norm(coupling->end[k].point) + coupling->end[k].radius);
    return extent;
}

/* The length by which the angle of a weld is multiplied: the larger radius of gyration of its bodies, so that its row
 * is of the size of the others. A particle has no angle: 0. */
static double weld_radius(const struct fbd_model *model, const struct constraint *source)
{
    double radius = 0;
    for (int k = 0; k < 2; k++) {
        if (source->body[k] == ground_body) continue;
        const struct model_body *body = &model->bodies[source->body[k]];
        if (body->kind == motion_particle) return 0;
        if (body->inertia.mass > 0) radius = fmax(radius, sqrt(body->inertia.I_G / body->inertia.mass));
    }
    return radius > 0 ? radius : 1;
}

/* A weld of a particle is a pin. */
static void set_weld(const struct fbd_model *model, struct coupling *coupling)
{
    if (coupling->kind != constraint_weld) return;
    coupling->end[0].radius = weld_radius(model, coupling->source);
    if (coupling->end[0].radius > 0) return;
    coupling->row_count--;
    model->tree->row_count--;
}

static struct coupling *add_coupling(struct fbd_model *model, int index, int from, int to)
{
    struct tree *tree = model->tree;
    const struct constraint *source = &model->scene->constraints[index];
    const struct constraint_law *law = &constraint_laws[source->kind];
    struct coupling *coupling = &tree->couplings[tree->coupling_count++];
    *coupling = (struct coupling){.kind = source->kind,
                                  .law = law,
                                  .constraint = index,
                                  .source = source,
                                  .name = source->name,
                                  .first_row = tree->row_count,
                                  .row_count = law->rows - (source->tension > 0),
                                  .length_given = source->length_given,
                                  .length = source->length,
                                  .place = from,
                                  .pair = -1,
                                  .surface = -1,
                                  .normal_row = tree->row_count,
                                  .along_row = tree->row_count + 1,
                                  .resistance = -1,
                                  .meeting = -1};
    tree->row_count += coupling->row_count;
    for (int k = from; k <= to; k++) coupling->end[coupling->end_count++] = coupling_end_of(model, index, k);
    set_weld(model, coupling);
    add_roots(tree, coupling);
    return coupling;
}

bool model_has_speeds_given(const struct fbd_model *model)
{
    if (model_is_driven(model)) return true;
    for (size_t i = 0; i < model->plan.mode_count && model->tree->coupling_count > 0; i++)
        if (model->plan.modes[i].surface_speed.expr) return true;
    for (int i = 0; i < model->tree->coupling_count; i++)
        if (model->tree->couplings[i].surface_speed.expr) return true;
    return false;
}

bool model_is_driven(const struct fbd_model *model)
{
    for (size_t i = 0; i < model->plan.mode_count; i++) {
        const struct mode *hold = &model->plan.modes[i];
        if (hold->kind == mode_drive ||
            (hold->kind == mode_rope && model->tree->couplings[hold->coupling].reels))
            return true;
    }
    return false;
}

void coupling_of_contact(struct fbd_model *model, int index, int meeting)
{
    add_coupling(model, index, 0, 1)->meeting = meeting;
}

static void wind(const struct constraint *source, int end, struct coupling *coupling)
{
    coupling->wound[end] = source->wound[end];
    coupling->spare[end] = source->spare[end];
}

/* A rope is divided at the pulleys that move with it; each piece is a coupling. */
static void add_rope(struct fbd_model *model, int index)
{
    const struct constraint *source = &model->scene->constraints[index];
    int from = 0;
    for (int k = 1; k < source->end_count; k++) {
        bool held = k + 1 == source->end_count || source->radius[k] > 0;
        if (!held) continue;
        struct coupling *coupling = add_coupling(model, index, from, k);
        if (from == 0) wind(source, 0, coupling);
        if (k + 1 == source->end_count) wind(source, 1, coupling);
        coupling->reels = from == 0 && source->reel.expr;
        /* A length in the file is that of the whole rope; pieces keep their length at the start. */
        if (from > 0 || k + 1 < source->end_count) coupling->length_given = false;
        from = k;
    }
}

static void set_line(const struct fbd_model *model, struct coupling *coupling)
{
    const struct constraint *source = coupling->source;
    struct vec e = vec_unit(source->along);
    coupling->e = e;
    if (source->body[1] == ground_body) return;
    const struct placement *place = &model->bodies[source->body[1]].place;
    coupling->e = vec_turn(place->turn, e);
}

/* Friction on a plane has no row of its normal force, and rows in two directions of the plane. */
static void set_plane(struct tree *tree)
{
    struct coupling *coupling = &tree->couplings[tree->coupling_count - 1];
    if (coupling->kind != constraint_plane) return;
    coupling->normal_row = -1;
    coupling->along_row = coupling->first_row;
    tree->plane_count++;
}

/* Rolling resistance and the friction of a gear act along their only row; their normal force is that of the roll or gear
 * before them. */
static void set_resistance(struct tree *tree)
{
    struct coupling *own = &tree->couplings[tree->coupling_count - 1], *roll = own - 1;
    if (own->kind != constraint_resistance) return;
    roll->resistance = tree->coupling_count - 1;
    own->normal_row = roll->first_row;
    own->along_row = own->first_row;
}

static const char *body_name(const struct fbd_model *model, int body)
{
    return body == ground_body ? "ground" : model->bodies[body].name;
}

/* Both strands of a rope with friction on a drum act on the drum. */
static void name_strands(struct fbd_model *model, struct coupling *coupling, int k)
{
    struct coupling_end *end = &coupling->end[k];
    model->bodies[end->body].arrow_count += k == 1 ? 2 : 1;
    end->name[0] = coupling->name;
    for (int strand = 0; k == 1 && strand < 2; strand++)
        end->name[strand] = arena_printf(&model->arena, "%s.%s", coupling->name,
                                         body_name(model, coupling->end[2 * (size_t)strand].body));
}

/* A rope's forces on a pulley are named after the body on the other side, those of a ratio on a body that carries
 * another one after that one; all others after the coupling. */
static void name_end(struct fbd_model *model, struct coupling *coupling, int k)
{
    struct arena *arena = &model->arena;
    struct coupling_end *end = &coupling->end[k];
    const char *const *parts = coupling->law->end_names;
    if (end->body == ground_body) return;
    if (coupling->kind == constraint_capstan) {
        name_strands(model, coupling, k);
        return;
    }
    model->bodies[end->body].arrow_count += parts[1] ? 2 : 1;
    end->name[0] = coupling->name;
    for (int part = 0; parts[1] && part < 2; part++)
        end->name[part] = arena_printf(arena, "%s%s", coupling->name, parts[part]);
    if (coupling->kind == constraint_rope && end->radius > 0 && coupling->wound[k > 0] == 0)
        end->name[0] = arena_printf(arena, "%s.%s", coupling->name,
                                    body_name(model, coupling->end[k == 0 ? 1 : k - 1].body));
    if (coupling->kind == constraint_ratio && coupling->source->terms[k].opposite)
        end->name[0] =
            arena_printf(arena, "%s.%s", coupling->name, body_name(model, coupling->end[k - 1].body));
}

static void name_rows(struct arena *arena, struct coupling *coupling)
{
    for (int k = 0; k < coupling->row_count; k++) {
        const char *before = coupling->law->row_names[k].before, *behind = coupling->law->row_names[k].behind;
        coupling->row_name[k] =
            before ? arena_printf(arena, "%s%s%s", before, coupling->name, behind) : coupling->name;
    }
}

const char *coupling_row_name(const struct tree *tree, int row)
{
    const struct coupling *coupling = &tree->couplings[tree->coupling_of_row[row]];
    return coupling->row_name[row - coupling->first_row];
}

const char *coupling_force_name(const struct tree *tree, int row)
{
    const struct coupling *coupling = &tree->couplings[tree->coupling_of_row[row]];
    bool parts = coupling->law->surface && coupling->end[0].name[1];
    return parts ? coupling->end[0].name[row - coupling->first_row] : coupling_row_name(tree, row);
}

bool couplings_build(struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    struct tree *tree = model->tree;
    if (scene->constraint_count == 0) return true;
    size_t most = 0, meetings = 0;
    for (size_t c = 0; c < scene->constraint_count; c++) {
        bool contact = scene->constraints[c].kind == constraint_contact;
        size_t here = contact ? (size_t)meetings_most(model, (int)c) : 0;
        most += contact ? 2 * here : (size_t)scene->constraints[c].end_count;
        meetings += here;
    }
    tree->couplings = ARENA_ARRAY(&model->arena, most, struct coupling);
    tree->meetings = ARENA_ARRAY(&model->arena, meetings, struct meeting);
    if (!tree->couplings || !tree->meetings) return false;
    for (size_t c = 0; c < scene->constraint_count; c++) {
        const struct constraint *source = &scene->constraints[c];
        if (source->kind == constraint_contact) {
            if (!meetings_add(model, (int)c)) return false;
        } else if (source->kind == constraint_rope)
            add_rope(model, (int)c);
        else
            set_line(model, add_coupling(model, (int)c, 0, source->end_count - 1));
        if (source->kind == constraint_resistance) set_resistance(tree);
        if (source->kind == constraint_plane) set_plane(tree);
    }
    if (!meetings_level(model)) return false;
    for (int i = 0; i < tree->coupling_count; i++) {
        name_rows(&model->arena, &tree->couplings[i]);
        for (int k = 0; k < tree->couplings[i].end_count; k++) name_end(model, &tree->couplings[i], k);
    }
    return !model->arena.failed;
}

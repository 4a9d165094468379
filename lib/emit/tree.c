/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The articulated-body recursion of dynamics/tree.h, unrolled: one line for each body in each pass.
 */

#include "emit/bodies.h"
#include "emit/placed.h"

/* The loads on the links, in the order of summation. */
struct tree_writer {
    struct emitter *emitter;
    struct text following, forces, moments, springs, drags;
};

static const char *link_name(const struct emitter *emitter, int link)
{
    return link == 0 ? "ground" : emitter->body[emitter->model->tree->links[link].body];
}

/* ---- constants of links */

static const char *place_of(struct emitter *emitter, int b, const char *point)
{
    return emit_printf(emitter, "place_point(&c->%s.place, %s)", emitter->body[b], point);
}

static void derive_place(struct emitter *emitter, int b)
{
    const struct model_body *body = &emitter->model->bodies[b];
    const struct motion *motion = &body->source->motion;
    struct text *out = &emitter->derive;
    const char *name = emitter->body[b];
    if (body->joint->has_axis)
        text_printf(out, "    c->%s.place = (struct place){vec_scale(-1, c->%s.pin), {1, 0}, 0};\n", name,
                    name);
    else if (body->count > 0)
        text_printf(out, "    c->%s.place = (struct place){{0, 0}, {1, 0}, 0};\n", name);
    if (body->count > 0) return;
    const char *parent = emitter->body[motion->parent];
    const char *angle = emit_parameter(emitter, emit_join(emitter, name, "angle"), motion->along,
                                       (struct emit_origin){motion->at, "angle", DIM_NONE, -1});
    const char *at = emit_vector(emitter, emit_join(emitter, name, "at"), motion->through,
                                 (struct emit_origin){motion->at, "at", DIM_LENGTH, motion->parent});
    const char *point = emit_vector(emitter, emit_join(emitter, name, "point"), motion->point,
                                    (struct emit_origin){motion->at, "point", DIM_LENGTH, b});
    text_printf(out, "    c->%s.place.turn = vec_turn(c->%s.place.turn, vec_unit(%s));\n", name, parent,
                angle);
    text_printf(out, "    c->%s.place.shift = vec_sub(%s, vec_turn(c->%s.place.turn, %s));\n", name,
                place_of(emitter, motion->parent, at), name, point);
    text_printf(out, "    c->%s.place.angle = c->%s.place.angle + %s;\n", name, parent, angle);
}

static void derive_link(struct emitter *emitter, int b)
{
    const struct model_body *body = &emitter->model->bodies[b];
    const struct motion *motion = &body->source->motion;
    struct text *out = &emitter->derive;
    const char *name = emitter->body[b];
    bool slide = body->joint->path == path_line, on_ground = motion->parent == ground_body;
    const char *at =
        emit_vector(emitter, emit_join(emitter, name, "at"), motion->through,
                    (struct emit_origin){motion->at, slide ? "through" : "at", DIM_LENGTH, motion->parent});
    const char *e = slide ? emit_printf(emitter, "c->%s.e", name) : "((struct vec){1, 0})";
    const char *along = slide ? emit_printf(emitter, "c->%s.along", name) : "0";
    if (on_ground) {
        text_printf(out, "    c->%s.link.at = %s;\n    c->%s.link.e = %s;\n    c->%s.link.along = %s;\n",
                    name, at, name, e, name, along);
        if (slide) text_printf(out, "    c->%s.link.n = c->%s.n;\n", name, name);
        return;
    }
    const char *parent = emitter->body[motion->parent];
    text_printf(out, "    c->%s.link.at = %s;\n", name, place_of(emitter, motion->parent, at));
    text_printf(out, "    c->%s.link.e = vec_turn(c->%s.place.turn, %s);\n", name, parent, e);
    text_printf(out, "    c->%s.link.along = %s + c->%s.place.angle;\n", name, along, parent);
    if (slide)
        text_printf(out, "    c->%s.link.n = vec_turn(c->%s.place.turn, c->%s.n);\n", name, parent, name);
}

static void derive_links(struct emitter *emitter)
{
    const struct tree *tree = emitter->model->tree;
    text_add(&emitter->derive, "\n    /* links: bodies with all that is welded to them */\n");
    for (int i = 0; i < tree->joined_count; i++) {
        int b = tree->bodies[i];
        const struct model_body *body = &emitter->model->bodies[b];
        if (body->count > 0) derive_link(emitter, b);
        derive_place(emitter, b);
        text_printf(&emitter->derive, "    add_mass(&c->%s.link, &c->%s, %s);\n",
                    link_name(emitter, body->place.link), emitter->body[b],
                    place_of(emitter, b, emit_printf(emitter, "c->%s.G", emitter->body[b])));
    }
}

/* ---- loads */

static void world_force(struct emitter *emitter, const struct model_load *load, const char *point,
                        const char *force)
{
    text_printf(&emitter->derive, "    add_world_force(&c->%s.link, %s, %s); /* %s.%s */\n",
                link_name(emitter, emitter->model->bodies[load->body].place.link),
                place_of(emitter, load->body, point), force, emitter->body[load->body], load->source->name);
}

/* Write a constant force and couple that turn with the link of body b. */
static void following(struct tree_writer *writer, const struct model_load *load, int b, const char *suffix,
                      const char *point, const char *force, const char *couple)
{
    struct emitter *emitter = writer->emitter;
    const char *owner = emitter->load[load - emitter->model->loads];
    const char *name = emit_constant(emitter, "struct following", emit_join(emitter, owner, suffix));
    const char *link = link_name(emitter, emitter->model->bodies[b].place.link);
    text_printf(&emitter->derive, "    c->%s = follow(&c->%s.place, %s, %s, %s);\n", name, emitter->body[b],
                point, force, couple);
    text_printf(&writer->following, "    apply_following(&l->%s, &c->%s); /* %s */\n", link, name,
                load->source->name);
}

static void varying(struct tree_writer *writer, const struct model_load *load, const char *point, bool frame,
                    const char *value, const char *angle)
{
    struct emitter *emitter = writer->emitter;
    const char *owner = emitter->load[load - emitter->model->loads], *body = emitter->body[load->body];
    const char *name = emit_constant(emitter, "struct vec", emit_join(emitter, owner, "place"));
    const char *link = link_name(emitter, emitter->model->bodies[load->body].place.link);
    text_printf(&emitter->derive, "    c->%s = %s;\n", name, place_of(emitter, load->body, point));
    const char *d = frame ? emit_printf(emitter, "vec_turn(l->%s.turn, vec_unit(%s + c->%s.place.angle))",
                                        link, angle, body)
                          : emit_printf(emitter, "vec_unit(%s)", angle);
    text_printf(&writer->forces,
                "    apply(&l->%s, vec_turn(l->%s.turn, c->%s), vec_scale(%s, %s)); /* %s */\n", link, link,
                name, value, d, load->source->name);
}

static void moment(struct tree_writer *writer, const struct model_load *load, const struct formula *formula,
                   const char *value)
{
    static const char *const suffixes[] = {"couple", "opposite"}, none[] = "((struct vec){0, 0})";
    const int bodies[] = {load->body, load->partner};
    for (int end = 0; end < 2 && bodies[end] >= 0; end++) {
        const struct model_body *body = &writer->emitter->model->bodies[bodies[end]];
        if (formula_is_constant(formula))
            following(writer, load, bodies[end], suffixes[end], none, none,
                      end == 0 ? value : emit_printf(writer->emitter, "-(%s)", value));
        else
            text_printf(&writer->moments, "    l->%s.p_own.moment %s= %s; /* %s */\n",
                        link_name(writer->emitter, body->place.link), end == 0 ? "-" : "+", value,
                        load->source->name);
    }
}

/* Write a force with a direction given by its angle. */
static void directed(struct tree_writer *writer, const struct model_load *load, const struct formula *formula,
                     const char *suffix, const char *value, const char *angle, bool frame)
{
    struct emitter *emitter = writer->emitter;
    const char *point = load_point(emitter, load, emitter->body[load->body]);
    const char *force = emit_printf(emitter, "vec_scale(%s, vec_unit(%s))", value, angle);
    if (!formula_is_constant(formula))
        varying(writer, load, point, frame, value, angle);
    else if (frame)
        following(writer, load, load->body, suffix, point, force, "0");
    else
        world_force(emitter, load, point, force);
}

static void components(struct tree_writer *writer, const struct model_load *load, bool frame)
{
    struct emitter *emitter = writer->emitter;
    directed(writer, load, &load->fx, "x", load_formula(emitter, load, "fx", &load->fx, DIM_FORCE), "0",
             frame);
    directed(writer, load, &load->fy, "y", load_formula(emitter, load, "fy", &load->fy, DIM_FORCE),
             "1.5707963267948966", frame);
}

static void applied(struct tree_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    const struct load *source = load->source;
    if (source->fx.expr || source->fy.expr) {
        components(writer, load, source->body_frame);
    } else {
        const char *value = load_formula(emitter, load, "value", &load->value, DIM_FORCE);
        const char *angle =
            source->angle.expr ? load_formula(emitter, load, "angle", &load->angle, DIM_NONE) : "0";
        const char *point = load_point(emitter, load, emitter->body[load->body]);
        if (!source->angle.expr)
            directed(writer, load, &load->value, "force", value, "0", true);
        else if (formula_is_constant(&load->angle))
            directed(writer, load, &load->value, "force", value, angle, source->body_frame);
        else
            varying(writer, load, point, source->body_frame, value, angle);
    }
    if (load_is_placed(source))
        moment(writer, load, &load->couple, load_formula(emitter, load, "moment", &load->couple, DIM_MOMENT));
}

static void drag(struct tree_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    const struct load *source = load->source;
    const char *link = link_name(emitter, emitter->model->bodies[load->body].place.link);
    if (load_has_wind(source)) components(writer, load, false);
    if (!load_drags_still_air(source)) return;
    const char *owner = emitter->load[load - emitter->model->loads];
    const char *name = emit_constant(emitter, "struct vec", emit_join(emitter, owner, "place"));
    text_printf(&emitter->derive, "    c->%s = %s;\n", name,
                place_of(emitter, load->body, load_point(emitter, load, emitter->body[load->body])));
    const char *linear = load_number(emitter, load, "linear", source->linear, DIM_DAMPING);
    const char *quadratic = load_number(emitter, load, "quadratic", source->quadratic, DIM_QUADRATIC_DRAG);
    text_printf(
        &writer->drags,
        "    apply(&l->%s, vec_turn(l->%s.turn, c->%s), drag(%s, %s, on_link(&l->%s, c->%s).v)); /* %s */\n",
        link, link, name, linear, quadratic, link, name, source->name);
}

/* Write a spring or damper between two points, each fixed in its link. */
static void linked(struct tree_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    const struct fbd_model *model = emitter->model;
    const char *owner = emitter->load[load - model->loads];
    const char *ends[2] = {emit_constant(emitter, "struct vec", emit_join(emitter, owner, "place")),
                           emit_constant(emitter, "struct vec", emit_join(emitter, owner, "end"))};
    const char *a = link_name(emitter, model->bodies[load->body].place.link), *b = "ground";
    const char *anchor = load_anchor(emitter, load);
    text_printf(&emitter->derive, "    c->%s = %s;\n", ends[0],
                place_of(emitter, load->body, load_point(emitter, load, emitter->body[load->body])));
    if (load->partner >= 0) {
        b = link_name(emitter, model->bodies[load->partner].place.link);
        anchor = place_of(emitter, load->partner, anchor);
    }
    text_printf(&emitter->derive, "    c->%s = %s;\n", ends[1], anchor);
    text_printf(&writer->springs,
                "    reach = between(&l->%s, c->%s, &l->%s, c->%s); /* %s */\n"
                "    apply_between(&l->%s, c->%s, &l->%s, c->%s, %s);\n",
                a, ends[0], b, ends[1], load->source->name, a, ends[0], b, ends[1],
                emit_link_force(emitter, load, "reach.p", "reach.v"));
}

static void tree_load(struct tree_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    const char *body = emitter->body[load->body];
    switch (load->source->kind) {
    case load_gravity:
        world_force(emitter, load, emit_printf(emitter, "c->%s.G", body),
                    emit_printf(emitter, "vec_scale(c->%s.mass, c->gravity)", body));
        break;
    case load_applied: applied(writer, load); break;
    case load_drag: drag(writer, load); break;
    case load_spring:
    case load_damper:
    case load_actuator:
        if (load->linked) linked(writer, load);
        break;
    case moment_applied:
        moment(writer, load, &load->value, load_formula(emitter, load, "value", &load->value, DIM_MOMENT));
        break;
    default: break; /* within the joint: bodies.c */
    }
}

static void write_loads(struct tree_writer *writer)
{
    struct emitter *emitter = writer->emitter;
    const struct fbd_model *model = emitter->model;
    struct text lines = {0}, *parts[] = {&writer->following, &writer->forces, &writer->moments,
                                         &writer->springs, &writer->drags};
    for (size_t i = 0; i < model->coupled_count; i++)
        if (!model->bodies[model->loads[i].body].alone) tree_load(writer, &model->loads[i]);
    if (writer->springs.length > 0) text_add(&lines, "    struct motion reach;\n");
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (parts[i]->length > 0) text_add(&lines, parts[i]->data);
        emitter->arena.failed = emitter->arena.failed || parts[i]->failed;
        text_free(parts[i]);
    }
    emitter->walks = lines.length > 0;
    if (lines.length > 0)
        emit_function(&emitter->links,
                      "/* The forces on the links that vary; constant forces are in their bias. */\n"
                      "static void load_links",
                      "const struct scene *s, double t, const double *y, struct links *l", &lines);
    emitter->arena.failed = emitter->arena.failed || lines.failed;
    text_free(&lines);
}

/* ---- passes */

/* Write a function with a line for each link, outward or inward. */
static void write_pass(struct emitter *emitter, const char *head, const char *arguments, bool outward,
                       const char *format(struct emitter *, int))
{
    const struct tree *tree = emitter->model->tree;
    struct text lines = {0};
    for (int k = 1; k < tree->joined; k++) text_add(&lines, format(emitter, outward ? k : tree->joined - k));
    emit_function(&emitter->links, head, arguments, &lines);
    emitter->arena.failed = emitter->arena.failed || lines.failed;
    text_free(&lines);
}

static const char *moved(struct emitter *emitter, int i)
{
    const struct tree_link *link = &emitter->model->tree->links[i];
    const char *name = link_name(emitter, i), *q = emitter->coordinate[link->coordinate],
               *v = emitter->rate[link->coordinate];
    bool one = link_joint(link)->count == 1;
    return emit_printf(emitter, "    move_%s(&l->%s, &l->%s, &c->%s.link, %sy[%s], %sy[%s]);\n",
                       link_joint(link)->name, name, link_name(emitter, link->parent), name, one ? "" : "&",
                       q, one ? "" : "&", v);
}

static const char *biased(struct emitter *emitter, int i)
{
    const struct tree_link *link = &emitter->model->tree->links[i];
    const char *name = link_name(emitter, i), *v = emitter->rate[link->coordinate],
               *on = link_name(emitter, link->parent);
    if (link_joint(link)->has_axis)
        return emit_printf(emitter, "    bias_pivot(&l->%s, &l->%s, &c->%s.link);\n", name, on, name);
    const char *own = link_joint(link)->count == 1
                          ? emit_printf(emitter, "vec_scale(y[%s], l->%s.e)", v, name)
                          : emit_printf(emitter, "vec_turn(l->%s.e, (struct vec){y[%s], y[%s]})", name, v,
                                        emitter->rate[link->coordinate + 1]);
    return emit_printf(emitter, "    bias_sliding(&l->%s, &l->%s, &c->%s.link, %s);\n", name, on, name, own);
}

static const char *pushed(struct emitter *emitter, int i)
{
    const struct tree_link *link = &emitter->model->tree->links[i];
    const char *name = link_name(emitter, i), *slot = emitter->coordinate[link->coordinate];
    const struct joint_type *joint = link_joint(link);
    if (joint->count == 1) return emit_printf(emitter, "    l->%s.g = f[%s];\n", name, slot);
    const char *along = emitter->coordinate[link->coordinate + 1];
    const char *force =
        emit_printf(emitter, "    l->%s.gf = vec_turn(l->%s.e, (struct vec){f[%s], f[%s]});\n", name, name,
                    slot, along);
    if (joint->angle < 0) return force;
    return emit_printf(emitter, "%s    l->%s.g = f[%s];\n", force, name,
                       emitter->coordinate[link->coordinate + joint->angle]);
}

static const char *factored(struct emitter *emitter, int i)
{
    const struct tree_link *link = &emitter->model->tree->links[i];
    const char *name = link_name(emitter, i), *on = link_name(emitter, link->parent);
    if (link_joint(link)->has_axis && link->end == i + 1)
        return emit_printf(emitter, "    factor_last_pivot(&l->%s, &l->%s);\n", name, on);
    return emit_printf(emitter, "    factor_%s(&l->%s, &l->%s);\n", link_joint(link)->name, name, on);
}

static const char *inward(struct emitter *emitter, int i)
{
    const struct tree_link *link = &emitter->model->tree->links[i];
    return emit_printf(emitter, "    inward_%s(&l->%s, &l->%s);\n", link_joint(link)->name,
                       link_name(emitter, i), link_name(emitter, link->parent));
}

static const char *outward(struct emitter *emitter, int i)
{
    const struct tree_link *link = &emitter->model->tree->links[i];
    return emit_printf(emitter, "    outward_%s(&l->%s, &l->%s, &a[%s]);\n", link_joint(link)->name,
                       link_name(emitter, i), link_name(emitter, link->parent),
                       emitter->coordinate[link->coordinate]);
}

static const char *placed_link(struct emitter *emitter, int i)
{
    return emit_printf(emitter, "    start_link(&l->%s, &c->%s.link);\n", link_name(emitter, i),
                       link_name(emitter, i));
}

static const char *cleared(struct emitter *emitter, int i)
{
    return emit_printf(emitter, "    clear_link(&l->%s);\n", link_name(emitter, i));
}

static const char *transmitted(struct emitter *emitter, int i)
{
    return emit_printf(emitter, "    transmit(&l->%s);\n", link_name(emitter, i));
}

static void write_struct(struct emitter *emitter)
{
    struct text *out = &emitter->links;
    text_add(out, "/* The links of the tree, each after the one that it moves on. */\nstruct links {\n    "
                  "struct joint ground");
    for (int i = 1; i < emitter->model->tree->joined; i++) text_printf(out, ", %s", link_name(emitter, i));
    text_add(out, ";\n};\n\n");
}

static void write_sweeps(struct emitter *emitter)
{
    write_pass(emitter,
               "/* Outward: how each link would accelerate if no joint gave way, and the forces that keep it "
               "on that path. */\n"
               "static void bias_links",
               "const struct scene *s, const double *y, struct links *l", true, biased);
    write_pass(emitter, "/* The forces within the joints. */\nstatic void push_joints",
               "const double *f, struct links *l", true, pushed);
    write_pass(emitter, "/* The inertia of each link alone. */\nstatic void start_links",
               "const struct scene *s, struct links *l", true, placed_link);
    write_pass(emitter,
               "/* Inward: the inertia of each link with all that hangs on it. */\nstatic void factor_links",
               "struct links *l", false, factored);
    write_pass(emitter,
               "/* Inward: the forces that keep it on its path, likewise. */\nstatic void pass_links_inward",
               "struct links *l", false, inward);
    write_pass(emitter, "/* Outward: the accelerations of the joints. */\nstatic void give_links_outward",
               "struct links *l, double *a", true, outward);
    if (emitter->model->tree->joined_watched == 0) return;
    write_pass(emitter, "/* The forces that the joints pass to the links. */\nstatic void transmit_links",
               "struct links *l", true, transmitted);
    if (emitter->model->tree->pair_count > 0)
        write_pass(emitter, "/* No forces, for another right-hand side. */\nstatic void clear_links",
                   "struct links *l", true, cleared);
}

void emit_tree(struct emitter *emitter)
{
    const struct tree *tree = emitter->model->tree;
    struct tree_writer writer = {.emitter = emitter};
    if (tree_joins(tree)) {
        derive_links(emitter);
        write_struct(emitter);
        write_pass(emitter, "/* Outward: where each link is and how it moves. */\nstatic void move_links",
                   "const struct scene *s, const double *y, struct links *l", true, moved);
        write_loads(&writer);
        write_sweeps(emitter);
    }
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Free-body diagrams of jointed bodies: every force in a joint is in two of them, equal and opposite.
 *
 * The sweeps give the total wrench of a joint. Minus the listed forces in the joint it is the reaction: of a
 * pivot a force at its axis; of a slide a force across it and the couple that prevents rotation; of a weld,
 * the difference of inertial and all other forces of the body.
 */
#include "dynamics/constraint_view.h"
#include "dynamics/diagram.h"
#include "dynamics/mass.h"

struct vec mass_center(const struct model_body *body, const struct instant *at)
{
    struct pose pose = body_pose(body, at);
    return point_motion(body, &pose, body->inertia.G).p;
}

/* The point of application of the forces in the joint of a guided body: of a slide G, as all points move
 * alike. */
static struct vec guide_point(const struct model_body *body, const struct instant *at)
{
    return body->joint->path == path_curve ? body_link(body, at)->p : mass_center(body, at);
}

struct vec tree_point_acceleration(const struct model_body *body, struct vec place, const struct instant *at)
{
    const struct tree_state *s = body_link(body, at);
    struct vec r = vec_sub(place, s->p);
    struct acceleration A = acceleration_at(s->A, r);
    return vec_sub(A.a, vec_scale(s->omega * s->omega, r));
}

struct vec mass_center_acceleration(const struct model_body *body, const struct instant *at)
{
    return tree_point_acceleration(body, mass_center(body, at), at);
}

double body_angular_acceleration(const struct model_body *body, const struct instant *at)
{
    return body_link(body, at)->A.alpha;
}

struct vec surface_normal(const struct fbd_model *model, const struct model_body *body,
                          const struct instant *at)
{
    return tree_normal(model->tree, at->tree, body->place.link);
}

bool tree_has_more(const struct model_body *body)
{
    if (body->joint->has_axis) return body->parent != ground_body;
    return body->source->motion.turns && (body->inertia.I_G > 0 || body->L > 0);
}

double tree_more(const struct model_body *body, const struct instant *at)
{
    const struct tree_state *s = body_link(body, at);
    struct vec r = vec_turn(s->turn, body->arm);
    if (body->joint->has_axis) return -body_mass(body, at) * vec_cross(r, s->A.a);
    struct vec f = vec_scale(body_mass(body, at), mass_center_acceleration(body, at));
    return -s->turning * (body_inertia(body, at).I_G * body_angular_acceleration(body, at) + vec_cross(r, f));
}

static void oppose(struct arrow *arrow, const char *name)
{
    arrow->name = name;
    arrow->force = vec_scale(-1, arrow->force);
    arrow->couple = -arrow->couple;
}

static struct arrow opposite(struct arrow arrow, const char *name)
{
    oppose(&arrow, name);
    return arrow;
}

/* ---- constraints: the multipliers as forces */

/* The force of the row at end k of its coupling. */
static struct arrow row_arrow(const struct instant *at, const struct row *row, int k, const char *name)
{
    struct arrow arrow = {.name = name, .load = -1};
    double couple = 0;
    for (int i = 0; i < row->port_count; i++) {
        const struct port *port = &row->ports[i];
        if (port->end != k) continue;
        arrow.point = vec_add(at->tree->links[port->link].p, port->arm);
        arrow.force = vec_add(arrow.force, vec_scale(row->lambda, port->force));
        couple += row->lambda * vec_cross(port->arm, port->force);
    }
    /* The stop of a pivot: two forces that form a couple. */
    if (arrow.force.x == 0 && arrow.force.y == 0) arrow.couple = couple;
    return arrow;
}

enum { most_of_an_end = 2 };

/* The strands at end k: a row has its ports at both ends of strand 0, then of strand 1. Strands with friction
 * share the load of that friction. */
static size_t fill_strands(const struct fbd_model *model, int index, int k, const struct instant *at,
                           struct arrow *arrows)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct constraint_form *form = &constraint_forms[coupling->kind];
    const struct row *row = &at->tree->rows[coupling->first_row];
    const char *const *names = coupling->end[k].name;
    double tension[2];
    size_t count = 0;
    form->tensions(model, at->tree, index, tension);
    for (int i = 0; i < row->port_count; i++) {
        const struct port *port = &row->ports[i];
        int strand = i / 2;
        if (port->end != k) continue;
        arrows[count++] =
            (struct arrow){.name = names[1] ? names[strand] : names[0],
                           .load = coupling->law->surface ? coupling->load : -1,
                           .point = vec_add(at->tree->links[port->link].p, port->arm),
                           .force = vec_scale(-tension[strand] / form->share[strand], port->force)};
    }
    return count;
}

/* The forces of a coupling at its end k: one, or for a rolling body those along and normal to its line. */
static size_t fill_end(const struct coupling *coupling, int k, const struct instant *at, struct arrow *arrows)
{
    const struct row *rows = &at->tree->rows[coupling->first_row];
    arrows[0] = row_arrow(at, &rows[0], k, coupling->end[k].name[0]);
    if (coupling->reels || coupling->kind == constraint_resistance || coupling->kind == constraint_plane)
        arrows[0].load = coupling->load; /* other ropes do no net work */
    if (coupling->row_count == 1) return 1;
    arrows[1] = row_arrow(at, &rows[1], k, coupling->end[k].name[1]);
    if (!coupling->law->end_names[1]) {
        arrows[0].force = vec_add(arrows[0].force, arrows[1].force);
        if (coupling_has_couple(coupling)) arrows[0].couple = row_arrow(at, &rows[2], k, NULL).couple;
        return 1;
    }
    arrows[1].load = coupling->load;
    return 2;
}

static size_t fill_coupling(const struct fbd_model *model, int index, int k, const struct instant *at,
                            struct arrow *arrows)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    if (coupling->law->strands) return fill_strands(model, index, k, at, arrows);
    return fill_end(coupling, k, at, arrows);
}

/* All constraint forces on body b; returns their number. */
static size_t fill_couplings(const struct fbd_model *model, int b, const struct instant *at,
                             struct arrow *arrows)
{
    const struct tree *tree = model->tree;
    size_t count = 0;
    for (int i = 0; i < tree->coupling_count; i++)
        for (int k = 0; k < tree->couplings[i].end_count; k++)
            if (tree->couplings[i].end[k].body == b) count += fill_coupling(model, i, k, at, arrows + count);
    return count;
}

/* Names of ends are unique. */
int rope_load(const struct fbd_model *model, int b, const struct arrow *arrow)
{
    for (int i = 0; i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        if (coupling->kind != constraint_rope && !coupling->source->lifetime.begins) continue;
        for (int k = 0; k < coupling->end_count; k++)
            if (coupling->end[k].body == b && coupling->end[k].name[0] == arrow->name) return coupling->load;
    }
    return -1;
}

/* ---- reactions */

/* The force across a slide, and the couple about its point, from the total wrench of its joint minus the
 * listed forces in the joint: `listed`, or NULL where they are not known yet. */
static struct arrow slide_reaction(const struct fbd_model *model, const struct model_body *body,
                                   const struct instant *at, const double *slots, const struct arrow *listed)
{
    const struct tree_state *s = body_link(body, at);
    struct vec across = vec_perp(s->e), P = guide_point(body, at);
    struct vec force = vec_scale(vec_dot(across, s->F.force), across);
    double couple = s->F.moment + vec_cross(vec_sub(s->p, P), s->F.force);
    for (int i = body->first_load; i < body->first_load + body->load_count; i++) {
        if (!model->loads[i].in_joint || model->loads[i].source->kind == load_normal) continue;
        struct arrow arrow = listed ? listed[i - body->first_load] : load_arrow(model, i, at, slots);
        couple -= arrow_moment(&arrow, P);
    }
    /* The reaction that turns a body along a curve has no power: a force along the track belongs to the
     * couple. */
    if (body->kind == motion_track) force = vec_sub(force, vec_scale(s->turning * couple, s->e));
    return (struct arrow){.load = -1, .force = force, .point = P, .couple = couple};
}

/* The first body that is welded to the parent, among b and its later siblings; or -1. */
static int first_welded(const struct fbd_model *model, int b)
{
    while (b >= 0 && model->bodies[b].kind != motion_weld) b = model->bodies[b].sibling;
    return b;
}

/* The body after b among those welded to `on`, directly or indirectly: first the bodies welded to b, then its
 * siblings, then those of its ancestors. -1 after the last. */
static int next_welded(const struct fbd_model *model, int b, int on)
{
    int next = first_welded(model, model->bodies[b].child);
    for (; next < 0 && b != on; b = model->bodies[b].parent)
        next = first_welded(model, model->bodies[b].sibling);
    return next;
}

static void add_arrow(struct wrench *sum, const struct arrow *arrow, struct vec about)
{
    sum->force = vec_sub(sum->force, arrow->force);
    sum->moment -= arrow_moment(arrow, about);
}

/* Add the inertial minus the applied forces of body b, welded to `on`, about `point`, and the wrenches of the
 * joints of bodies that move on it. */
static void add_needs(const struct fbd_model *model, int b, const struct instant *at, const double *slots,
                      struct vec point, struct wrench *sum)
{
    const struct model_body *body = &model->bodies[b];
    struct vec f = vec_scale(body_mass(body, at), mass_center_acceleration(body, at));
    sum->force = vec_add(sum->force, f);
    sum->moment += vec_cross(vec_sub(mass_center(body, at), point), f) +
                   body_inertia(body, at).I_G * body_angular_acceleration(body, at);
    for (int i = body->first_load; i < body->first_load + body->load_count; i++) {
        struct arrow arrow = load_arrow(model, i, at, slots);
        add_arrow(sum, &arrow, point);
    }
    for (size_t i = model->listed_count; i < model->coupled_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (load->body != b && load->partner != b) continue;
        struct arrow arrow = load_arrow(model, (int)i, at, slots);
        arrow.point = load->body == b ? arrow.point : other_end(model, load, at).p;
        if (load->body != b) arrow = opposite(arrow, arrow.name);
        add_arrow(sum, &arrow, point);
    }
    for (int i = 0; i < model->tree->coupling_count; i++)
        for (int k = 0; k < model->tree->couplings[i].end_count; k++)
            if (model->tree->couplings[i].end[k].body == b) {
                struct arrow couplings[most_of_an_end];
                size_t count = fill_coupling(model, i, k, at, couplings);
                for (size_t j = 0; j < count; j++) add_arrow(sum, &couplings[j], point);
            }
    for (int c = body->child; c >= 0; c = model->bodies[c].sibling) {
        const struct tree_state *s = body_link(&model->bodies[c], at);
        if (model->bodies[c].kind == motion_weld) continue;
        wrench_add(sum, s->F, vec_sub(s->p, point));
    }
}

static struct arrow weld_reaction(const struct fbd_model *model, int b, const struct instant *at,
                                  const double *slots)
{
    const struct model_body *body = &model->bodies[b];
    struct pose pose = body_pose(body, at);
    struct vec point = point_motion(body, &pose, body->source->motion.point).p;
    struct wrench sum = {0, {0, 0}};
    for (int i = b; i >= 0; i = next_welded(model, i, b)) add_needs(model, i, at, slots, point, &sum);
    return (struct arrow){.load = -1, .force = sum.force, .point = point, .couple = sum.moment};
}

/* The reaction of the joint of body b, as a force on b; written in place, see pose_arrow. */
static void reaction_fill(const struct fbd_model *model, int b, const struct instant *at, const double *slots,
                          struct arrow *arrow)
{
    const struct model_body *body = &model->bodies[b];
    const struct tree_state *s = body_link(body, at);
    if (body->joint->path != path_none)
        *arrow = slide_reaction(model, body, at, slots, NULL);
    else if (body->kind == motion_weld)
        *arrow = weld_reaction(model, b, at, slots);
    else if (body->kind == motion_particle) /* it does not turn */
        *arrow = (struct arrow){.load = -1, .point = s->p, .couple = s->F.moment};
    else
        *arrow = (struct arrow){.load = -1, .force = s->F.force, .point = s->p};
    arrow->name = body->reaction;
}

/* ---- the whole */

/* The forces in the joint of child c, as they act on its parent. */
static size_t fill_child(const struct fbd_model *model, int c, const struct instant *at, const double *slots,
                         struct arrow *arrows)
{
    const struct model_body *child = &model->bodies[c];
    size_t count = 0;
    for (int i = child->first_load; i < child->first_load + child->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (!load->in_joint) continue;
        struct arrow arrow = load_arrow(model, i, at, slots);
        if (load->source->kind == load_normal) {
            arrow = slide_reaction(model, child, at, slots, NULL);
            arrow.load = i;
        }
        arrows[count++] = opposite(arrow, load->name_on_parent);
    }
    if (child->drive >= 0)
        arrows[count++] = opposite(load_arrow(model, child->drive, at, slots), child->drive_on_parent);
    if (child->reaction) {
        reaction_fill(model, c, at, slots, &arrows[count]);
        oppose(&arrows[count++], child->reaction_on_parent);
    }
    return count;
}

size_t tree_diagram_add(const struct fbd_model *model, int index, const struct instant *at,
                        const double *slots, struct arrow *arrows)
{
    const struct model_body *body = &model->bodies[index];
    size_t count = (size_t)body->load_count;
    for (size_t i = 0; i < count; i++) {
        if (model->loads[arrows[i].load].source->kind != load_normal) continue;
        struct arrow reaction = slide_reaction(model, body, at, slots, arrows);
        reaction.name = arrows[i].name;
        reaction.load = arrows[i].load;
        arrows[i] = reaction;
    }
    for (size_t i = model->listed_count; i < model->coupled_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (load->body != index && load->partner != index) continue;
        struct arrow arrow = load_arrow(model, (int)i, at, slots);
        if (load->body == index) arrows[count++] = arrow;
        if (load->partner != index) continue;
        arrow.point = other_end(model, load, at).p;
        arrows[count++] = opposite(arrow, arrow.name);
    }
    if (body->drive >= 0) arrows[count++] = load_arrow(model, body->drive, at, slots);
    if (model->tree->coupling_count > 0) count += fill_couplings(model, index, at, arrows + count);
    if (body->reaction) reaction_fill(model, index, at, slots, &arrows[count++]);
    for (int c = body->child; c >= 0; c = model->bodies[c].sibling)
        count += fill_child(model, c, at, slots, arrows + count);
    return count;
}

struct balance balance_of(const struct model_body *body, const struct instant *at, const struct arrow *arrows,
                          size_t count)
{
    const struct inertia inertia = body_inertia(body, at);
    struct balance balance = {.m_a = vec_scale(inertia.mass, mass_center_acceleration(body, at)),
                              .I_alpha = inertia.I_G * body_angular_acceleration(body, at)};
    struct vec G = mass_center(body, at);
    double forces = vec_norm(balance.m_a), moments = fabs(balance.I_alpha);
    for (size_t i = 0; i < count; i++) {
        double moment = arrow_moment(&arrows[i], G);
        balance.force = vec_add(balance.force, arrows[i].force);
        balance.moment += moment;
        forces = fmax(forces, vec_norm(arrows[i].force));
        moments = fmax(moments, fabs(moment));
    }
    moments = fmax(moments, forces * sqrt(inertia.I_G / inertia.mass));
    double off = vec_norm(vec_sub(balance.force, balance.m_a));
    double turned = fabs(balance.moment - balance.I_alpha);
    balance.residual = fmax(forces > 0 ? off / forces : 0, moments > 0 ? turned / moments : 0);
    return balance;
}

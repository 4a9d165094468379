/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Common to the files of the constraints: links as jets, and the ports of rows.
 */
#ifndef FBD_DYNAMICS_CONSTRAINT_VIEW_H
#define FBD_DYNAMICS_CONSTRAINT_VIEW_H

#include "dynamics/constraint.h"

/* ---- points, angles and directions of links as jets */

struct view {
    const struct fbd_model *model;
    const struct tree *tree;
    const struct tree_work *work;
    bool varied;
    const struct instant *at;      /* for functions of time, */
    const struct direction *along; /* and their variation, or NULL */
};

/* The links at their positions, without variations or time. */
static inline struct view view_of(const struct fbd_model *model, const struct tree_work *work)
{
    return (struct view){model, model->tree, work, false, NULL, NULL};
}

static const struct tree_variation still = {0};

static inline const struct tree_variation *variation_of(const struct view *view, int link)
{
    return view->varied ? &view->work->variation[link] : &still;
}

static inline struct jet_vec jets(struct vec p, struct vec v, struct vec a, struct vec dp, struct vec dv,
                                  struct vec da)
{
    return (struct jet_vec){{p.x, v.x, a.x, dp.x, dv.x, da.x}, {p.y, v.y, a.y, dp.y, dv.y, da.y}};
}

/* A vector that turns with a link: r' = omega k x r, r'' = alpha k x r - omega^2 r. */
static inline struct jet_vec turning(const struct view *view, int link, struct vec own)
{
    const struct tree_state *s = &view->work->links[link];
    const struct tree_variation *d = variation_of(view, link);
    struct vec r = vec_turn(s->turn, own), k_r = vec_perp(r), dr = vec_scale(d->angle, k_r),
               k_dr = vec_perp(dr);
    double w2 = s->omega * s->omega;
    struct vec v = vec_scale(s->omega, k_r), a = vec_sub(vec_scale(s->A.alpha, k_r), vec_scale(w2, r));
    struct vec dv = vec_add(vec_scale(d->omega, k_r), vec_scale(s->omega, k_dr));
    struct vec da = vec_add(vec_scale(d->A.alpha, k_r), vec_scale(s->A.alpha, k_dr));
    da = vec_sub(da, vec_add(vec_scale(2 * s->omega * d->omega, r), vec_scale(w2, dr)));
    return jets(r, v, a, dr, dv, da);
}

static inline struct jet_vec origin_of(const struct view *view, int link)
{
    const struct tree_state *s = &view->work->links[link];
    const struct tree_variation *d = variation_of(view, link);
    return jets(s->p, s->v, s->A.a, d->p, d->v, d->A.a);
}

static inline struct jet_vec point_of(const struct view *view, const struct coupling_end *end)
{
    struct jet_vec O = origin_of(view, end->link), r = turning(view, end->link, end->point);
    return (struct jet_vec){jet_add(O.x, r.x), jet_add(O.y, r.y)};
}

static inline struct jet angle_of(const struct view *view, int link)
{
    const struct tree_state *s = &view->work->links[link];
    const struct tree_variation *d = variation_of(view, link);
    return (struct jet){s->angle, s->omega, s->A.alpha, d->angle, d->omega, d->A.alpha};
}

/* ---- ports */

/* Add the force f at Q on the link of end k, for a unit multiplier. */
static inline void add_port(const struct view *view, struct row *row, const struct coupling *coupling, int k,
                            struct jet_vec Q, struct jet_vec f)
{
    int link = coupling->end[k].link;
    struct jet_vec arm = jet_vec_sub(Q, origin_of(view, link));
    row->ports[row->port_count++] =
        (struct port){link, k, jet_value(arm), jet_value(f), jet_variation(arm), jet_variation(f)};
}

static inline struct jet_vec negative(struct jet_vec a)
{
    return (struct jet_vec){jet_scale(-1, a.x), jet_scale(-1, a.y)};
}

static inline void start_row(struct row *row, struct jet g)
{
    row->g = g;
    row->surface = 0;
    row->port_count = 0;
}

/* Subtract the nearest multiple of `period`, as the line of centres may have turned round. */
static inline struct jet nearest(struct jet g, double period)
{
    if (period != 0) g.x -= period * round(g.x / period);
    return g;
}

/* A circle at a line: end `k` of the coupling carries the circle. */
struct at_line {
    int k;
    struct coupling_end circle, base;
    struct vec e; /* direction of the line, in the frame of its link */
    double side;  /* the normal is side k x e */
    double moves; /* direction of the moving surface along e, 0 for none */
};

/* The row along the line, and with `normal` also the row normal to it. */
void row_line(const struct view *view, const struct coupling *coupling, const struct at_line *at, double zero,
              struct row *normal, struct row *along);

/* ---- kinds */

/* The functions of a kind of constraint beside its law (scene/constraint.h); NULL where it has none. */
struct constraint_form {
    /* Its rows at the positions of the links, with the ports of their multipliers. */
    void (*rows)(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
                 struct row *rows);

    /* Set its references from the start; `rows` has room for its rows. */
    void (*start)(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                  struct row *rows);

    /* Update the part that depends on the path since. */
    void (*follow)(const struct view *view, const struct coupling *coupling, struct coupling_state *state);

    /* The distance from its ends. */
    struct room (*left)(const struct view *view, const struct coupling *coupling,
                        const struct coupling_state *state, int end);

    /* Of a path round discs: the direction of its first (end 0) or last piece. */
    struct jet_vec (*piece)(const struct view *view, const struct coupling *coupling,
                            const struct coupling_state *state, int end);

    /* The wrap angle: the coefficient of friction is tanh(mu angle / 2), see constraint.h. */
    double (*wrap)(const struct fbd_model *model, const struct instant *at, int index, bool varied,
                   double *variation);

    /* Of two strands: their tensions, and the factors of their forces in the first row. */
    void (*tensions)(const struct fbd_model *model, const struct tree_work *work, int index,
                     double tension[2]);
    double share[2];
};

extern const struct constraint_form constraint_forms[constraint_kinds];

/* Set the zero of its last row to the given length, or to its value at the start. */
void zero_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *rows);

void pin_rows(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
              struct row *rows);

/* Add to a row forces of the given size at the ends of a diameter of radius r: a couple on end 0, its opposite on 1. */
void add_couples(const struct coupling *coupling, double r, double force, struct row *row);

/* constraint_rope.c */
void rope_row(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
              struct row *row);
void rope_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *row);
void rope_start_wrap(const struct tree *tree, struct tree_work *work, int index); /* after all have started */
struct jet_vec rope_end_piece(const struct view *view, const struct coupling *coupling,
                              const struct coupling_state *state, int end);
struct room rope_room(const struct view *view, const struct coupling *coupling,
                      const struct coupling_state *state, int end);
void way_follow(const struct view *view, const struct coupling *coupling, struct coupling_state *state);

void capstan_rows(const struct view *view, const struct coupling *coupling,
                  const struct coupling_state *state, struct row *rows);
void capstan_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                   struct row *rows);
struct jet_vec capstan_piece(const struct view *view, const struct coupling *coupling,
                             const struct coupling_state *state, int strand);

void belt_rows(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
               struct row *rows);
void belt_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *rows);
struct jet_vec belt_piece(const struct view *view, const struct coupling *coupling,
                          const struct coupling_state *state, int strand);

/* constraint_slot.c */
void slot_row(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
              struct row *row);
void slot_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *row);
void slot_follow(const struct view *view, const struct coupling *coupling, struct coupling_state *state);
struct room slot_room(const struct view *view, const struct coupling *coupling,
                      const struct coupling_state *state, int end);

/* constraint_ratio.c */
void ratio_row(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
               struct row *row);

/* constraint_pin.c */
void weld_rows(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
               struct row *rows);
void weld_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *rows);

/* constraint_contact.c: at its feature */
void contact_rows(const struct view *view, const struct coupling *coupling,
                  const struct coupling_state *state, struct row *rows);

#endif

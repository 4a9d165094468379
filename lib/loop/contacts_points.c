/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/contacts_points.h"

#include "dynamics/contact.h"
#include "dynamics/tree_system.h"
#include "loop/contacts.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

/* The scale of a row's velocity: the speeds of its points. */
static double speed_at(const struct run *run, const struct row *row)
{
    double size = 0;
    for (int k = 0; k < row->port_count; k++) {
        const struct tree_state *s = &run->state->tree->links[row->ports[k].link];
        size = fmax(size, vec_norm(s->v) + fabs(s->omega) * vec_norm(row->ports[k].arm));
    }
    return size;
}

double contacts_no_speed(const struct run *run, const struct row *row)
{
    const double rounding = 1e-11, of_all = negligible_part;
    return fmax(rounding * speed_at(run, row), of_all * run->contacts.speed);
}

static double normal_rate(const struct run *run, const struct striker *striker)
{
    double rate = run->state->tree->rows[run->model->tree->couplings[striker->coupling].first_row].g.x1;
    return striker->rope ? -rate : rate;
}

/* Does coupling i take part in impacts in its present mode? */
static bool is_striker(const struct run *run, int i)
{
    const struct coupling *coupling = &run->model->tree->couplings[i];
    if (coupling->kind == constraint_contact) return run->state->tree->couplings[i].feature != no_feature;
    if (coupling->kind == constraint_rope) return run->state->slip[coupling->pair] == stick;
    return coupling_takes_impulses(coupling) && run->state->slip[coupling->surface] == stick;
}

/* ---- coinciding points */

static const struct port *port_on(const struct row *row, int link)
{
    for (int k = 0; k < row->port_count; k++)
        if (row->ports[k].link == link) return &row->ports[k];
    return NULL;
}

/* Are two closed contacts one point: the same links, position and normal? Positions to the touching
 * tolerance, directions to the digits of a file. */
static bool coincide(const struct run *run, int a, int b)
{
    const struct coupling *couplings = run->model->tree->couplings;
    const struct tree_work *work = run->state->tree;
    int first = couplings[a].end[0].link, second = couplings[a].end[1].link, index = couplings[a].meeting;
    bool same = couplings[b].end[0].link == first && couplings[b].end[1].link == second;
    bool swapped = couplings[b].end[0].link == second && couplings[b].end[1].link == first;
    if (!same && !swapped) return false;
    if (run->model->tree->meetings[index].stop != 0 ||
        run->model->tree->meetings[couplings[b].meeting].stop != 0)
        return false;
    int link = first > 0 ? first : second;
    const struct port *p = port_on(&work->rows[couplings[a].first_row], link),
                      *q = port_on(&work->rows[couplings[b].first_row], link);
    return p && q && vec_norm(vec_sub(p->force, q->force)) <= undecided_part &&
           vec_norm(vec_sub(p->arm, q->arm)) <= contacts_same * meeting_near(run->model, work, index);
}

/* The impact constraint among the first `count` that coincides with the contact of coupling i; -1 without
 * one. */
static int coinciding(const struct run *run, int i, int count)
{
    const struct striker *strikers = run->contacts.strikers;
    for (int k = 0; k < count; k++)
        if (strikers[k].contact && coincide(run, strikers[k].coupling, i)) return k;
    return -1;
}

/* ---- impact constraints */

static void set_striker(struct run *run, int i, struct striker *striker)
{
    const struct coupling *coupling = &run->model->tree->couplings[i];
    bool rope = coupling->kind == constraint_rope, contact = coupling->meeting >= 0;
    *striker = (struct striker){.coupling = i,
                                .contact = contact,
                                .rope = rope,
                                .rubs = contact || (!rope && coupling->pair >= 0)};
    if (coupling->reels) striker->reel = rope_reel_rate(run->state, i);
    const struct row *rows = &run->state->tree->rows[coupling->first_row];
    striker->v_n = normal_rate(run, striker);
    striker->v_t = coupling->row_count > 1 && !rope ? rows[1].g.x1 : 0;
    striker->surface = coupling->moves ? rows[1].surface : 0;
    run->contacts.speed = fmax(run->contacts.speed, speed_at(run, rows));
}

/* Rounding of redundant points is inconsistent, which matters in a slow impact. */
static void drop_no_speeds(const struct run *run, struct striker *striker)
{
    double least =
        contacts_no_speed(run,
                          &run->state->tree->rows[run->model->tree->couplings[striker->coupling].first_row]);
    if (fabs(striker->v_n) <= least) striker->v_n = 0;
    if (fabs(striker->v_t) <= least) striker->v_t = 0;
    striker->rubs |= striker->v_t != 0; /* a roll without a limit that lands sticks from then on */
}

int contacts_find_strikers(struct run *run)
{
    struct contacts_work *work = &run->contacts;
    int count = 0;
    work->twin_count = 0;
    for (int i = 0; i < run->model->tree->coupling_count; i++) {
        if (!is_striker(run, i)) continue;
        int point = run->model->tree->couplings[i].meeting >= 0 ? coinciding(run, i, count) : -1;
        if (point >= 0)
            work->twins[work->twin_count++] = (struct striker_twin){i, point};
        else
            set_striker(run, i, &work->strikers[count++]);
    }
    for (int i = 0; i < count; i++) drop_no_speeds(run, &work->strikers[i]);
    return count;
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "section/section.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/tolerances.h"
#include "section/loads.h"
#include "section/name.h"

/* ---- places */

static int compare_places(const void *a, const void *b)
{
    const double one = *(const double *)a, other = *(const double *)b;
    return one < other ? -1 : one > other;
}

static int compare_loads(const void *a, const void *b)
{
    return compare_places(&((const struct section_load *)a)->x, &((const struct section_load *)b)->x);
}

/* Sort the places, and take those that differ by rounding as one. */
static void sort_places(struct section_work *work)
{
    fbd_section *section = work->section;
    size_t count = 1;
    qsort(work->places, work->place_count, sizeof *work->places, compare_places);
    for (size_t i = 1; i < work->place_count; i++)
        if (work->places[i] > work->places[count - 1] + section->near)
            work->places[count++] = work->places[i];
    work->place_count = count;
    work->places[count - 1] = count > 1 ? section->length : 0;
    for (size_t i = 0; i < section->load_count; i++)
        for (size_t k = 0; k < count; k++)
            if (fabs(section->loads[i].x - work->places[k]) <= 2 * section->near)
                section->loads[i].x = work->places[k];
    qsort(section->loads, section->load_count, sizeof *section->loads, compare_loads);
}

/* ---- pieces */

enum { most_pieces = 8192 };

/* Room for one more piece; NULL when memory is out. */
static struct section_piece *next_piece(struct section_work *work)
{
    fbd_section *section = work->section;
    if (section->piece_count == section->piece_room) {
        const size_t room = section->piece_room ? 2 * section->piece_room : 8;
        struct section_piece *larger = realloc(section->pieces, room * sizeof *larger);
        if (!larger) {
            section->arena.failed = true;
            return NULL;
        }
        section->pieces = larger;
        section->piece_room = room;
    }
    return &section->pieces[section->piece_count];
}

/* One of the three densities on a stretch. */
struct sample {
    const struct section_work *work;
    double from, to;
    int which;
};

static double sample_at(double t, void *context)
{
    const struct sample *sample = context;
    double density[3];
    const double middle = sample->from + (sample->to - sample->from) / 2;
    section_density(sample->work, middle + t * (sample->to - sample->from) / 2, middle, density);
    return density[sample->which];
}

/* Compare density and polynomial at places between the nodes, by the loads on all of the body: the terms of a density may
 * cancel, as weight and inertia do. */
static bool is_met(struct sample *sample, const struct polynomial *fitted)
{
    const fbd_section *section = sample->work->section;
    const double size = section->size[sample->which == 2 ? section_M : section_N] / section->length;
    double off = 0;
    for (int i = -10; i <= 10; i++) {
        const double t = i / 10.5;
        off = fmax(off, fabs(polynomial_at(fitted, t) - sample_at(t, sample)));
    }
    return off <= negligible_sum * size;
}

/* Add the stretch, in halves where its densities are no polynomials; false when it takes too many, or memory is out. */
static bool add_pieces(struct section_work *work, double from, double to)
{
    fbd_section *section = work->section;
    struct section_piece *piece = section->piece_count == most_pieces ? NULL : next_piece(work);
    if (!piece) return false;
    struct polynomial *const density[3] = {&piece->along, &piece->across, &piece->couple};
    bool met = true;
    for (int which = 0; which < 3; which++) {
        struct sample sample = {work, from, to, which};
        *density[which] = polynomial_fit(sample_at, &sample);
        met = met && is_met(&sample, density[which]);
    }
    piece->from = from;
    piece->to = to;
    section->piece_count += met;
    const double middle = from + (to - from) / 2;
    if (met || !(to - from > nine_digits * section->length)) return met;
    return add_pieces(work, from, middle) && add_pieces(work, middle, to);
}

static bool make_pieces(struct section_work *work)
{
    bool fine = true;
    for (size_t i = 0; fine && i + 1 < work->place_count; i++)
        fine = add_pieces(work, work->places[i], work->places[i + 1]);
    if (!fine && !work->section->arena.failed)
        diag_add(work->errors, FBD_ERROR, "no-section", work->body->source->at,
                 "divide it where `value` changes its form",
                 "a distributed load on `%s` varies too wildly for its integral along the body",
                 work->body->name);
    return fine;
}

/* ---- the integrals */

/* Add the jumps of the loads at `x`. */
static void jump(const fbd_section *section, double x, double values[section_forces])
{
    for (size_t i = 0; i < section->load_count; i++)
        for (int k = 0; k < section_forces && section->loads[i].x == x; k++)
            values[k] += section->loads[i].jump[k];
}

/* Integrate along the body; `values` are those beyond its end. */
static void integrate(fbd_section *section, double values[section_forces])
{
    for (int k = 0; k < section_forces; k++) values[k] = 0;
    for (size_t i = 0; i < section->piece_count; i++) {
        struct section_piece *piece = &section->pieces[i];
        const double half = (piece->to - piece->from) / 2;
        jump(section, piece->from, values);
        struct polynomial scaled = {{0}};
        polynomial_add(&scaled, -half, &piece->along);
        piece->of[section_N] = polynomial_integral(&scaled, values[section_N]);
        scaled = (struct polynomial){{0}};
        polynomial_add(&scaled, half, &piece->across);
        piece->of[section_V] = polynomial_integral(&scaled, values[section_V]);
        scaled = (struct polynomial){{0}};
        polynomial_add(&scaled, half, &piece->of[section_V]);
        polynomial_add(&scaled, half, &piece->couple);
        piece->of[section_M] = polynomial_integral(&scaled, values[section_M]);
        for (int k = 0; k < section_forces; k++) values[k] = polynomial_at(&piece->of[k], 1);
    }
    jump(section, section->length, values);
}

/* N, V and M vanish beyond the end. */
static bool closes(struct section_work *work)
{
    /* at rest: a file with six digits in its positions and forces is in equilibrium */
    const double enough = work->section->at_rest ? 2 * six_digits : undecided_part;
    fbd_section *section = work->section;
    double left[section_forces];
    integrate(section, left);
    section->size[section_V] = section->size[section_N];
    for (int k = 0; k < section_forces; k++) {
        if (fabs(left[k]) <= enough * section->size[k]) continue;
        diag_add(work->errors, FBD_ERROR, "no-balance", work->body->source->at,
                 "a load of this body is not one that a section can show: leave it out by --without",
                 "the loads on `%s` and its inertia do not balance: beyond its end %s is %.3g in place of 0, "
                 "and the loads are %.3g",
                 work->body->name, section_symbols[k], left[k], section->size[k]);
        return false;
    }
    return true;
}

/* ---- the whole */

static bool compute(struct section_work *work)
{
    if (!section_find_axis(work) || !section_list_loads(work)) return false;
    sort_places(work);
    return make_pieces(work) && closes(work);
}

fbd_section *section_new(const struct fbd_state *state, bool at_rest, int body, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    fbd_section *section = calloc(1, sizeof *section);
    struct section_work work = {.section = section,
                                .state = state,
                                .errors = errors,
                                .body = &model->bodies[body]};
    work.at = state_instant(state);
    work.pose = body_pose(work.body, &work.at);
    if (section) {
        section->model = model;
        section->body = work.body;
        section->t = state->t;
        section->at_rest = at_rest;
    }
    const bool done = section && compute(&work);
    if (!section || section->arena.failed) diag_out_of_memory(errors);
    if (done) return section;
    fbd_section_free(section);
    return NULL;
}

void fbd_section_free(fbd_section *section)
{
    if (section) {
        arena_free(&section->arena);
        free(section->pieces);
    }
    free(section);
}

/* ---- values */

double section_snap(const fbd_section *section, double x)
{
    for (size_t i = 0; i < section->piece_count; i++) {
        const struct section_piece *piece = &section->pieces[i];
        if (fabs(x - piece->from) <= section->near) return piece->from;
        if (fabs(x - piece->to) <= section->near) return piece->to;
    }
    return x;
}

double section_rounded(const fbd_section *section, enum section_force force, double value)
{
    return fabs(value) <= solved_rounding * section->size[force] ? 0 : value;
}

fbd_cut fbd_section_at(const fbd_section *section, double x, bool behind)
{
    if (section) x = section_snap(section, x);
    if (!section || !(x >= 0 && x <= section->length)) return (fbd_cut){x, NAN, NAN, NAN};
    size_t i = 0;
    while (i + 1 < section->piece_count &&
           (section->pieces[i].to < x || (behind && section->pieces[i].to == x)))
        i++;
    const struct section_piece *piece = &section->pieces[i];
    const double t = (2 * x - piece->from - piece->to) / (piece->to - piece->from);
    double values[section_forces];
    for (int k = 0; k < section_forces; k++)
        values[k] = section_rounded(section, (enum section_force)k, polynomial_at(&piece->of[k], t));
    const bool outside = (x == 0 && !behind) || (x == section->length && behind);
    if (outside) return (fbd_cut){x, 0, 0, 0};
    return (fbd_cut){x, values[section_N], values[section_V], values[section_M]};
}

double section_force_at(const fbd_section *section, enum section_force force, double x, bool behind)
{
    x = section_snap(section, x);
    const fbd_cut cut = fbd_section_at(section, x, x == 0 || (behind && x < section->length));
    return force == section_N ? cut.N : force == section_V ? cut.V : cut.M;
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/section.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "study/section_loads.h"

const char *const section_symbols[section_forces] = {"N", "V", "M"};
const char *const section_words[section_forces] = {"normal force", "shear force", "bending moment"};

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
    const double near = 1e-11 * section->length;
    size_t count = 1;
    qsort(work->places, work->place_count, sizeof *work->places, compare_places);
    for (size_t i = 1; i < work->place_count; i++)
        if (work->places[i] > work->places[count - 1] + near) work->places[count++] = work->places[i];
    work->place_count = count;
    work->places[count - 1] = count > 1 ? section->length : 0;
    for (size_t i = 0; i < section->load_count; i++)
        for (size_t k = 0; k < count; k++)
            if (fabs(section->loads[i].x - work->places[k]) <= 2 * near)
                section->loads[i].x = work->places[k];
    qsort(section->loads, section->load_count, sizeof *section->loads, compare_loads);
}

/* ---- pieces */

enum { most_pieces = 8192 };

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
    const double enough = 1e-12;
    const fbd_section *section = sample->work->section;
    const double size = section->size[sample->which == 2 ? section_M : section_N] / section->length;
    double off = 0;
    for (int i = -10; i <= 10; i++) {
        const double t = i / 10.5;
        off = fmax(off, fabs(polynomial_at(fitted, t) - sample_at(t, sample)));
    }
    return off <= enough * size;
}

/* Add the stretch, in halves where its densities are no polynomials; false when it takes too many. */
static bool add_pieces(struct section_work *work, double from, double to)
{
    fbd_section *section = work->section;
    struct section_piece *piece = &section->pieces[section->piece_count];
    struct polynomial *const density[3] = {&piece->along, &piece->across, &piece->couple};
    if (section->piece_count == most_pieces) return false;
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
    if (met || !(to - from > 1e-9 * section->length)) return met;
    return add_pieces(work, from, middle) && add_pieces(work, middle, to);
}

static bool make_pieces(struct section_work *work)
{
    fbd_section *section = work->section;
    section->pieces = ARENA_ARRAY(&section->arena, most_pieces + 1, struct section_piece);
    if (!section->pieces) {
        diag_out_of_memory(work->errors);
        return false;
    }
    for (size_t i = 0; i + 1 < work->place_count; i++)
        if (!add_pieces(work, work->places[i], work->places[i + 1])) {
            diag_add(work->errors, FBD_ERROR, "no-section", (struct pos){work->seen.line, work->seen.column},
                     "divide it where `value` changes its form",
                     "a distributed load on `%s` varies too wildly for its integral along the body",
                     section->body);
            return false;
        }
    return true;
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

/* Beyond the end nothing is left. */
static bool closes(struct section_work *work)
{
    const double enough =
        work->statics ? 4e-6 : 1e-8; /* at rest: as a file with six digits is in equilibrium */
    fbd_section *section = work->section;
    double left[section_forces];
    integrate(section, left);
    section->size[section_V] = section->size[section_N];
    for (int k = 0; k < section_forces; k++) {
        if (fabs(left[k]) <= enough * section->size[k]) continue;
        diag_add(work->errors, FBD_ERROR, "no-balance", (struct pos){work->seen.line, work->seen.column},
                 "a load of this body is not one that a section can show: leave it out by --without",
                 "the loads on `%s` and its inertia do not balance: beyond its end %s = %.3g is left of %.3g",
                 section->body, section_symbols[k], left[k], section->size[k]);
        return false;
    }
    return true;
}

/* ---- extremes */

static void take_extreme(fbd_section *section, int k, double x, double value)
{
    fbd_section_extreme *least = &section->extremes[k][0], *greatest = &section->extremes[k][1];
    const double near = 1e-12 * section->size[k];
    if (value < least->value - near) *least = (fbd_section_extreme){x, value};
    if (value > greatest->value + near) *greatest = (fbd_section_extreme){x, value};
}

static void find_extremes(fbd_section *section)
{
    for (int k = 0; k < section_forces; k++) {
        section->extremes[k][0] = (fbd_section_extreme){NAN, HUGE_VAL};
        section->extremes[k][1] = (fbd_section_extreme){NAN, -HUGE_VAL};
    }
    for (size_t i = 0; i < section->piece_count; i++)
        for (int k = 0; k < section_forces; k++) {
            const struct section_piece *piece = &section->pieces[i];
            const double middle = piece->from + (piece->to - piece->from) / 2, half = piece->to - middle;
            const struct polynomial slope = polynomial_derivative(&piece->of[k]);
            double roots[polynomial_most];
            const int count = polynomial_roots(&slope, roots);
            take_extreme(section, k, piece->from, polynomial_at(&piece->of[k], -1));
            for (int r = 0; r < count; r++)
                take_extreme(section, k, middle + roots[r] * half, polynomial_at(&piece->of[k], roots[r]));
            take_extreme(section, k, piece->to, polynomial_at(&piece->of[k], 1));
        }
}

/* ---- the whole */

/* The names of the ends, where the file names them. */
static void name_ends(fbd_section *section, size_t body)
{
    const struct vec last = vec_add(section->origin, vec_scale(section->length, section->e));
    for (size_t i = 0; i < fbd_model_point_count(section->model, body); i++) {
        const fbd_named_point point = fbd_model_point(section->model, body, i);
        const struct vec at = {point.x, point.y};
        const double near = 1e-9 * section->length;
        if (!section->start && vec_norm(vec_sub(at, section->origin)) <= near) section->start = point.name;
        if (!section->end && vec_norm(vec_sub(at, last)) <= near) section->end = point.name;
    }
}

static bool find_body(struct section_work *work, const char *name)
{
    const fbd_model *model = work->section->model;
    const size_t count = fbd_model_body_count(model);
    const char **names = calloc(count + 1, sizeof *names);
    bool found = false;
    for (size_t b = 0; names && b < count; b++) {
        names[b] = fbd_model_body_name(model, b);
        if (strcmp(names[b], name) != 0) continue;
        work->body = b;
        found = true;
    }
    if (!names)
        diag_out_of_memory(work->errors);
    else if (!found)
        diag_add(work->errors, FBD_ERROR, "unknown-body", (struct pos){0, 0},
                 diag_nearest(work->errors, name, names, count), "there is no body `%s`", name);
    if (found) work->section->body = names[work->body];
    free(names);
    return found;
}

static bool is_in_equilibrium(const struct section_work *work)
{
    if (!work->statics || fbd_statics_holds(work->statics)) return true;
    diag_add(work->errors, FBD_ERROR, "no-balance", (struct pos){0, 0},
             "without --static the section forces are those of the motion",
             "the scene is not in equilibrium: there are no section forces at rest");
    return false;
}

static bool compute(struct section_work *work, const char *body)
{
    fbd_section *section = work->section;
    if (!find_body(work, body) || !is_in_equilibrium(work)) return false;
    work->seen = fbd_model_body(section->model, work->body);
    if (!section_find_axis(work) || !section_list_loads(work)) return false;
    sort_places(work);
    if (!make_pieces(work) || !closes(work)) return false;
    find_extremes(section);
    name_ends(section, work->body);
    return true;
}

fbd_section *fbd_section_new(fbd_state *state, const fbd_statics *statics, const char *body, fbd_errors *list)
{
    if (!state || !body) return api_refuse(list, "there is no state, or no name of a body");
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_section *section = calloc(1, sizeof *section);
    struct section_work work = {.section = section, .state = state, .statics = statics, .errors = errors};
    if (section) {
        section->model = fbd_state_model(state);
        if (!fbd_state_get(state, "t", &section->t)) section->t = NAN;
        section->at_rest = statics != NULL;
        diag_in_file(errors, fbd_model_file(section->model));
    }
    const bool done = section && compute(&work, body);
    if (!section || section->arena.failed) diag_out_of_memory(errors);
    if (!done) fbd_section_free(section);
    diag_end(&call);
    return done ? section : NULL;
}

void fbd_section_free(fbd_section *section)
{
    if (section) arena_free(&section->arena);
    free(section);
}

/* ---- access */

double fbd_section_length(const fbd_section *section)
{
    return section ? section->length : NAN;
}

double section_rounded(const fbd_section *section, enum section_force force, double value)
{
    return fabs(value) <= 1e-11 * section->size[force] ? 0 : value;
}

const char *section_unit(const fbd_section *section, enum section_force force)
{
    const fbd_units units = fbd_model_units(section->model);
    return force == section_M ? units.moment : units.force;
}

bool fbd_section_place(const fbd_section *section, const char *text, double *x, fbd_errors *errors)
{
    if (!section || !text || !x) return api_refuse(errors, "there is no section, or no place") != NULL;
    const fbd_model *model = section->model;
    for (size_t b = 0; b < fbd_model_body_count(model); b++)
        for (size_t i = 0;
             strcmp(fbd_model_body_name(model, b), section->body) == 0 && i < fbd_model_point_count(model, b);
             i++) {
            const fbd_named_point point = fbd_model_point(model, b, i);
            if (strcmp(point.name, text) != 0) continue;
            *x = vec_dot(section->e, vec_sub((struct vec){point.x, point.y}, section->origin));
            return true;
        }
    if (!fbd_model_quantity(model, "--cut", text, fbd_model_units(model).length, x, errors)) return false;
    if (*x >= 0 && *x <= section->length) return true;
    struct diag_call call;
    diag_add(diag_begin(&call, errors), FBD_ERROR, "bad-place", (struct pos){0, 0},
             "the place is the distance from the end `from` (`left`)",
             "`%s` has no section at x = %g: its length is %g %s", section->body, *x, section->length,
             fbd_model_units(model).length);
    diag_end(&call);
    return false;
}

fbd_cut fbd_section_at(const fbd_section *section, double x, bool behind)
{
    fbd_cut cut = {x, NAN, NAN, NAN};
    if (!section || !(x >= 0 && x <= section->length)) return cut;
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

size_t fbd_section_load_count(const fbd_section *section)
{
    return section ? section->load_count : 0;
}

fbd_section_load fbd_section_load_get(const fbd_section *section, size_t index)
{
    if (index >= fbd_section_load_count(section)) return (fbd_section_load){NULL, NAN, NAN, NAN, NAN};
    const struct section_load *load = &section->loads[index];
    return (fbd_section_load){load->name, load->x, load->jump[section_N], load->jump[section_V],
                              load->jump[section_M]};
}

fbd_section_extreme fbd_section_extreme_of(const fbd_section *section, int force, bool greatest)
{
    if (!section || force < 0 || force >= section_forces) return (fbd_section_extreme){NAN, NAN};
    fbd_section_extreme extreme = section->extremes[force][greatest];
    extreme.value = section_rounded(section, (enum section_force)force, extreme.value);
    return extreme;
}

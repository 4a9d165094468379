/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the section forces of a body, their extremes and loads.
 */
#include <math.h>

#include "base/api_check.h"
#include "numeric/tolerances.h"
#include "output/equations.h"
#include "rest/statics.h"
#include "section/name.h"

/* ---- extremes */

static void take_extreme(fbd_section *section, int k, double x, double value)
{
    fbd_section_extreme *least = &section->extremes[k][0], *greatest = &section->extremes[k][1];
    const double near = negligible_sum * section->size[k];
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

/* ---- the ends */

/* The names of the ends, where the file names them. */
static void name_ends(fbd_section *section, const struct body *body)
{
    const struct vec last = vec_add(section->origin, vec_scale(section->length, section->e));
    const double near = nine_digits * section->length;
    for (size_t i = 0; i < body->point_count; i++) {
        const struct named_point *point = &body->points[i];
        if (!section->start && vec_norm(vec_sub(point->where, section->origin)) <= near)
            section->start = point->name;
        if (!section->end && vec_norm(vec_sub(point->where, last)) <= near) section->end = point->name;
    }
}

/* ---- the whole */

static bool is_in_equilibrium(const fbd_statics *statics, fbd_errors *errors)
{
    if (!statics || fbd_statics_holds(statics)) return true;
    diag_add(errors, FBD_ERROR, "no-balance", (struct pos){0, 0},
             "without --static the section forces are those of the motion",
             "the scene is not in equilibrium: there are no section forces at rest");
    return false;
}

static fbd_section *make(fbd_state *state, const fbd_statics *statics, const char *body, fbd_errors *errors)
{
    const int b = section_body(state->model, body, errors);
    if (b < 0 || !is_in_equilibrium(statics, errors)) return NULL;
    if (!statics) state_ready(state);
    fbd_section *section = section_new(statics ? statics->state : state, statics != NULL, b, errors);
    if (!section) return NULL;
    find_extremes(section);
    name_ends(section, section->body->source);
    return section;
}

fbd_section *fbd_section_new(fbd_state *state, const fbd_statics *statics, const char *body, fbd_errors *list)
{
    if (!state || !body) return api_refuse(list, "there is no state, or no name of a body");
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    diag_in_file(errors, state->model->scene->file);
    fbd_section *section = make(state, statics, body, errors);
    diag_end(&call);
    return section;
}

/* ---- access */

double fbd_section_length(const fbd_section *section)
{
    return section ? section->length : NAN;
}

fbd_section_source fbd_section_source_of(const fbd_section *section)
{
    if (!section) return (fbd_section_source){.body = "", .t = NAN};
    return (fbd_section_source){section->model, section->body->name, section->t, section->at_rest};
}

size_t fbd_section_ends(const fbd_section *section, double *ends, size_t room)
{
    if (!section) return 0;
    for (size_t i = 0; ends && i <= section->piece_count && i < room; i++)
        ends[i] = i < section->piece_count ? section->pieces[i].from : section->length;
    return section->piece_count + 1;
}

bool fbd_section_place(const fbd_section *section, const char *text, double *x, fbd_errors *list)
{
    if (!section || !text || !x) return api_refuse(list, "there is no section, or no place") != NULL;
    struct diag_call call;
    const double place = section_place(section, text, diag_begin(&call, list));
    diag_end(&call);
    if (!isnan(place)) *x = place;
    return !isnan(place);
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

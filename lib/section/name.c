/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "section/name.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "section/loads.h"

const char *const section_symbols[section_forces] = {"N", "V", "M"};

/* ---- bodies */

int section_body(const struct fbd_model *model, const char *name, fbd_errors *errors)
{
    const char **names = calloc(model->body_count + 1, sizeof *names);
    int found = -1;
    for (size_t b = 0; names && b < model->body_count; b++) {
        names[b] = model->bodies[b].name;
        if (strcmp(names[b], name) == 0) found = (int)b;
    }
    if (!names)
        diag_out_of_memory(errors);
    else if (found < 0)
        diag_add(errors, FBD_ERROR, "unknown-body", (struct pos){0, 0},
                 diag_nearest(errors, name, names, model->body_count), "there is no body `%.80s`", name);
    free(names);
    return found;
}

/* ---- places */

/* The names of a place: parameters, and alone the points of the body. */
struct place_names {
    const fbd_section *section;
    struct arena arena;
};

static const struct parameter *parameter_named(const struct scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (strcmp(scene->parameters[i].name, name) == 0) return &scene->parameters[i];
    return NULL;
}

static const struct named_point *point_named(const struct body *body, const char *name)
{
    for (size_t i = 0; i < body->point_count; i++)
        if (strcmp(body->points[i].name, name) == 0) return &body->points[i];
    return NULL;
}

static struct symbol lookup(void *context, const char *name, struct pos at)
{
    const struct place_names *names = context;
    const struct parameter *one = parameter_named(names->section->model->scene, name);
    (void)at;
    if (!one) return (struct symbol){.kind = symbol_unknown};
    return (struct symbol){.kind = symbol_constant, .dim = one->dim, .free = one->bare, .value = one->value};
}

static size_t list_names(void *context, const char *const **names)
{
    struct place_names *of = context;
    const struct body *body = of->section->body->source;
    const struct scene *scene = of->section->model->scene;
    const char **list = ARENA_ARRAY(&of->arena, body->point_count + scene->parameter_count + 1, const char *);
    size_t count = 0;
    for (size_t i = 0; list && i < body->point_count; i++) list[count++] = body->points[i].name;
    for (size_t i = 0; list && i < scene->parameter_count; i++) list[count++] = scene->parameters[i].name;
    *names = list;
    return count;
}

/* The value of a length; NAN with a note. */
static double length_of(const fbd_section *section, const char *text, fbd_errors *errors)
{
    struct place_names names = {.section = section};
    const struct scope scope = {.lookup = lookup,
                                .names = list_names,
                                .context = &names,
                                .units = section->model->scene->units};
    const struct expr_want want = {DIM_LENGTH, false, true, false, false, false, "place"};
    const struct expr *expr = expr_compile(&names.arena, text, (struct pos){0, 0}, &scope, &want, errors);
    const double x = expr ? expr_value(expr) : NAN;
    arena_free(&names.arena);
    return x;
}

static double refuse_place(const fbd_section *section, double x, struct pos at, fbd_errors *errors)
{
    char unit[64];
    unit_name(DIM_LENGTH, section->model->scene->units, unit, sizeof unit);
    diag_add(errors, FBD_ERROR, "bad-place", at, "the place is the distance from the end `from` (`left`)",
             "`%s` has no section at x = %g: its length is %g %s", section->body->name, x, section->length,
             unit);
    return NAN;
}

/* The place on the body, at an end or a load where it differs by rounding. */
static double within(const fbd_section *section, double x, struct pos at, fbd_errors *errors)
{
    if (isnan(x)) return NAN;
    if (x < -section->near || x > section->length + section->near)
        return refuse_place(section, x, at, errors);
    return section_snap(section, x);
}

/* The distance of a named point or a length, on the body or not; NAN with a note. */
static double distance_of(const fbd_section *section, const char *text, fbd_errors *errors)
{
    const struct named_point *point = point_named(section->body->source, text);
    if (point && parameter_named(section->model->scene, text)) {
        diag_add(errors, FBD_ERROR, "ambiguous-name", (struct pos){0, 0},
                 diag_hint(errors, "write `1*%s` for the parameter, or call the point otherwise", text),
                 "`%s` is a point of `%s` and a parameter", text, section->body->name);
        return NAN;
    }
    return point ? vec_dot(section->e, vec_sub(point->where, section->origin))
                 : length_of(section, text, errors);
}

double section_place(const fbd_section *section, const char *text, fbd_errors *errors)
{
    return within(section, distance_of(section, text, errors), (struct pos){0, 0}, errors);
}

/* ---- names */

bool section_is_name(const char *text)
{
    const size_t length = strlen(text);
    return length > 3 && strchr("NVM", text[0]) && text[1] == '(' && text[length - 1] == ')';
}

/* The text up to the next comma outside of parentheses, without blanks around it; *text moves behind that. */
static const char *next_part(struct arena *arena, const char **text, const char *end)
{
    const char *from = *text + strspn(*text, " "), *to = from;
    for (int depth = 0; to < end && (depth > 0 || *to != ','); to++) depth += (*to == '(') - (*to == ')');
    *text = to < end ? to + 1 : end;
    while (to > from && to[-1] == ' ') to--;
    return arena_text(arena, from, (size_t)(to - from));
}

static bool refuse_name(const char *text, fbd_errors *errors)
{
    diag_add(errors, FBD_ERROR, "bad-place", (struct pos){0, 0},
             diag_hint(errors,
                       "write `%c(BODY, PLACE)`, as `%c(beam, 0.4 m)`, `%c(beam, L/2)` or `%c(beam, right)`",
                       text[0], text[0], text[0], text[0]),
             "`%.80s` is no section force", text);
    return false;
}

/* The axis alone, without loads; false with a note in the file of the model. */
static bool find_axis(const struct fbd_model *model, int body, fbd_section *section, fbd_errors *errors)
{
    const char *file = errors->file;
    *section = (fbd_section){.model = model, .body = &model->bodies[body]};
    struct section_work work = {.section = section, .errors = errors, .body = section->body};
    diag_in_file(errors, model->scene->file);
    const bool straight = section_find_axis(&work);
    errors->file = file;
    return straight;
}

bool section_exists(const struct fbd_model *model, int body, double x, struct pos at, fbd_errors *errors)
{
    fbd_section section;
    const bool exists = find_axis(model, body, &section, errors) && !isnan(within(&section, x, at, errors));
    arena_free(&section.arena);
    return exists;
}

/* Is the place one that can be evaluated? Whether it is on the body depends on the parameters. */
static bool names_place(const struct fbd_model *model, const struct section_name *name, fbd_errors *errors)
{
    fbd_section section;
    const bool fine =
        find_axis(model, name->body, &section, errors) && !isnan(distance_of(&section, name->place, errors));
    arena_free(&section.arena);
    return fine;
}

bool section_name_read(const struct fbd_model *model, struct arena *arena, const char *text,
                       struct section_name *name, fbd_errors *errors)
{
    const char *rest = text + 2, *end = text + strlen(text) - 1, *parts[4] = {""};
    size_t count = 0;
    while (rest < end && count < 4)
        if (!(parts[count++] = next_part(arena, &rest, end))) return false;
    *name = (struct section_name){.force = text[0] == 'N'   ? section_N
                                           : text[0] == 'V' ? section_V
                                                            : section_M};
    name->behind = count > 1 && strcmp(parts[count - 1], "behind") == 0;
    count -= name->behind;
    const bool whole = count == 1 && (model->body_count != 1 || strcmp(parts[0], model->bodies[0].name) == 0);
    if (count == 0 || count > 2 || whole || !parts[count - 1][0]) return refuse_name(text, errors);
    name->place = parts[count - 1];
    name->body = count == 2 ? section_body(model, parts[0], errors) : 0;
    name->title = arena_printf(arena, "%c(%s%s%s%s)", text[0], count == 2 ? parts[0] : "",
                               count == 2 ? " " : "", name->place, name->behind ? " behind" : "");
    return name->title && name->body >= 0 && names_place(model, name, errors);
}

double section_name_value(const struct section_name *name, const struct fbd_state *state, bool at_rest,
                          fbd_errors *errors)
{
    fbd_section *section = section_new(state, at_rest, name->body, errors);
    const double x = section ? section_place(section, name->place, errors) : NAN;
    const double value = section ? section_force_at(section, name->force, x, name->behind) : NAN;
    fbd_section_free(section);
    return value;
}

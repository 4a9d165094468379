/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parts of a solution that no key lists: reactions by their values at the start, and equations.
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_export.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/handout.h"

fbd_model *solution_model(const struct handout *handout, fbd_errors *errors)
{
    struct fbd_grade grade = {.key = handout->key, .student = handout->student};
    fbd_model *model = grade_compile(&grade, handout->key->root, handout->key->file, true, errors);
    if (grade.arena.failed) diag_out_of_memory(errors);
    arena_free(&grade.arena);
    return model;
}

/* `R_` and the name of a reaction, since the coupling has the name itself. */
static void write_name(struct text *text, const char *name)
{
    text_add(text, "R_");
    for (; *name; name++) text_printf(text, "%c", *name == '.' ? '_' : *name);
}

/* A value in the units of the model; `unknown` with its sense. */
static void write_size(struct text *text, bool known, double size, const char *unit)
{
    if (known)
        text_printf(text, ", value: %.6g %s", size, unit);
    else
        text_printf(text, ", value: %sunknown", size < 0 ? "-" : "");
}

static void write_reaction(struct text *text, bool us, const fbd_arrow *arrow, bool moments, bool known,
                           const struct vec *from)
{
    const double size = hypot(arrow->fx, arrow->fy);
    text_add(text, "      - applied: {name: ");
    write_name(text, arrow->name);
    if (moments) {
        text_add(text, size > 0 ? "_moment" : "");
        write_size(text, known, arrow->couple, us ? "lbf*ft" : "N*m");
    } else {
        write_size(text, known, size, us ? "lbf" : "N");
        text_printf(text, ", angle: %.5g deg", atan2(arrow->fy, arrow->fx) * 57.29577951308232);
        if (from) text_printf(text, ", at: {point: G, offset: [%.6g, %.6g]}", from->x, from->y);
    }
    text_add(text, "}\n");
}

/* Where a reaction is not zero: by its value at the start, else by its sense at that time. */
static bool write_asked(const struct handout *handout, fbd_state *state, size_t b, size_t index, bool moments,
                        fbd_listed_force *forces)
{
    const fbd_body body = fbd_model_body(handout->model, b);
    const double time = handout->key->asked[b][index];
    if (time > 0 && fbd_state_set(state, "t", time)) fbd_state_settle(state);
    const bool turns = body.motion != FBD_MOTION_SLIDE && body.motion != FBD_MOTION_PARTICLE,
               us = strcmp(fbd_model_scene(handout->model).units, "US") == 0;
    const fbd_pose pose = fbd_state_pose(state, b);
    const size_t count = fbd_state_forces(state, b, forces, body.most_forces);
    if (count == SIZE_MAX) return false;
    if (body.listed + index >= count) return true;
    const fbd_arrow *arrow = &forces[body.listed + index].arrow;
    const struct vec from = {arrow->x - pose.G[0], arrow->y - pose.G[1]};
    if (moments ? arrow->couple != 0 : hypot(arrow->fx, arrow->fy) > 0)
        write_reaction(handout->text, us, arrow, moments, time == 0, turns ? &from : NULL);
    return true;
}

void solution_reactions(const struct handout *handout, const char *body_name, bool moments)
{
    const fbd_model *model = handout->model;
    const struct fbd_key *key = handout->key;
    size_t b = 0;
    while (strcmp(fbd_model_body_name(model, b), body_name) != 0) b++;
    if (key_asks(key, b) == 0) return;
    fbd_listed_force *forces = calloc(fbd_model_body(model, b).most_forces + 1, sizeof *forces);
    bool done = forces != NULL;
    for (size_t i = 0; done && i < key->asked_count[b]; i++) {
        if (isnan(key->asked[b][i])) continue;
        fbd_state *state = grade_start(model);
        done = state && write_asked(handout, state, b, i, moments, forces);
        fbd_state_free(state);
    }
    if (!done) handout->arena->failed = true;
    free(forces);
}

void solution_equations(const struct handout *handout)
{
    fbd_state *state = grade_start(handout->model);
    char *equations = state ? fbd_equations_write(state, NULL, NULL) : NULL;
    if (!equations) handout->arena->failed = true;
    text_add(handout->text, "#\n");
    for (const char *line = equations; line && *line;) {
        size_t length = strcspn(line, "\n");
        text_printf(handout->text, "#%s%.*s\n", length ? " " : "", (int)length, line);
        line += length + (line[length] == '\n');
    }
    fbd_free(equations);
    fbd_state_free(state);
}

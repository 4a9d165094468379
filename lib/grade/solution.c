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

static void write_reaction(struct text *text, bool us, const fbd_arrow *arrow, bool moments,
                           const struct vec *from)
{
    const double size = hypot(arrow->fx, arrow->fy);
    text_add(text, "      - applied: {name: ");
    write_name(text, arrow->name);
    if (moments) {
        text_printf(text, "%s, value: %.6g %s}\n", size > 0 ? "_moment" : "", arrow->couple,
                    us ? "lbf*ft" : "N*m");
        return;
    }
    text_printf(text, ", value: %.6g %s, angle: %.5g deg", size, us ? "lbf" : "N",
                atan2(arrow->fy, arrow->fx) * 57.29577951308232);
    if (from) text_printf(text, ", at: {point: G, offset: [%.6g, %.6g]}", from->x, from->y);
    text_add(text, "}\n");
}

void solution_reactions(const struct handout *handout, const char *body_name, bool moments)
{
    const fbd_model *model = handout->model;
    const bool us = strcmp(fbd_model_scene(model).units, "US") == 0;
    size_t b = 0;
    while (strcmp(fbd_model_body_name(model, b), body_name) != 0) b++;
    if (key_asks(handout->key, b) == 0) return;
    const fbd_body body = fbd_model_body(model, b);
    fbd_state *state = fbd_state_new_start(model);
    fbd_listed_force *forces = calloc(body.most_forces + 1, sizeof *forces);
    bool turns = body.motion != FBD_MOTION_SLIDE && body.motion != FBD_MOTION_PARTICLE;
    const fbd_pose pose = fbd_state_pose(state, b);
    size_t count = forces && state ? fbd_state_forces(state, b, forces, body.most_forces) : SIZE_MAX;
    if (count == SIZE_MAX) handout->arena->failed = true;
    for (size_t i = 0; count != SIZE_MAX && i < handout->key->asked_count[b] && body.listed + i < count;
         i++) {
        const fbd_arrow *arrow = &forces[body.listed + i].arrow;
        struct vec from = {arrow->x - pose.G[0], arrow->y - pose.G[1]};
        bool there = moments ? arrow->couple != 0 : hypot(arrow->fx, arrow->fy) > 0;
        if (handout->key->asked[b][i] && there)
            write_reaction(handout->text, us, arrow, moments, turns ? &from : NULL);
    }
    free(forces);
    fbd_state_free(state);
}

void solution_equations(const struct handout *handout)
{
    fbd_state *state = fbd_state_new_start(handout->model);
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

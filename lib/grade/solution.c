/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parts of a solution that no key lists: reactions by their values at the start, and equations.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/diagram.h"
#include "dynamics/kinematics.h"
#include "dynamics/project.h"
#include "fbd_export.h"
#include "fbd_grade.h"
#include "grade/handout.h"
#include "output/random_state.h"
#include "output/words.h"

fbd_model *solution_model(const struct handout *handout, fbd_errors *errors)
{
    struct fbd_grade grade = {.key = handout->key, .student = handout->student};
    fbd_model *model = grade_compile(&grade, handout->key->document.root, handout->key->file, true, errors);
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

static void write_reaction(struct text *text, const fbd_model *model, const struct arrow *arrow, bool moments,
                           const struct vec *from)
{
    text_add(text, "      - applied: {name: ");
    write_name(text, arrow->name);
    if (moments) {
        text_printf(text, "%s, value: %.6g %s}\n", vec_norm(arrow->force) > 0 ? "_moment" : "", arrow->couple,
                    model->scene->units == unit_us ? "lbf*ft" : "N*m");
        return;
    }
    text_printf(text, ", value: %.6g %s, angle: %.5g deg", vec_norm(arrow->force), force_unit(model),
                atan2(arrow->force.y, arrow->force.x) * 57.29577951308232);
    if (from) text_printf(text, ", at: {point: G, offset: [%.6g, %.6g]}", from->x, from->y);
    text_add(text, "}\n");
}

/* The start, in the modes of the motion that follows (compare.c). NULL when memory is out. */
static fbd_state *start_of(const struct handout *handout)
{
    fbd_state *state = state_new(handout->model);
    if (!state) handout->arena->failed = true;
    if (state && handout->model->assembles) state_project(state, true);
    if (state && !random_admissible(state)) state_evaluate(state);
    return state;
}

void solution_reactions(const struct handout *handout, const char *body_name, bool moments)
{
    const fbd_model *model = handout->model;
    int b = 0;
    while (strcmp(model->bodies[b].name, body_name) != 0) b++;
    const struct model_body *body = &model->bodies[b];
    fbd_state *state = key_asks(handout->key, (size_t)b) > 0 ? start_of(handout) : NULL;
    struct arrow *arrows = calloc(diagram_arrows(model, b) + 1, sizeof *arrows);
    bool turns = body->kind != motion_slide && body->kind != motion_particle;
    if (!arrows) handout->arena->failed = true;
    if (state && arrows) {
        struct instant at = state_instant(state);
        struct pose pose = body_pose(body, &at);
        struct vec G = point_motion(body, &pose, body->inertia.G).p;
        size_t listed = body->source->load_count;
        size_t count = diagram_list(model, b, &at, state->a, state->slots, arrows);
        for (size_t i = 0; i < handout->key->asked_count[b] && listed + i < count; i++) {
            const struct arrow *arrow = &arrows[listed + i];
            struct vec from = vec_sub(arrow->point, G);
            bool there = moments ? arrow->couple != 0 : vec_norm(arrow->force) > 0;
            if (handout->key->asked[b][i] && there)
                write_reaction(handout->text, model, arrow, moments, turns ? &from : NULL);
        }
    }
    free(arrows);
    state_free(state);
}

void solution_equations(const struct handout *handout)
{
    fbd_state *state = start_of(handout);
    char *equations = state ? fbd_equations_write(state, NULL, NULL) : NULL;
    if (!equations) handout->arena->failed = true;
    text_add(handout->text, "#\n");
    for (const char *line = equations; line && *line;) {
        size_t length = strcspn(line, "\n");
        text_printf(handout->text, "#%s%.*s\n", length ? " " : "", (int)length, line);
        line += length + (line[length] == '\n');
    }
    fbd_free(equations);
    state_free(state);
}

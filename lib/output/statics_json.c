/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Statics of a scene for programs: its free-body diagrams by name, and as one JSON object (docs/output.md).
 */
#include "dynamics/spatial.h"
#include "fbd_study.h"
#include "output/display_units.h"
#include "output/equations.h"
#include "rest/statics.h"

static struct vec mass_center_of(const struct fbd_statics *statics, const struct model_body *body)
{
    struct instant at = state_instant(statics->state);
    struct pose pose = body_pose(body, &at);
    return point_motion(body, &pose, body->inertia.G).p;
}

size_t fbd_statics_diagram(const fbd_statics *statics, size_t body, fbd_arrow *arrows, size_t room)
{
    if (!statics || body >= statics->model->body_count) return 0;
    if (!arrows) room = 0;
    const struct model_body *of = &statics->model->bodies[body];
    const struct rest_diagram *diagram = &statics->diagrams[body];
    struct instant at = state_instant(statics->state);
    struct vec about = moment_center(of, &at);
    for (size_t i = 0; i < diagram->count && i < room; i++)
        arrows[i] = public_arrow(&diagram->arrows[i], about);
    return diagram->count;
}

static void write_verdict(struct text *text, const struct fbd_statics *statics)
{
    text_add(text, "  ");
    text_json_member(text, "t", statics->state->t, ",\n  \"coordinates\": {");
    for (int i = 0; i < statics->model->plan.n; i++)
        text_json_member(text, statics->model->labels[i].name,
                         statics->state->y[i] /
                             display_of_component(statics->model, (size_t)i, statics->state->degrees).size,
                         i + 1 < statics->model->plan.n ? ", " : "");
    text_add(text, "},\n  ");
    text_json_flag(text, "equilibrium", fbd_statics_holds(statics), ",\n  ");
    text_printf(text, "\"indeterminacy\": %zu,\n  \"mobility\": %zu,\n  \"undetermined\": [",
                statics->indeterminacy, statics->mobility);
    for (size_t i = 0; i < statics->undetermined_count; i++) {
        text_add(text, i ? ", " : "");
        text_json_string(text, statics->undetermined[i]);
    }
    text_add(text, "],\n  \"unbalanced\": [");
    for (size_t i = 0; i < statics->unbalanced_count; i++) {
        const fbd_unbalanced *one = &statics->unbalanced[i];
        text_add(text, i ? ", {\"coordinate\": " : "{\"coordinate\": ");
        text_json_string(text, one->coordinate);
        text_add(text, ", ");
        text_json_member(text, "holding", one->holding, ", ");
        text_json_flag(text, "alone", one->alone, "}");
    }
    text_add(text, "],\n  \"limits\": {");
    static const char *const kinds[] = {"normal", "friction", "rope"};
    for (size_t i = 0; i < statics->limit_count; i++) {
        const fbd_limit *limit = &statics->limits[i];
        text_add(text, i ? ",\n    " : "\n    ");
        text_json_key(text, limit->name);
        text_printf(text, "{\"kind\": \"%s\", ", kinds[limit->kind]);
        text_json_member(text, "needed", limit->needed, ", ");
        text_json_member(text, "limit", limit->limit, ", ");
        text_json_flag(text, "holds", limit->holds, "}");
    }
    text_add(text, statics->limit_count > 0 ? "\n  },\n" : "},\n");
}

static void write_members(struct text *text, const struct fbd_statics *statics)
{
    static const char *const kinds[] = {"rod", "rope", "body"};
    text_add(text, "  \"members\": [");
    for (size_t i = 0; i < statics->member_count; i++) {
        const fbd_member *member = &statics->members[i];
        text_add(text, i ? ", {\"name\": " : "{\"name\": ");
        text_json_string(text, member->name);
        text_printf(text, ", \"kind\": \"%s\", ", kinds[member->kind]);
        text_json_member(text, "tension", member->tension, "}");
    }
    text_add(text, "],\n");
}

static void write_body(struct text *text, const struct fbd_statics *statics, size_t b, struct wrench *sum)
{
    const struct rest_diagram *diagram = &statics->diagrams[b];
    struct vec G = mass_center_of(statics, &statics->model->bodies[b]);
    text_json_key(text, statics->model->bodies[b].name);
    text_add(text, "{");
    for (size_t i = 0; i < diagram->count; i++) {
        const struct arrow *arrow = &diagram->arrows[i];
        double moment = arrow_moment(arrow, G);
        sum->force = vec_add(sum->force, arrow->force);
        sum->moment += moment;
        text_add(text, i ? ",\n      " : "\n      ");
        text_json_key(text, arrow->name);
        text_add(text, "{");
        text_json_member(text, "fx", arrow->force.x, ", ");
        text_json_member(text, "fy", arrow->force.y, ", ");
        text_json_member(text, "x", arrow->point.x, ", ");
        text_json_member(text, "y", arrow->point.y, ", ");
        text_json_member(text, "couple", arrow->couple, ", ");
        text_json_member(text, "moment_G", moment, "}");
    }
    text_add(text, diagram->count > 0 ? "\n    }" : "}");
}

static void write_bodies(struct text *text, const struct fbd_statics *statics)
{
    const struct fbd_model *model = statics->model;
    struct text sums = {0};
    text_add(text, "  \"forces\": {");
    for (size_t b = 0; b < model->body_count; b++) {
        struct wrench sum = {0, {0, 0}};
        text_add(text, b ? ",\n    " : "\n    ");
        write_body(text, statics, b, &sum);
        text_add(&sums, b ? ",\n    " : "\n    ");
        text_json_key(&sums, model->bodies[b].name);
        text_add(&sums, "{");
        text_json_member(&sums, "fx", sum.force.x, ", ");
        text_json_member(&sums, "fy", sum.force.y, ", ");
        text_json_member(&sums, "moment_G", rest_turns(&model->bodies[b]) ? sum.moment : NAN, "}");
    }
    text_add(text, "\n  },\n  \"balance\": {");
    text_add(text, sums.data ? sums.data : "");
    text_add(text, "\n  }\n");
    text->failed |= sums.failed;
    text_free(&sums);
}

char *fbd_statics_json(const fbd_statics *statics)
{
    if (!statics) return NULL;
    const struct scene *scene = statics->model->scene;
    struct text text = {0};
    text_add(&text, "{\n  \"title\": ");
    text_json_string(&text, scene->title);
    text_printf(&text, ",\n  \"units\": \"%s\",\n%s", scene->units == unit_si ? "SI" : "US",
                statics->state->degrees ? "  \"angles\": \"deg\",\n" : "");
    write_verdict(&text, statics);
    write_members(&text, statics);
    write_bodies(&text, statics);
    text_add(&text, "}\n");
    if (text.failed) text_free(&text);
    return text.data;
}

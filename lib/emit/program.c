/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The complete program.
 */
#include <stdlib.h>
#include <string.h>

#include "emit/helper.h"
#include "emit/live.h"

static void add(struct text *out, const struct text *part)
{
    if (part->data) text_add(out, part->data);
}

static void write_head(struct emitter *emitter, struct text *out)
{
    const struct scene *scene = emitter->model->scene;
    text_add(out, "/* ");
    emit_comment(out, *scene->title ? scene->title : "A scene without title");
    text_add(out, "\n *\n * Written by fbd-run --emit-c");
    if (scene->file) {
        text_add(out, " from `");
        emit_comment(out, scene->file);
        text_add(out, "`");
    }
    text_add(out, ". Change the numbers of set_parameters as you like; constants that follow are\n"
                  " * computed in derive. Build it with\n *\n"
                  " *     cc -O2 -ffp-contract=off FILE.c -lgsl -lgslcblas -lm\n *\n"
                  " * (on processors without fused multiply-add that cc uses by itself -ffp-contract=off "
                  "changes nothing).\n");
    text_printf(out,
                " * Units: %s, angles in rad. x points to the right, y up, angles counter-clockwise.\n */\n",
                scene->units == unit_us ? "slug, ft, s, lbf" : "kg, m, s, N");
    text_add(out, "#include <float.h>\n#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include "
                  "<string.h>\n\n"
                  "#include <gsl/gsl_errno.h>\n#include <gsl/gsl_odeiv2.h>\n\n");
}

static void write_enum(struct emitter *emitter, struct text *out)
{
    const struct fbd_model *model = emitter->model;
    const struct plan *plan = &model->plan;
    int n = plan->n;
    text_add(out, "/* Where things stand in y: coordinates, rates, places; sums of forces have the places of "
                  "coordinates. */\n"
                  "enum {\n");
    for (int i = 0; i < n; i++)
        text_printf(out, "    %s, /* %s */\n", emitter->coordinate[i], model->labels[i].unit);
    text_add(out, "    coordinates,\n");
    for (int i = 0; i < n; i++)
        text_printf(out, "    %s%s, /* %s */\n", emitter->rate[i], i ? "" : " = coordinates",
                    model->labels[i].rate_unit);
    for (size_t k = 0; k < model->absolute_count; k++)
        if (emitter->used[k]) text_printf(out, "    %s,\n", emitter->place[k]);
    text_add(out, "    size\n};\n");
    text_add(out,
             "/* Further sums of forces: across slides, and reactions that would hold joints. */\nenum {\n");
    for (int i = n; i < plan->slots; i++)
        text_printf(out, "    %s%s,\n", emitter->slot[i], i > n ? "" : " = coordinates");
    text_add(out, plan->slots > n ? "    slots\n};\n" : "    slots = coordinates\n};\n");
    text_add(out, "/* Modes: pairs that stick or slip, switches of expressions; further functions that are "
                  "watched. */\nenum {\n    ");
    for (size_t i = 0; i < plan->mode_count; i++) text_printf(out, "%s, ", emitter->pair[i]);
    text_add(out, "pairs\n};\nenum {\n    ");
    for (int i = 0; i < plan->branches; i++) text_printf(out, "%s, ", emitter->branch[i]);
    text_printf(out, "branches\n};\nenum {\n    surfaces = %zu, events = %zu,\n", plan->contact_count,
                plan->watch_count);
    text_add(out, "    watches = 2*pairs + surfaces + branches + events,\n"
                  "    looks = 3,     /* within a step, for changes that are undone, */\n"
                  "    look_depth = 6 /* and so often halved where that bends */\n};\n\n");
}

static void write_structures(struct emitter *emitter, struct text *out)
{
    text_add(out, "/* The numbers of the file. */\nstruct parameters {\n    double until, tolerance;\n");
    add(out, &emitter->parameters);
    text_add(out,
             "};\n\n/* Constants that follow from them. */\nstruct constants {\n    struct vec gravity;\n");
    add(out, &emitter->constants);
    text_add(out, "};\n\nstruct scene {\n    struct parameters p;\n    struct constants c;\n"
                  "    int slip[pairs + 1]; /* 0 sticks, 1 or -1: the side on which it slips */\n"
                  "    int pull[pairs + 1]; /* of guides: the side that they press on */\n"
                  "    double branch[branches + 1];\n    int silent[branches + 1];\n"
                  "    int side[events + 1]; /* of zero on which events are */\n    int rows; /* print the "
                  "motion */\n};\n\n");
}

static void write_gravity(struct emitter *emitter, struct text *out)
{
    struct vec gravity = emitter->model->scene->gravity;
    if (gravity.x == 0 && gravity.y <= 0)
        text_add(out, "    c->gravity = (struct vec){0, -p->g};\n");
    else
        text_printf(out, "    c->gravity = (struct vec){%s, %s};\n", emit_number(emitter, gravity.x),
                    emit_number(emitter, gravity.y));
}

/* Write comments about the parameters that cannot be changed independently. */
static void write_fixed(struct emitter *emitter, struct text *out)
{
    const struct scene *scene = emitter->model->scene;
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (emitter->fixed[i])
            text_printf(out,
                        "    /* %s = %s is part of other numbers: write the program anew to change it */\n",
                        scene->parameters[i].name, emit_number(emitter, scene->parameters[i].value));
}

static void write_setup(struct emitter *emitter, struct text *out)
{
    text_add(out, "static void set_parameters(struct parameters *p)\n{\n");
    write_fixed(emitter, out);
    add(out, &emitter->defaults);
    text_add(out, "}\n\nstatic void derive(const struct parameters *p, struct constants *c)\n{\n"
                  "    memset(c, 0, sizeof *c);\n");
    write_gravity(emitter, out);
    add(out, &emitter->derive);
    text_add(out, "}\n\n");
}

/* Write the members for the run and gravity first, since formulas may use its magnitude. */
static void write_first(struct emitter *emitter, double until, double tolerance)
{
    const struct value *given = &emitter->model->scene->simulate.until;
    struct emit_origin origin = {given->at, "until", DIM_TIME, -1};
    const char *gravity = emit_live_gravity(emitter);
    if (gravity) {
        text_printf(&emitter->defaults, "    p->g = %s;\n", gravity);
        text_add(&emitter->parameters, "    double g; /* magnitude of gravity */\n");
    }
    bool of_file = given->expr && expr_value(given->expr) == until;
    const char *end = of_file ? emit_live_number(emitter, until, origin) : emit_number(emitter, until);
    text_printf(&emitter->defaults, "    p->until = %s;\n    p->tolerance = %s;\n", end,
                emit_number(emitter, tolerance));
}

/* Write the initial state as parameters. */
static void write_start(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    for (int i = 0; i < model->plan.n; i++) {
        const struct coordinate *coordinate = &model->scene->coordinates[i];
        struct pos at = model->scene->bodies[coordinate->body].at;
        struct emit_origin place = emit_live_start(emitter, at, coordinate->name);
        struct emit_origin rate = emit_live_start(emitter, at, coordinate->rate_name);
        place.dim = coordinate->dim;
        rate.dim = coordinate->rate_dim;
        const char *q = emit_join(emitter, emitter->coordinate[i], "start");
        const char *v = emit_join(emitter, emitter->rate[i], "start");
        q = emit_parameter(emitter, q, coordinate->initial, place);
        v = emit_parameter(emitter, v, coordinate->initial_rate, rate);
        text_printf(&emitter->start, "    y[%s] = %s;\n    y[%s] = %s;\n", emitter->coordinate[i], q,
                    emitter->rate[i], v);
    }
}

static void write_names(struct emitter *emitter, struct text *out)
{
    const struct fbd_model *model = emitter->model;
    text_add(out, "static const char *const state_name[2*coordinates] = {\n");
    for (int i = 0; i < 2 * model->plan.n; i++) {
        const struct label *label = &model->labels[i % model->plan.n];
        bool rate = i >= model->plan.n;
        text_printf(out, "    \"%s [%s]\",\n", rate ? label->rate_name : label->name,
                    rate ? label->rate_unit : label->unit);
    }
    text_add(out, "};\n\n");
}

static void write_beginning(struct emitter *emitter, struct text *out)
{
    text_add(out, "static void start(struct scene *s, double *y)\n{\n"
                  "    memset(s, 0, sizeof *s);\n    memset(y, 0, size*sizeof *y);\n"
                  "    for (int i = 0; i < pairs; i++) s->pull[i] = 1;\n"
                  "    set_parameters(&s->p);\n    derive(&s->p, &s->c);\n"
                  "    const struct parameters *p = &s->p;\n");
    add(out, &emitter->start);
    text_add(out, "    complete(s, 0, y);\n}\n\n");
}

static void write_main(bool watched, struct text *out)
{
    text_printf(out,
                "/* Without arguments the motion to its end; with `rows` all steps of it as CSV; with `at` "
                "the accelerations at\n"
                " * states \"t q.. v..\" that are read. */\n"
                "int main(int count, char **words)\n{\n    struct scene scene;\n    double y[size];\n"
                "    gsl_set_error_handler_off();\n    start(&scene, y);\n"
                "    if (count > 1 && strcmp(words[1], \"at\") == 0) return %s(&scene, y);\n"
                "    scene.rows = count > 1 && strcmp(words[1], \"rows\") == 0;\n"
                "    return run_to_end(&scene, y);\n}\n",
                watched ? "answer" : "answer_smoothly");
}

static void write_runner(bool watched, struct text *out)
{
    text_printf(
        out,
        "static int run_to_end(struct scene *s, double *y)\n{\n    double t = 0;\n"
        "    struct run run = {.s = s, .system = {rates, NULL, 2*coordinates, s}};\n"
        "    run.step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2*coordinates);\n"
        "    run.control = gsl_odeiv2_control_standard_new(1e-6*s->p.tolerance, s->p.tolerance, 1, 1);\n"
        "    run.evolve = gsl_odeiv2_evolve_alloc(2*coordinates);\n"
        "    if (!run.step || !run.control || !run.evolve) return EXIT_FAILURE;\n"
        "    print_heading(s);\n    print_row(s, t, y);\n"
        "    const int code = %s(&run, &t, y);\n"
        "    if (!s->rows) print_state(t, y);\n"
        "    gsl_odeiv2_evolve_free(run.evolve);\n    gsl_odeiv2_control_free(run.control);\n"
        "    gsl_odeiv2_step_free(run.step);\n    return code == 0 ? EXIT_SUCCESS : EXIT_FAILURE;\n}\n\n",
        watched ? "integrate" : "integrate_smoothly");
}

/* Write the functions of the run, preceded by those that they call. */
static void write_run(struct emitter *emitter, struct text *out)
{
    struct text end = {0};
    write_runner(emit_watches(emitter) > 0, &end);
    write_main(emit_watches(emitter) > 0, &end);
    write_names(emitter, out);
    write_beginning(emitter, out);
    emit_helpers(emitter, emit_run_list, emit_run_count, &end, out);
    add(out, &end);
    out->failed = out->failed || end.failed;
    text_free(&end);
}

static void free_texts(struct emitter *emitter)
{
    struct text *texts[] = {&emitter->parameters, &emitter->defaults, &emitter->constants,
                            &emitter->derive,     &emitter->formulas, &emitter->forces,
                            &emitter->links,      &emitter->rest,     &emitter->start};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        emitter->arena.failed = emitter->arena.failed || texts[i]->failed;
        text_free(texts[i]);
    }
}

static void write_all(struct emitter *emitter, double until, double tolerance, struct text *out)
{
    struct text below = {0};
    write_first(emitter, until, tolerance);
    emit_inertias(emitter);
    emit_bodies(emitter);
    emit_tree(emitter);
    emit_solution(emitter);
    emit_modes(emitter);
    write_start(emitter);
    write_structures(emitter, &below);
    write_setup(emitter, &below);
    add(&below, &emitter->formulas);
    add(&below, &emitter->forces);
    add(&below, &emitter->links);
    add(&below, &emitter->rest);
    write_run(emitter, &below);
    write_head(emitter, out);
    emit_helpers(emitter, emit_helper_list, emit_helper_count, &below, out);
    write_enum(emitter, out);
    add(out, &below);
    out->failed = out->failed || below.failed;
    text_free(&below);
}

/* Write the program once; *settled is false if further parameters must be fixed, and the writing repeated. */
static char *write_once(struct emitter emitter, double until, double tolerance, bool *settled,
                        fbd_errors *errors)
{
    struct text out = {0};
    *settled = true;
    if (emit_live_open(&emitter) && emit_names(&emitter)) {
        write_all(&emitter, until, tolerance, &out);
        *settled = emit_live_settled(&emitter);
    } else {
        emitter.arena.failed = true;
    }
    free_texts(&emitter);
    emit_live_close(&emitter);
    if (out.failed || emitter.arena.failed) {
        text_free(&out);
        *settled = true;
        diag_out_of_memory(errors);
    }
    arena_free(&emitter.arena);
    return out.data;
}

char *emit_program(const struct fbd_model *model, double until, double tolerance, fbd_errors *errors)
{
    char *program = NULL;
    bool settled = false;
    if (!emit_admits(model, errors)) return NULL;
    bool *fixed = calloc(model->scene->parameter_count + 1, sizeof *fixed);
    if (!fixed) diag_out_of_memory(errors);
    while (fixed && !settled) {
        free(program);
        program =
            write_once((struct emitter){.model = model, .fixed = fixed}, until, tolerance, &settled, errors);
    }
    free(fixed);
    return program;
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/csv.h"

#include <stdlib.h>
#include <string.h>

enum { digits = 17, default_rows = 500 };

/* ---- columns of forces: a slide shows the component along itself (normal force: across), a pivot the moment
 * about its axis, a body in the plane its components */

static void force_headers(struct csv *csv, const struct model_body *body, const char *name)
{
    struct text *line = &csv->line;
    const char *force = force_unit(csv->model), *moment = moment_unit(csv->model);
    if (body->count == 1) {
        text_printf(line, ",%s.%s [%s]", body->name, name, body->kind == motion_pivot ? moment : force);
        return;
    }
    text_printf(line, ",%s.%s.x [%s],%s.%s.y [%s]", body->name, name, force, body->name, name, force);
    if (body->kind == motion_planar) text_printf(line, ",%s.%s.moment [%s]", body->name, name, moment);
}

/* A jointed body has its whole diagram: components and moment about its centre of mass of every force. */
static void diagram_headers(struct csv *csv, int b, const struct fbd_state *start)
{
    const struct fbd_model *model = csv->model;
    const struct model_body *body = &model->bodies[b];
    const char *force = force_unit(model), *moment = moment_unit(model);
    struct instant at = state_instant(start);
    size_t count = diagram_fill(model, b, &at, start->a, start->slots, csv->arrows);
    for (size_t i = 0; i < count; i++) {
        const char *name = csv->arrows[i].name;
        text_printf(&csv->line, ",%s.%s.x [%s],%s.%s.y [%s],%s.%s.moment [%s]", body->name, name, force,
                    body->name, name, force, body->name, name, moment);
        if (i < (size_t)body->load_count)
            text_printf(&csv->line, ",%s.%s.work [%s]", body->name, name, energy_unit(model));
    }
}

static void ledger_headers(struct csv *csv, const struct fbd_state *start)
{
    const struct fbd_model *model = csv->model;
    const char *energy = energy_unit(model);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        if (body->place.link > 0) {
            diagram_headers(csv, (int)b, start);
            continue;
        }
        for (int i = 0; i < body->load_count; i++) {
            const char *name = model->loads[body->first_load + i].source->name;
            force_headers(csv, body, name);
            text_printf(&csv->line, ",%s.%s.work [%s]", body->name, name, energy);
        }
        if (body->kind == motion_pivot)
            text_printf(&csv->line, ",%s.pin.x [%s],%s.pin.y [%s]", body->name, force_unit(model), body->name,
                        force_unit(model));
    }
    text_printf(&csv->line,
                ",energy.kinetic [%s],energy.potential [%s],energy.work [%s],energy.residual [%s]", energy,
                energy, energy, energy);
}

static void headers(struct csv *csv, const struct fbd_state *start)
{
    const struct fbd_model *model = csv->model;
    text_add(&csv->line, "t [s]");
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        const struct label *labels = model->labels + body->first;
        for (int k = 0; k < body->count; k++)
            text_printf(&csv->line, ",%s [%s]", labels[k].name, labels[k].unit);
        for (int k = 0; k < body->count; k++)
            text_printf(&csv->line, ",%s [%s]", labels[k].rate_name, labels[k].rate_unit);
    }
    if (csv->ledger) ledger_headers(csv, start);
}

/* ---- rows */

static void number(struct csv *csv, double value)
{
    text_add(&csv->line, ",");
    text_number(&csv->line, value, digits);
}

static void force_values(struct csv *csv, const struct model_body *body, const struct arrow *arrow)
{
    bool normal = csv->model->loads[arrow->load].source->kind == load_normal;
    number(csv, normal ? vec_dot(arrow->force, body->n) : arrow->share[0]);
    for (int k = 1; k < body->count; k++) number(csv, arrow->share[k]);
}

static void diagram_values(struct csv *csv, int b, const struct fbd_state *state)
{
    const struct fbd_model *model = csv->model;
    const struct model_body *body = &model->bodies[b];
    struct instant at = state_instant(state);
    struct pose pose = body_pose(body, &at);
    struct vec G = point_motion(body, &pose, body->inertia.G).p;
    size_t count = diagram_fill(model, b, &at, state->a, state->slots, csv->arrows);
    for (size_t i = 0; i < count; i++) {
        number(csv, csv->arrows[i].force.x);
        number(csv, csv->arrows[i].force.y);
        number(csv, arrow_moment(&csv->arrows[i], G));
        if (i < (size_t)body->load_count)
            number(csv, ledger_work(csv->ledger, state, (size_t)csv->arrows[i].load, csv->work));
    }
}

static void ledger_values(struct csv *csv, const struct fbd_state *state)
{
    const struct fbd_model *model = csv->model;
    struct instant at = state_instant(state);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        if (body->place.link > 0) {
            diagram_values(csv, (int)b, state);
            continue;
        }
        diagram_fill(model, (int)b, &at, state->a, state->slots, csv->arrows);
        for (int i = 0; i < body->load_count; i++) {
            force_values(csv, body, &csv->arrows[i]);
            number(csv, ledger_work(csv->ledger, state, (size_t)csv->arrows[i].load, csv->work));
        }
        if (body->kind == motion_pivot) {
            number(csv, csv->arrows[body->load_count].force.x);
            number(csv, csv->arrows[body->load_count].force.y);
        }
    }
    fbd_energy energy = ledger_energy(csv->ledger, state, csv->work);
    number(csv, energy.kinetic);
    number(csv, energy.potential);
    number(csv, energy.work);
    number(csv, energy.residual);
}

static bool put_line(struct csv *csv)
{
    text_add(&csv->line, "\n");
    if (csv->line.failed || csv->write(csv->context, csv->line.data, csv->line.length) != 0)
        csv->failed = true;
    csv->line.length = 0;
    return !csv->failed;
}

static bool row(struct csv *csv, const struct fbd_state *state)
{
    const struct fbd_model *model = csv->model;
    csv->last = state->t;
    text_number(&csv->line, state->t, digits);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        for (int k = 0; k < body->count; k++) number(csv, state->y[body->first + k]);
        for (int k = 0; k < body->count; k++) number(csv, state->y[body->first_rate + k]);
    }
    if (csv->ledger) ledger_values(csv, state);
    return put_line(csv);
}

/* ---- the file */

bool csv_begin(struct csv *csv, const struct fbd_model *model, struct ledger *ledger,
               const fbd_recording *recording, double until, struct fbd_state *start)
{
    double every = recording->every > 0 ? recording->every : model->scene->simulate.every;
    *csv = (struct csv){.model = model,
                        .ledger = recording->ledger ? ledger : NULL,
                        .write = recording->csv,
                        .context = recording->csv_context,
                        .start = start->t,
                        .until = until,
                        .every = every > 0 ? every : (until - start->t) / default_rows,
                        .next = 1};
    csv->near = 1e-9 * csv->every;
    csv->arrows = calloc(diagram_most_arrows(model), sizeof *csv->arrows);
    csv->work = calloc(model->load_count + 1, sizeof *csv->work);
    if (!csv->arrows || !csv->work) return false;
    headers(csv, start);
    return put_line(csv) && row(csv, start);
}

double csv_next(const struct csv *csv)
{
    return csv->every > 0 ? fmin(csv->start + (double)csv->next * csv->every, csv->until) : csv->until;
}

bool csv_row(struct csv *csv, struct ensemble *ensemble, bool event)
{
    bool regular = csv->every > 0 && ensemble->t >= csv->start + (double)csv->next * csv->every - csv->near;
    if (regular) csv->next++;
    bool last = ensemble->outcome != FBD_GOING && ensemble->t > csv->last;
    if (!regular && !event && !last) return true;
    if (csv->ledger && !ledger_at(csv->ledger, ensemble, csv->work)) return false;
    return row(csv, ensemble_state(ensemble));
}

void csv_free(struct csv *csv)
{
    text_free(&csv->line);
    free(csv->arrows);
    free(csv->work);
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <string.h>

#include "solve/run.h"

/* The sum of the sizes of what acts along each coordinate of a body. */
static void gross_forces(struct run *run, int b, const struct instant *at, double *gross)
{
    const struct model_body *body = &run->model->bodies[b];
    size_t count = diagram_fill(run->model, b, at, run->state->a, run->state->slots, run->arrows);
    for (int k = 0; k < body->count; k++) gross[k] = 0;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < body->count; k++) gross[k] += fabs(run->arrows[i].share[k]);
}

/* How fast the accelerations change along the motion: what an error of the time does to them. `along` has n
 * entries. */
static void changes(struct run *run, const struct instant *at, double *along)
{
    const struct plan *plan = &run->model->plan;
    size_t n = (size_t)plan->n;
    double *slots = run->state->scratch, *slots_along = slots + plan->slots, *dy = run->sample;
    memcpy(dy, run->state->y + n, n * sizeof *dy);
    memcpy(dy + n, run->state->a, n * sizeof *dy);
    struct direction flow = {1, dy};
    accelerations_along(run->model, at, &flow, slots, slots_along, along);
}

/* A coordinate or rate that is exactly zero has no size that an error could be compared with, and a method of
 * low order needs one (Euler's first step from rest errs by all that the body moves). What the acceleration
 * does in a thousandth of the run is small, and enough. */
static void set_floors(struct run *run, int i)
{
    size_t position = (size_t)i, rate = position + (size_t)run->model->plan.n;
    double tau = 1e-3 * (run->options.until - run->state->t), v = fabs(run->state->y[rate]),
           a = fabs(run->state->a[i]);
    if (run->state->y[position] == 0) switcher_set_floor(run->stepper, position, v * tau + a * tau * tau);
    if (v == 0) switcher_set_floor(run->stepper, rate, a * tau);
}

void run_set_noise(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    struct instant at = state_instant(run->state);
    double *along = run->f; /* is overwritten by the restart that follows */
    changes(run, &at, along);
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct model_body *body = &run->model->bodies[b];
        double gross[most_coordinates_of_a_body];
        gross_forces(run, (int)b, &at, gross);
        for (int k = 0; k < body->count; k++) {
            int i = body->first + k;
            double of_time = fabs(at.t * along[i]), of_sum = 2 * gross[k] * plan->inverse_inertia[i];
            double noise = DBL_EPSILON * (of_sum + of_time);
            switcher_set_noise(run->stepper, (size_t)i, isfinite(noise) ? noise : 0);
            set_floors(run, i);
        }
    }
}

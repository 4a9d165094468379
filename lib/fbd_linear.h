/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_linear: linearisations with inputs and outputs, transfer functions and frequency responses. The rules of fbd.h apply.
 */
#ifndef FBD_LINEAR_H
#define FBD_LINEAR_H

#include "fbd_study.h"

#ifdef __cplusplus
extern "C" {
#endif

/* x' = A x + B u, y = C x + D u: a linearisation with inputs u and outputs y, as deviations from the equilibrium. A and x
 * are those of the linearisation. */
typedef struct fbd_linear_system fbd_linear_system;

/* Names of inputs and outputs. Inputs are `inputs` of the file. Outputs are coordinates and rates ("cart.x", "cart.v"),
 * accelerations ("cart.v_dot"), user states ("states.charge"), and places, velocities and accelerations of points
 * ("rod.tip.x", "rod.G.vy", "rod.tip.ax"). */
typedef struct fbd_linear_plan {
    size_t size;               /* sizeof(fbd_linear_plan), or 0 */
    const char *const *inputs; /* none: all inputs of the file */
    size_t input_count;
    const char *const *outputs; /* none: all coordinates and user states */
    size_t output_count;
} fbd_linear_plan;

/* Make the system; B, C and D are exact. The inputs cost one compilation of the model. NULL with a note in `errors`:
 * `no-inputs` for a file without any, `unknown-input`, `unknown-output`, `no-derivatives` (a file with `hysteresis`, or an
 * input that a callback computes), `not-finite`, or memory is out. The linearisation and its model must outlive it. */
FBD_API fbd_linear_system *fbd_linear_system_new(const fbd_linearization *linearization,
                                                 const fbd_linear_plan *plan, fbd_errors *errors);
FBD_API void fbd_linear_system_free(fbd_linear_system *system);

/* An input or output; its unit is coherent, as in fbd_variable. Past the last one both are NULL. */
typedef struct fbd_signal {
    const char *name, *unit;
} fbd_signal;

FBD_API size_t fbd_linear_system_input_count(const fbd_linear_system *system);
FBD_API size_t fbd_linear_system_output_count(const fbd_linear_system *system);
FBD_API fbd_signal fbd_linear_system_input(const fbd_linear_system *system, size_t index);
FBD_API fbd_signal fbd_linear_system_output(const fbd_linear_system *system, size_t index);

/* B (fbd_linearization_size x inputs), C (outputs x size) and D (outputs x inputs), row by row; they live as long as the
 * system. */
FBD_API const double *fbd_linear_system_input_matrix(const fbd_linear_system *system);
FBD_API const double *fbd_linear_system_output_matrix(const fbd_linear_system *system);
FBD_API const double *fbd_linear_system_feedthrough(const fbd_linear_system *system);

typedef struct fbd_complex {
    double re, im;
} fbd_complex;

/* The transfer function of one input to one output, H(s) = gain prod(s - zeros) / prod(s - poles), s in 1/s. States that
 * the input does not reach, or that do not act on the output, by the zeros of A, B and C are left out; other motions that
 * cancel appear both as a pole and a zero. Poles and zeros are ordered by absolute value. */
typedef struct fbd_transfer {
    size_t pole_count, zero_count;
    const fbd_complex *poles, *zeros;
    double gain; /* 0, without poles and zeros, where the input does not act on the output */
    double
        static_gain; /* H(0) in the unit of the output by that of the input; INFINITY with a pole at 0, NAN where a pole
                         * and a zero at 0 may cancel */
} fbd_transfer;

/* Find the transfer function; it is freed with fbd_transfer_free and independent of the system. NULL for an index past the
 * end, with a note in `errors`: `not-finite` where poles or zeros are not found, or memory is out. */
FBD_API fbd_transfer *fbd_transfer_new(const fbd_linear_system *system, size_t input, size_t output,
                                       fbd_errors *errors);
FBD_API void fbd_transfer_free(fbd_transfer *transfer);

/* The frequency response H(i omega) at `count` frequencies [rad/s], solved from the matrices; both parts are INFINITY at an
 * undamped pole. False for an invalid call, a frequency that is not finite, or memory is out. */
FBD_API bool fbd_linear_system_response(const fbd_linear_system *system, size_t input, size_t output,
                                        const double *omega, size_t count, fbd_complex *response);

/* Texts, to be freed with fbd_free; NULL when memory is out. The text and JSON of the linearisation with those of the
 * system; the frequency responses of all inputs and outputs as a table (CSV: omega, then magnitude and phase of each), and
 * as a Bode plot by gnuplot, whose terminal follows from the ending of `file` as in fbd_result_gnuplot. Phases are
 * continuous and begin with that of s = 0 in the left half-plane. */
FBD_API char *fbd_linear_system_text(const fbd_linear_system *system);
FBD_API char *fbd_linear_system_json(const fbd_linear_system *system);
FBD_API char *fbd_linear_system_csv(const fbd_linear_system *system);
FBD_API char *fbd_linear_system_gnuplot(const fbd_linear_system *system, const char *file);

#ifdef __cplusplus
}
#endif

#endif

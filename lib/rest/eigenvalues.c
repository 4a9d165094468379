/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/eigenvalues.h"
#include "fbd_study.h"
#include "numeric/tolerances.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* By frequency, then the one with the positive imaginary part first. */
static int by_frequency(const void *left, const void *right)
{
    const fbd_mode *a = left, *b = right;
    double difference = a->frequency - b->frequency;
    if (fabs(difference) > negligible_sum * (a->frequency + b->frequency)) return difference < 0 ? -1 : 1;
    return a->im > b->im ? -1 : a->im < b->im ? 1 : a->re < b->re ? -1 : 1;
}

int eigenvalues_find(size_t size, const double *matrix, fbd_mode *modes)
{
    size_t bytes = size * size * sizeof *matrix;
    double *A = malloc(bytes); /* a copy, which is overwritten */
    gsl_vector_complex *values = gsl_vector_complex_alloc(size);
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(size);
    bool made = A && values && work, done = false;
    if (made) {
        memcpy(A, matrix, bytes);
        gsl_matrix_view view = gsl_matrix_view_array(A, size, size);
        gsl_eigen_nonsymm_params(0, 1, work); /* balanced: coordinates have different units */
        done = gsl_eigen_nonsymm(&view.matrix, values, work) == GSL_SUCCESS;
        for (size_t i = 0; done && i < size; i++) {
            gsl_complex lambda = gsl_vector_complex_get(values, i);
            double re = GSL_REAL(lambda), im = GSL_IMAG(lambda), frequency = hypot(re, im);
            modes[i] = (fbd_mode){re, im, frequency, frequency > 0 ? -re / frequency : NAN};
            done = isfinite(frequency) && (frequency == 0 || isfinite(1 / frequency));
        }
        if (done) qsort(modes, size, sizeof *modes, by_frequency);
    }
    if (work) gsl_eigen_nonsymm_free(work);
    if (values) gsl_vector_complex_free(values);
    free(A);
    return made ? done : -1;
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Validation of error bars: for every model of the gallery, every method and six tolerances, the ratio of
 * estimated to true errors. Prints the tables of docs/error-bars.md.
 *
 * Usage: validate_error_bars [--verbose] [--method NAME] MODEL...
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_errno.h>

#include "error_ratio.h"
#include "integrate/method.h"

static const double tolerances[] = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13};

enum { tolerance_count = sizeof tolerances / sizeof *tolerances, most_methods = 32 };

struct totals {
    struct ratio_table by_method[most_methods], by_tolerance[tolerance_count], all;
    unsigned long left_out;
    const char *method; /* the only one, or NULL for all */
    bool verbose;
};

static const char *method_name(size_t index)
{
    if (index == 0) return "auto";
    const struct method *method = method_at(index - 1);
    return method ? method->name : NULL;
}

static void add(struct ratio_table *to, const struct ratio_table *from)
{
    for (int k = 0; k < ratio_kinds; k++) {
        to->counts[k].low += from->counts[k].low;
        to->counts[k].good += from->counts[k].good;
        to->counts[k].high += from->counts[k].high;
        to->counts[k].floor += from->counts[k].floor;
        to->counts[k].over += from->counts[k].over;
    }
}

static void validate(struct totals *totals, const char *path)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_read(path, NULL, 0, errors);
    struct truth *truth = model ? truth_new(model, exact_motion_of(path)) : NULL;
    struct ratio_table here = {0};
    for (size_t m = 0; truth && method_name(m); m++) {
        if (totals->method && strcmp(totals->method, method_name(m)) != 0) continue;
        for (int i = 0; i < tolerance_count; i++) {
            struct ratio_table one = {.verbose = totals->verbose};
            if (!ratio_add(&one, truth, method_name(m), tolerances[i], 0)) {
                totals->left_out++;
                break; /* a smaller tolerance takes longer */
            }
            add(&totals->by_method[m], &one);
            add(&totals->by_tolerance[i], &one);
            add(&totals->all, &one);
            add(&here, &one);
        }
    }
    const char *name = strstr(path, "models/");
    if (truth)
        printf("%-44s %s to %8.1e; %4.0f %% of %lu good\n", name ? name : path,
               exact_motion_of(path) ? "closed form" : "two methods", truth_floor(truth),
               100 * ratio_share(&here.counts[ratio_global]),
               here.counts[ratio_global].good + here.counts[ratio_global].low +
                   here.counts[ratio_global].high + here.counts[ratio_global].floor +
                   here.counts[ratio_global].over);
    else
        printf("%-44s does not come to an end\n", name ? name : path);
    fflush(stdout);
    truth_free(truth);
    fbd_model_free(model);
    fbd_errors_free(errors);
}

static void print_row(const char *name, const struct ratio_counts *c)
{
    unsigned long all = c->low + c->good + c->high + c->floor + c->over;
    printf("| %-19s | %6lu | %5lu | %5lu | %5lu | %5lu | %5lu | %5.1f %% | %5.1f %% |\n", name, all, c->low,
           c->good, c->high, c->floor, c->over, 100 * ratio_determined_share(c), 100 * ratio_share(c));
}

static void print_head(const char *title)
{
    printf("\n| %-19s | cases  | < 0.3 | good  | > 10  | floor | over  | good of determined | good of all |\n"
           "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
           title);
}

int main(int argc, char **argv)
{
    static struct totals totals;
    gsl_set_error_handler_off();
    int first = 1;
    if (first < argc && strcmp(argv[first], "--verbose") == 0) {
        totals.verbose = true;
        first++;
    }
    if (first + 1 < argc && strcmp(argv[first], "--method") == 0) {
        totals.method = argv[first + 1];
        first += 2;
    }
    for (int i = first; i < argc; i++) validate(&totals, argv[i]);
    print_head("quantity");
    for (int k = 0; k < ratio_kinds; k++) print_row(ratio_names[k], &totals.all.counts[k]);
    print_head("global error, by");
    for (size_t m = 0; method_name(m); m++)
        if (!totals.method || strcmp(totals.method, method_name(m)) == 0)
            print_row(method_name(m), &totals.by_method[m].counts[ratio_global]);
    for (int i = 0; i < tolerance_count; i++) {
        char name[32];
        snprintf(name, sizeof name, "tolerance %g", tolerances[i]);
        print_row(name, &totals.by_tolerance[i].counts[ratio_global]);
    }
    printf("\n%lu of the ladders ended early: the method failed or took too many evaluations\n",
           totals.left_out);
    return 0;
}

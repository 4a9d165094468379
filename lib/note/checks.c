/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The checks of a note, each with its result and limit: balance of each body, energy, couplings, derivations by hand, an exact
 * solution, and another method.
 */
#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "fbd_grade.h"
#include "note/note.h"

/* Relative limits: of balances, which are solved to rounding, and of differences of runs, relative to the size of the
 * motion. Where the error of the run itself is larger, ten times that is the limit of differences. */
static const double balance_limit = 1e-9, run_limit = 1e-6, error_bars_allowed = 10;

static void check_row(struct making *making, struct block *table, const char *check, const char *found,
                      const char *limit, bool met)
{
    document_cell(making->document, table, check);
    document_cell(making->document, table, found);
    document_cell(making->document, table, limit);
    document_cell(making->document, table, met ? "yes" : "NO");
    making->note->checks++;
    making->note->failed_checks += !met;
}

/* ---- balance of forces and moments */

/* The sizes of the forces of the scene, and of their moments about the centres of mass. */
struct sizes {
    double force, moment;
};

static void take_sizes(struct making *making, fbd_state *state, size_t body, struct sizes *sizes)
{
    fbd_arrow *arrows;
    const size_t count = making_arrows(making, state, body, &arrows);
    const fbd_pose pose = fbd_state_pose(state, body);
    for (size_t i = 0; i < count; i++) {
        const double force = hypot(arrows[i].fx, arrows[i].fy),
                     arm = hypot(arrows[i].x - pose.G[0], arrows[i].y - pose.G[1]);
        sizes->force = fmax(sizes->force, force);
        sizes->moment = fmax(sizes->moment, fabs(arrows[i].couple) + force * arm);
    }
}

/* The largest difference between inertia times acceleration and the sum of the terms, relative to the largest force or
 * moment of the scene. */
static double worst_balance(const fbd_equations *equations, const char *force_unit, const struct sizes *sizes)
{
    double worst = 0;
    for (size_t i = 0; i < fbd_equations_count(equations); i++) {
        const fbd_equation e = fbd_equations_get(equations, i);
        double size = strcmp(e.unit, force_unit) == 0 ? sizes->force : sizes->moment;
        for (size_t k = 0; k < e.term_count; k++) size = fmax(size, fabs(e.terms[k].value));
        if (size > 0) worst = fmax(worst, fabs(e.inertia * e.acceleration - e.sum) / size);
    }
    return worst;
}

static void check_balance(struct making *making, struct block *table, fbd_state *state, const char *check)
{
    struct sizes sizes = {0, 0};
    for (size_t b = 0; b < fbd_model_body_count(making->model); b++) take_sizes(making, state, b, &sizes);
    fbd_equations *equations = fbd_assemble_components(state);
    if (!equations) {
        making->document->arena.failed = true;
        return;
    }
    const double worst = worst_balance(equations, fbd_model_units(making->model).force, &sizes);
    check_row(making, table, check, making_number(making, worst, error_digits),
              making_number(making, balance_limit, error_digits), worst <= balance_limit);
    fbd_equations_free(equations);
}

/* ---- energy and couplings */

static void check_energy(struct making *making, struct block *table)
{
    const char *unit = fbd_model_units(making->model).energy;
    double residual = NAN, explained = NAN;
    const bool met = fbd_result_balanced(making->result, &residual, &explained);
    if (!isfinite(residual)) return;
    check_row(making, table,
              "energy: change of kinetic and potential energy less the work of the other forces",
              making_value(making, residual, unit, error_digits),
              isfinite(explained) ? making_value(making, explained, unit, error_digits)
                                  : "none for steps of fixed size",
              met);
}

static void check_couplings(struct making *making, struct block *table)
{
    const fbd_drift drift = fbd_simulation_drift(making->simulation);
    if (drift.rows == 0) return;
    check_row(making, table,
              "couplings: largest violation after a step, of the tolerance times the size of the motion",
              making_number(making, drift.left_share, error_digits), "1", drift.left_share <= 1);
}

/* ---- derivations by hand */

static bool begins_derivation(const char *line)
{
    return line[0] && line[0] != ' ' && strncmp(line, "seed ", 5) != 0;
}

/* Each derivation is a line, its result in indented lines below. */
static size_t count_derivations(const char *text)
{
    size_t count = 0;
    for (const char *line = text; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL)
        count += begins_derivation(line);
    return count;
}

static const char *check_hand(struct making *making, struct block *table)
{
    static const char none[] = "no body carries";
    size_t differing = 0;
    char *text = fbd_check_hand(making->model, 1, &differing);
    const char *kept = document_take(making->document, text);
    if (!kept || strncmp(kept, none, strlen(none)) == 0) return NULL;
    const size_t count = count_derivations(kept);
    struct arena *arena = &making->document->arena;
    check_row(making, table, "derivations by hand in the file, at random states",
              arena_printf(arena, "%zu of %zu agree", count > differing ? count - differing : 0, count),
              "all", differing == 0);
    return kept;
}

/* ---- other solutions */

static double limit_of_runs(const struct making *making)
{
    const double error = making->stats.error_estimate;
    return isfinite(error) ? fmax(run_limit, error_bars_allowed * error) : run_limit;
}

static void check_exact(struct making *making, struct block *table)
{
    const size_t count = fbd_model_coordinate_count(making->model);
    double worst = NAN;
    for (size_t i = 0; i < 2 * count; i++) {
        const fbd_coordinate c = fbd_model_coordinate(making->model, i < count ? i : i - count);
        double exact, rate, value = 0;
        if (!fbd_model_exact(making->model, i, making->t, &exact, &rate)) continue;
        fbd_state_get(making->end, i < count ? c.name : c.rate_name, &value);
        const double size = fmax(fabs(exact), fabs(value));
        worst = fmax(worst, size > 1 ? fabs(value - exact) / size : fabs(value - exact));
    }
    if (isnan(worst)) return;
    const double limit = limit_of_runs(making);
    check_row(making, table, "exact solution of the file, at the end",
              making_number(making, worst, error_digits), making_number(making, limit, error_digits),
              worst <= limit);
}

static void check_second_run(struct making *making, struct block *table, const struct second_run *second)
{
    struct arena *arena = &making->document->arena;
    const double limit = limit_of_runs(making);
    check_row(
        making, table,
        arena_printf(
            arena,
            "another method (%s, tolerance %s): largest difference at the end, of the size of the motion",
            second->method, making_number(making, second->tolerance, error_digits)),
        arena_printf(arena, "%s, in %s", making_number(making, second->difference, error_digits),
                     second->worst ? making_symbol(making, second->worst) : "none"),
        making_number(making, limit, error_digits), second->difference <= limit);
    check_row(making, table, "the same events by that method",
              second->same_events && isfinite(second->event_difference)
                  ? arena_printf(arena, "the same, times differ by %s",
                                 making_value(making, second->event_difference, "s", error_digits))
              : second->same_events ? "the same"
                                    : "others",
              "the same", second->same_events);
}

/* An accuracy that the file or the caller requested. */
static void check_accuracy(struct making *making, struct block *table)
{
    const fbd_stats *stats = &making->stats;
    if (!(stats->accuracy > 0)) return;
    check_row(making, table, "requested accuracy: estimated error, of the size of the motion",
              making_number(making, stats->error_estimate, error_digits),
              making_number(making, stats->accuracy, error_digits), fbd_result_accurate(making->result));
}

/* ---- all */

static void list_balances(struct making *making, struct block *table)
{
    check_balance(making, table, making->start,
                  "balance of forces and of moments of each body at the start: largest residual, of the "
                  "largest force or moment");
    check_balance(making, table, making->end, "the same at the end");
}

void note_checks(struct making *making)
{
    static const char *const heads[] = {"Check", "Found", "Limit", "Met"};
    struct second_run second;
    document_heading(making->document, 2, "Checks");
    struct block *table = document_table(making->document, "checks", "wlll", heads);
    table->table.marked = true;
    list_balances(making, table);
    check_energy(making, table);
    check_couplings(making, table);
    check_accuracy(making, table);
    const char *hand = check_hand(making, table);
    check_exact(making, table);
    if (!second_run(making, &second)) {
        making->refused = true;
        if (!making->document->arena.failed)
            diag_add(making->list, FBD_ERROR, "stopped", (struct pos){0, 0}, NULL,
                     "the note was interrupted");
        return;
    }
    if (!second.reason) check_second_run(making, table, &second);
    if (second.reason)
        document_paragraph(making->document, "The run by another method (%s) was not completed: %s.",
                           second.method, second.reason);
    if (!hand) {
        document_paragraph(making->document, "The file contains no derivation by hand (`hand:`).");
    } else {
        document_paragraph(making->document, "The derivations by hand:");
        document_verbatim(making->document, hand, strlen(hand));
    }
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Expressions: compiled once, evaluated many times.
 *
 * A scalar of the model file (`30 deg`, `4[N/s]*t`, `-k*x - k3*x^3`) is compiled to a compact program.
 * Evaluation yields the value, exact derivatives by dual numbers (first order) and hyper-dual numbers (second
 * order), never allocates, and may run in many threads on one program. Constants are folded: an expression of
 * constants is one number.
 *
 * Grammar (loosest first):  or | and | not | comparison (< <= > >= ==) | + - | * / | unary - + | ^ (right to
 * left) | call, name, number, ( ). A literal takes a unit in brackets: 5[N], 0.1[N*m*s/rad]. A whole scalar
 * that is a number followed by a unit (`30 deg`, `-5 lbf`) is a quantity. Anything else of the form `5 N +
 * ...` is an error whose message shows the brackets.
 *
 * Functions: sin cos tan asin acos atan atan2 sinh cosh tanh exp ln log (= ln) log10 sqrt cbrt hypot pow abs
 * sign min max (two to eight arguments) floor ceil round mod(a, b) (with the sign of b), step(u) (0 below
 * zero, 1 from zero on), pulse(t, start, width) (1 from start to start + width), square(u) (+1 in the first
 * half of each unit period of u, -1 in the second), sawtooth(u) (u - floor(u)), clamp(u, low, high),
 * if(condition, a, b). Tables of the scope (table.h) are functions of one argument. Constants: pi.
 *
 * Dimensions are checked everywhere. A bare literal (no unit) takes the dimension that it needs, and so does
 * a product with such a factor; so `2*x + F` passes. pi counts as a bare literal, so that sin(pi*t) needs no
 * more units than sin(3*t). Exponents must be numbers when the base has a dimension. Angles are pure numbers.
 *
 * KINKS. Functions that are not smooth (abs sign min max step pulse square floor mod clamp if and comparisons
 * ...) are switches: each has a branch (a small integer), and evaluation with given branches follows the
 * smooth formula of that branch, also beyond its end. The caller keeps the branches, detects by the margins
 * when a branch ends, locates that time and changes the branch. So no step of an integrator contains a kink.
 * Without branches (NULL) evaluation gives the plain value. A table has a branch for each of its pieces.
 *
 * if(condition, a, b) evaluates only the side that is chosen; clamp and pulse are two switches each, `and`,
 * `or` and `not` none. A switch by sign (of u, or of a - b) has the branches -1 and 1, and sign and == also
 * 0, for u that is and stays zero: there sign is 0 and == is true. A rounding (floor, ceil, round, mod,
 * sawtooth, square) has a branch for each of its steps. Beyond 2^31 steps branches are not counted: no
 * margins, and the plain value.
 *
 * DERIVATIVES are those of the smooth formula of the branch. They are finite where the derivative exists
 * (x^2, x*abs(x), x*sqrt(x) at 0), infinite where it is (sqrt at 0), and 0 for abs (without branches) and
 * hypot at their corner.
 */
#ifndef FBD_EXPR_EXPR_H
#define FBD_EXPR_EXPR_H

#include "base/arena.h"
#include "base/diag.h"
#include "base/time_dd.h"
#include "expr/interval.h"
#include "expr/unit.h"

/* ---- compiling */

struct expr;

/* The meaning of a name. */
struct symbol {
    enum {
        symbol_unknown,
        symbol_constant,
        symbol_variable,
        symbol_failed
    } kind; /* failed: a note was given already */
    struct dim dim;
    bool free;    /* given as a bare number: takes any dimension */
    bool angle;   /* it is an angle: a bare number compared with it is in rad */
    double value; /* of a constant */
    int slot;     /* of a variable: 0 is t, k >= 1 is y[k - 1] */
    const char
        *because; /* why it is not constant, in messages: "is the time"; NULL for "changes with the motion" */
};

/* The meaning of a name with an argument that is no function: `failed` after a note, else NULL if it is no
 * table. */
struct table;
struct table_symbol {
    const struct table *table;
    bool failed;
};

/* The names that an expression may use. */
struct scope {
    /* The meaning of `name` (dots included: `crank.theta`); called at most once for each occurrence. */
    struct symbol (*lookup)(void *context, const char *name, struct pos at);
    /* All names that are allowed here, for hints; returns their number, *names lives as long as the scope.
     * May be NULL. */
    size_t (*names)(void *context, const char *const **names);
    /* The table called `name`; called at most once for each occurrence. May be NULL. */
    struct table_symbol (*table)(void *context, const char *name, struct pos at);
    /* Their names, as `names`; may be NULL. */
    size_t (*tables)(void *context, const char *const **names);
    /* True if `word` takes an expression in brackets whose names are looked up in another sense, as
     * `before(v)`. That sense holds from then on until a call with NULL. May be NULL. */
    bool (*sense)(void *context, const char *word);
    /* The variable that `name` is at a constant length x, as the bending moment `M(0.4[m])`; symbol_unknown if it has no
     * such meaning, which is asked before by NAN for x; `free` if bare numbers are lengths then. May be NULL. */
    struct symbol (*at_length)(void *context, const char *name, double x, struct pos at);
    void *context;
    enum unit_system units;
};

/* The requirements of the caller. */
struct expr_want {
    struct dim dim;
    bool any_dim;     /* accept any dimension (it is returned by expr_dim) */
    bool constant;    /* variables are an error (id `not-constant`) */
    bool angle;       /* warn about a bare number beyond one turn, as `30` for `30 deg` (id `bare-angle`) */
    bool in_braces;   /* the text is in braces without quotes; a hint shows an expression with quotes */
    bool condition;   /* a truth value is required (for if); otherwise it is an error */
    const char *what; /* for messages: "mass", "friction.static" */
};

/* Compile `text`, which starts at `at` in its file. Memory comes from `arena`. NULL with at least one note in
 * `errors` when it is wrong (no further note for a name that is symbol_failed); columns point at the
 * offending token. A newline counts as one column. Limits: 16384 characters, nesting 100, 4096 operations,
 * 1024 different numbers, variables and intermediate values together (id `expression-too-long`). Ids:
 * `expression-syntax`, `unknown-name`, `unknown-function`, `argument-count`, `wrong-dimension`,
 * `unknown-unit`, `unit-syntax`, `unit-needs-brackets`, `not-constant`, `not-finite` (a constant part that is
 * inf or nan, as 1/0). A condition in place of a number, or the reverse, is an `expression-syntax`. Warnings:
 * `bare-angle`, and `hertz-as-rate` for a quantity in Hz where an angular velocity is required. */
const struct expr *expr_compile(struct arena *arena, const char *text, struct pos at,
                                const struct scope *scope, const struct expr_want *want, fbd_errors *errors);

/* Compile an equation `left = right` or a comparison `left < right`, split at its only top-level relation,
 * into both sides, whose dimensions must be equal. *relation is '=', '<', '>' (<= and >= count as < and >) or
 * 0 if there is none (then *right is NULL). False with notes on error. `want->any_dim` is the usual choice. */
bool expr_compile_relation(struct arena *arena, const char *text, struct pos at, const struct scope *scope,
                           const struct expr_want *want, fbd_errors *errors, const struct expr **left,
                           char *relation, const struct expr **right);

/* A summand of a sum: its text without the sign before it. */
struct summand {
    size_t start, length;
    bool negative;
};

/* Split `text`, an expression that compiles, at the + and - outside of all brackets. Returns the number of
 * summands and stores at most `room`. */
size_t expr_summands(const char *text, size_t length, struct summand *summands, size_t room);

/* A constant expression without text. */
const struct expr *expr_constant(struct arena *arena, double value, struct dim dim);

/* The name of function `index`, or NULL past the last one. */
const char *expr_function(size_t index);

/* ---- properties */

bool expr_is_constant(const struct expr *expr);
double expr_value(const struct expr *expr); /* of a constant */
bool expr_is_bare(const struct expr *expr); /* its dimension is free, by a bare number */

/* The dimension: the required one; with any_dim that of the expression, where bare literals count as pure
 * numbers if no other part decides. A condition has none. */
struct dim expr_dim(const struct expr *expr);
bool expr_uses_time(const struct expr *expr);

/* The slots k >= 1 that it depends on, ascending, without t; returns their number. */
size_t expr_variables(const struct expr *expr, const int **slots);

/* How an expression varies between events, that is, with constant branches. */
enum expr_degree {
    expr_constant_between, /* constant */
    expr_affine,           /* c + sum c_k y_k with constant c, without t */
    expr_nonlinear,        /* any other, or not shown to be simpler */
};

/* Slots beyond `last` count as nonlinear; those of `constant`, by slot, as constant, unless it is NULL. */
enum expr_degree expr_degree(const struct expr *expr, int last, const bool *constant);

/* The same expression over another vector: slot k becomes moved[k]; the order of the slots must not change.
 * Shares all else with `expr`. NULL when memory is out. */
const struct expr *expr_renumbered(struct arena *arena, const struct expr *expr, const int *moved);

/* ---- evaluation; y is the caller's vector, slot k is y[k - 1]; `branch` are this program's branches or NULL */

double expr_eval(const struct expr *expr, double t, const double *y, const int *branch);

/* Value and derivative along the direction (dt, dy): first-order dual numbers. dy may be NULL for zero. */
double expr_eval_along(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                       const int *branch, double *derivative);

/* Value and derivative with respect to one slot (0 is t). */
double expr_eval_slot(const struct expr *expr, double t, const double *y, int slot, const int *branch,
                      double *derivative);

/* Value, d/da, d/db and d2/(da db) for slots a and b: hyper-dual numbers (Fike & Alonso 2011, AIAA 2011-886).
 */
double expr_eval_second(const struct expr *expr, double t, const double *y, int slot_a, int slot_b,
                        const int *branch, double *d_a, double *d_b, double *d_ab);

/* A first-order bound of the rounding error of the value: (tanh(u + 3) - tanh(u - 3))/2 has an error of 1e-16
 * where its value is 1e-20. Operations without a bound (a square root of 0) are not counted. */
double expr_rounding(const struct expr *expr, double t, const double *y, const int *branch);

/* ---- kinks */

/* The number of switches; the caller keeps one int for each. */
size_t expr_switches(const struct expr *expr);

/* True when switch `index` depends on t alone (its crossings can be found before a step is taken). */
bool expr_switch_is_time(const struct expr *expr, size_t index);

/* Two margins for each switch, positive inside the branch, negative beyond its end; +HUGE_VAL for an end that
 * does not exist. Evaluated with the given branches (so that they are smooth functions of the state).
 * `margins` has 2 * expr_switches entries, the lower end of switch i at 2 i and the upper one at 2 i + 1.
 * With `rates` not NULL, also their derivatives along (dt, dy), 0 for ends that do not exist; with
 * `roundings` not NULL, the tolerance within which a margin counts as zero. A switch in the side of an `if`
 * that is not chosen is inactive: both margins are +HUGE_VAL. Margins have the unit of u, and for roundings
 * that of the branch number. */
void expr_margins(const struct expr *expr, struct time_dd t, const double *y, double dt, const double *dy,
                  const int *branch, double *margins, double *rates, double *roundings);

/* Choose the branches at a point from the values; where a switching function is zero to rounding, from its
 * rate along (dt, dy), the direction in which the motion continues. `keep` (may be NULL) marks switches whose
 * branch in `branch` is already decided and stays. With a rate of exactly zero a switch takes the side of its
 * plain value, sign and == their branch 0. An inactive switch gets branch 0. Zero to rounding means within a
 * few bounds of the rounding error of u, which is propagated through the expression; so a time located to the
 * last bit is recognised. With `keep`, that of an event, the time and the constants count as exact; without,
 * the time may be any double. */
void expr_resolve(const struct expr *expr, struct time_dd t, const double *y, double dt, const double *dy,
                  const bool *keep, int *branch);

/* The same, except that a switch whose u is zero with a rate of exactly zero keeps its branch in `branch`, if
 * that is not 0: the branch itself keeps u at zero, as at the limit of an integrator. */
void expr_resolve_at_rest(const struct expr *expr, struct time_dd t, const double *y, double dt,
                          const double *dy, const bool *keep, int *branch);

/* The switching functions of the active switches at a point of the motion: u, its rate along (dt, dy), and
 * the rounding error of u, within which it is zero. NAN for inactive switches. Each array has expr_switches
 * entries. */
void expr_switchings(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                     const int *branch, double *u, double *rates, double *rounding);

/* True if the value jumps at a switch (sign, step, comparisons), so that a sliding mode is possible. False
 * for abs, min and max. */
bool expr_switch_jumps(const struct expr *expr, size_t index);

/* The degree of the switching function of one switch, likewise. */
enum expr_degree expr_switch_degree(const struct expr *expr, size_t index, int last, const bool *constant);

/* True if the switching function is a + b t with constants a and b while the branches of all switches last. */
bool expr_switch_is_affine_in_time(const struct expr *expr, size_t index);

/* True for a relay, whose value depends on the previous motion. */
bool expr_switch_remembers(const struct expr *expr, size_t index);

/* True if the switching function of switch `index` depends on switch `on`, which precedes it. */
bool expr_switch_depends(const struct expr *expr, size_t index, size_t on);

/* The table whose pieces are the branches of a switch, or NULL. */
const struct table *expr_switch_table(const struct expr *expr, size_t index);

/* True for a switch of levels, at whose ends the value does not change: it only prevents steps from passing
 * over the range in which exp, tanh and others vary. */
bool expr_switch_is_silent(const struct expr *expr, size_t index);

/* The branch on the other side of end `end` (0 lower, 1 upper) of switch `index`. */
int expr_branch_beyond(const struct expr *expr, size_t index, int end, int branch);

/* ---- enclosures */

/* The ranges of the value and of its rate over a time interval, for all motions whose slots k >= 1 stay in
 * y[k - 1]; y may be NULL for any motion. Entries beyond the slots in use are not read. */
struct enclosure expr_enclose(const struct expr *expr, const struct stretch *stretch,
                              const struct enclosure *y, const int *branch);

/* The same for expr_margins; margins that do not exist are the point +HUGE_VAL. */
void expr_enclose_margins(const struct expr *expr, const struct stretch *stretch, const struct enclosure *y,
                          const int *branch, struct enclosure *margins);

/* ---- poles */

/* The number of divisions by a varying divisor, including powers with a negative exponent. */
size_t expr_poles(const struct expr *expr);

/* The divisors and their rates along (dt, dy): where a divisor passes through zero the expression is
 * infinite, or has a limit as sin(x)/x has. +HUGE_VAL and 0 for one in the side of an `if` that is not
 * chosen. Both arrays have expr_poles entries. */
void expr_divisors(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                   const int *branch, double *divisors, double *rates);

#endif

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Formulas of the file as functions of the program.
 */
#include "emit/bodies.h"
#include "emit/expression.h"
#include "emit/live.h"

const char *emit_dual_name(unsigned op)
{
    switch (op) {
    case op_negate: return "dual_negate";
    case op_add: return "dual_add";
    case op_subtract: return "dual_subtract";
    case op_multiply: return "dual_multiply";
    case op_divide: return "dual_divide";
    case op_power: return "dual_power";
    case op_sqrt: return "dual_sqrt";
    case op_cbrt: return "dual_cbrt";
    case op_hypot: return "dual_hypot";
    case op_exp: return "dual_exp";
    case op_ln: return "dual_log";
    case op_log10: return "dual_log10";
    case op_sin: return "dual_sin";
    case op_cos: return "dual_cos";
    case op_tan: return "dual_tan";
    case op_asin: return "dual_asin";
    case op_acos: return "dual_acos";
    case op_atan: return "dual_atan";
    case op_atan2: return "dual_atan2";
    case op_sinh: return "dual_sinh";
    case op_cosh: return "dual_cosh";
    case op_tanh: return "dual_tanh";
    case op_abs: return "dual_abs";
    case op_min: return "dual_min";
    case op_max: return "dual_max";
    case op_mod: return "dual_mod";
    case op_sawtooth: return "dual_sawtooth";
    default: return NULL;
    }
}

bool emit_dual_takes_two(unsigned op)
{
    return op == op_add || op == op_subtract || op == op_multiply || op == op_divide || op == op_power ||
           op == op_hypot || op == op_atan2;
}

/* Write a function of (s, t, y) with one line. */
static const char *write_function(struct emitter *emitter, const char *type, const char *wanted,
                                  const char *comment, const char *value)
{
    struct text lines = {0};
    const char *name = emit_name(emitter, wanted);
    text_printf(&lines, "    return %s;\n", value);
    const char *head = emit_printf(emitter, "/* %s */\nstatic %s %s", comment, type, name);
    emit_function(&emitter->formulas, head, "const struct scene *s, double t, const double *y", &lines);
    emitter->arena.failed = emitter->arena.failed || lines.failed;
    text_free(&lines);
    return emit_printf(emitter, "%s(s, t, y)", name);
}

const char *emit_formula(struct emitter *emitter, const struct formula *formula, const char *wanted,
                         struct emit_origin origin)
{
    if (formula_is_constant(formula)) return emit_parameter(emitter, wanted, formula->constant, origin);
    char unit[64];
    unit_name(expr_dim(formula->expr), emitter->model->scene->units, unit, sizeof unit);
    const char *comment = emit_printf(emitter, "`%s`%s%s", origin.key, *unit ? " in " : "", unit);
    emit_live_formula(emitter, formula->expr, origin);
    const char *value = emit_expression(emitter, emit_live(emitter, formula->expr), formula->branch);
    return write_function(emitter, "double", wanted, comment, value);
}

const char *emit_slope(struct emitter *emitter, const struct formula *formula, const char *wanted, int slot,
                       struct emit_origin origin)
{
    emit_live_formula(emitter, formula->expr, origin);
    const char *value = emit_dual(emitter, emit_live(emitter, formula->expr), formula->branch, slot);
    const int n = emitter->model->plan.n;
    const char *by = slot == 0 ? "t" : slot <= n ? emitter->coordinate[slot - 1] : "a rate";
    const char *comment =
        emit_printf(emitter, "`%s` with its first and second derivative by %s", origin.key, by);
    return write_function(emitter, "struct dual", wanted, comment, value);
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random equations, written in random notations (LaTeX, letters beyond ASCII, plain text; products with and without a
 * sign) and as expressions: both have the same value. With two readings they are refused, and both readings are told.
 * Spoiled ones crash nothing, and what is an expression stays as it is.
 *
 * FBD_DRAWS: times as many.
 */
#include "notation_scope.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/text.h"
#include "random_numbers.h"
#include "thorough.h"

enum style { style_latex, style_signs, style_plain, styles };

/* The same expression in two spellings. */
struct pair_of_texts {
    struct random_numbers *random;
    enum style style;
    struct text written, plain;
};

static int draw(struct pair_of_texts *pair, int count)
{
    return (int)(random_bits(pair->random) % (uint64_t)count);
}

static void both(struct pair_of_texts *pair, const char *text)
{
    text_add(&pair->written, text);
    text_add(&pair->plain, text);
}

/* ---- names */

enum ending {
    after_letters, /* another letter would join it */
    after_command, /* a letter would join the command */
    after_mark,    /* nothing joins */
    after_number,
    after_exponent, /* that a letter would join */
    after_bare,     /* a function without brackets */
};

struct symbol_texts {
    const char *plain, *written[styles][2]; /* of each style two ways */
    bool letter;                            /* one letter */
};

static const struct symbol_texts symbols[] = {
    {"m", {{"m", "m"}, {"m", "m"}, {"m", "m"}}, true},
    {"g", {{"g", "g"}, {"g", "g"}, {"g", "g"}}, true},
    {"k", {{"k", "k"}, {"k", "k"}, {"k", "k"}}, true},
    {"b", {{"b", "b"}, {"b", "b"}, {"b", "b"}}, true},
    {"L", {{"L", "L"}, {"L", "L"}, {"L", "L"}}, true},
    {"R", {{"R", "R"}, {"R", "R"}, {"R", "R"}}, true},
    {"F", {{"F", "F"}, {"F", "F"}, {"F", "F"}}, true},
    {"q", {{"q", "q"}, {"q", "q"}, {"q", "q"}}, true},
    {"x", {{"x", "x"}, {"x", "x"}, {"x", "x"}}, true},
    {"x_dot", {{"\\dot{x}", "\\dot x"}, {"ẋ", "x′"}, {"x'", "x_dot"}}, false},
    {"x_ddot", {{"\\ddot{x}", "\\ddot x"}, {"ẍ", "x″"}, {"x''", "x_ddot"}}, false},
    {"theta", {{"\\theta", "\\vartheta"}, {"θ", "θ"}, {"theta", "theta"}}, false},
    {"theta_dot", {{"\\dot\\theta", "\\dot{\\theta}"}, {"θ̇", "θ'"}, {"theta'", "theta_dot"}}, false},
    {"theta_ddot", {{"\\ddot\\theta", "\\ddot{\\theta}"}, {"θ̈", "θ''"}, {"theta''", "theta_ddot"}}, false},
    {"omega", {{"\\omega", "\\omega"}, {"ω", "ω"}, {"omega", "omega"}}, false},
    {"lambda", {{"\\lambda", "\\lambda"}, {"λ", "λ"}, {"lambda", "lambda"}}, false},
    {"mu_k", {{"\\mu_k", "\\mu_{\\mathrm{k}}"}, {"μ_k", "μₖ"}, {"mu_k", "mu_k"}}, false},
    {"m_1", {{"m_1", "m_{1}"}, {"m₁", "m_1"}, {"m1", "m_1"}}, false},
};

static const struct symbol_texts *put_symbol(struct pair_of_texts *pair)
{
    const struct symbol_texts *symbol = &symbols[draw(pair, sizeof symbols / sizeof *symbols)];
    text_add(&pair->written, symbol->written[pair->style][draw(pair, 2)]);
    text_add(&pair->plain, symbol->plain);
    return symbol;
}

static enum ending symbol_ending(const struct pair_of_texts *pair, const struct symbol_texts *symbol)
{
    const struct text *text = &pair->written;
    if (pair->style == style_latex) return symbol->letter ? after_letters : after_command;
    bool mark = text->data[text->length - 1] == '\'' || (unsigned char)text->data[text->length - 1] >= 0x80u;
    return mark ? after_mark : symbol->letter ? after_letters : after_command;
}

/* ---- factors */

static void put_sum(struct pair_of_texts *pair, int depth);

static void put_number(struct pair_of_texts *pair)
{
    static const char *const numbers[] = {"2", "3", "0.5", "1.25", "10"};
    both(pair, numbers[draw(pair, 5)]);
}

static void put_group(struct pair_of_texts *pair, int depth)
{
    bool large = pair->style == style_latex && draw(pair, 2) == 0;
    text_add(&pair->written, large ? "\\left(" : "(");
    text_add(&pair->plain, "(");
    put_sum(pair, depth - 1);
    text_add(&pair->written, large ? "\\right)" : ")");
    text_add(&pair->plain, ")");
}

static enum ending put_power(struct pair_of_texts *pair)
{
    put_symbol(pair);
    text_add(&pair->plain, "^2");
    if (pair->style == style_latex) {
        text_add(&pair->written, draw(pair, 2) ? "^2" : "^{2}");
        return after_mark;
    }
    if (pair->style == style_signs) {
        text_add(&pair->written, "²");
        return after_mark;
    }
    text_add(&pair->written, draw(pair, 2) ? "^2" : "**2");
    return after_exponent;
}

static void put_fraction(struct pair_of_texts *pair, int depth)
{
    static const char *const commands[] = {"\\frac{", "\\tfrac{", "\\dfrac{"};
    bool latex = pair->style == style_latex;
    text_add(&pair->written, latex ? commands[draw(pair, 3)] : "((");
    text_add(&pair->plain, "((");
    put_sum(pair, depth - 1);
    text_add(&pair->written, latex ? "}{" : ")/(");
    text_add(&pair->plain, ")/(");
    put_sum(pair, depth - 1);
    text_add(&pair->written, latex ? "}" : "))");
    text_add(&pair->plain, "))");
}

static const char *const functions[] = {"sin", "cos", "exp", "tanh"};

/* `sin θ`, `sin 2θ`, `sin^2 θ` */
static enum ending put_bare(struct pair_of_texts *pair)
{
    const char *function = functions[draw(pair, 4)];
    int power = draw(pair, 3);
    static const char *const powers[styles][2] = {{"^2", "^{2}"}, {"²", "²"}, {"^2", "^2"}};
    text_printf(&pair->written, "%s%s%s ", pair->style == style_latex ? "\\" : "", function,
                power == 0 ? powers[pair->style][draw(pair, 2)] : "");
    text_printf(&pair->plain, "%s(", function);
    if (draw(pair, 3) == 0) {
        both(pair, "2");
        text_add(&pair->written, draw(pair, 2) ? " " : "");
        text_add(&pair->plain, "*");
    }
    put_symbol(pair);
    text_add(&pair->plain, power == 0 ? ")^2" : ")");
    return after_bare;
}

static void put_call(struct pair_of_texts *pair, int depth)
{
    int which = draw(pair, 6);
    bool latex = pair->style == style_latex;
    if (which == 4) {
        text_add(&pair->written, latex ? "\\sqrt{" : pair->style == style_signs ? "√(" : "sqrt(");
        text_add(&pair->plain, "sqrt(");
        put_symbol(pair);
        text_add(&pair->written, latex ? "}" : ")");
    } else if (which == 5) {
        text_add(&pair->written,
                 latex ? "\\left|" : "abs("); /* two with a product between have two readings */
        text_add(&pair->plain, "abs(");
        put_symbol(pair);
        text_add(&pair->written, latex ? "\\right|" : ")");
    } else {
        text_printf(&pair->written, "%s%s", latex ? "\\" : "", functions[which]);
        text_add(&pair->plain, functions[which]);
        both(pair, "(");
        put_sum(pair, depth - 1);
        text_add(&pair->written, ")");
    }
    text_add(&pair->plain, ")");
}

/* ---- products and sums */

/* What joins two factors; with no sign where that is plain to read. */
static void put_times(struct pair_of_texts *pair, enum ending ending)
{
    static const char *const explicits[styles][3] = {{"\\cdot ", " \\times ", "*"},
                                                     {"·", " × ", "⋅"},
                                                     {"*", " * ", " *"}};
    text_add(&pair->plain, "*");
    if (draw(pair, 3) == 0) {
        text_add(&pair->written, explicits[pair->style][draw(pair, 3)]);
        return;
    }
    bool glue = ending == after_letters || ending == after_mark || ending == after_number;
    if (pair->style == style_latex && draw(pair, 2) == 0)
        text_add(&pair->written, "\\,");
    else if (!glue || draw(pair, 2) == 0)
        text_add(&pair->written, " ");
}

/* A factor that begins with a letter of more than one would join letters before it: a blank is between. */
static void put_letters_apart(struct pair_of_texts *pair)
{
    const struct text *text = &pair->written;
    char last = text->length > 0 ? text->data[text->length - 1] : ' ';
    bool letter =
        (last >= 'a' && last <= 'z') || (last >= 'A' && last <= 'Z') || (last >= '0' && last <= '9');
    if (letter && pair->style == style_plain) text_add(&pair->written, " ");
}

static enum ending put_factor(struct pair_of_texts *pair, int depth, bool last)
{
    int kind = draw(pair, depth > 0 ? 9 : 5);
    if (kind == 3) put_letters_apart(pair);
    if (kind == 3) return put_power(pair);
    if (kind == 4 && !last) kind = 0;
    if (kind == 4 || kind == 7) put_letters_apart(pair);
    if (kind == 4) {
        if (pair->style == style_signs) text_add(&pair->written, " ");
        return put_bare(pair);
    }
    if (kind == 5)
        put_group(pair, depth);
    else if (kind == 6)
        put_fraction(pair, depth);
    else if (kind == 7) {
        if (pair->style == style_signs) text_add(&pair->written, " ");
        put_call(pair, depth);
    } else {
        put_letters_apart(pair);
        return symbol_ending(pair, put_symbol(pair));
    }
    return after_mark;
}

static void put_term(struct pair_of_texts *pair, int depth)
{
    int count = 1 + draw(pair, 4);
    bool number = draw(pair, 3) == 0, half = !number && draw(pair, 6) == 0;
    enum ending ending = after_number;
    if (number) put_number(pair);
    if (half) {
        both(pair, "1/2*");
        pair->written.data[pair->written.length - 1] = ' ';
    }
    for (int i = 0; i < count; i++) {
        if (i > 0 || number) put_times(pair, ending);
        ending = put_factor(pair, depth, i + 1 == count);
    }
    if (ending != after_bare && draw(pair, 4) == 0) {
        both(pair, "/");
        put_symbol(pair);
    }
}

static void put_sum(struct pair_of_texts *pair, int depth)
{
    static const char *const minus[styles] = {" - ", " − ", "-"};
    int count = 1 + draw(pair, depth > 1 ? 3 : 2);
    for (int i = 0; i < count; i++) {
        bool negative = draw(pair, 3) == 0;
        if (negative) text_add(&pair->written, minus[pair->style]);
        if (negative) text_add(&pair->plain, "-");
        if (!negative && i > 0) both(pair, " + ");
        put_term(pair, depth);
    }
}

/* ---- reading */

struct values {
    double y[sizeof pure_names / sizeof *pure_names];
};

/* The value of the right side; NAN when it is no expression. */
static double value_of(struct arena *arena, const char *text, const struct values *values)
{
    const struct scope scope = notation_scope(pure());
    const struct expr_want want = {.any_dim = true, .what = "equation"};
    const struct expr *left, *right;
    char relation;
    fbd_errors *errors = fbd_errors_new();
    bool fine = expr_compile_relation(arena, text, (struct pos){1, 1}, &scope, &want, errors, &left,
                                      &relation, &right);
    fbd_errors_free(errors);
    if (!fine || !right) return (double)NAN;
    int branch[64] = {0};
    assert_true(expr_switches(right) < 64);
    expr_resolve(right, (struct time_dd){0}, values->y, 0, NULL, NULL, branch);
    return expr_eval(right, 0, values->y, branch);
}

static struct notation read_text(struct arena *arena, const char *text, fbd_errors *errors)
{
    const struct scope scope = notation_scope(pure());
    struct notation notation;
    if (!notation_read(arena, text, (struct pos){1, 1}, &scope, true, errors, &notation))
        notation.text = NULL;
    return notation;
}

static bool is_same(double a, double b)
{
    return a == b || fabs(a - b) <= 1e-9 * (1 + fabs(b)); /* also of two that are infinite */
}

static struct values draw_values(struct random_numbers *random)
{
    struct values values;
    for (size_t i = 0; i < sizeof values.y / sizeof *values.y; i++)
        values.y[i] = random_between(random, 0.3, 1.7);
    return values;
}

static bool check_pair(struct arena *arena, const struct pair_of_texts *pair, const struct values *values)
{
    fbd_errors *errors = fbd_errors_new();
    struct notation read = read_text(arena, pair->written.data, errors);
    double want = value_of(arena, pair->plain.data, values);
    double got = read.text ? value_of(arena, read.text, values) : (double)NAN;
    struct notation again = read_text(arena, pair->plain.data, errors);
    bool fine = is_same(got, want) && again.text && !again.changed;
    if (!fine) {
        print_error("`%s`\n  is read as `%s` = %g\n  and not as `%s` = %g\n", pair->written.data,
                    read.text ? read.text : "", got, pair->plain.data, want);
        fbd_errors_print(errors, stdout);
    }
    fbd_errors_free(errors);
    return fine;
}

static void random_notations_have_the_value_of_the_expression(void **unused)
{
    (void)unused;
    int failed = 0;
    for (int i = 0; i < draws_of(1500) && failed < 10; i++) {
        struct random_numbers random = {(uint64_t)i + 1};
        struct pair_of_texts pair = {.random = &random, .style = (enum style)(i % styles)};
        struct arena arena = {0};
        const struct values values = draw_values(&random);
        text_add(&pair.written, pair.style == style_latex ? "$y = " : "y = ");
        text_add(&pair.plain, "y = ");
        put_sum(&pair, 2);
        if (pair.style == style_latex) text_add(&pair.written, "$");
        failed += !check_pair(&arena, &pair, &values);
        text_free(&pair.written);
        text_free(&pair.plain);
        arena_free(&arena);
    }
    assert_int_equal(failed, 0);
}

/* ---- two readings */

/* The reading between backticks, with the start of the line before it. */
static const char *reading(struct arena *arena, const char *hint, int which)
{
    const char *from = hint ? strchr(hint, '`') : NULL;
    for (; from && which > 0; which--) {
        const char *end = strchr(from + 1, '`');
        from = end ? strchr(end + 1, '`') : NULL;
    }
    const char *end = from ? strchr(from + 1, '`') : NULL;
    return end ? arena_printf(arena, "y = %.*s", (int)(end - from - 1), from + 1) : "";
}

static bool check_refusal(struct arena *arena, const char *text, const struct values *values)
{
    fbd_errors *errors = fbd_errors_new();
    struct notation read = read_text(arena, text, errors);
    const fbd_error note = fbd_errors_get(errors, 0);
    double first = value_of(arena, reading(arena, note.hint, 0), values);
    double second = value_of(arena, reading(arena, note.hint, 1), values);
    bool fine = !read.text && note.id && strcmp(note.id, "ambiguous-notation") == 0 && isfinite(first) &&
                isfinite(second) && !is_same(first, second);
    if (!fine) {
        print_error("`%s` is read as `%s`: %g or %g\n", text, read.text ? read.text : "", first, second);
        fbd_errors_print(errors, stdout);
    }
    fbd_errors_free(errors);
    return fine;
}

static void random_texts_with_two_readings_are_refused(void **unused)
{
    (void)unused;
    static const char *const forms[] = {"A/B C",       "sin A B^2*C", "cos A/B + C", "sin 2A*B - C",
                                        "A/B (C + 2)", "exp A^2 B/C", "2/A sin B/C", "tanh A·B·C"};
    int failed = 0;
    for (int i = 0; i < draws_of(400) && failed < 10; i++) {
        struct random_numbers random = {(uint64_t)i + 7};
        struct arena arena = {0};
        const struct values values = draw_values(&random);
        const char *names[3];
        for (int k = 0; k < 3; k++) {
            const struct symbol_texts *symbol =
                &symbols[random_bits(&random) % (sizeof symbols / sizeof *symbols)];
            names[k] = symbol->written[random_bits(&random) % styles][random_bits(&random) % 2];
        }
        struct text text = {0};
        text_add(&text, "y = ");
        for (const char *form = forms[i % 8]; *form; form++)
            if (*form >= 'A' && *form <= 'C')
                text_add(&text, names[*form - 'A']);
            else
                text_add_bytes(&text, form, 1);
        failed += !check_refusal(&arena, text.data, &values);
        text_free(&text);
        arena_free(&arena);
    }
    assert_int_equal(failed, 0);
}

/* ---- spoiled texts */

/* What comes out, if it is an expression, is one that stays. */
static bool check_spoiled(struct arena *arena, const char *text, const struct values *values)
{
    assert_non_null(text);
    fbd_errors *errors = fbd_errors_new();
    struct notation read = read_text(arena, text, errors);
    bool fine = read.text || fbd_errors_failed_count(errors) == 1;
    if (read.text && isfinite(value_of(arena, read.text, values))) {
        struct notation again = read_text(arena, read.text, errors);
        fine = again.text && !again.changed;
    }
    if (isfinite(value_of(arena, text, values)) && !strstr(text, "=="))
        fine = fine && read.text && !read.changed;
    if (!fine) print_error("`%s` is read as `%s`\n", text, read.text ? read.text : "");
    for (size_t i = 0; read.text && i <= strlen(read.text); i++)
        fine = fine && notation_source(&read, i) <= strlen(text);
    fbd_errors_free(errors);
    return fine;
}

static void spoiled_texts_do_no_harm(void **unused)
{
    (void)unused;
    static const char *const pieces[] = {"{", "}", "(",      ")",     "^",   "_",  "\\", "|",     "'",
                                         "/", " ", "\\frac", "\\dot", "d",   "dt", "²",  "θ",     "\xCC",
                                         "[", "]", "=",      "$",     "sin", "2",  ".",  "\\left"};
    int failed = 0;
    for (int i = 0; i < draws_of(1500) && failed < 10; i++) {
        struct random_numbers random = {(uint64_t)i + 100000};
        struct pair_of_texts pair = {.random = &random, .style = (enum style)(i % styles)};
        struct arena arena = {0};
        struct text spoiled = {0};
        const struct values values = draw_values(&random);
        both(&pair, "y = ");
        put_sum(&pair, 1);
        for (size_t k = 0; k < pair.written.length; k++) {
            int what = draw(&pair, 30);
            if (what == 0) text_add(&spoiled, pieces[draw(&pair, sizeof pieces / sizeof *pieces)]);
            if (what != 1) text_add_bytes(&spoiled, pair.written.data + k, 1);
        }
        text_add(&spoiled, " ");
        failed += !check_spoiled(&arena, spoiled.data, &values);
        text_free(&spoiled);
        text_free(&pair.written);
        text_free(&pair.plain);
        arena_free(&arena);
    }
    assert_int_equal(failed, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_notations_have_the_value_of_the_expression),
        cmocka_unit_test(random_texts_with_two_readings_are_refused),
        cmocka_unit_test(spoiled_texts_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Splits a notation into items: numbers, names, signs, brackets, and LaTeX commands.
 */
#include <string.h>

#include "base/number.h"
#include "expr/glyph.h"
#include "expr/notation_work.h"
#include "expr/parser.h"

struct item *writing_add(struct writing *w, enum item_kind kind, size_t start, size_t end, const char *text)
{
    if (w->count == w->room) {
        size_t room = w->room ? 2 * w->room : 64;
        struct item *items = ARENA_ARRAY(w->arena, room, struct item);
        if (!items) return NULL;
        if (w->count > 0) memcpy(items, w->items, w->count * sizeof *items);
        w->items = items;
        w->room = room;
    }
    struct item *item = &w->items[w->count++];
    *item = (struct item){.kind = kind, .start = start, .length = end - start, .text = text};
    item->gap = w->gap;
    item->verbatim = !w->foreign;
    w->gap = w->foreign = false;
    return item;
}

static bool add(struct writing *w, enum item_kind kind, size_t length, const char *text)
{
    size_t start = w->offset;
    w->offset += length;
    return writing_add(w, kind, start, w->offset, text) != NULL;
}

/* ---- signs */

struct word {
    const char *word;
    enum item_kind kind;
    const char *text; /* NULL: unchanged; "": removed */
};

/* Longest first; removed signs are item_end. */
static const struct word signs[] = {
    {"**", item_power, "^"},    {"<=", item_break, NULL},     {">=", item_break, NULL},
    {"<>", item_other, NULL},   {"!=", item_other, NULL},     {"||", item_other, NULL},
    {"+", item_sign, NULL},     {"-", item_sign, NULL},       {"*", item_sign, NULL},
    {"/", item_sign, NULL},     {"^", item_power, NULL},      {"<", item_break, NULL},
    {">", item_break, NULL},    {",", item_break, NULL},      {"(", item_open, NULL},
    {")", item_close, NULL},    {"|", item_bar, NULL},        {"−", item_sign, "-"},
    {"–", item_sign, "-"},      {"—", item_sign, "-"},        {"‐", item_sign, "-"},
    {"·", item_sign, "*"},      {"⋅", item_sign, "*"},        {"×", item_sign, "*"},
    {"∙", item_sign, "*"},      {"•", item_sign, "*"},        {"∗", item_sign, "*"},
    {"÷", item_sign, "/"},      {"∕", item_sign, "/"},        {"⁄", item_sign, "/"},
    {"≤", item_break, "<="},    {"≥", item_break, ">="},      {"½", item_number, "0.5"},
    {"¼", item_number, "0.25"}, {"¾", item_number, "0.75"},   {"（", item_open, "("},
    {"）", item_close, ")"},    {"√", item_function, "sqrt"}, {"$", item_end, ""},
    {"\\(", item_end, ""},      {"\\)", item_end, ""},        {"\\[", item_end, ""},
    {"\\]", item_end, ""},      {"\\\\", item_end, ""},       {"\\{", item_open, "("},
    {"\\}", item_close, ")"},   {"\\|", item_bar, NULL},
};

static const struct word commands[] = {
    {"cdot", item_sign, "*"},
    {"times", item_sign, "*"},
    {"ast", item_sign, "*"},
    {"div", item_sign, "/"},
    {"le", item_break, "<="},
    {"leq", item_break, "<="},
    {"ge", item_break, ">="},
    {"geq", item_break, ">="},
    {"lt", item_break, "<"},
    {"gt", item_break, ">"},
    {"lparen", item_open, "("},
    {"rparen", item_close, ")"},

    {"rvert", item_close, ")"},
    {"vert", item_bar, NULL},
    {"frac", item_fraction, ""},
    {"dfrac", item_fraction, ""},
    {"tfrac", item_fraction, ""},
    {"cfrac", item_fraction, ""},
    {"sqrt", item_function, "sqrt"},
    {"sin", item_function, "sin"},
    {"cos", item_function, "cos"},
    {"tan", item_function, "tan"},
    {"arcsin", item_function, "asin"},
    {"arccos", item_function, "acos"},
    {"arctan", item_function, "atan"},
    {"sinh", item_function, "sinh"},
    {"cosh", item_function, "cosh"},
    {"tanh", item_function, "tanh"},
    {"exp", item_function, "exp"},
    {"ln", item_function, "ln"},
    {"log", item_function, "log"},
    {"sgn", item_function, "sign"},
    {"min", item_call, "min"},
    {"max", item_call, "max"},
    {"land", item_break, "and"},
    {"lor", item_break, "or"},
    {"lnot", item_break, "not"},
    {"left", item_end, ""},
    {"right", item_end, ""},
    {"big", item_end, ""},
    {"Big", item_end, ""},
    {"bigg", item_end, ""},
    {"Bigg", item_end, ""},
    {"bigl", item_end, ""},
    {"bigr", item_end, ""},
    {"Bigl", item_end, ""},
    {"Bigr", item_end, ""},
    {"biggl", item_end, ""},
    {"biggr", item_end, ""},
    {"Biggl", item_end, ""},
    {"Biggr", item_end, ""},
    {"quad", item_end, ""},
    {"qquad", item_end, ""},
    {"displaystyle", item_end, ""},
    {"textstyle", item_end, ""},
    {"thinspace", item_end, ""},
};

/* Skip the source up to `end`; `gap`: replace it by a blank. */
static bool leave_out(struct writing *w, size_t end, bool gap)
{
    w->gap |= gap;
    w->foreign = true;
    w->offset = end;
    return true;
}

static bool take_word(struct writing *w, const struct word *word, size_t length)
{
    if (word->kind != item_end) return add(w, word->kind, length, word->text);
    return leave_out(w, w->offset + length, false);
}

/* ---- commands */

static bool add_magnitude(struct writing *w, size_t length)
{
    if (!add(w, item_open, length, "abs(")) return false;
    w->items[w->count - 1].magnitude = true;
    return leave_out(w, writing_skip(w, w->offset), false);
}

/* `\left[`, `\bigl[`, `\left.`: the bracket is a parenthesis, the point is removed. */
static bool take_delimiter(struct writing *w, size_t length)
{
    char last = w->text[w->offset + length - 1], side = '\0'; /* \left, \bigl; \right, \bigr */
    if (command_is(w, w->offset, "left") || last == 'l') side = 'l';
    if (command_is(w, w->offset, "right") || last == 'r') side = 'r';
    size_t at = writing_skip(w, w->offset + length);
    leave_out(w, at, false);
    if (writing_has(w, at, ".")) return leave_out(w, at + 1, false);
    if (writing_has(w, at, "[")) return add(w, item_open, 1, "(");
    if (writing_has(w, at, "]")) return add(w, item_close, 1, ")");
    if (!writing_has(w, at, "|") || side == '\0') return true;
    return side == 'l' ? add_magnitude(w, 1) : add(w, item_close, 1, ")");
}

static bool is_delimiter(const struct writing *w)
{
    return command_is(w, w->offset, "left") || command_is(w, w->offset, "right") ||
           memcmp(w->text + w->offset + 1, "big", 3) == 0 || memcmp(w->text + w->offset + 1, "Big", 3) == 0;
}

static bool refuse_command(struct writing *w, size_t length)
{
    struct {
        const char *word, *hint;
    } const known[] = {{"pm", "write one equation for each sign"},
                       {"mp", "write one equation for each sign"},
                       {"vec", "write one equation for each component"},
                       {"sum", "write the sum out, and an equation behind it: `\\sum F_x = F - f = m a`"},
                       {"int", "an equation of motion has no integral: differentiate it"},
                       {"approx", "write `=`"},
                       {"ne", "a comparison is written `<`, `>` or `=`"}};
    const char *hint = "docs/notation.md has the commands that are read";
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (command_is(w, w->offset, known[i].word)) hint = known[i].hint;
    const char *message =
        arena_printf(w->arena, "`%.*s` cannot be used here", (int)length, w->text + w->offset);
    return message && writing_refuse(w, "expression-syntax", w->offset, hint, message);
}

/* `\sqrt[3]{x}` */
static bool take_root(struct writing *w, size_t length)
{
    size_t at = w->offset + length;
    if (!writing_has(w, at, "[")) return add(w, item_function, length, "sqrt");
    if (writing_has(w, at, "[3]")) return add(w, item_function, length + 3, "cbrt");
    return writing_refuse(w, "expression-syntax", at, "write `(x)^(1/4)` for a fourth root",
                          "this root has no name");
}

/* A blank ends the command of a sign; it is kept if there is one before the sign, too. */
static bool take_operator(struct writing *w, const struct word *word, size_t length)
{
    bool gap = w->gap;
    if (!add(w, item_sign, length, word->text)) return false;
    size_t behind = writing_skip(w, w->offset);
    return behind == w->offset || leave_out(w, behind, gap);
}

static bool take_command(struct writing *w, size_t length)
{
    if (command_is(w, w->offset, "sqrt")) return take_root(w, length);
    if (is_delimiter(w)) return take_delimiter(w, length);
    if (command_is(w, w->offset, "lvert")) return add_magnitude(w, length);
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        if (command_is(w, w->offset, commands[i].word))
            return commands[i].kind == item_sign ? take_operator(w, &commands[i], length)
                                                 : take_word(w, &commands[i], length);
    return refuse_command(w, length);
}

/* ---- numbers */

/* The byte behind a degree sign at `offset`; `offset` if there is none. */
static size_t behind_degrees(const struct writing *w, size_t offset)
{
    static const char *const degrees[] = {"°", "º", "^\\circ", "^{\\circ}", "^{\\,\\circ}", "\\degree"};
    for (size_t i = 0; i < sizeof degrees / sizeof *degrees; i++)
        if (writing_has(w, offset, degrees[i])) return offset + strlen(degrees[i]);
    return offset;
}

/* The byte behind an upright unit after a number, as `9.81\,\mathrm{m/s^2}`, with the text in braces; 0 for
 * none. */
static size_t upright_unit(const struct writing *w, size_t offset, const char **unit, size_t *length)
{
    struct unit read;
    size_t at = writing_skip(w, offset);
    if (!command_is(w, at, "mathrm") && !command_is(w, at, "text")) return 0;
    at = writing_skip(w, at + command_length(w, at));
    if (!writing_has(w, at, "{")) return 0;
    const char *from = w->text + at + 1, *end = memchr(from, '}', w->length - at - 1);
    if (!end || memchr(from, '{', (size_t)(end - from)) ||
        !unit_parse(from, (size_t)(end - from), w->scope->units, NULL, w->at, &read))
        return 0;
    *unit = from;
    *length = (size_t)(end - from);
    return (size_t)(end - w->text) + 1;
}

static bool take_number(struct writing *w, size_t size)
{
    const char *unit, *text = w->text + w->offset;
    size_t end = w->offset + size, degrees = behind_degrees(w, end), length;
    size_t upright = degrees > end ? 0 : upright_unit(w, end, &unit, &length);
    if (degrees > end)
        return add(w, item_number, degrees - w->offset, arena_printf(w->arena, "%.*s[deg]", (int)size, text));
    if (upright > 0)
        return add(w, item_number, upright - w->offset,
                   arena_printf(w->arena, "%.*s[%.*s]", (int)size, text, (int)length, unit));
    size_t at = end + strspn(w->text + end, " \t\r\n");
    const char *close = writing_has(w, at, "[") ? memchr(w->text + at, ']', w->length - at) : NULL;
    return add(w, item_number, close ? (size_t)(close - text) + 1 : size, NULL);
}

/* `²`, `⁻¹`: an exponent. */
static bool take_raised(struct writing *w)
{
    static const char *const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char number[24] = "";
    size_t at = w->offset, length = 0;
    if (writing_has(w, at, "⁻")) number[length++] = '-';
    at += length > 0 ? strlen("⁻") : 0;
    for (int i = 0; i < 10 && length + 1 < sizeof number;) {
        bool here = writing_has(w, at, digits[i]);
        if (here) {
            number[length++] = (char)('0' + i);
            at += strlen(digits[i]);
        }
        i = here ? 0 : i + 1;
    }
    size_t whole = at - w->offset;
    const char *text = arena_text(w->arena, number, length);
    if (!text || !add(w, item_power, 0, "^") || !add(w, item_number, whole, text)) return false;
    w->items[w->count - 1].closed = true;
    return true;
}

static bool is_raised(const struct writing *w)
{
    static const char *const first[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹", "⁻"};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        if (writing_has(w, w->offset, first[i])) return true;
    return false;
}

/* ---- sides that are quantities, as `9.81 m/s^2` */

static size_t side_end(const struct writing *w)
{
    size_t end = w->offset;
    while (end < w->length && !strchr("=<>", w->text[end])) end++;
    return end;
}

/* The length of the quantity if all of this side is one, else 0. With `products` such a side is read as a
 * product: `2 m g`. */
static size_t quantity_length(struct writing *w)
{
    struct unit unit;
    size_t end = side_end(w),
           at = w->offset + (writing_has(w, w->offset, "-") || writing_has(w, w->offset, "+"));
    while (end > w->offset && strchr(" \t\r\n", w->text[end - 1])) end--;
    size_t size = at < end ? number_length(w->text + at, end - at) : 0;
    if (size == 0) return 0;
    at += size;
    at += strspn(w->text + at, " \t\r\n");
    char c = at < end ? w->text[at] : '\0';
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '1')) return 0;
    if (!unit_parse(w->text + at, end - at, w->scope->units, NULL, w->at, &unit)) return 0;
    w->doubtful = true;
    return w->products ? 0 : end - w->offset;
}

/* ---- all items */

static bool take_equals(struct writing *w)
{
    size_t length = writing_has(w, w->offset, "==") ? 2 : 1;
    bool top = w->equation && length == 2;
    return add(w, item_break, length, top ? "=" : NULL);
}

static bool take_symbol(struct writing *w)
{
    struct run run = {.count = 0};
    struct dim dim;
    bool quotient = w->text[w->offset] == 'd' && name_is_known(w, "dt", &dim);
    size_t end = quotient ? 0 : derivative_read(w, w->offset, &run);
    if (end > 0) {
        for (size_t i = 0; i < run.count; i++) run.atoms[i].start = run.atoms[i].end = w->offset;
    } else {
        run.count = 0;
        run.failed = false;
        if (!run_begins(w, w->offset)) return add(w, item_other, command_length(w, w->offset), NULL);
        end = run_read(w, w->offset, &run);
    }
    size_t start = w->offset;
    w->offset = end > w->length ? w->length : end;
    if (run.failed || run.count == 0) return writing_add(w, item_other, start, w->offset, NULL) != NULL;
    run.atoms[0].start = start; /* including accents and braces */
    run.atoms[run.count - 1].end = w->offset;
    return run_add(w, &run, w->offset);
}

static bool take_sign(struct writing *w)
{
    if (w->latex && writing_has(w, w->offset, "&")) return leave_out(w, w->offset + 1, false);
    if (writing_has(w, w->offset, "{"))
        return add(w, item_open, 1, "(") && (w->items[w->count - 1].brace = true);
    if (writing_has(w, w->offset, "}"))
        return add(w, item_close, 1, ")") && (w->items[w->count - 1].brace = true);
    if (writing_has(w, w->offset, "=")) return take_equals(w);
    if (is_raised(w)) return take_raised(w);
    if (w->equation && writing_has(w, w->offset, "|")) return add(w, item_bar, 1, NULL);
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (writing_has(w, w->offset, signs[i].word)) return take_word(w, &signs[i], strlen(signs[i].word));
    return add(w, item_other, glyph_size(w->text + w->offset, w->length - w->offset), NULL);
}

static bool take_one(struct writing *w, bool begins)
{
    size_t left = w->length - w->offset, size = number_length(w->text + w->offset, left);
    size_t command = command_length(w, w->offset), quantity = begins ? quantity_length(w) : 0;
    struct run run = {.count = 0};
    if (quantity > 0) return add(w, item_number, quantity, NULL);
    if (size > 0) return take_number(w, size);
    if (run_begins(w, w->offset) || derivative_read(w, w->offset, &run) > 0) return take_symbol(w);
    return command > 0 ? take_command(w, command) : take_sign(w);
}

static void end_sense(struct writing *w)
{
    if (w->sense_end > 0) w->scope->sense(w->scope->context, NULL);
    w->sense_end = 0;
}

bool writing_read_items(struct writing *w)
{
    bool begins = w->equation;
    w->latex = strpbrk(w->text, "\\${") != NULL;
    while (!w->failed && !w->arena->failed) {
        size_t blanks = writing_skip(w, w->offset);
        for (size_t i = w->offset; i < blanks; i++) {
            w->gap = true;
            w->foreign |= strchr(" \t\r\n", w->text[i]) == NULL;
        }
        w->offset = blanks;
        if (w->offset >= w->length) break;
        if (w->sense_end > 0 && w->offset >= w->sense_end) end_sense(w);
        if (!take_one(w, begins)) break;
        begins = w->equation && w->count > 0 && w->items[w->count - 1].kind == item_break;
    }
    end_sense(w);
    bool done = !w->failed && !w->arena->failed;
    return done && writing_add(w, item_end, w->length, w->length, NULL) != NULL;
}

/* ---- queries of items */

/* The item behind the bracket that closes `item`, or the end. */
static const struct item *item_behind_group(const struct item *item)
{
    int depth = 0;
    for (; item->kind != item_end; item++) {
        depth += item->kind == item_open;
        depth -= item->kind == item_close;
        if (depth == 0) return item + 1;
    }
    return item;
}

bool item_is_single(const struct item *open)
{
    return open->kind == item_open && open[1].kind != item_end && open[2].kind == item_close &&
           (open[1].kind == item_number || open[1].kind == item_name);
}

const struct item *item_behind_power(const struct item *power)
{
    const struct item *item = power + 1;
    while (item->kind == item_sign) item++;
    return item->kind == item_end ? item : item->kind == item_open ? item_behind_group(item) : item + 1;
}

bool item_begins_operand(const struct item *item)
{
    return item->kind == item_number || item->kind == item_name || item->kind == item_function ||
           item->kind == item_call || item->kind == item_open || item->kind == item_fraction ||
           item->kind == item_bar;
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Writes the items of a notation as the text of an expression.
 *
 * Items are written one by one unchanged; product signs, brackets, and the equivalents of LaTeX are added.
 * Precedence is that of the language. If a product without a sign follows a quotient, or the argument of a
 * function without brackets, the text has two readings: the one that is written, and one with a part of it in
 * brackets (struct doubt).
 */
#include <string.h>

#include "expr/notation_work.h"
#include "expr/parser.h"

/* Two readings of a product, in bytes of the written text: A is `begin` to its end, B has the part from
 * `open` to the end in brackets; for a function whose argument ended at `close`, B has that bracket at the
 * end. */
struct doubt {
    bool set;
    size_t at; /* in the source */
    size_t begin, open, close;
};

struct writer {
    struct writing *w;
    const struct item *item; /* the next one */
    struct text text;
    const struct notation_stretch *first;
    struct notation_stretch *last;
    size_t behind; /* the end of the last item in the source */
    int nesting;
};

/* State of the text written last, on one level of brackets. Offsets are those of the written text. */
struct level {
    bool begun;    /* a product has begun */
    bool complete; /* the last item completed an operand */
    enum {
        last_other,
        last_number,
        last_exponent, /* a number behind ^ */
        last_function, /* with an argument without brackets */
    } last;
    size_t product;         /* start of the product */
    size_t operand;         /* start of its last operand */
    size_t divisor;         /* start of its last divisor; 0 for none */
    bool numbers;           /* it consists of numbers only */
    bool bars, between;     /* it contains a magnitude, and a factor behind that */
    size_t exponent, close; /* start of the last exponent; closing bracket of the last function */
    struct doubt doubt;
};

/* ---- writing */

static void put(struct writer *writer, const char *text, size_t length, size_t from, size_t from_length)
{
    struct notation_stretch *stretch = ARENA_NEW(writer->w->arena, struct notation_stretch);
    if (!stretch) return;
    *stretch = (struct notation_stretch){writer->text.length, from, from_length, NULL};
    if (writer->last)
        writer->last->next = stretch;
    else
        writer->first = stretch;
    writer->last = stretch;
    text_add_bytes(&writer->text, text, length);
}

static void put_sign(struct writer *writer, const char *sign)
{
    put(writer, sign, strlen(sign), writer->item->start, 0);
}

/* Write the gap before the item: the blanks of the source, or one blank if other text was removed. */
static void put_gap(struct writer *writer)
{
    const struct item *item = writer->item;
    const char *from = writer->w->text + writer->behind;
    bool edge = writer->text.length == 0 || item->kind == item_end;
    if (!item->gap || (edge && !item->verbatim)) return;
    if (item->verbatim)
        put(writer, from, item->start - writer->behind, writer->behind, item->start - writer->behind);
    else
        put(writer, " ", 1, writer->behind, 0);
}

static void put_item(struct writer *writer)
{
    const struct item *item = writer->item;
    const char *source = writer->w->text + item->start;
    if (item->text)
        put(writer, item->text, strlen(item->text), item->start, 0);
    else
        put(writer, source, item->length, item->start, item->length);
    writer->behind = item->start + item->length;
    writer->item++;
}

/* ---- readings */

static const char *bracketed(const struct writer *writer, const struct doubt *doubt)
{
    const char *made = writer->text.data;
    size_t end = writer->text.length;
    struct arena *arena = writer->w->arena;
    if (doubt->close == 0)
        return arena_printf(arena, "%.*s(%.*s)", (int)(doubt->open - doubt->begin), made + doubt->begin,
                            (int)(end - doubt->open), made + doubt->open);
    return arena_printf(arena, "%.*s%.*s)", (int)(doubt->close - doubt->begin), made + doubt->begin,
                        (int)(end - doubt->close - 1), made + doubt->close + 1);
}

/* End the product; note its two readings, if any. */
static void end_product(struct writer *writer, struct level *level)
{
    const struct doubt *doubt = &level->doubt;
    if (doubt->set && !writer->w->failed && !writer->text.failed) {
        const char *plain = arena_text(writer->w->arena, writer->text.data + doubt->begin,
                                       writer->text.length - doubt->begin);
        writing_ambiguous(writer->w, doubt->at, plain, bracketed(writer, doubt));
    }
    *level = (struct level){.numbers = true};
}

/* Begin an operand, and a product if none has begun. */
static void begin_operand(struct writer *writer, struct level *level)
{
    level->operand = writer->text.length;
    if (!level->begun) level->product = writer->text.length;
    level->begun = true;
}

static void doubt_it(struct level *level, const struct item *item, size_t begin, size_t open, size_t close)
{
    if (!level->doubt.set) level->doubt = (struct doubt){true, item->start, begin, open, close};
}

/* Note `5 N` as ambiguous if N is both a name and the unit of that quantity. */
static void refuse_unit(struct writer *writer, const struct level *level, const struct item *item)
{
    struct arena *arena = writer->w->arena;
    const char *number = writer->text.data + level->operand, *name = writer->w->text + item->start;
    int digits = (int)(writer->text.length - level->operand), length = (int)item->length;
    writing_ambiguous(writer->w, item->start, arena_printf(arena, "%.*s*%.*s", digits, number, length, name),
                      arena_printf(arena, "%.*s[%.*s]", digits, number, length, name));
}

/* Write the product sign between two operands. */
static void put_product(struct writer *writer, struct level *level)
{
    const struct item *item = writer->item;
    bool half = level->numbers && (item->gap || item->kind == item_fraction); /* 1/2 m */
    if (level->last == last_function && item->kind != item_function)
        doubt_it(level, item, level->operand, 0, level->close);
    else if (level->divisor > 0 && !half)
        doubt_it(level, item, level->product, level->divisor, 0);
    else if (level->last == last_exponent && !item->gap && !writer->w->latex && item->kind == item_name)
        doubt_it(level, item, level->operand, level->exponent, 0);
    if (level->last == last_number && item->kind == item_name && name_is_unit(writer->w, item))
        refuse_unit(writer, level, item);
    put_sign(writer, "*");
    if (half) level->divisor = 0;
}

/* ---- operands */

static void write_items(struct writer *writer, enum item_kind until);

static bool goes_deeper(struct writer *writer)
{
    if (++writer->nesting <= nesting_limit) return true;
    writing_refuse(writer->w, "expression-too-long", writer->item->start, "name parts of it as parameters",
                   "the expression is nested more than 100 deep");
    return false;
}

static void pass(struct writer *writer)
{
    writer->behind = writer->item->start + writer->item->length;
    writer->item++;
}

/* Write a group in brackets; a single item in braces needs none, unless `always`. */
static void write_group(struct writer *writer, bool always)
{
    const struct item *open = writer->item;
    bool bare = open->brace && !always && item_is_single(open);
    if (!goes_deeper(writer)) return;
    if (bare) {
        pass(writer);
        put_item(writer);
    } else {
        put_item(writer);
        write_items(writer, item_close);
    }
    bool closed = writer->item->kind == item_close;
    if (closed && writer->item->brace != open->brace)
        writing_refuse(writer->w, "expression-syntax", writer->item->start, NULL,
                       open->brace ? "`}` is missing before `)`" : "`)` is missing before `}`");
    if (closed && bare) pass(writer);
    if (closed && !bare) put_item(writer);
    writer->nesting--;
}

/* Write an argument of a LaTeX command: a group, a number or a name. */
static void write_argument(struct writer *writer)
{
    if (writer->item->kind == item_open)
        write_group(writer, false);
    else if (writer->item->kind == item_number || writer->item->kind == item_name)
        put_item(writer);
    else
        writing_refuse(writer->w, "expression-syntax", writer->item->start, "write `\\frac{a}{b}`",
                       "a group in braces is missing");
}

/* `\frac12` is one half: each digit of a number is an argument. */
static bool write_digits(struct writer *writer)
{
    const struct item *item = writer->item;
    const char *digits = writer->w->text + item->start;
    if (item->kind != item_number || item->length != 2 || item->text || item[1].kind == item_open)
        return false;
    char quotient[] = {'(', digits[0], '/', digits[1], ')'};
    put(writer, quotient, sizeof quotient, item->start, 0);
    writer->behind = item->start + item->length;
    writer->item++;
    return true;
}

static void write_fraction(struct writer *writer)
{
    pass(writer);
    if (write_digits(writer)) return;
    put_sign(writer, "(");
    write_argument(writer);
    if (writer->w->failed) return;
    put_sign(writer, "/");
    write_argument(writer);
    put_sign(writer, ")");
}

static void write_magnitude(struct writer *writer)
{
    put_sign(writer, "abs(");
    pass(writer);
    if (!goes_deeper(writer)) return;
    write_items(writer, item_bar);
    writer->nesting--;
    if (writer->item->kind != item_bar) {
        writing_refuse(writer->w, "expression-syntax", writer->item->start,
                       "a magnitude is `|v|` or `abs(v)`", "the second `|` is missing");
        return;
    }
    put_sign(writer, ")");
    pass(writer);
}

/* Write the exponent behind `^`. */
static void write_exponent(struct writer *writer)
{
    while (writer->item->kind == item_sign) put_item(writer);
    if (writer->item->kind == item_open)
        write_group(writer, false);
    else if (writer->item->kind == item_fraction)
        write_fraction(writer);
    else if (writer->item->kind == item_number || writer->item->kind == item_name)
        put_item(writer);
}

static void write_power(struct writer *writer, struct level *level)
{
    const struct item *item = writer->item;
    if (level->last == last_function) doubt_it(level, item, level->operand, 0, level->close);
    put_gap(writer);
    put_item(writer);
    level->exponent = writer->text.length;
    level->last = item[1].kind == item_number && !item[1].closed ? last_exponent : last_other;
    level->numbers = false;
    put_gap(writer);
    write_exponent(writer);
}

static void write_function(struct writer *writer, struct level *level);

/* Write the argument of a function without brackets: a sign, a number, one operand. */
static void write_bare(struct writer *writer, struct level *level)
{
    struct level inner = {.complete = false};
    put_sign(writer, "(");
    if (writer->item->kind == item_sign) put_item(writer);
    bool number = writer->item->kind == item_number;
    if (number) put_item(writer);
    enum item_kind kind = writer->item->kind;
    if (number && (kind == item_name || kind == item_fraction)) put_sign(writer, "*");
    if (kind == item_name)
        put_item(writer);
    else if (kind == item_fraction)
        write_fraction(writer);
    else if (kind == item_bar && !number)
        write_magnitude(writer);
    else if (kind == item_open && !number)
        write_group(writer, false);
    else if (kind == item_function && !number)
        write_function(writer, &inner);
    else if (!number)
        writing_refuse(writer->w, "expression-syntax", writer->item->start, "write `sin(x)`",
                       "the argument of the function is missing");
    level->close = writer->text.length;
    level->last = last_function;
    put_sign(writer, ")");
}

/* Accept `sin^2`; refuse `sin^{-1}` and invalid exponents. */
static void check_exponent(struct writer *writer, const struct item *power)
{
    const struct item *first = power[1].kind == item_open ? power + 2 : power + 1;
    if (first->kind == item_sign || (first->text && first->text[0] == '-'))
        writing_refuse(writer->w, "ambiguous-notation", writer->item->start,
                       "write `asin(x)` for the inverse function, and `1/sin(x)` for the other one",
                       "this can be read in two ways");
    else if (first->kind != item_number && first->kind != item_name)
        writing_refuse(writer->w, "expression-syntax", first->start, "write `sin(x)^2`",
                       "the exponent is missing");
}

/* `sin(x)`, `sin x`, `sin^2 x`, `\sqrt{x}` */
static void write_function(struct writer *writer, struct level *level)
{
    const struct item *power = writer->item[1].kind == item_power ? writer->item + 1 : NULL;
    if (!goes_deeper(writer)) return;
    if (power) check_exponent(writer, power);
    put_item(writer);
    if (power) writer->item = item_behind_power(power);
    level->last = last_other;
    if (writer->item->kind == item_open && !writer->item->magnitude) {
        if (!power) put_gap(writer);
        write_group(writer, true);
    } else if (!writer->w->failed) {
        write_bare(writer, level);
    }
    if (power && !writer->w->failed) {
        const struct writer here = *writer;
        writer->item = power;
        put_item(writer);
        write_exponent(writer);
        writer->item = here.item;
        writer->behind = here.behind;
    }
    writer->nesting--;
}

/* Note `x(t)` as ambiguous: x, or x times t. */
static void check_of_time(struct writer *writer, const struct item *name)
{
    const struct item *item = name + 1;
    const char *text = writer->w->text;
    if (item->kind != item_open || item->brace || item->magnitude || item[1].kind != item_name ||
        item[2].kind != item_close)
        return;
    if (item[1].text || item[1].length != 1 || text[item[1].start] != 't') return;
    const char *spelled =
        name->text ? name->text : arena_text(writer->w->arena, text + name->start, name->length);
    if (!spelled) return;
    writing_ambiguous(writer->w, item->start, spelled, arena_printf(writer->w->arena, "%s*t", spelled));
}

/* Write `e^x` as exp(x) if no name is e. */
static bool write_exponential(struct writer *writer)
{
    const struct item *item = writer->item;
    struct dim dim;
    bool e =
        item->kind == item_name && item->length == 1 && writer->w->text[item->start] == 'e' && !item->text;
    if (!e || item[1].kind != item_power || name_is_known(writer->w, "e", &dim)) return false;
    const bool open = item[2].kind == item_open;
    put_sign(writer, open ? "exp" : "exp(");
    pass(writer);
    pass(writer);
    if (open) {
        write_group(writer, true);
    } else {
        write_exponent(writer);
        put_sign(writer, ")");
    }
    return true;
}

static void write_call(struct writer *writer)
{
    put_item(writer);
    if (writer->item->kind != item_open) return;
    put_gap(writer);
    write_group(writer, true);
}

static void write_operand(struct writer *writer, struct level *level)
{
    const struct item *item = writer->item;
    bool product = level->complete && item->kind != item_number;
    if (product)
        put_product(writer, level);
    else
        put_gap(writer);
    begin_operand(writer, level);
    level->complete = true;
    level->last = item->kind == item_number ? last_number : last_other;
    level->numbers = level->numbers && item->kind == item_number;
    if (item->kind == item_name) check_of_time(writer, item);
    if (item->kind == item_bar && product && level->between) /* |a| b |c|, or |a |b| c| */
        writing_refuse(writer->w, "ambiguous-notation", item->start, "write `abs(...)` for each magnitude",
                       "this can be read in two ways");
    level->between = level->bars && item->kind != item_bar;
    level->bars = level->bars || item->kind == item_bar;
    switch (item->kind) {
    case item_function: write_function(writer, level); break;
    case item_open: write_group(writer, false); break;
    case item_fraction: write_fraction(writer); break;
    case item_bar: write_magnitude(writer); break;
    case item_call: write_call(writer); break;
    default:
        if (!write_exponential(writer)) put_item(writer);
    }
}

/* ---- signs */

static void write_sign(struct writer *writer, struct level *level)
{
    const struct item *item = writer->item;
    char sign = item->text ? item->text[0] : writer->w->text[item->start];
    bool product = level->complete && (sign == '*' || sign == '/');
    if (product && level->last == last_function) doubt_it(level, item, level->operand, 0, level->close);
    if (level->complete && !product) end_product(writer, level);
    put_gap(writer);
    put_item(writer);
    level->complete = false;
    level->last = last_other;
    level->bars = level->between = false;
    if (product) level->divisor = sign == '/' ? writer->text.length : 0;
}

/* Write items up to the end of this level of brackets, which is an item of kind `until`. */
static void write_items(struct writer *writer, enum item_kind until)
{
    struct level level = {.numbers = true};
    while (!writer->w->failed && !writer->w->arena->failed) {
        const struct item *item = writer->item;
        bool bar = item->kind == item_bar && until == item_bar && level.complete;
        if (item->kind == item_end || item->kind == item_close || bar) break;
        if (item_begins_operand(item)) {
            write_operand(writer, &level);
        } else if (item->kind == item_sign) {
            write_sign(writer, &level);
        } else if (item->kind == item_power) {
            write_power(writer, &level);
        } else {
            end_product(writer, &level);
            put_gap(writer);
            put_item(writer);
        }
    }
    end_product(writer, &level);
    put_gap(writer);
}

static void write_all(struct writer *writer)
{
    write_items(writer, item_end);
    while (writer->item->kind == item_close && !writer->w->failed) { /* without an opening bracket */
        put_item(writer);
        write_items(writer, item_end);
    }
}

const char *writing_make(struct writing *w, const struct notation_stretch **stretches)
{
    struct writer writer = {.w = w, .behind = w->start};
    const char *made = NULL;
    w->offset = w->start;
    w->count = w->room = 0;
    w->gap = w->foreign = false;
    if (writing_read_items(w)) {
        writer.item = w->items;
        write_all(&writer);
        if (writer.text.failed) w->arena->failed = true;
        if (!w->failed && !w->arena->failed)
            made = arena_text(w->arena, writer.text.length ? writer.text.data : "", writer.text.length);
    }
    *stretches = writer.first;
    text_free(&writer.text);
    return made;
}

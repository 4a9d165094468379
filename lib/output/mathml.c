/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The notation consists of words, products by a blank, signs, parentheses, units in brackets: `-m_1 g L_1 cos(theta)`.
 * A word is a name, with `_dot` or `_ddot`, and an index behind `_`; before a point the body that it belongs to.
 */
#include "output/mathml.h"

#include <stdbool.h>
#include <string.h>

#include "base/printed.h"

struct mathml {
    struct text *text;
    const char *at;
    int depth;            /* of parentheses */
    bool operand;         /* an operand is before: a blank is a product */
    bool open;            /* within an element <math> */
    size_t operand_start; /* of the last name or number, in the written text */
};

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80);
}

static void open_math(struct mathml *math)
{
    if (!math->open) text_add(math->text, "<math><mrow>");
    math->open = true;
}

static void close_math(struct mathml *math)
{
    if (math->open) text_add(math->text, "</mrow></math>");
    math->open = false;
}

static void write_operator(struct mathml *math, const char *sign, size_t length)
{
    if (length == 1 && *sign == '-')
        text_add(math->text, "<mo>−</mo>");
    else if (length == 1 && *sign == '<')
        text_add(math->text, "<mo>&lt;</mo>");
    else if (length == 1 && *sign == '>')
        text_add(math->text, "<mo>&gt;</mo>");
    else if (length == 1 && *sign == '&')
        text_add(math->text, "<mo>&amp;</mo>");
    else if (length == 1 && (*sign == '(' || *sign == ')'))
        text_printf(math->text, "<mo stretchy=\"false\">%c</mo>", *sign);
    else
        text_printf(math->text, "<mo>%.*s</mo>", (int)length, sign);
}

/* One letter is italic, longer words are upright; a dotted letter is two characters, which would be upright. */
static void write_name(struct mathml *math, const char *word, size_t length, int dots)
{
    static const char *const marks[] = {"", "\u0307", "\u0308"};
    const char *letter = greek_letter(word, length);
    text_add(math->text,
             dots > 0 && (letter || length == 1) ? "<mi mathvariant=\"italic\" class=\"dotted\">" : "<mi>");
    if (letter)
        text_add(math->text, letter);
    else
        text_add_bytes(math->text, word, length);
    text_printf(math->text, "%s</mi>", marks[dots]);
}

static size_t index_length(const char *index)
{
    size_t length = 0;
    while (is_letter(index[length]) || is_digit(index[length]) || index[length] == '_') length++;
    return length;
}

static int dots_at(const char *text)
{
    return strncmp(text, "_ddot", 5) == 0 ? 2 : strncmp(text, "_dot", 4) == 0 ? 1 : 0;
}

/* A name with its dots and index: I_O1, omega_dot, vx. */
static void write_symbol(struct mathml *math)
{
    const char *word = math->at;
    size_t length = 0;
    while (is_letter(word[length]) || is_digit(word[length]) || word[length] == '\'') length++;
    const bool velocity = length == 2 && word[0] == 'v' && (word[1] == 'x' || word[1] == 'y');
    const int dots = dots_at(word + length);
    const char *index = word + length + (dots ? dots + 3 : 0);
    const size_t index_size = *index == '_' ? index_length(index + 1) : 0;
    if (velocity || index_size > 0) text_add(math->text, "<msub>");
    write_name(math, word, velocity ? 1 : length, dots);
    if (velocity) text_printf(math->text, "<mi>%c</mi></msub>", word[1]);
    if (!velocity && index_size > 0) {
        const bool number = strspn(index + 1, "0123456789") >= index_size;
        const char *letter = greek_letter(index + 1, index_size);
        text_printf(math->text, number ? "<mn>%.*s</mn></msub>" : "<mi>%.*s</mi></msub>",
                    letter ? (int)strlen(letter) : (int)index_size, letter ? letter : index + 1);
    }
    math->at = index + (velocity ? 0 : index_size > 0 ? index_size + 1 : 0);
}

/* The words before a point are bodies: crank.omega_dot. */
static void write_word(struct mathml *math)
{
    const char *word = math->at;
    size_t length = index_length(word);
    if (word[length] == '.' && is_letter(word[length + 1])) {
        text_printf(math->text, "<mtext>%.*s.</mtext>", (int)length, word);
        math->at += length + 1;
    } else if (length == 3 && (strncmp(word, "sin", 3) == 0 || strncmp(word, "cos", 3) == 0)) {
        text_printf(math->text, "<mi>%.3s</mi><mo>\u2061</mo>", word);
        math->at += 3;
    } else {
        write_symbol(math);
    }
}

/* A unit, "[deg]" or "[m]". */
static void write_unit(struct mathml *math)
{
    const size_t length = strcspn(math->at, "]");
    if (strncmp(math->at, "[deg]", 5) == 0)
        text_add(math->text, "<mtext>°</mtext>");
    else
        text_printf(math->text, "<mtext>\u00a0%.*s\u2009</mtext>", (int)length - 1, math->at + 1);
    math->at += length + (math->at[length] == ']');
}

static void write_number(struct mathml *math)
{
    const size_t length = strspn(math->at, "0123456789.");
    text_printf(math->text, "<mn>%.*s</mn>", (int)length, math->at);
    math->at += length;
}

/* The last name or number with its exponent. */
static void write_power(struct mathml *math)
{
    const size_t length = strspn(++math->at, "0123456789"), start = math->operand_start;
    struct text base = {0};
    if (math->text->failed) return;
    text_add_bytes(&base, math->text->data + start, math->text->length - start);
    math->text->failed |= base.failed;
    math->text->length = start;
    text_printf(math->text, "<msup>%s<mn>%.*s</mn></msup>", base.data ? base.data : "", (int)length,
                math->at);
    text_free(&base);
    math->at += length;
}

/* A sign between summands outside of parentheses begins the next element, where it would else be a prefix. */
static void write_sign(struct mathml *math)
{
    const char c = *math->at++;
    const bool between = math->depth == 0 && math->operand && (c == '+' || c == '-');
    if (between) {
        close_math(math);
        text_add(math->text, " ");
        open_math(math);
        text_printf(math->text, "<mo form=\"infix\">%s</mo>", c == '-' ? "−" : "+");
    } else {
        write_operator(math, &c, 1);
    }
    math->depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    math->operand = c == ')' || (c == '|' && math->operand);
}

static void write_item(struct mathml *math)
{
    const char c = *math->at;
    open_math(math);
    if (c == '[') {
        write_unit(math);
    } else if (c == '^') {
        write_power(math);
    } else if (is_digit(c) || c == '.') {
        math->operand_start = math->text->length;
        write_number(math);
        math->operand = true;
    } else if (is_letter(c)) {
        math->operand_start = math->text->length;
        write_word(math);
        math->operand = true;
    } else {
        write_sign(math);
    }
}

static void write_blank(struct mathml *math)
{
    const char next = *++math->at;
    const bool factor = math->operand && (is_letter(next) || is_digit(next) || next == '(' || next == '|');
    if (factor && math->open) text_add(math->text, "<mo>\u2062</mo><mspace width=\"0.17em\"/>");
}

void mathml_write(struct text *text, const char *sign, const char *formula)
{
    struct mathml math = {.text = text, .at = formula};
    if (sign[0]) {
        open_math(&math);
        write_operator(&math, sign, strlen(sign));
    }
    while (*math.at)
        if (*math.at == ' ')
            write_blank(&math);
        else
            write_item(&math);
    close_math(&math);
}

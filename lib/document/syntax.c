/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document/syntax.h"

#include <string.h>

#include "base/utf8.h"
#include "document/scalar.h"

struct pos syntax_place(yaml_mark_t mark)
{
    return (struct pos){(int)mark.line + 1, (int)mark.column + 1};
}

/* Messages of libyaml, with the replacement and a hint. The first row applies whose `problem` is the start of
 * libyaml's, and whose `context` (if any) is libyaml's. */
static const struct explanation {
    const char *problem, *context, *message, *hint;
} explanations[] = {
    {"mapping values are not allowed", NULL, "a colon where no key can stand",
     "does this line start in the column of its neighbours? text with `: ` needs quotes"},
    {"could not find expected ':'", NULL, "this line is no `key: value`",
     "put a colon and a blank after a key, `- ` before a list entry"},
    {"did not find expected key", NULL, "this line fits nothing above it",
     "keys of one block start in the same column, and list entries do not mix with keys"},
    {"did not find expected '-' indicator", NULL, "a list continues here without `-`",
     "start each entry with `- `; the keys of an entry are indented deeper than its `-`"},
    {"did not find expected ',' or '}'", NULL, "a mapping in braces is not closed, or lacks a comma",
     "write {key: value, key: value}"},
    {"did not find expected ',' or ']'", NULL, "a list in brackets is not closed, or lacks a comma",
     "write [a, b, c]; an expression with brackets needs quotes inside a list: \"4[N]*t\""},
    {"found unexpected end of stream", NULL, "a quote is opened and never closed",
     "close it, or delete the opening quote"},
    {"found unexpected document indicator", NULL, "a quote is opened and never closed",
     "close it, or delete the opening quote"},
    {"found unknown escape character", NULL, "an unknown escape after `\\` in double quotes",
     "use single quotes: in them `\\` is an ordinary character"},
    {"block sequence entries are not allowed", NULL, "a list entry `- ` where none can stand",
     "start a list on the line below its key, or write it in brackets: [a, b]"},
    {"block mapping keys are not allowed", NULL, "a key where none can stand", NULL},
    {"found character that cannot start any token", NULL, "no value starts with this character",
     "put text that starts with `@`, `%` or a backtick in quotes"},
    {"did not find expected alphabetic or numeric character", "while scanning an alias",
     "`*` without the name of an anchor", "a product needs a left side; quote text that starts with `*`"},
    {"did not find expected alphabetic or numeric character", NULL, "`&` without a name", NULL},
    {"did not find expected node content", NULL, "a value is missing here",
     "is there a stray bracket, brace or comma?"},
    {"did not find expected <document start>", NULL, "the model ends before this line",
     "is it indented as its neighbours, and is there no stray bracket before it?"},
    {"found undefined tag handle", NULL, "a tag (`!...`) that means nothing here",
     "delete it; quote text that starts with `!`"},
};

static const struct explanation *find_explanation(const char *problem, const char *context)
{
    for (size_t i = 0; i < sizeof explanations / sizeof *explanations; i++) {
        const struct explanation *e = &explanations[i];
        if (strncmp(problem, e->problem, strlen(e->problem)) != 0) continue;
        if (!e->context || (context && strcmp(context, e->context) == 0)) return e;
    }
    return NULL;
}

/* Line `number` (from 1) without its end; empty beyond the last line. */
static struct source line_of(const struct source *source, int number)
{
    const char *text = source->text, *end = text + source->length;
    for (int line = 1; line < number && text < end; text++)
        if (source_line_ends(text, end)) line++;
    const char *stop = text;
    while (stop < end && *stop != '\n' && *stop != '\r') stop++;
    return (struct source){text, (size_t)(stop - text)};
}

static size_t leading_blanks(struct source line)
{
    size_t i = 0;
    while (i < line.length && line.text[i] == ' ') i++;
    return i;
}

/* The column of the colon in a line that starts as `key:value`, without a blank after the colon; else 0. */
static int glued_colon(struct source line)
{
    size_t start = leading_blanks(line), i = start;
    while (i < line.length && scalar_is_word(line.text[i])) i++;
    bool glued = i > start && i + 1 < line.length && line.text[i] == ':' && line.text[i + 1] != ' ';
    return glued ? (int)i + 1 : 0;
}

/* `mass:2 kg` is plain text in YAML, and libyaml reports a later line. Search in the reported line and in the
 * one above. */
static bool explain_glued_colon(const struct source *source, struct pos at, fbd_errors *errors)
{
    for (int line = at.line; line >= 1 && line >= at.line - 1; line--) {
        struct source text = line_of(source, line);
        int column = glued_colon(text);
        if (column == 0) continue;
        size_t start = leading_blanks(text);
        int length = column - (int)start - 1;
        diag_add(errors, FBD_ERROR, "yaml-syntax", (struct pos){line, column},
                 "a key is followed by a colon and a blank", "no blank after the colon of `%.*s`",
                 length > 40 ? 40 : length, text.text + start);
        return true;
    }
    return false;
}

/* A tab among the leading blanks of the reported line. */
static bool explain_tab(const struct source *source, struct pos at, fbd_errors *errors)
{
    struct source line = line_of(source, at.line);
    size_t i = leading_blanks(line);
    if (i == line.length || line.text[i] != '\t') return false;
    diag_add(errors, FBD_ERROR, "tab-indent", (struct pos){at.line, (int)i + 1},
             "replace it by blanks; most editors can do so for the whole file",
             "a tab indents this line: YAML allows blanks only");
    return true;
}

/* The entry that contains the bracket at i: from the last `{`, `[`, colon or comma outside of parentheses to
 * the next comma or bracket there. */
static struct source entry_around(struct source line, size_t i)
{
    size_t start = 0, stop;
    int depth = 0;
    for (size_t k = 0; k < i; k++) {
        char c = line.text[k];
        depth += (c == '(') - (c == ')');
        if (depth == 0 && strchr("{[,:", c)) start = k + 1;
    }
    while (start < i && line.text[start] == ' ') start++;
    for (stop = i; stop < line.length; stop++) {
        char c = line.text[stop];
        if (depth <= 0 && strchr(",}]", c)) break;
        depth += (c == '(' || c == '[') - (c == ')' || c == ']');
    }
    while (stop > i && line.text[stop - 1] == ' ') stop--;
    return (struct source){line.text + start, stop - start};
}

/* A hint with the entry in quotes, and a blank between it and the key of `value:4[N]`. */
static const char *hint_quoted(struct source line, struct source found, fbd_errors *errors)
{
    const size_t longest = 100;
    const char *key = found.text;
    if (key > line.text && key[-1] == ':')
        for (key--; key > line.text && scalar_is_word(key[-1]);) key--;
    size_t word = key < found.text ? (size_t)(found.text - key) - 1 : 0;
    if (word + found.length > longest || memchr(found.text, '"', found.length))
        return "write for example {value: \"4[N/s]*t\"}, or give the entry lines of its own";
    return diag_hint(errors, "write `%.*s%s\"%.*s\"`", (int)word, key, word > 0 ? ": " : "",
                     (int)found.length, found.text);
}

/* Inside braces or brackets a plain `4[N]*t` ends at its own bracket. */
static bool explain_unit_in_flow(const struct source *source, struct pos at, fbd_errors *errors)
{
    struct source line = line_of(source, at.line);
    unsigned code;
    size_t i = 0;
    for (int column = 1; column < at.column && i < line.length; column++)
        i += utf8_decode(line.text + i, line.length - i, &code);
    if (i == 0 || i >= line.length || line.text[i] != '[' || strchr(" ,[{:", line.text[i - 1])) return false;
    diag_add(errors, FBD_ERROR, "unquoted-unit", at, hint_quoted(line, entry_around(line, i), errors),
             "inside braces or brackets an expression with `[unit]` needs quotes");
    return true;
}

/* libyaml searches for the colon of a key within 1024 characters. */
static bool explain_long_key(struct pos at, fbd_errors *errors)
{
    const int longest = 1024;
    if (at.column <= longest) return false;
    diag_add(errors, FBD_ERROR, "bad-key", at, "is a line end or a quote missing?",
             "the text before this colon is too long for a key");
    return true;
}

static bool is_about_tabs(const char *problem)
{
    return strstr(problem, "tab character") || strstr(problem, "cannot start any token");
}

static bool is_about_colons(const char *problem)
{
    return strstr(problem, "mapping values") || strstr(problem, "expected ':'") ||
           strstr(problem, "expected key") || strstr(problem, "<document start>");
}

/* For these problems libyaml reports the end of the faulty part, possibly the end of the file; its start is
 * more useful. */
static bool is_about_start(const char *problem)
{
    return strstr(problem, "expected ':'") || strstr(problem, "end of stream") ||
           strstr(problem, "document indicator");
}

void syntax_explain(const yaml_parser_t *parser, const struct source *source, fbd_errors *errors)
{
    if (parser->error == YAML_MEMORY_ERROR) {
        diag_out_of_memory(errors);
        return;
    }
    const char *problem = parser->problem ? parser->problem : "the file is no YAML";
    struct pos at = syntax_place(parser->problem_mark);
    if (is_about_tabs(problem) && explain_tab(source, at, errors)) return;
    if (is_about_colons(problem) && explain_glued_colon(source, at, errors)) return;
    if (strstr(problem, "mapping values") && explain_long_key(at, errors)) return;
    if (strstr(problem, "expected ','") && explain_unit_in_flow(source, at, errors)) return;
    struct pos within = parser->context ? syntax_place(parser->context_mark) : (struct pos){0, 0};
    if (is_about_start(problem) && within.line > 0) at = within;
    if (within.line == at.line && within.column == at.column) within = (struct pos){0, 0};
    const struct explanation *e = find_explanation(problem, parser->context);
    diag_add_within(errors, "yaml-syntax", at, within, e ? e->hint : NULL, "%s", e ? e->message : problem);
}

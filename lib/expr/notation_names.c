/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Finds the names of the scope that the symbols of a notation stand for.
 *
 * A symbol that is a name as spelled is that name. Else it may be another spelling of one (`N_1` of N1, `a_x`
 * of ax, `F_N` of the force N, `x_A` of A.x), and else several names without a sign between (`mgL`).
 */
#include <string.h>

#include "expr/notation_work.h"
#include "expr/parser.h"

enum { longest_name = 160 };

struct spelled {
    char text[longest_name];
};

bool name_is_known(const struct writing *w, const char *name, struct dim *dim)
{
    struct dim none = {0};
    *dim = none;
    if (strcmp(name, "pi") == 0) return true;
    struct symbol symbol = w->scope->lookup(w->scope->context, name, w->at);
    if (!symbol.free) *dim = symbol.dim;
    return symbol.kind != symbol_unknown;
}

/* ---- one name */

/* The known names among the spellings of a symbol. */
struct matches {
    const struct writing *w;
    const char *suffix; /* of a derivative */
    bool force;         /* forces only */
    struct spelled found[2];
    int count; /* number of different ones */
};

/* Try the name `a` `middle` `b` followed by the suffix. */
static void try_name(struct matches *matches, const char *a, size_t length, const char *middle, const char *b)
{
    struct spelled name = {{0}};
    struct dim dim;
    const struct dim of_force = DIM_INIT(1, 1, -2);
    size_t more = strlen(middle), rest = strlen(b), end = strlen(matches->suffix);
    if (length + more + rest == 0 || length + more + rest + end >= sizeof name.text) return;
    memcpy(name.text, a, length);
    memcpy(name.text + length, middle, more);
    memcpy(name.text + length + more, b, rest);
    memcpy(name.text + length + more + rest, matches->suffix, end + 1);
    if (!name_is_known(matches->w, name.text, &dim) || (matches->force && !dim_equal(dim, of_force))) return;
    if (matches->count == 2 || (matches->count == 1 && strcmp(matches->found[0].text, name.text) == 0))
        return;
    matches->found[matches->count++] = name;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_plain_name(const char *text)
{
    return *text != '\0' && *text != '_' && *text != '.' && !is_digit(*text);
}

/* Try spellings with one `_` more or less, the symbol of a force with its name as subscript, and a coordinate
 * of a body. */
static void try_others(struct matches *matches, const char *name, size_t greek)
{
    size_t length = strlen(name), digits = length;
    while (digits > 0 && is_digit(name[digits - 1])) digits--;
    if (digits < length && digits > 0 && name[digits - 1] != '_')
        try_name(matches, name, digits, "_", name + digits);
    if (greek > 0 && greek < length && name[greek] != '_') try_name(matches, name, greek, "_", name + greek);
    for (const char *low = strchr(name, '_'); low; low = strchr(low + 1, '_')) {
        size_t before = (size_t)(low - name);
        if (before == 0 || !low[1]) continue;
        try_name(matches, name, before, "", low + 1);
        if (before == 1 && name[0] == 'F' && is_plain_name(low + 1) && !matches->force) {
            matches->force = true;
            try_name(matches, low + 1, strlen(low + 1), "", "");
            try_others(matches, low + 1, 0);
            matches->force = false;
        }
        if (!is_plain_name(low + 1) || strchr(name, '.')) continue;
        struct spelled prefix = {{0}};
        prefix.text[0] = '.';
        memcpy(prefix.text + 1, name, before);
        try_name(matches, low + 1, strlen(low + 1), prefix.text, "");
        if (*matches->suffix) {
            const char *suffix = matches->suffix;
            struct spelled whole = {{0}};
            memcpy(whole.text, suffix, strlen(suffix));
            whole.text[strlen(suffix)] = '_';
            matches->suffix = "";
            try_name(matches, name, before, whole.text, low + 1);
            matches->suffix = suffix;
        }
    }
}

/* Spell the atoms from `first` to `end` as a name, without marks; false if they are no name. */
static bool spell(const struct run *run, size_t first, size_t end, struct spelled *name, int *marks)
{
    size_t length = 0;
    *marks = 0;
    for (size_t i = first; i < end; i++) {
        const struct atom *atom = &run->atoms[i];
        bool last = i + 1 == end || run->atoms[i + 1].text[0] == '_';
        if ((atom->marks > 0 && !last) || length + atom->length >= longest_name - 8) return false;
        memcpy(name->text + length, atom->text, atom->length);
        length += atom->length;
        *marks += atom->marks;
    }
    name->text[length] = '\0';
    return is_plain_name(name->text) || name->text[0] == '_';
}

static const char *suffix_of(int marks)
{
    return marks == 0 ? "" : marks == 1 ? "_dot" : marks == 2 ? "_ddot" : NULL;
}

/* Find the known names of these atoms: 0 none, 1 one, 2 several. */
static int match(const struct writing *w, const struct run *run, size_t first, size_t end,
                 struct spelled names[2])
{
    int count;
    struct spelled plain = {{0}};
    if (!spell(run, first, end, &plain, &count) || !suffix_of(count)) return 0;
    struct matches matches = {.w = w, .suffix = suffix_of(count)};
    try_name(&matches, plain.text, strlen(plain.text), "", "");
    if (matches.count == 0)
        try_others(&matches, plain.text, run->atoms[first].greek ? run->atoms[first].length : 0);
    memcpy(names, matches.found, sizeof matches.found);
    return matches.count;
}

/* ---- functions */

static const char *const usual[][2] = {
    {"arcsin", "asin"}, {"arccos", "acos"}, {"arctan", "atan"}, {"sgn", "sign"}, {"signum", "sign"}};

/* The function named by these atoms; NULL if none. */
static const char *function_of(const struct run *run, size_t first, size_t end)
{
    int marks;
    struct spelled name = {{0}};
    if (!spell(run, first, end, &name, &marks) || marks > 0) return NULL;
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++)
        if (strcmp(name.text, usual[i][0]) == 0) return usual[i][1];
    const char *found;
    for (size_t i = 0; (found = expr_function(i)) != NULL; i++)
        if (strcmp(name.text, found) == 0) return found;
    return NULL;
}

/* True if the argument may be without brackets. */
static bool takes_bare(const char *function)
{
    static const char *const bare[] = {"sin",  "cos",  "tan", "asin", "acos", "atan", "sinh",
                                       "cosh", "tanh", "exp", "ln",   "log",  "sign"};
    for (size_t i = 0; i < sizeof bare / sizeof *bare; i++)
        if (strcmp(function, bare[i]) == 0) return true;
    return false;
}

/* ---- several names */

enum { most_pieces = most_atoms };

struct split {
    const struct writing *w;
    const struct run *run;
    size_t pieces[most_pieces],
        kept[2][most_pieces]; /* ends of the names: of the current split, of two found */
    size_t count, found;
    bool called; /* a bracket follows the last name */
    int looked;  /* remaining number of trials */
    bool known[most_atoms][most_atoms + 1], asked[most_atoms][most_atoms + 1];
};

static bool is_piece(struct split *split, size_t first, size_t end)
{
    if (!split->asked[first][end]) {
        struct spelled names[2];
        split->asked[first][end] = true;
        const char *function = function_of(split->run, first, end);
        bool called = split->called && end == split->run->count;
        split->known[first][end] = match(split->w, split->run, first, end, names) == 1 ||
                                   (function && (called || takes_bare(function)));
    }
    return split->known[first][end];
}

/* `vx` is not split into a product: it is the component of a vector that the body does not have. */
static bool is_component(const struct run *run, size_t before, size_t first)
{
    char a = run->atoms[before].text[0], b = run->atoms[first].text[0];
    return run->atoms[before].length == 1 && run->atoms[first].length == 1 && first == before + 1 &&
           (a == 'v' || a == 'a') && (b == 'x' || b == 'y');
}

static void try_pieces(struct split *split, size_t first)
{
    const struct run *run = split->run;
    if (first == run->count) {
        if (split->found < 2) memcpy(split->kept[split->found], split->pieces, sizeof split->pieces);
        split->found++;
        return;
    }
    for (size_t end = run->count; end > first && split->found < 2 && split->looked > 0;
         end--, split->looked--) {
        size_t before = split->count > 1 ? split->pieces[split->count - 2] : 0;
        if (!is_piece(split, first, end)) continue;
        if (split->count > 0 && is_component(run, before, first)) continue;
        split->pieces[split->count++] = end;
        try_pieces(split, end);
        split->count--;
    }
}

/* ---- items */

/* True if a bracket follows. */
static bool is_called(const struct writing *w, size_t end)
{
    size_t at = writing_skip(w, end), size = command_length(w, at);
    if (size > 0 && (command_is(w, at, "left") || memcmp(w->text + at, "\\big", 4) == 0 ||
                     memcmp(w->text + at, "\\Big", 4) == 0))
        at = writing_skip(w, at + size);
    return writing_has(w, at, "(") || command_is(w, at, "lparen");
}

static bool is_table(const struct writing *w, const char *name)
{
    if (!w->scope->table) return false;
    struct table_symbol table = w->scope->table(w->scope->context, name, w->at);
    return table.table || table.failed;
}

/* True for a variable at a length, as `M(L/2)`. */
static bool is_at_length(const struct writing *w, const char *name)
{
    return w->scope->at_length &&
           w->scope->at_length(w->scope->context, name, NAN, w->at).kind != symbol_unknown;
}

/* True if the brackets behind `end` begin a sense of names; it ends where they close. */
static bool begins_sense(struct writing *w, const char *name, size_t end)
{
    int depth = 0;
    if (!w->scope->sense || !w->scope->sense(w->scope->context, name)) return false;
    for (w->sense_end = end; w->sense_end < w->length; w->sense_end++) {
        depth += w->text[w->sense_end] == '(';
        if (w->text[w->sense_end] == ')' && --depth == 0) break;
    }
    return true;
}

/* Add an item for these atoms: the source if it is spelled like `text`, else `text`. */
static bool add_item(struct writing *w, enum item_kind kind, const struct run *run, size_t first, size_t end,
                     const char *text)
{
    size_t from = run->atoms[first].start, to = run->atoms[end - 1].end, length = strlen(text);
    for (size_t i = first; i < end; i++) {
        if (run->atoms[i].start < from) from = run->atoms[i].start;
        if (run->atoms[i].end > to) to = run->atoms[i].end;
    }
    bool same = to - from == length && memcmp(w->text + from, text, length) == 0;
    const char *kept = same ? NULL : arena_text(w->arena, text, length);
    return (same || kept) && writing_add(w, kind, from, to, kept);
}

static bool add_piece(struct writing *w, const struct run *run, size_t first, size_t end)
{
    struct spelled names[2];
    const char *function = function_of(run, first, end);
    if (match(w, run, first, end, names) == 1) return add_item(w, item_name, run, first, end, names[0].text);
    return function &&
           add_item(w, takes_bare(function) ? item_function : item_call, run, first, end, function);
}

static const char *pieces_text(const struct writing *w, const struct run *run, const size_t *pieces)
{
    struct text text = {0};
    for (size_t first = 0; first < run->count; first = *pieces++) {
        struct spelled names[2];
        const char *function = function_of(run, first, *pieces);
        bool known = match(w, run, first, *pieces, names) == 1;
        text_printf(&text, "%s%s", first > 0 ? "*" : "", known ? names[0].text : function);
    }
    const char *kept = text.failed ? NULL : arena_text(w->arena, text.data, text.length);
    text_free(&text);
    return kept;
}

static bool add_product(struct writing *w, const struct split *split)
{
    size_t first = 0;
    const size_t *pieces = split->kept[0];
    if (split->found > 1)
        return writing_ambiguous(w, split->run->atoms[0].start, pieces_text(w, split->run, pieces),
                                 pieces_text(w, split->run, split->kept[1]));
    for (; first < split->run->count; first = *pieces++)
        if (!add_piece(w, split->run, first, *pieces)) return false;
    return true;
}

/* Add an unknown name, spelled as in the language; the parser of expressions reports it. */
static bool add_unknown(struct writing *w, const struct run *run, bool called)
{
    struct spelled name = {{0}};
    int marks;
    if (!spell(run, 0, run->count, &name, &marks)) {
        if (run->atoms[0].start < run->atoms[run->count - 1].end && !run->atoms[0].greek && marks == 0)
            return writing_add(w, item_other, run->atoms[0].start, run->atoms[run->count - 1].end, NULL) !=
                   NULL;
        return writing_refuse(w, "expression-syntax", run->atoms[0].start, NULL, "this is no name");
    }
    if (!suffix_of(marks))
        return writing_refuse(w, "expression-syntax", run->atoms[0].start, NULL,
                              "a derivative beyond the second has no name");
    memcpy(name.text + strlen(name.text), suffix_of(marks), strlen(suffix_of(marks)) + 1);
    return add_item(w, called ? item_call : item_name, run, 0, run->count, name.text);
}

static bool is_word(const char *name)
{
    return strcmp(name, "and") == 0 || strcmp(name, "or") == 0 || strcmp(name, "not") == 0;
}

bool run_add(struct writing *w, const struct run *run, size_t end)
{
    struct spelled name = {{0}}, names[2];
    int marks;
    bool called = is_called(w, end);
    const char *function = function_of(run, 0, run->count);
    bool spelled = spell(run, 0, run->count, &name, &marks);
    if (spelled && marks == 0 && is_word(name.text))
        return writing_add(w, item_break, run->atoms[0].start, end, NULL) != NULL;
    if (called && function)
        return add_item(w, takes_bare(function) ? item_function : item_call, run, 0, run->count, function);
    if (called && spelled && marks == 0 && begins_sense(w, name.text, end))
        return add_item(w, item_call, run, 0, run->count, name.text);
    if (called && spelled && marks == 0 && (is_table(w, name.text) || is_at_length(w, name.text)))
        return add_item(w, item_call, run, 0, run->count, name.text);
    int count = match(w, run, 0, run->count, names);
    if (count == 1) return add_item(w, item_name, run, 0, run->count, names[0].text);
    if (count > 1) return writing_ambiguous(w, run->atoms[0].start, names[0].text, names[1].text);
    if (function && takes_bare(function)) return add_item(w, item_function, run, 0, run->count, function);
    struct split *split = ARENA_NEW(w->arena, struct split);
    if (!split) return false;
    *split = (struct split){.w = w, .run = run, .called = called, .looked = 4000};
    try_pieces(split, 0);
    bool cut = split->looked <= 0;
    return split->found > 0 && !cut ? add_product(w, split) : add_unknown(w, run, called);
}

bool name_is_unit(const struct writing *w, const struct item *name)
{
    struct unit unit;
    struct dim dim;
    const char *text = name->text ? name->text : arena_text(w->arena, w->text + name->start, name->length);
    if (!text || !unit_parse(w->text + name->start, name->length, w->scope->units, NULL, w->at, &unit))
        return false;
    return name_is_known(w, text, &dim) && dim_equal(dim, unit.dim) && !dim_equal(dim, DIM_NONE);
}

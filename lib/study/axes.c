/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/axes.h"

#include "base/hash.h"
#include "expr/expr.h"

#include <math.h>
#include <string.h>

/* ---- values */

/* A value between the ends of a grid. */
static double even(const struct member *m, uint64_t i)
{
    double last = (double)(m->count - 1), at = (double)i;
    return (m->a * (last - at) + m->b * at) / last;
}

static double logarithmic(const struct member *m, uint64_t i)
{
    return m->a * pow(m->b / m->a, (double)i / (double)(m->count - 1));
}

static void add_between(struct text *text, const struct member *m, uint64_t i)
{
    const double rounding = 1e-15;
    double value = m->kind == values_log ? logarithmic(m, i) : even(m, i);
    bool zero = fabs(value) < rounding * fmax(fabs(m->a), fabs(m->b)) && m->kind == values_even;
    text_number(text, zero ? 0 : value, 15);
}

void axes_value(const struct axes *axes, const struct member *m, uint64_t run, struct text *text)
{
    uint64_t i = run;
    for (size_t axis = axes->axis_count - 1; axis > m->axis; axis--) i /= axes->counts[axis];
    i %= axes->counts[m->axis];
    const struct draw_place place = {axes->seed, m->key, i};
    if (m->kind == values_words)
        text_add(text, m->words[i]);
    else if (m->kind == values_listed)
        text_exact(text, m->list[i]);
    else if (m->kind == values_drawn)
        text_exact(text, draw(m->distribution, m->a, m->b, place));
    else if (i > 0 && i + 1 < m->count)
        add_between(text, m, i);
    else
        text_exact(text, i == 0 ? m->a : m->b);
}

/* ---- reading */

struct vary {
    struct arena *arena;
    fbd_errors *errors;
    const char *whole; /* the text as given, for messages */
};

static bool refuse(const struct vary *vary, const char *hint, const char *message)
{
    diag_add(vary->errors, FBD_ERROR, "bad-vary", (struct pos){0, 0}, hint, "`%.80s`: %s", vary->whole,
             message);
    return false;
}

static const char usual_hint[] =
    "write NAME=start:stop:count, NAME=1,2,5 or NAME=uniform(low,high):count, a unit behind a number";

struct slice {
    const char *text;
    size_t length;
};

static struct slice trim(struct slice slice)
{
    while (slice.length && strchr(" \t", slice.text[0])) slice.text++, slice.length--;
    while (slice.length && strchr(" \t", slice.text[slice.length - 1])) slice.length--;
    return slice;
}

/* Cut off the part before the first `mark` outside parentheses; false, with all in `first`, when there is
 * none. */
static bool cut(struct slice *rest, char mark, struct slice *first)
{
    int depth = 0;
    for (size_t i = 0; i < rest->length; i++) {
        char c = rest->text[i];
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (c != mark || depth > 0) continue;
        *first = trim((struct slice){rest->text, i});
        *rest = (struct slice){rest->text + i + 1, rest->length - i - 1};
        return true;
    }
    *first = trim(*rest);
    *rest = (struct slice){rest->text + rest->length, 0};
    return false;
}

/* The length of the leading part that looks like a number. */
static size_t number_length(struct slice slice)
{
    size_t i = 0;
    const char *c = slice.text;
    if (i < slice.length && strchr("+-", c[i])) i++;
    while (i < slice.length && strchr("0123456789.", c[i])) i++;
    size_t mantissa = i;
    if (i == slice.length || !strchr("eE", c[i])) return mantissa;
    i++;
    if (i < slice.length && strchr("+-", c[i])) i++;
    size_t digits = i;
    while (i < slice.length && strchr("0123456789", c[i])) i++;
    return i > digits ? i : mantissa;
}

static bool set_unit(const struct vary *vary, struct member *member, struct slice unit)
{
    unit = trim(unit);
    if (unit.length == 0) return true;
    size_t length = strlen(member->unit);
    if (length == unit.length && strncmp(member->unit, unit.text, length) == 0) return true;
    if (length) return refuse(vary, "give all values of a parameter in one unit", "it names two units");
    member->unit = arena_text(vary->arena, unit.text, unit.length);
    return member->unit != NULL;
}

/* A number with an optional unit. */
static bool read_quantity(const struct vary *vary, struct member *member, struct slice slice, double *value)
{
    size_t length = number_length(slice);
    if (!expr_number(slice.text, length, value) || !isfinite(*value))
        return refuse(vary, usual_hint, "a number is missing or is none");
    return set_unit(vary, member, (struct slice){slice.text + length, slice.length - length});
}

static bool read_count(const struct vary *vary, struct slice slice, uint64_t *count)
{
    uint64_t value = 0;
    for (size_t i = 0; i < slice.length; i++) {
        if (!strchr("0123456789", slice.text[i]) || value > most_runs) value = 0, slice.length = 0;
        if (slice.length) value = 10 * value + (uint64_t)(slice.text[i] - '0');
    }
    *count = value;
    if (value >= 1 && value <= most_runs) return true;
    return refuse(vary, usual_hint, "the number of values must be a whole number above zero");
}

/* NAME(a,b)[ unit]:count; `brace` is the opening parenthesis. */
static bool read_drawn(const struct vary *vary, struct member *m, struct slice slice, const char *brace)
{
    static const char *const names[] = {"uniform", "normal", "loguniform"};
    struct slice name = trim((struct slice){slice.text, (size_t)(brace - slice.text)}), call, inner, a, b;
    size_t k = 0;
    while (k < 3 && (strlen(names[k]) != name.length || strncmp(names[k], name.text, name.length) != 0)) k++;
    if (k == 3)
        return refuse(vary, "one of uniform(low,high), normal(mean,deviation), loguniform(low,high)",
                      "there is no such distribution");
    m->kind = values_drawn;
    m->distribution = (enum distribution)k;
    const char *end = memchr(brace, ')', (size_t)(slice.text + slice.length - brace));
    if (!end) return refuse(vary, usual_hint, "a parenthesis is not closed");
    inner = (struct slice){brace + 1, (size_t)(end - brace - 1)};
    struct slice rest = {end + 1, (size_t)(slice.text + slice.length - end - 1)};
    if (!cut(&inner, ',', &a)) return refuse(vary, usual_hint, "a distribution takes two numbers");
    if (!cut(&rest, ':', &call)) return refuse(vary, usual_hint, "how many draws? write `:count` behind it");
    b = trim(inner);
    if (!read_quantity(vary, m, a, &m->a) || !read_quantity(vary, m, b, &m->b)) return false;
    if (!set_unit(vary, m, call) || !read_count(vary, trim(rest), &m->count)) return false;
    if (k == draw_loguniform && !(m->a > 0 && m->b > 0))
        return refuse(vary, NULL, "loguniform takes two numbers above zero");
    return k != draw_normal || m->b >= 0 || refuse(vary, NULL, "a standard deviation cannot be below zero");
}

static bool read_grid(const struct vary *vary, struct member *m, struct slice slice)
{
    struct slice a, b, count, rest = slice;
    cut(&rest, ':', &a);
    if (!cut(&rest, ':', &b)) return refuse(vary, usual_hint, "a grid is start:stop:count");
    bool more = cut(&rest, ':', &count);
    rest = trim(rest);
    m->kind = values_even;
    if (more && (rest.length != 3 || strncmp(rest.text, "log", 3) != 0))
        return refuse(vary, "behind the count only `:log` may stand", "a grid is start:stop:count");
    if (more) m->kind = values_log;
    if (!read_quantity(vary, m, a, &m->a) || !read_quantity(vary, m, b, &m->b)) return false;
    if (m->kind == values_log && !(m->a * m->b > 0))
        return refuse(vary, NULL, "a logarithmic grid needs ends of one sign, not zero");
    return read_count(vary, count, &m->count);
}

/* True for the name of a file: not a number, with a dot or a slash in it. */
static bool is_file(struct slice slice)
{
    bool number = number_length(slice) > 0 && strchr("0123456789+-", slice.text[0]);
    bool mark = memchr(slice.text, '.', slice.length) || memchr(slice.text, '/', slice.length);
    return !number && mark && !memchr(slice.text, '"', slice.length) && slice.length > 1;
}

static bool read_files(const struct vary *vary, struct member *m, struct slice slice, size_t count)
{
    const char **words = ARENA_ARRAY(vary->arena, count, const char *);
    if (!words) return false;
    m->kind = values_words;
    m->words = words;
    m->count = count;
    for (size_t i = 0; i < count; i++) {
        struct slice item;
        cut(&slice, ',', &item);
        if (!is_file(item))
            return refuse(vary, "write NAME=a.csv,b.csv", "one of these is no file of a table");
        words[i] = arena_text(vary->arena, item.text, item.length);
    }
    return true;
}

static bool read_list(const struct vary *vary, struct member *m, struct slice slice)
{
    size_t count = 1;
    for (size_t i = 0; i < slice.length; i++) count += slice.text[i] == ',';
    struct slice rest = slice, first;
    cut(&rest, ',', &first);
    if (first.length > 0 && is_file(first)) return read_files(vary, m, slice, count);
    double *list = ARENA_ARRAY(vary->arena, count, double);
    if (!list) return false;
    m->kind = values_listed;
    m->list = list;
    m->count = count;
    for (size_t i = 0; i < count; i++) {
        struct slice item;
        cut(&slice, ',', &item);
        if (!read_quantity(vary, m, item, &list[i])) return false;
    }
    return true;
}

static bool read_member(const struct vary *vary, struct member *m, struct slice slice)
{
    struct slice name;
    if (!cut(&slice, '=', &name) || name.length == 0)
        return refuse(vary, usual_hint, "it names no parameter and its values");
    *m = (struct member){.name = arena_text(vary->arena, name.text, name.length), .unit = ""};
    m->key = hash_text(name.text, name.length);
    slice = trim(slice);
    if (!m->name || slice.length == 0) return refuse(vary, usual_hint, "it has no values");
    const char *brace = memchr(slice.text, '(', slice.length), *colon = memchr(slice.text, ':', slice.length);
    if (brace && (slice.text[0] < '0' || slice.text[0] > '9') && !strchr("+-.", slice.text[0]))
        return read_drawn(vary, m, slice, brace);
    return colon ? read_grid(vary, m, slice) : read_list(vary, m, slice);
}

/* ---- the whole */

static bool check_name(const struct axes *axes, const struct vary *vary, const struct member *member)
{
    for (const struct member *m = axes->members; m < member; m++)
        if (strcmp(m->name, member->name) == 0)
            return refuse(vary, "vary each parameter once", "the parameter is varied already");
    return true;
}

static bool read_axis(struct axes *axes, const struct vary *vary, bool zip)
{
    struct slice rest = {vary->whole, strlen(vary->whole)}, slice;
    size_t axis = zip ? 0 : axes->axis_count;
    for (bool more = true; more;) {
        struct member *m = &axes->members[axes->member_count];
        if (axes->member_count == most_members) return refuse(vary, NULL, "too many parameters vary");
        more = cut(&rest, ';', &slice);
        if (!read_member(vary, m, slice) || !check_name(axes, vary, m)) return false;
        axes->member_count++;
        m->axis = axis;
        if (axis == axes->axis_count) axes->counts[axes->axis_count++] = m->count;
        if (axes->counts[axis] != m->count)
            return refuse(vary, "parameters side by side must have equally many values",
                          "its number of values differs");
    }
    return true;
}

bool axes_read(struct axes *axes, struct arena *arena, const char *const *texts, size_t count, bool zip,
               uint64_t seed, fbd_errors *errors)
{
    *axes = (struct axes){.members = ARENA_ARRAY(arena, most_members, struct member),
                          .counts = ARENA_ARRAY(arena, most_members, uint64_t),
                          .seed = seed,
                          .runs = 1};
    if (!axes->members || !axes->counts) {
        diag_out_of_memory(errors);
        return false;
    }
    bool fine = true;
    errors->file = "--vary";
    for (size_t i = 0; i < count && fine; i++) {
        const struct vary vary = {arena, errors, texts[i]};
        fine = read_axis(axes, &vary, zip);
    }
    for (size_t i = 0; i < axes->axis_count && fine; i++) {
        const struct vary vary = {arena, errors, texts[0]};
        fine = axes->counts[i] <= most_runs / axes->runs || refuse(&vary, NULL, "the runs are past counting");
        axes->runs *= axes->counts[i];
    }
    if (arena->failed) diag_out_of_memory(errors);
    return fine && !arena->failed;
}

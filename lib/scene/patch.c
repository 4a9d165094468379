/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/patch.h"

#include "scene/record.h"
#include "scene/values.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* ---- one reading */

struct reading {
    struct scene *scene;
    struct reader reader;
    struct record record;
};

static void close_reading(struct reading *reading)
{
    scene_free(reading->scene);
    arena_free(&reading->record.exprs);
    arena_free(&reading->record.derived);
}

static bool read_with(struct reading *reading, const struct document *document,
                      const struct override *overrides, size_t count)
{
    fbd_errors *errors = fbd_errors_new();
    struct record *record = &reading->record;
    if (!errors) return false;
    reading->scene = scene_read_by(&reading->reader, document, overrides, count, NULL, record, errors);
    bool fine = reading->scene && fbd_errors_failed_count(errors) == 0 && !errors->out_of_memory &&
                !record->exprs.failed && !record->derived.failed;
    fbd_errors_free(errors);
    return fine;
}

/* ---- finding the stored values */

/* A word of the scene that contains the value of a site, or the pointer to its expression. */
struct stored_word {
    uint64_t *word;
    size_t site;
    bool pointer;
};

struct patch {
    struct reading reading;
    struct override *own; /* copy used by the readings */
    size_t count;
    struct stored_word *words;
    size_t word_count, word_room;
    size_t absolutes; /* number of absolutes of the scene */
    struct arena exprs;
    fbd_errors *errors;
};

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static bool is_number(const struct site *site)
{
    return site->expr && expr_is_constant(site->expr);
}

/* NOLINTNEXTLINE(readability-non-const-parameter): written later */
static bool add_word(struct patch *patch, uint64_t *word, size_t site, bool pointer)
{
    if (patch->word_count == patch->word_room) {
        size_t room = patch->word_room ? 2 * patch->word_room : 32;
        struct stored_word *words = realloc(patch->words, room * sizeof *words);
        if (!words) return false;
        patch->words = words;
        patch->word_room = room;
    }
    patch->words[patch->word_count++] = (struct stored_word){word, site, pointer};
    return true;
}

struct comparison {
    struct patch *patch;
    const struct reading *beside;
};

/* True if `twin` points to the same place in the other reading as `word` in this one. */
static bool same_place(const struct reading *a, const struct reading *b, uint64_t word, uint64_t twin)
{
    uintptr_t other = arena_twin(&a->scene->arena, &b->scene->arena, (uintptr_t)word);
    if (!other) other = arena_twin(&a->record.derived, &b->record.derived, (uintptr_t)word);
    return other && other == twin;
}

/* The sum of the masses of the parts, in the same order as the reader adds them. */
static double mass_of_parts(const struct body *body)
{
    double mass = 0;
    for (size_t i = 0; i < body->part_count; i++) mass += body->parts[i].mass;
    return mass;
}

static bool is_mass(const struct reading *reading, const uint64_t *word)
{
    for (size_t b = 0; b < reading->scene->body_count; b++)
        if ((const void *)word == &reading->reader.drafts[b].mass) return true;
    return false;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): type required by arena_compare */
static bool in_derived(void *context, uint64_t *word, uint64_t twin)
{
    const struct comparison *comparison = context;
    return same_place(&comparison->patch->reading, comparison->beside, *word, twin);
}

/* Explain a word that differs between the two readings; false if it is not the value of a site. */
static bool in_scene(void *context, uint64_t *word, uint64_t twin)
{
    struct comparison *comparison = context;
    struct patch *patch = comparison->patch;
    const struct record *first = &patch->reading.record, *second = &comparison->beside->record;
    if (same_place(&patch->reading, comparison->beside, *word, twin)) return true;
    for (size_t i = 0; i < first->count; i++) {
        const struct site *a = &first->sites[i], *b = &second->sites[i];
        if (*word == (uintptr_t)a->expr && twin == (uintptr_t)b->expr)
            return !a->varies || add_word(patch, word, i, true);
        if (a->varies && is_number(a) && *word == bits_of(expr_value(a->expr)) &&
            twin == bits_of(expr_value(b->expr)))
            return add_word(patch, word, i, false);
    }
    return is_mass(&patch->reading, word);
}

/* Compare the members of the scene itself, which are not in the arena. */
static bool compare_top(struct comparison *comparison)
{
    uint64_t *words = (uint64_t *)comparison->patch->reading.scene;
    const uint64_t *twins = (const uint64_t *)comparison->beside->scene;
    for (size_t i = offsetof(struct scene, file) / sizeof *words; i < sizeof(struct scene) / sizeof *words;
         i++)
        if (words[i] != twins[i] && !in_scene(comparison, &words[i], twins[i])) return false;
    return true;
}

/* ---- conditions for patching */

enum side { below_zero, at_zero, up_to_one, beyond_one, at_no_side };

static enum side side_of(double value)
{
    return value < 0    ? below_zero
           : value == 0 ? at_zero
           : value <= 1 ? up_to_one
           : value > 1  ? beyond_one
                        : at_no_side;
}

/* True if two expressions have the same properties except for their values. */
static bool same_kind(const struct expr *a, const struct expr *b)
{
    if (expr_is_constant(a) != expr_is_constant(b) || expr_is_bare(a) != expr_is_bare(b) ||
        !dim_equal(expr_dim(a), expr_dim(b)))
        return false;
    if (expr_is_constant(a)) return side_of(expr_value(a)) == side_of(expr_value(b));
    const int *slots_a, *slots_b;
    size_t count = expr_variables(a, &slots_a);
    return expr_variables(b, &slots_b) == count &&
           (count == 0 || memcmp(slots_a, slots_b, count * sizeof *slots_a) == 0) &&
           expr_uses_time(a) == expr_uses_time(b) && expr_switches(a) == expr_switches(b) &&
           expr_poles(a) == expr_poles(b) && expr_degree(a, INT_MAX, NULL) == expr_degree(b, INT_MAX, NULL);
}

/* The parameter that an expression consists of, followed through definitions that consist of another
 * parameter; -1 if it is any other expression. */
static long name_of(const struct reader *reader, const struct site *site)
{
    size_t index;
    const struct scene *scene = reader->scene;
    if (site->outside) return parameters_find(reader, site->outside->name, &index) ? (long)index : -1;
    const struct node *node = site->node;
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (reader->definitions[i].node == node && !reader->definitions[i].override) {
            const char *text = node->text;
            return parameters_find(reader, text, &index) && index != i
                       ? name_of(reader, &(struct site){.node = reader->definitions[index].node,
                                                        .outside = reader->definitions[index].override})
                       : (long)i;
        }
    if (!parameters_find(reader, node->text, &index)) return -1;
    return name_of(reader, &(struct site){.node = reader->definitions[index].node,
                                          .outside = reader->definitions[index].override});
}

/* True unless two sites have equal values in both readings and are different quantities: their words could
 * not be distinguished. */
static bool told_apart(const struct reading *a, const struct reading *b, size_t i, size_t k)
{
    const struct site *of_a = a->record.sites, *of_b = b->record.sites;
    if (!of_a[i].varies || !of_a[k].varies || !is_number(&of_a[i]) || !is_number(&of_a[k])) return true;
    if (bits_of(expr_value(of_a[i].expr)) != bits_of(expr_value(of_a[k].expr)) ||
        bits_of(expr_value(of_b[i].expr)) != bits_of(expr_value(of_b[k].expr)))
        return true;
    const struct node *of_i = of_a[i].node, *of_k = of_a[k].node;
    bool constants = of_a[i].constants && of_a[k].constants;
    if (constants && of_i && of_k && strcmp(of_i->text, of_k->text) == 0) return true;
    long name = name_of(&a->reader, &of_a[i]);
    return name >= 0 && name == name_of(&a->reader, &of_a[k]);
}

static bool check_sites(const struct reading *a, const struct reading *b)
{
    if (a->record.count != b->record.count) return false;
    for (size_t i = 0; i < a->record.count; i++) {
        const struct site *of_a = &a->record.sites[i], *of_b = &b->record.sites[i];
        if (of_a->node != of_b->node || of_a->outside != of_b->outside || !of_a->expr != !of_b->expr)
            return false;
        if (!of_a->varies) continue;
        if (!of_a->patched || !same_kind(of_a->expr, of_b->expr)) return false;
        for (size_t k = 0; k < i; k++)
            if (!told_apart(a, b, i, k)) return false;
    }
    return true;
}

/* True if the masses of all bodies equal the sums of the masses of their parts. */
static bool check_masses(const struct reading *reading)
{
    for (size_t b = 0; b < reading->scene->body_count; b++)
        if (bits_of(mass_of_parts(&reading->scene->bodies[b])) != bits_of(reading->reader.drafts[b].mass))
            return false;
    return true;
}

static bool find_words(struct patch *patch, const struct reading *beside)
{
    struct comparison comparison = {patch, beside};
    struct reading *reading = &patch->reading;
    return check_sites(reading, beside) && check_masses(reading) && check_masses(beside) &&
           arena_compare(&reading->record.derived, &beside->record.derived, in_derived, &comparison) &&
           arena_compare(&reading->scene->arena, &beside->scene->arena, in_scene, &comparison) &&
           compare_top(&comparison);
}

/* ---- making and freeing */

/* Limit of the quadratic comparison of sites with each other and with words: beyond some hundred sites
 * reading anew is faster. */
enum { most_sites = 500 };

static bool make(struct patch *patch, const struct document *document, const struct override *overrides,
                 const char *const *beside)
{
    struct reading second = {0};
    memcpy(patch->own, overrides, patch->count * sizeof *overrides);
    bool fine = read_with(&patch->reading, document, patch->own, patch->count);
    for (size_t i = 0; i < patch->count; i++)
        if (beside[i]) patch->own[i].value = beside[i];
    fine = fine && patch->reading.record.count <= most_sites &&
           read_with(&second, document, patch->own, patch->count) && find_words(patch, &second);
    close_reading(&second);
    return fine;
}

struct patch *patch_new(const struct document *document, const struct override *overrides, size_t count,
                        const char *const *beside)
{
    struct patch *patch = calloc(1, sizeof *patch);
    if (!patch) return NULL;
    patch->count = count;
    patch->own = calloc(count + 1, sizeof *patch->own);
    patch->errors = fbd_errors_new();
    if (!patch->own || !patch->errors || !make(patch, document, overrides, beside)) {
        patch_free(patch);
        return NULL;
    }
    patch->absolutes = patch->reading.scene->absolute_count;
    struct reader *reader = &patch->reading.reader;
    reader->errors = patch->errors;
    reader->record = NULL;
    reader->exprs = &patch->exprs;
    return patch;
}

void patch_free(struct patch *patch)
{
    if (!patch) return;
    close_reading(&patch->reading);
    arena_free(&patch->exprs);
    fbd_errors_free(patch->errors);
    free(patch->own);
    free(patch->words);
    free(patch);
}

/* ---- applying other values */

static const struct expr *compile(struct patch *patch, struct site *site, const struct override *overrides)
{
    struct reader *reader = &patch->reading.reader;
    if (site->outside) return override_compile(reader, &overrides[site->outside - patch->own]);
    if (site->constants) return value_compile(reader, site->node, &site->want, &reader->constants);
    const struct scope scope = names_scope(&site->names);
    return value_compile(reader, site->node, &site->want, &scope);
}

static void store(const struct patch *patch, size_t site, const struct expr *expr)
{
    bool number = expr_is_constant(expr);
    for (size_t k = 0; k < patch->word_count; k++) {
        const struct stored_word *word = &patch->words[k];
        if (word->site != site) continue;
        if (word->pointer)
            *word->word = (uintptr_t)expr;
        else if (number)
            *word->word = bits_of(expr_value(expr));
    }
}

/* Update the masses of bodies, which expressions may name. */
static void add_masses(struct reading *reading)
{
    for (size_t b = 0; b < reading->scene->body_count; b++)
        reading->reader.drafts[b].mass = mass_of_parts(&reading->scene->bodies[b]);
}

/* Compile and store the varying sites in the order of the reading, so that later ones use the new values of
 * earlier ones. After a failure the scene is partly changed until the next successful call. */
static bool renew(struct patch *patch, const struct override *overrides)
{
    struct record *record = &patch->reading.record;
    bool added = false;
    for (size_t i = 0; i < record->count; i++) {
        struct site *site = &record->sites[i];
        if (!site->varies) continue;
        if (!site->constants && !added) add_masses(&patch->reading);
        added = !site->constants;
        const struct expr *expr = compile(patch, site, overrides);
        if (!expr || !same_kind(site->expr, expr)) return false;
        store(patch, i, expr);
    }
    return true;
}

/* Any note, even a warning, requires a full reading, which reports it. */
static bool is_quiet(struct patch *patch)
{
    if (patch->errors->count == 0 && !patch->errors->out_of_memory) return true;
    fbd_errors *fresh = fbd_errors_new();
    if (!fresh) return false;
    fbd_errors_free(patch->errors);
    patch->errors = patch->reading.reader.errors = fresh;
    return false;
}

struct scene *patch_apply(struct patch *patch, const struct override *overrides)
{
    struct reading *reading = &patch->reading;
    arena_free(&patch->exprs);
    bool fine = renew(patch, overrides);
    if (!is_quiet(patch) || !fine || reading->scene->absolute_count != patch->absolutes ||
        patch->exprs.failed || reading->scene->arena.failed)
        return NULL;
    return reading->scene;
}

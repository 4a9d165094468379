/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "words.h"

#include "expr/expr.h"
#include "expr/unit_table.h"
#include "scene/language.h"

struct visitor {
    void (*visit)(void *context, const struct word_set *set);
    void *context;
};

static void add(struct word_set *set, const char *word)
{
    if (set->count < most_words) set->words[set->count++] = word;
}

static void visit_choices(const struct visitor *visitor, const struct field *field)
{
    struct word_set set = {.count = 0};
    for (size_t i = 0; i < field->choice_count; i++) add(&set, field->choices[i].name);
    if (set.count > 0) visitor->visit(visitor->context, &set);
}

static void visit_group(const struct visitor *visitor, const struct group *group)
{
    struct word_set set = {.count = 0};
    for (const struct group *part = group; part; part = part->base)
        for (size_t i = 0; i < part->count; i++) {
            add(&set, part->fields[i].key);
            visit_choices(visitor, &part->fields[i]);
            if (part->fields[i].group) visit_group(visitor, part->fields[i].group);
        }
    visitor->visit(visitor->context, &set);
}

static void visit_kinds(const struct visitor *visitor, const struct kinds *kinds)
{
    struct word_set set = {.count = 0};
    for (size_t i = 0; i < kinds->count; i++) {
        add(&set, kinds->kinds[i].name);
        if (kinds->kinds[i].group) visit_group(visitor, kinds->kinds[i].group);
    }
    visitor->visit(visitor->context, &set);
}

static void visit_expressions(const struct visitor *visitor)
{
    static const char *const other[] = {"and", "or", "not", "pi", "t", "<=", ">=", "=="};
    struct word_set units = {.count = 0}, functions = {.count = 0}, others = {.count = 0};
    for (size_t i = 0; unit_row(i); i++) add(&units, unit_row(i)->name);
    for (size_t i = 0; expr_function(i); i++) add(&functions, expr_function(i));
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) add(&others, other[i]);
    visitor->visit(visitor->context, &units);
    visitor->visit(visitor->context, &functions);
    visitor->visit(visitor->context, &others);
}

void each_word_set(void (*visit)(void *context, const struct word_set *set), void *context)
{
    const struct visitor visitor = {visit, context};
    const struct kinds *const kinds[] = {&motion_kinds, &force_kinds, &moment_kinds, &coupling_kinds};
    const struct group *const groups[] = {&scene_group, &event_group, &part_group, &inertia_group,
                                          &hand_group};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) visit_kinds(&visitor, kinds[i]);
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) visit_group(&visitor, groups[i]);
    for (int motion = 0; motion <= motion_weld; motion++) {
        visit_group(&visitor, &initial_groups[motion]);
        visit_group(&visitor, &exact_groups[motion]);
    }
    visit_expressions(&visitor);
}

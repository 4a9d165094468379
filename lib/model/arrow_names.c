/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Make the names of the arrows of each diagram unique, since they are columns and keys of the output.
 *
 * Loads listed in the file have distinct names; derived ones may not: of a rope that meets a body twice, a
 * pulley between two points of the ground, a coupling called as a body that moves on its other body,
 * `b1.friction`. All but the first get a number.
 */
#include <stdlib.h>
#include <string.h>

#include "model/builder.h"

struct arrow_name {
    int body;
    size_t order;      /* among all arrows */
    const char *text;  /* the intended name */
    const char **made; /* where it is stored; NULL for a name of the file */
};

struct arrow_names {
    struct arrow_name *all;
    size_t count;
};

static void add(struct arrow_names *names, int body, const char *text, const char **made)
{
    if (body == ground_body || !text) return;
    names->all[names->count] = (struct arrow_name){body, names->count, text, made};
    names->count++;
}

static void add_made(struct arrow_names *names, int body, const char **made)
{
    add(names, body, *made, made);
}

static int compare(const struct arrow_name *a, const struct arrow_name *b)
{
    if (a->body != b->body) return a->body < b->body ? -1 : 1;
    return strcmp(a->text, b->text);
}

static int by_name(const void *a, const void *b)
{
    const struct arrow_name *first = a, *second = b;
    int order = compare(first, second);
    return order != 0 ? order : first->order < second->order ? -1 : 1;
}

static int by_text(const void *a, const void *b)
{
    return compare(a, b);
}

static size_t most_names(const struct fbd_model *model)
{
    size_t most = 0;
    for (int i = 0; i < model->tree->joined_count; i++)
        most += (size_t)model->bodies[model->tree->bodies[i]].arrow_count;
    return most;
}

static void collect(struct fbd_model *model, struct arrow_names *names)
{
    struct tree *tree = model->tree;
    for (size_t i = 0; i < model->coupled_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (model->bodies[load->body].alone) continue;
        add(names, load->body, load->source->name, NULL);
        if (load->partner >= 0) add(names, load->partner, load->source->name, NULL);
    }
    for (int i = 0; i < tree->coupling_count; i++)
        for (int k = 0; k < tree->couplings[i].end_count; k++)
            for (int row = 0; row < 2; row++)
                add_made(names, tree->couplings[i].end[k].body, &tree->couplings[i].end[k].name[row]);
    for (int i = 0; i < tree->joined_count; i++) {
        struct model_body *body = &model->bodies[tree->bodies[i]];
        add_made(names, tree->bodies[i], &body->reaction);
        for (int l = body->first_load; l < body->first_load + body->load_count; l++)
            add_made(names, body->parent, &model->loads[l].name_on_parent);
        add_made(names, body->parent, &body->drive_on_parent);
        add_made(names, body->parent, &body->reaction_on_parent);
    }
}

/* `rope_2`, or the first number from there on that no other arrow of the body has. */
static const char *numbered(struct arena *arena, const struct arrow_names *names,
                            const struct arrow_name *name, int *number)
{
    struct arrow_name wanted = *name;
    do {
        wanted.text = arena_printf(arena, "%s_%d", name->text, ++*number);
    } while (wanted.text && bsearch(&wanted, names->all, names->count, sizeof wanted, by_text));
    return wanted.text;
}

bool arrows_name(struct fbd_model *model)
{
    struct arrow_names names = {0};
    names.all = calloc(most_names(model) + 1, sizeof *names.all);
    if (!names.all) return false;
    collect(model, &names);
    qsort(names.all, names.count, sizeof *names.all, by_name);
    int number = 1;
    for (size_t i = 1; i < names.count; i++) {
        const struct arrow_name *name = &names.all[i];
        if (compare(&names.all[i - 1], name) != 0)
            number = 1;
        else if (name->made)
            *name->made = numbered(&model->arena, &names, name, &number);
    }
    free(names.all);
    return !model->arena.failed;
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Properties of a tree as a whole, after all loads are added: they select the parts of the recursion that a scene
 * needs.
 */
#include "model/builder.h"

static double mass_ratio(const struct tree *tree)
{
    double heaviest = 0, lightest = HUGE_VAL;
    for (int i = 1; i < tree->joined; i++) {
        const double mass = tree->links[i].mass;
        heaviest = fmax(heaviest, mass);
        if (mass > 0) lightest = fmin(lightest, mass);
    }
    return heaviest / lightest;
}

static bool is_loaded(const struct tree *tree)
{
    bool loaded = tree->bulk_count > 0;
    for (size_t i = 0; i < tree->spring_count; i++) loaded |= tree->springs[i].link[0] < tree->joined;
    for (size_t i = 0; i < tree->following_count; i++) loaded |= tree->following[i].link < tree->joined;
    for (size_t i = 0; i < tree->force_count; i++) loaded |= tree->forces[i].link < tree->joined;
    for (size_t i = 0; i < tree->moment_count; i++) loaded |= tree->moments[i].link < tree->joined;
    for (size_t i = 0; i < tree->drag_count; i++) loaded |= tree->drags[i].link < tree->joined;
    return loaded;
}

bool tree_finish(struct fbd_model *model)
{
    struct tree *tree = model->tree;
    const struct plan *plan = &model->plan;
    for (int i = 1; i < tree->count; i++)
        tree->links[i].normal_slot = model->bodies[tree->links[i].body].normal_slot;
    for (int p = 0; p < (int)plan->mode_count; p++) {
        const struct mode *mode = &plan->modes[p];
        if (mode->coupling >= 0) continue;
        int link = model->bodies[mode->body].place.link;
        tree->links[link].pair = p;
        if (mode->normal_slot >= 0 && !link_is_alone(tree, link)) tree->pairs[tree->pair_count++] = link;
    }
    for (int i = 1; i < tree->count; i++) {
        if (tree->links[i].normal_slot < 0 && tree->links[i].pair < 0) continue;
        tree->watched[tree->watched_count++] = i;
        tree->joined_watched += i < tree->joined;
    }
    tree->loaded = is_loaded(tree);
    tree->mass_ratio = mass_ratio(tree);
    tree->joined_by_pivots = tree->joined_watched == 0 && tree->bulk_count == 0;
    tree->pivots_only = tree->watched_count == 0 && tree->bulk_count == 0;
    for (int i = 1; i < tree->count; i++) {
        const bool has_axis = link_joint(&tree->links[i])->has_axis;
        if (!has_axis) tree->pivots_only = false;
        if (!has_axis && i < tree->joined) tree->joined_by_pivots = false;
        if (tree->links[i].track) tree->curved = true;
    }
    return couplings_order(model);
}

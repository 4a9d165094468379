/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Properties of a tree as a whole, after all loads are added: they select the parts of the recursion that a scene
 * needs.
 */
#include "model/builder.h"

struct mass_range tree_masses(const struct tree *tree)
{
    struct mass_range masses = {HUGE_VAL, 0};
    for (int i = 1; i < tree->joined; i++) {
        const double mass = tree->links[i].mass;
        masses.most = fmax(masses.most, mass);
        if (mass > 0) masses.least = fmin(masses.least, mass);
    }
    return masses;
}

/* ---- which loads act on which link: those of jointed links come first, then link by link those of the others */

static void take_into(struct link_loads *loads, enum load_list list, int index)
{
    struct range *range = &loads->of[list];
    if (range->count++ == 0) range->first = index;
    if (list <= list_drags) loads->any = true;
}

static void take(struct tree *tree, enum load_list list, int link, int index)
{
    bool alone = link_is_alone(tree, link);
    take_into(&tree->loads, list, index);
    take_into(alone ? &tree->alone_loads[link - tree->joined] : &tree->joined_loads, list, index);
}

static bool share_loads(struct fbd_model *model)
{
    struct tree *tree = model->tree;
    const struct plan *plan = &model->plan;
    tree->alone_loads =
        ARENA_ARRAY(&model->arena, (size_t)(tree->count - tree->joined) + 1, struct link_loads);
    if (!tree->alone_loads) return false;
    for (int i = 0; i < (int)tree->following_count; i++)
        take(tree, list_following, tree->following[i].link, i);
    for (int i = 0; i < (int)tree->force_count; i++) take(tree, list_forces, tree->forces[i].link, i);
    for (int i = 0; i < (int)tree->moment_count; i++) take(tree, list_moments, tree->moments[i].link, i);
    for (int i = 0; i < (int)tree->spring_count; i++) take(tree, list_springs, tree->springs[i].link[0], i);
    for (int i = 0; i < (int)tree->drag_count; i++) take(tree, list_drags, tree->drags[i].link, i);
    for (int i = 0; i < (int)plan->affine_count; i++) take(tree, list_affine, plan->affine[i].link, i);
    for (int i = 0; i < (int)plan->potential_count; i++)
        take(tree, list_potentials, plan->potentials[i].link, i);
    return true;
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
        tree->links[link].journal = mode->moment && mode->normal_slot >= 0;
        tree->journal_count += tree->links[link].journal;
    }
    for (int i = 1; i < tree->count; i++) {
        if (tree->links[i].normal_slot < 0 && tree->links[i].pair < 0) continue;
        tree->watched[tree->watched_count++] = i;
        tree->joined_watched += i < tree->joined;
    }
    if (!share_loads(model)) return false;
    tree->loaded = tree->joined_loads.any || tree->bulk_count > 0;
    const struct mass_range masses = tree_masses(tree);
    tree->mass_ratio = masses.most / masses.least;
    for (int i = 1; i < tree->joined; i++)
        if (tree->links[i].track) tree->general = true;
    if (!tree_find_massless(model)) return false;
    if (tree->massless_count > 0) tree->general = true;
    return couplings_order(model);
}

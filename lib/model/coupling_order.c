/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Elimination order of the unknowns of dynamics/tree_system.h, fixed when the model is compiled.
 *
 * Two unknowns are coupled when they act on a common tree: rows of couplings, and frictions of slides, which
 * belong to one tree each. The stored envelope of a row and column reaches from its first coupled unknown to
 * the diagonal, so that a chain of loops takes time in proportion to its length when its unknowns are
 * numbered along it. A file may list couplings and bodies in any order; so they are renumbered from one end
 * of each connected part to the other by George's reverse Cuthill-McKee order (George and Liu, Computer
 * Solution of Large Sparse Positive Definite Systems, 1981, chapter 4). That order is used if its envelope is
 * smaller than that of the order of the file. Massless coordinates are eliminated last (tree_massless.c).
 */
#include <string.h>

#include "model/model.h"

/* Unknowns that are kept together: the rows of a coupling, the friction of a slide, or a massless coordinate. */
struct group {
    int first, count;
    const int *roots;
    int root_count;
};

struct graph {
    const struct tree *tree;
    int group_count, unknowns; /* without massless coordinates, which come last */
    struct group *groups;      /* with them */
    int *at_root, *members; /* groups of the tree with first link i: members[at_root[i]] to at_root[i + 1] */
    int *queue, *level;     /* groups in search order, and their distance; -1: not visited */
    bool *root_seen;
};

static void set_groups(struct graph *graph)
{
    const struct tree *tree = graph->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        graph->groups[i] =
            (struct group){coupling->first_row, coupling->row_count, coupling->root, coupling->root_count};
    }
    for (int k = 0; k < tree->pair_count; k++)
        graph->groups[tree->coupling_count + k] =
            (struct group){tree->row_count + k, 1, &tree->links[tree->pairs[k]].root, 1};
    for (int k = 0; k < tree->massless_count; k++)
        graph->groups[graph->group_count + k] =
            (struct group){graph->unknowns + k, 1, &tree->links[tree->massless[k].link].root, 1};
}

static void set_members(struct graph *graph)
{
    int links = graph->tree->count, *at = graph->at_root;
    for (int g = 0; g < graph->group_count; g++)
        for (int i = 0; i < graph->groups[g].root_count; i++) at[graph->groups[g].roots[i] + 1]++;
    for (int i = 0; i < links; i++) at[i + 1] += at[i];
    for (int g = graph->group_count - 1; g >= 0; g--)
        for (int i = 0; i < graph->groups[g].root_count; i++) {
            int root = graph->groups[g].roots[i];
            graph->members[--at[root + 1]] = g;
        }
    /* at[i + 1] is now the index of the first group of tree i. */
    for (int i = 0; i < links; i++) at[i] = at[i + 1];
}

static bool make_graph(struct graph *graph, const struct tree *tree, struct arena *arena)
{
    size_t links = (size_t)tree->count, groups = (size_t)tree->coupling_count + (size_t)tree->pair_count;
    size_t members = 0;
    *graph = (struct graph){.tree = tree, .group_count = (int)groups};
    graph->unknowns = tree->row_count + tree->pair_count;
    graph->groups = ARENA_ARRAY(arena, groups + (size_t)tree->massless_count, struct group);
    graph->at_root = ARENA_ARRAY(arena, links + 1, int);
    graph->queue = ARENA_ARRAY(arena, groups, int);
    graph->level = ARENA_ARRAY(arena, groups, int);
    graph->root_seen = ARENA_ARRAY(arena, links, bool);
    if (arena->failed) return false;
    set_groups(graph);
    for (size_t g = 0; g < groups; g++) members += (size_t)graph->groups[g].root_count;
    graph->members = ARENA_ARRAY(arena, members + 1, int);
    if (arena->failed) return false;
    memset(graph->at_root, 0, (links + 1) * sizeof *graph->at_root);
    set_members(graph);
    graph->at_root[links] = (int)members;
    return true;
}

/* Breadth-first search from a group; queue[from ..] receives its connected part. Returns the index past the
 * last. */
static int search(struct graph *graph, int start, int from)
{
    int end = from;
    graph->level[start] = 0;
    graph->queue[end++] = start;
    for (int k = from; k < end; k++) {
        const struct group *group = &graph->groups[graph->queue[k]];
        for (int i = 0; i < group->root_count; i++) {
            int root = group->roots[i];
            if (graph->root_seen[root]) continue;
            graph->root_seen[root] = true;
            for (int m = graph->at_root[root]; m < graph->at_root[root + 1]; m++) {
                int other = graph->members[m];
                if (graph->level[other] >= 0) continue;
                graph->level[other] = graph->level[graph->queue[k]] + 1;
                graph->queue[end++] = other;
            }
        }
    }
    return end;
}

static void forget(struct graph *graph, int from, int end)
{
    for (int k = from; k < end; k++) {
        const struct group *group = &graph->groups[graph->queue[k]];
        graph->level[graph->queue[k]] = -1;
        for (int i = 0; i < group->root_count; i++) graph->root_seen[group->roots[i]] = false;
    }
}

/* Order each connected part from a pseudo-peripheral group: the farthest from the farthest of any group. */
static void set_order(struct graph *graph, int *unknown_at)
{
    int from = 0, place = graph->unknowns;
    for (int g = 0; g < graph->group_count; g++) graph->level[g] = -1;
    memset(graph->root_seen, 0, (size_t)graph->tree->count * sizeof *graph->root_seen);
    for (int g = 0; g < graph->group_count; g++) {
        int start = g, end = from;
        if (graph->level[g] >= 0) continue;
        for (int pass = 0; pass < 3; pass++) {
            if (pass > 0) forget(graph, from, end);
            end = search(graph, start, from);
            start = graph->queue[end - 1];
        }
        from = end;
    }
    for (int k = 0; k < from; k++) {
        const struct group *group = &graph->groups[graph->queue[k]];
        for (int i = group->count - 1; i >= 0; i--) unknown_at[--place] = group->first + i;
    }
}

/* Compute the envelope of the order in unknown_at. */
static void set_envelope(struct graph *graph, struct tree *tree, int *group_of, int *lowest)
{
    int m = graph->unknowns + tree->massless_count, groups = graph->group_count + tree->massless_count;
    for (int g = 0; g < groups; g++)
        for (int i = 0; i < graph->groups[g].count; i++) group_of[graph->groups[g].first + i] = g;
    for (int i = 0; i < tree->count; i++) lowest[i] = m;
    for (int p = 0; p < m; p++) {
        const struct group *group = &graph->groups[group_of[tree->unknown_at[p]]];
        for (int i = 0; i < group->root_count; i++) {
            int root = group->roots[i];
            if (lowest[root] > p) lowest[root] = p;
        }
    }
    tree->envelope_size = 0;
    for (int p = 0; p < m; p++) {
        const struct group *group = &graph->groups[group_of[tree->unknown_at[p]]];
        tree->first[p] = p;
        for (int i = 0; i < group->root_count; i++) {
            int root = group->roots[i];
            if (lowest[root] < tree->first[p]) tree->first[p] = lowest[root];
        }
        tree->envelope[p] = tree->envelope_size;
        tree->envelope_size += (size_t)(p - tree->first[p]);
    }
}

static bool allocate(struct tree *tree, struct arena *arena, size_t m)
{
    tree->coupling_of_row = ARENA_ARRAY(arena, (size_t)tree->row_count, int);
    tree->unknown_at = ARENA_ARRAY(arena, m, int);
    tree->first = ARENA_ARRAY(arena, m, int);
    tree->envelope = ARENA_ARRAY(arena, m, size_t);
    return !arena->failed;
}

bool couplings_order(struct fbd_model *model)
{
    struct tree *tree = model->tree;
    struct arena *arena = &model->arena;
    struct graph graph;
    int m = tree->row_count + tree->pair_count + tree->massless_count;
    if (!allocate(tree, arena, (size_t)m) || !make_graph(&graph, tree, arena)) return false;
    int *group_of = ARENA_ARRAY(arena, (size_t)m, int);
    int *lowest = ARENA_ARRAY(arena, (size_t)tree->count, int);
    if (arena->failed) return false;
    for (int i = 0; i < tree->coupling_count; i++)
        for (int k = 0; k < tree->couplings[i].row_count; k++)
            tree->coupling_of_row[tree->couplings[i].first_row + k] = i;
    for (int k = 0; k < m; k++) tree->unknown_at[k] = k;
    set_envelope(&graph, tree, group_of, lowest);
    size_t of_the_file = tree->envelope_size;
    set_order(&graph, tree->unknown_at);
    set_envelope(&graph, tree, group_of, lowest);
    if (tree->envelope_size < of_the_file) return true;
    for (int k = 0; k < m; k++) tree->unknown_at[k] = k;
    set_envelope(&graph, tree, group_of, lowest);
    return true;
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The reactions that events name, and the forces and couplings that begin or end.
 */
#include <string.h>

#include "model/builder.h"

static struct range couplings_of(const struct tree *tree, int constraint)
{
    struct range found = {0, 0};
    for (int i = 0; i < tree->coupling_count; i++) {
        if (tree->couplings[i].constraint != constraint) continue;
        if (found.count == 0) found.first = i;
        found.count = i + 1 - found.first;
    }
    return found;
}

/* The spring, damper or actuator of a reaction: between bodies, or in the list of its body. */
static int load_called(const struct fbd_model *model, const struct model_absolute *reaction, const char *name)
{
    const struct model_body *body = &model->bodies[reaction->body];
    for (size_t i = model->listed_count; i < model->coupled_count; i++)
        if (strcmp(model->loads[i].source->name, name) == 0) return (int)i;
    for (int i = body->first_load; i < body->first_load + body->load_count; i++)
        if (strcmp(model->loads[i].source->name, name) == 0) return i;
    return -1;
}

/* The load of a lifetime; of a force with a reaction on another body the force. */
static int load_of_lifetime(const struct fbd_model *model, int number)
{
    for (size_t i = 0; number > 0 && i < model->coupled_count; i++) {
        const struct load *source = model->loads[i].source;
        if (source->lifetime.number == number && !source->reaction) return (int)i;
    }
    return -1;
}

static int coupling_of_lifetime(const struct tree *tree, int number)
{
    for (int i = 0; number > 0 && i < tree->coupling_count; i++)
        if (tree->couplings[i].source->lifetime.number == number) return i;
    return -1;
}

/* Does it name a reaction? */
static bool reacts(const struct fbd_model *model, const struct formula *formula)
{
    const int *slots, first = 1 + (int)plan_size(&model->plan) + hand_slots;
    size_t count = formula->expr ? expr_variables(formula->expr, &slots) : 0;
    for (size_t i = 0; i < count; i++)
        if (slots[i] >= first && model->absolutes[slots[i] - first].kind == absolute_reaction) return true;
    return false;
}

void reactions_find(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    struct tree *tree = model->tree;
    for (size_t k = 0; k < model->absolute_count; k++) {
        const struct absolute *source = &model->scene->absolutes[k];
        struct model_absolute *absolute = &model->absolutes[k];
        if (absolute->kind != absolute_reaction) continue;
        if (source->roll > 0) absolute->couplings = couplings_of(tree, source->roll - 1);
        if (source->force) absolute->load = load_called(model, absolute, source->force);
        tree->reacts |= absolute_is_of_pin(source);
    }
    for (size_t i = 0; i < plan->watch_count; i++) {
        const int number = plan->watches[i].source->lifetime;
        plan->watches[i].coupling = coupling_of_lifetime(tree, number);
        plan->watches[i].load = load_of_lifetime(model, number);
        plan->watches[i].reacts =
            reacts(model, &plan->watches[i].left) || reacts(model, &plan->watches[i].right);
    }
    for (size_t i = 0; i < plan->kink_count; i++)
        plan->kinks[i].reacts = reacts(model, &plan->kinks[i].formula);
    tree->ends = model->scene->lifetime_count > 0;
}

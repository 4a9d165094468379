/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/finite_result.h"

#include "dynamics/nonfinite.h"

/* Works that were not requested are NaN, and so are energies. */
static bool note_work(struct ledger *ledger, const struct fbd_state *state, const double *work,
                      struct nonfinite *found)
{
    const struct fbd_model *model = ledger->model;
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (ledger_has_works(ledger, i) && !ledger->any) continue;
        if (nonfinite_note(found, ledger_work(ledger, state, i, work), load->source->at,
                           "the work of `%s` on `%s`", load->source->name, model->bodies[load->body].name))
            return true;
    }
    return false;
}

static bool note_energies(struct ledger *ledger, const struct fbd_state *state, const double *work,
                          struct nonfinite *found)
{
    struct pos nowhere = {0, 0};
    fbd_energy energy = ledger_energy(ledger, state, work);
    const double values[] = {energy.kinetic, energy.potential, energy.work, energy.residual};
    static const char *const names[] = {"kinetic energy", "potential energy", "work of all forces",
                                        "residual of the energy"};
    int count = ledger->any ? 4 : 2;
    for (int i = 0; i < count; i++)
        if (nonfinite_note(found, values[i], nowhere, "the %s", names[i])) return true;
    return false;
}

static const char unresolved[] = "forces oscillate thousands of times within a step, and the motion does not "
                                 "depend on them; give a small --step";

bool result_finite(struct ensemble *ensemble, struct ledger *ledger, const double *work)
{
    struct fbd_state *state = ensemble_state(ensemble);
    struct nonfinite found;
    struct unresisted motion;
    if (state_is_unresisted(state, &motion)) {
        ensemble_spoil(ensemble, "%s at t = %.9g", motion.text, state->t);
        return false;
    }
    bool odd = nonfinite_find(state, &found);
    if (!odd && ledger)
        odd = note_work(ledger, state, work, &found) || note_energies(ledger, state, work, &found);
    if (odd) {
        const char *reason = ledger && ledger->unresolved ? unresolved : nonfinite_reason(found.value);
        ensemble_spoil(ensemble, "%s is not finite at t = %.9g: %s", found.what, state->t, reason);
    }
    return !odd;
}

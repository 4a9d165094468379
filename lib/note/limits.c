/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The limits of validity: times, values, effects, accuracy, and events after which the model says less.
 */
#include <math.h>

#include "note/note.h"

static bool has_event(const struct making *making, fbd_event_kind kind)
{
    for (size_t i = 0; i < fbd_simulation_event_count(making->simulation); i++)
        if (fbd_simulation_event(making->simulation, i).kind == kind) return true;
    return false;
}

static void list_accuracy(struct making *making, struct block *list)
{
    const fbd_stats *stats = &making->stats;
    struct document *document = making->document;
    const double large = 0.1;
    if (isnan(stats->error_estimate))
        document_cell_format(document, list,
                             "The error of the numbers was not estimated; the tolerance of a step is %s.",
                             making_number(making, stats->tolerance, error_digits));
    else if (!isfinite(stats->error_estimate))
        document_cell(document, list,
                      "The error of the numbers is not known: a more accurate run could not follow.");
    else if (stats->error_estimate > large)
        document_cell(document, list,
                      "Runs of different accuracy part: the numbers at the end are not determined by the "
                      "data (a chaotic motion), or the tolerance is too large.");
    else
        document_cell_format(document, list,
                             "The numerical error is about %s of the size of the motion; it says nothing "
                             "about errors of the data and of the assumptions.",
                             making_number(making, stats->error_estimate, error_digits));
}

static void list_events(struct making *making, struct block *list)
{
    static const struct {
        fbd_event_kind kind;
        const char *sentence;
    } limits[] = {
        {FBD_EVENT_SEVERAL,
         "At some event more than one motion agrees with the forces or the laws of impact; one of them "
         "was taken, see the events."},
        {FBD_EVENT_JAM,
         "At some event no finite forces agree with a slip (Painlevé); an impulse ends it, see the events."},
        {FBD_EVENT_REST, "Infinitely many impacts in a finite time are summed to their limit."},
    };
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++)
        if (has_event(making, limits[i].kind)) document_cell(making->document, list, limits[i].sentence);
}

void note_limits(struct making *making)
{
    struct document *document = making->document;
    document_heading(document, 2, "Limits");
    struct block *list = document_list(document);
    document_cell_format(document, list,
                         "The results hold for t = 0 to %s and for the values listed under Data.",
                         making_value(making, making->t, "s", note_digits));
    document_cell(
        document, list,
        "They hold as far as the assumptions do: rigid bodies in a plane, and the effects listed as "
        "simulated, no others. Strength and deformation of the bodies were not examined.");
    const char *reason = fbd_simulation_reason(making->simulation);
    if (reason[0]) document_cell_format(document, list, "The run ended early: %s.", reason);
    list_accuracy(making, list);
    list_events(making, list);
    if (making->statics && fbd_statics_indeterminacy(making->statics) > 0)
        document_cell(document, list,
                      "Reactions listed as not determined depend on the stiffness of the supports, which the "
                      "theory of rigid bodies does not contain.");
}

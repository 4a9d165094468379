/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Live: a model whose text is changed interactively by sliders, checkboxes and an editor. Every change is
 * made in the text, so that the run, the saved file and the input of fbd-run agree.
 */
#ifndef FBD_LIVE_LIVE_H
#define FBD_LIVE_LIVE_H

#include "base/text.h"
#include "document/spans.h"
#include "model/model.h"

/* An entry of the file that lists an effect: a force or moment of a body, a coupling or a contact. */
struct live_effect {
    const char *body; /* NULL for a coupling or contact */
    const char *name;
    int owner;       /* node of the mapping that contains the list: of the body, or of the file */
    const char *key; /* of the list there: "forces", "moments", "couplings", "contacts" */
    size_t index;    /* in the list */
};

/* List all entries with a text of their own (not aliases), at most `room` of them; returns their number. */
size_t live_effects(const struct fbd_model *model, const struct spans *spans, struct live_effect *effects,
                    size_t room);

/* True if its name is `name`: "block.friction", or "cable" for a coupling. */
bool live_effect_is(const struct live_effect *effect, const char *name);

/* ---- the library in a page (live_page.c) */

/* Append the last members and the end of the JSON object of such a page: the data files of the scene's
 * tables, and the scripts of the worker. Returns false with notes if a file cannot be read. */
bool live_add_engine(struct text *text, const struct scene *scene, fbd_errors *errors);

/* Parts of a page, POLICY and LIVE-PARTS: the context of the latter is that object as a struct text. */
void live_write_policy(struct text *text, const void *context);
void live_write_parts(struct text *text, const void *context);

#endif

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sheet of a student as one HTML file to draw on: lib/live/drawing, with the key and the library if the
 * page grades the drawing.
 */
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "base/json.h"
#include "draw/page.h"
#include "draw/svg.h"
#include "fbd_export.h"
#include "fbd_grade.h"
#include "grade/handout.h"
#include "live/drawing.h"
#include "live/live.h"

struct drawing_page {
    const fbd_key *key;
    const char *student;
    fbd_model *sheet;
    struct text source, pictures, data,
        engine; /* the open sheet; the data of the page; the key and the library */
};

/* ---- the sheet */

static bool write_sheet(const struct drawing_page *page, struct text *text, bool open)
{
    struct arena arena = {0};
    struct handout handout = {.text = text,
                              .arena = &arena,
                              .key = page->key,
                              .student = page->student,
                              .open = open,
                              .scene = !open};
    bool done = handout_write(&handout);
    arena_free(&arena);
    return done;
}

/* Compile the sheet of the student with the inertia that a motion requires; the pictures and points of its
 * bodies depend on nothing else. */
static bool compile_sheet(struct drawing_page *page, fbd_errors *errors)
{
    struct text plain = {0};
    fbd_errors *others = fbd_errors_new(); /* warnings are for the author of the key, who got them before */
    if (others && write_sheet(page, &plain, false))
        page->sheet = fbd_model_parse(plain.data, plain.length, page->key->file, NULL, 0, others);
    const fbd_error *error = page->sheet || !others || others->out_of_memory ? NULL : first_error(others);
    if (error)
        diag_add(
            errors, FBD_ERROR, "no-sheet", (struct pos){0, 0},
            "the sheet is the key without forces, moments and derivations (`--handout` alone prints it): "
            "its other parts must not name them",
            "the sheet without the key is no valid model: %.300s", error->message);
    else if (!page->sheet)
        diag_out_of_memory(errors);
    fbd_errors_free(others);
    text_free(&plain);
    return page->sheet != NULL;
}

static bool add_bodies(struct drawing_page *page, fbd_errors *errors)
{
    fbd_state *state = fbd_state_new(page->sheet);
    if (!state) {
        diag_out_of_memory(errors);
        return false;
    }
    fbd_view *view = fbd_view_new(state, errors);
    bool done = view && drawing_add_bodies(&page->data, &page->pictures, state, view);
    if (!done && fbd_errors_failed_count(errors) == 0) diag_out_of_memory(errors);
    if (done && (page->data.odd || page->pictures.odd)) {
        diag_add(errors, FBD_ERROR, "not-finite", (struct pos){0, 0}, NULL,
                 "the sheet cannot be drawn: a length is too large or too small for any scale");
        done = false;
    }
    fbd_view_free(view);
    fbd_state_free(state);
    return done;
}

/* Append a member with a composed text. */
static void add_made(struct text *text, const char *name, struct text *made)
{
    text_add_bytes(made, "", 1);
    json_text_member(text, name, made->data ? made->data : "");
    text->failed |= made->failed;
    text_free(made);
}

/* Make the data: the texts around the lists of an answer, and the bodies (drawing_body.c). */
static bool make_data(struct drawing_page *page, bool exam, fbd_errors *errors)
{
    struct text *text = &page->data, reactions = {0};
    if (!write_sheet(page, &page->source, true)) {
        diag_out_of_memory(errors);
        return false;
    }
    handout_reactions(&reactions, &page->key->grading);
    text_add(text, "{");
    json_text_member(text, "title", fbd_model_title(page->key->model));
    json_text_member(text, "student", page->student);
    json_text_member(text, "sheet", page->source.data);
    add_made(text, "reactions", &reactions);
    text_printf(text, "\"exam\":%s,\"bodies\":", exam ? "true" : "false");
    bool done = add_bodies(page, errors);
    text_add(text, "}");
    return done;
}

/* ---- the key, where the page grades */

static bool make_engine(struct drawing_page *page, fbd_errors *errors)
{
    const fbd_key *key = page->key;
    struct text source = {0}, settings = {0};
    text_add_bytes(&source, key->source, key->length);
    for (size_t i = 0; i < key->set_count; i++)
        text_printf(&settings, "%s=%s\n", key->set[i].name, key->set[i].value);
    text_add(&page->engine, "{");
    add_made(&page->engine, "key", &source);
    add_made(&page->engine, "settings", &settings);
    return live_add_engine(&page->engine, key->model, errors);
}

/* ---- the page */

static void write_title(struct text *text, const void *context)
{
    const struct drawing_page *page = context;
    const char *title = fbd_model_title(page->key->model);
    svg_escape(text, *title ? title : "Free-body diagram");
    text_add(text, ": ");
    svg_escape(text, page->student);
}

static void write_style(struct text *text, const void *context)
{
    (void)context;
    text_add(text, svg_style);
}

static void write_pictures(struct text *text, const void *context)
{
    const struct text *pictures = context;
    text_add_bytes(text, pictures->data, pictures->length);
}

static void write_data(struct text *text, const void *context)
{
    page_add_json(text, context);
}

static void write_engine(struct text *text, const void *context)
{
    const struct page_asset *asset = page_asset_find(context);
    if (asset) text_add_bytes(text, (const char *)asset->data, asset->size);
}

static char *fill(const struct drawing_page *page, bool grades, fbd_errors *errors)
{
    struct page_part parts[] = {{"POLICY", grades ? live_write_policy : page_write_policy, NULL},
                                {"TITLE", write_title, page},
                                {"DRAWING-STYLE", write_style, NULL},
                                {"PICTURES", write_pictures, &page->pictures},
                                {"DATA", write_data, &page->data},
                                {"LIVE-PARTS", live_write_parts, &page->engine},
                                {"LIVE-ENGINE", write_engine, "engine.js"},
                                {0}};
    if (!grades) parts[5] = (struct page_part){0}; /* nor a list after it */
    struct text text = {0};
    page_fill(&text, page_asset_find("drawing.html"), parts);
    if (!text.failed && !page->data.failed && !page->engine.failed) return text.data;
    text_free(&text);
    diag_out_of_memory(errors);
    return NULL;
}

static char *make_page(const fbd_key *key, const char *student, bool exam, fbd_errors *errors)
{
    struct drawing_page page = {.key = key, .student = student};
    char *made = NULL;
    diag_in_file(errors, key->file);
    if (!page_asset_find("drawing.html"))
        diag_add(errors, FBD_ERROR, "no-page", (struct pos){0, 0}, "build again without -Dhtml=disabled",
                 "this fbd was built without the pages");
    else if (!exam && !fbd_has_live())
        diag_add(errors, FBD_ERROR, "no-live", (struct pos){0, 0},
                 "an exam (`--exam`) saves answers for `--grade` instead; or `make live`, and build again",
                 "this fbd was built without live pages: its pages cannot check drawings");
    else if (compile_sheet(&page, errors) && make_data(&page, exam, errors) &&
             (exam || make_engine(&page, errors)))
        made = fill(&page, !exam, errors);
    fbd_model_free(page.sheet);
    text_free(&page.source);
    text_free(&page.pictures);
    text_free(&page.data);
    text_free(&page.engine);
    return made;
}

char *fbd_key_page(const fbd_key *key, const char *student, bool exam, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    char *page = key && student ? make_page(key, student, exam, errors)
                                : api_refuse(errors, "there is no key, or no name of a student");
    diag_end(&call);
    return page;
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/page.h"

#include <stdlib.h>
#include <string.h>

#include "base/call.h"
#include "base/diag.h"
#include "draw/svg.h"

static const struct page_asset *find_asset(const char *name, size_t length)
{
    for (size_t i = 0; i < page_asset_count; i++)
        if (strlen(page_assets[i].name) == length && memcmp(page_assets[i].name, name, length) == 0)
            return &page_assets[i];
    return NULL;
}

/* In a script element `<` could end the element or begin a comment; in JSON it stands within strings only. */
static void add_json(struct text *text, const struct text *json)
{
    size_t from = 0;
    for (size_t i = 0; i < json->length; i++) {
        if (json->data[i] != '<') continue;
        text_add_bytes(text, json->data + from, i - from);
        text_add(text, "\\u003c");
        from = i + 1;
    }
    text_add_bytes(text, json->data + from, json->length - from);
}

/* Copy the template; a line of `@NAME@` stands for the asset NAME, the title or the data. */
static void fill_template(struct text *text, const struct page_asset *template, const char *title,
                          const struct text *json)
{
    const char *line = (const char *)template->data, *end = line + template->size;
    while (line < end) {
        const char *stop = memchr(line, '\n', (size_t)(end - line));
        size_t length = stop ? (size_t)(stop - line) : (size_t)(end - line);
        bool mark = length > 2 && line[0] == '@' && line[length - 1] == '@';
        const struct page_asset *asset = mark ? find_asset(line + 1, length - 2) : NULL;
        if (asset)
            text_add_bytes(text, (const char *)asset->data, asset->size);
        else if (mark && strncmp(line, "@TITLE@", length) == 0)
            svg_escape(text, title);
        else if (mark && strncmp(line, "@DATA@", length) == 0)
            add_json(text, json);
        else
            text_add_bytes(text, line, length);
        text_add(text, "\n");
        line += length + 1;
    }
}

bool fbd_has_html(void)
{
    return find_asset("page.html", strlen("page.html")) != NULL;
}

static char *make_page(fbd_result *result, fbd_errors *errors)
{
    const struct fbd_model *model = result->simulation->ensemble->model;
    const struct page_asset *template = find_asset("page.html", strlen("page.html"));
    diag_in_file(errors, model->scene->file);
    if (!template) {
        diag_add(errors, FBD_ERROR, "no-page", (struct pos){0, 0},
                 "install dygraphs (Debian: libjs-dygraphs) and build again with -Dhtml=enabled",
                 "this fbd was built without the HTML page");
        return NULL;
    }
    if (!result->record) {
        diag_add(errors, FBD_ERROR, "not-recorded", (struct pos){0, 0}, "set `keep` in fbd_recording",
                 "the run was not recorded");
        return NULL;
    }
    struct text json = {0}, page = {0};
    bool done = page_data_write(&json, result, result->record);
    const char *title = model->scene->title[0] ? model->scene->title : "fbd";
    if (done) fill_template(&page, template, title, &json);
    text_free(&json);
    if (done && !page.failed) return page.data;
    text_free(&page);
    diag_out_of_memory(errors);
    return NULL;
}

char *fbd_result_html(fbd_result *result, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    char *page = result ? make_page(result, errors) : call_refuse(errors, "there is no result");
    diag_end(&call);
    return page;
}

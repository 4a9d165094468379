/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/page.h"

#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "draw/svg.h"
#include "fbd_export.h"
#include "fbd_view.h"

static const struct page_asset *find_asset(const char *name, size_t length)
{
    for (size_t i = 0; i < page_asset_count; i++)
        if (strlen(page_assets[i].name) == length && memcmp(page_assets[i].name, name, length) == 0)
            return &page_assets[i];
    return NULL;
}

const struct page_asset *page_asset_find(const char *name)
{
    return find_asset(name, strlen(name));
}

/* Escapes `<`, which could end the script element or begin a comment; in JSON it only occurs within strings. */
void page_add_json(struct text *text, const struct text *json)
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

static const struct page_part *find_part(const struct page_part *parts, const char *mark, size_t length)
{
    for (; parts->mark; parts++)
        if (strlen(parts->mark) == length && memcmp(parts->mark, mark, length) == 0) return parts;
    return NULL;
}

/* Copy one line of the template or its replacement; returns false when the line is dropped. */
static bool fill_line(struct text *text, const char *line, size_t length, const struct page_part *parts)
{
    bool mark = length > 2 && line[0] == '@' && line[length - 1] == '@';
    const struct page_asset *asset = mark ? find_asset(line + 1, length - 2) : NULL;
    const struct page_part *part = mark ? find_part(parts, line + 1, length - 2) : NULL;
    if (asset)
        text_add_bytes(text, (const char *)asset->data, asset->size);
    else if (part)
        part->write(text, part->context);
    else if (!mark || length < 6 || strncmp(line, "@LIVE", 5) != 0)
        text_add_bytes(text, line, length);
    else
        return false;
    return true;
}

void page_fill(struct text *text, const struct page_asset *template, const struct page_part *parts)
{
    const char *line = (const char *)template->data, *end = line + template->size;
    while (line < end) {
        const char *stop = memchr(line, '\n', (size_t)(end - line));
        size_t length = stop ? (size_t)(stop - line) : (size_t)(end - line);
        if (fill_line(text, line, length, parts)) text_add(text, "\n");
        line += length + 1;
    }
}

bool fbd_has_html(void)
{
    return page_asset_find("page.html") != NULL;
}

static void write_title(struct text *text, const void *context)
{
    svg_escape(text, context);
}

static void write_data(struct text *text, const void *context)
{
    page_add_json(text, context);
}

/* Fill with the caller's parts and those of every page. */
static void fill_page(struct text *page, const struct page_asset *template, const char *title,
                      const struct text *json, const struct page_part *parts)
{
    enum { most_slots = 16 };
    struct page_part all[most_slots] = {{"TITLE", write_title, title}, {"DATA", write_data, json}};
    for (size_t i = 2; parts->mark && i + 1 < most_slots; i++) all[i] = *parts++;
    page_fill(page, template, all);
}

static char *make(fbd_result *result, const char *data, const struct page_asset *template,
                  const struct page_part *parts, fbd_errors *errors)
{
    const char *title = fbd_model_title(fbd_state_model(fbd_result_state(result)));
    struct text json = {0}, page = {0};
    text_add(&json, data);
    fill_page(&page, template, title[0] ? title : "fbd", &json, parts);
    page.failed |= json.failed;
    text_free(&json);
    if (!page.failed) return page.data;
    text_free(&page);
    diag_out_of_memory(errors);
    return NULL;
}

char *page_make(fbd_result *result, size_t most_bytes, const struct page_part *parts, fbd_errors *errors)
{
    const struct page_asset *template = page_asset_find("page.html");
    diag_in_file(errors, fbd_model_file(fbd_state_model(fbd_result_state(result))));
    if (!template) {
        diag_add(errors, FBD_ERROR, "no-page", (struct pos){0, 0},
                 "install dygraphs (Debian: libjs-dygraphs) and build again with -Dhtml=enabled",
                 "this fbd was built without the HTML page");
        return NULL;
    }
    char *data = fbd_result_page_data(result, most_bytes, errors);
    char *page = data ? make(result, data, template, parts, errors) : NULL;
    fbd_free(data);
    return page;
}

/* Permits only resources contained in the page. */
void page_write_policy(struct text *text, const void *context)
{
    (void)context;
    text_add(text, "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
                   "'unsafe-inline'; "
                   "script-src 'unsafe-inline'; img-src data:\">");
}

char *fbd_result_html(fbd_result *result, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    const struct page_part parts[] = {{"POLICY", page_write_policy, NULL}, {0}};
    char *page = result ? page_make(result, 0, parts, errors) : api_refuse(errors, "there is no result");
    diag_end(&call);
    return page;
}

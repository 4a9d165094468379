/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The page of a run with the library included: lib/live/page on top of lib/draw/page.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "base/file.h"
#include "base/json.h"
#include "draw/page.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "live/live.h"

/* Maximum sizes. The page without its numbers takes some 900 KB, and base 64 makes four bytes of three. */
enum { most_page_bytes = 2000000, most_script_bytes = 260000 };

struct live_page {
    struct text parts; /* the model, and the texts of the worker */
    const struct page_asset *wasm;
};

static const char wasm_name[] = "fbd-live.wasm.base64";

bool fbd_has_live(void)
{
    return page_asset_find(wasm_name) != NULL;
}

/* ---- the parts */

/* Permits compiling WebAssembly, and a worker from the page's own text, but no requests. */
void live_write_policy(struct text *text, const void *context)
{
    (void)context;
    text_add(text, "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
                   "'unsafe-inline'; "
                   "script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; img-src data:\">");
}

static void write_asset(struct text *text, const void *context)
{
    const struct page_asset *asset = page_asset_find(context);
    if (asset) text_add_bytes(text, (const char *)asset->data, asset->size);
}

static void write_scripts(struct text *text, const void *context)
{
    static const char *const names[] = {"engine.js", "knobs.js", "editor.js", "share.js",
                                        "values.js", "check.js", "again.js",  "grips.js",
                                        "pull.js",   "hints.js", "bench.js"};
    (void)context;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) write_asset(text, names[i]);
}

void live_write_parts(struct text *text, const void *context)
{
    const struct page_asset *wasm = page_asset_find(wasm_name);
    text_add(text, "<script type=\"application/json\" id=\"live-parts\">\n");
    page_add_json(text, context);
    text_add(text, "\n</script>\n<script type=\"text/plain\" id=\"live-wasm\">\n");
    if (wasm) text_add_bytes(text, (const char *)wasm->data, wasm->size);
    text_add(text, "\n</script>\n");
    write_asset(text, "wasm.license");
}

/* ---- the model */

/* Append an asset as a string under its name. */
static void add_asset(struct text *text, const char *name)
{
    struct text copy = {0};
    json_key(text, name);
    write_asset(&copy, name);
    text_add_bytes(&copy, "", 1);
    text_json_string(text, copy.data ? copy.data : "");
    text->failed |= copy.failed;
    text_free(&copy);
}

/* Append the data file of a table under its name in the model. */
static bool add_file(struct text *text, const char *model_file, const char *path, size_t index,
                     fbd_errors *errors)
{
    const char *slash = strrchr(model_file, '/');
    size_t folder = slash ? (size_t)(slash - model_file) + 1 : 0, length;
    const char *name = strncmp(path, model_file, folder) == 0 ? path + folder : path;
    char *data = file_text(path, &length, errors);
    json_comma(text, index);
    text_add(text, "[");
    text_json_string(text, name);
    text_add(text, ",");
    text_json_string(text, data ? data : "");
    text_add(text, "]");
    free(data);
    return data != NULL;
}

/* "" without one. */
static const char *file_of(const fbd_model *model)
{
    const char *file = fbd_model_file(model);
    return file ? file : "";
}

bool live_add_engine(struct text *text, const fbd_model *model, fbd_errors *errors)
{
    bool done = true;
    text_add(text, "\"files\":[");
    for (size_t i = 0; i < fbd_model_data_file_count(model); i++)
        done = add_file(text, file_of(model), fbd_model_data_file(model, i).path, i, errors) && done;
    text_add(text, "],\n");
    add_asset(text, "wasi.js");
    text_add(text, ",\n");
    add_asset(text, "worker.js");
    text_add(text, "}");
    return done;
}

/* Append the settings of the command line, by the keys of the sliders. */
static void add_moved(struct text *text, const fbd_live_options *options)
{
    const fbd_options *run = options->run;
    text_add(text, "\"moved\":{");
    for (size_t i = 0; i < options->setting_count; i++) {
        struct text key = {0};
        text_printf(&key, "parameters.%s", options->settings[i].name);
        json_text_member(text, key.data ? key.data : "", options->settings[i].value);
        text->failed |= key.failed;
        text_free(&key);
    }
    if (run->method) json_text_member(text, "method", run->method);
    if (run->tolerance > 0) text_printf(text, "\"tolerance\":\"%g\",", run->tolerance);
    if (isfinite(run->until)) text_printf(text, "\"until\":\"%.17g s\",", run->until);
    text_add(text, "\"\":\"\"},\n");
}

static bool make_parts(struct live_page *page, const fbd_model *model, const fbd_live_options *options,
                       fbd_errors *errors)
{
    struct text *text = &page->parts, source = {0};
    const char *file = file_of(model), *slash = strrchr(file, '/');
    const char *name = slash ? slash + 1 : file;
    size_t length;
    const char *written = fbd_model_source(model, &length);
    text_add_bytes(&source, written, length);
    text_add_bytes(&source, "", 1);
    text_add(text, "{");
    json_text_member(text, "name", *name && *name != '<' ? name : "model.yaml");
    json_text_member(text, "text", source.data ? source.data : "");
    add_moved(text, options);
    add_asset(text, "live-texts.json");
    text_add(text, ",\n");
    bool done = live_add_engine(text, model, errors);
    if (text->failed || source.failed) diag_out_of_memory(errors);
    done = done && !text->failed && !source.failed;
    text_free(&source);
    return done;
}

/* The bytes that remain for the numbers of the initial run. */
static size_t room_for_numbers(const struct live_page *page)
{
    size_t taken = page->wasm->size + page->parts.length + most_script_bytes;
    const size_t least = 100000;
    return taken + least < most_page_bytes ? (most_page_bytes - taken) / 4 * 3 : least;
}

/* A page has no callbacks: inputs by them have no value. */
static bool has_values(const fbd_model *model, fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_model_parameter_count(model); i++) {
        if (!isnan(fbd_model_parameter(model, i).value)) continue;
        diag_add(errors, FBD_ERROR, "no-live", (struct pos){0, 0}, "write its law into the file",
                 "the input `%s` is computed by a callback, which a live page cannot call",
                 fbd_model_parameter(model, i).name);
        return false;
    }
    return true;
}

static char *make_page(fbd_result *result, const fbd_live_options *options, fbd_errors *errors)
{
    const fbd_model *model = fbd_state_model(fbd_result_state(result));
    struct live_page page = {.wasm = page_asset_find(wasm_name)};
    diag_in_file(errors, fbd_model_file(model));
    if (!has_values(model, errors)) return NULL;
    if (!page.wasm) {
        diag_add(errors, FBD_ERROR, "no-live", (struct pos){0, 0},
                 "`make live` compiles the library for browsers ; then build again",
                 "this fbd was built without live pages");
        return NULL;
    }
    const struct page_part parts[] = {
        {"POLICY", live_write_policy, NULL},           {"LIVE-STYLE", write_asset, "live.css"},
        {"LIVE-PANEL", write_asset, "live.html"},      {"LIVE-EDITOR", write_asset, "live-editor.html"},
        {"LIVE-TEXTS", write_asset, "phrases.js"},     {"LIVE-SCRIPT", write_scripts, NULL},
        {"LIVE-PARTS", live_write_parts, &page.parts}, {0}};
    char *text = NULL;
    if (make_parts(&page, model, options, errors))
        text = page_make(result, room_for_numbers(&page), parts, errors);
    text_free(&page.parts);
    return text;
}

char *fbd_result_live_html(fbd_result *result, const fbd_live_options *options, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_live_options own = {0};
    fbd_options run = FBD_OPTIONS_DEFAULT;
    bool sized = api_take_options(&own, sizeof own, options, errors) &&
                 api_take_options(&run, sizeof run, own.run, errors);
    bool meant = sized && result && api_has_settings(own.settings, own.setting_count);
    if (sized && !meant) api_refuse(errors, "there is no result, or a setting has no value");
    own.run = &run;
    char *page = meant ? make_page(result, &own, errors) : NULL;
    diag_end(&call);
    return page;
}

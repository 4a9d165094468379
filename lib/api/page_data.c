/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data of the page about a run, as one JSON object:
 *
 * - title, units, angles, reason, stats: as in the JSON of the run; start and end [s] - rows, thinned,
 * bucket, buckets, doubleColumns, floatColumns: of the data - columns: {n: name, u: unit} and one of {c:
 * constant}, {of, a, b: a + b column[of]}, {d | f: number of data} - doubles, floats, envelope: base 64, see
 * pack.h; `doubles` begins with the times - bodies: {name, motion, parent, frame: 3 columns, shapes, G, axis
 * | line, stops, coil, arrows, equations, kinematics} (page_bodies.c, page_equations.c) - links: springs, dampers and actuators with another end; couplings (both:
 * page_links.c) - energy: 4 columns - states: user states - events: {kinds, labels, times, of: index into
 * labels, details}
 *
 * Names and titles are data, never markup: the script inserts them as text.
 */
#include <string.h>

#include "api/pack.h"
#include "api/page_data.h"
#include "api/page_equations.h"
#include "base/json.h"
#include "fbd_view.h"
#include "output/words.h"

enum { most_bytes = 3600 * 1024, most_listed_events = 60000, bytes_of_event = 26, most_details = 2000 };

/* ---- columns */

static void write_columns(struct text *text, const struct pack *pack)
{
    const struct record *record = pack->record;
    text_add(text, "\"columns\":[");
    for (size_t c = 0; c < record->column_count; c++) {
        const struct packed_column *packed = &pack->columns[c];
        json_comma(text, c);
        text_add(text, "\n{");
        json_text_member(text, "n", record->columns[c].name);
        json_text_member(text, "u", record->columns[c].unit);
        switch (packed->kind) {
        case packed_constant:
            json_key(text, "c");
            json_number(text, packed->offset);
            break;
        case packed_affine:
            json_number_member(text, "a", packed->offset);
            json_number_member(text, "b", packed->factor);
            text_printf(text, "\"of\":%d", packed->of);
            break;
        case packed_double: text_printf(text, "\"d\":%zu", packed->slot); break;
        case packed_float: text_printf(text, "\"f\":%zu", packed->slot); break;
        }
        text_add(text, "}");
    }
    text_add(text, "],\n");
}

static void write_numbers(struct text *text, const struct pack *pack)
{
    const struct record *record = pack->record;
    text_printf(text,
                "\"rows\":%zu,\"thinned\":%s,\"buckets\":%zu,\"doubleColumns\":%zu,\"floatColumns\":%zu,",
                record->count, record_is_thinned(record) ? "true" : "false", record->bucket_count,
                pack->doubles, pack->floats);
    json_number_member(text, "bucket", record->bucket);
    text_add(text, "\n\"doubles\":\"");
    pack_write_doubles(pack, text);
    text_add(text, "\",\n\"floats\":\"");
    pack_write_floats(pack, text);
    text_add(text, "\",\n\"envelope\":\"");
    pack_write_envelope(pack, text);
    text_add(text, "\",\n");
}

/* ---- events */

/* The page lists so many events at most, and gives the total number; the JSON of the run has all. */
static size_t listed_events(const struct ensemble *run)
{
    size_t count = run->event_count;
    if (count > most_listed_events) count = most_listed_events;
    return count;
}

static void write_labels(struct text *text, const struct ensemble *run, size_t count)
{
    enum { most_labels = 4096 };
    const struct run_event *labels[most_labels];
    size_t label_count = 0;
    struct text of = {0};
    text_add(text, "\"labels\":[");
    for (size_t i = 0; i < count; i++) {
        const struct run_event *event = &run->events[i];
        size_t k = 0;
        while (k < label_count && !events_are_alike(labels[k], event)) k++;
        if (k == label_count && label_count < most_labels) {
            json_comma(text, label_count);
            labels[label_count++] = event;
            text_add(text, "{");
            json_text_member(text, "body", event_body(run->model, event));
            json_text_member(text, "kind", fbd_event_kind_name(event->kind));
            json_key(text, "name");
            text_json_string(text, event_name(run->model, event));
            text_add(text, "}");
        }
        json_comma(&of, i);
        if (k < label_count)
            text_printf(&of, "%zu", k);
        else
            text_add(&of, "null");
    }
    text_add(text, "],\"of\":[");
    if (of.data) text_add(text, of.data);
    text_add(text, "],");
    text->failed |= of.failed;
    text_free(&of);
}

static void write_events(struct text *text, const struct ensemble *run)
{
    size_t count = listed_events(run);
    text_printf(text, "\"events\":{\"count\":%zu,", run->event_count);
    write_labels(text, run, count);
    text_add(text, "\"times\":[");
    for (size_t i = 0; i < count; i++) {
        json_comma(text, i);
        json_number(text, run->events[i].t);
    }
    text_add(text, "],\"details\":[");
    for (size_t i = 0; i < count && i < most_details; i++) {
        char detail[event_detail_size];
        event_detail(run->model, &run->events[i], detail, sizeof detail);
        json_comma(text, i);
        text_json_string(text, detail);
    }
    text_add(text, "]},\n");
}

/* ---- the whole */

static void write_head(struct text *text, fbd_result *result)
{
    const struct ensemble *run = result->simulation->ensemble;
    const struct fbd_model *model = run->model;
    fbd_stats stats = fbd_simulation_stats(result->simulation);
    struct text title = {0};
    text_shown(&title, model->scene->title);
    json_text_member(text, "title", title.data ? title.data : "");
    text->failed |= title.failed;
    text_free(&title);
    json_text_member(text, "reason", run->reason);
    if (result->degrees) json_text_member(text, "angles", "deg");
    json_number_member(text, "start", result->start->t);
    json_number_member(text, "end", run->t);
    text_printf(text, "\"units\":{\"length\":\"%s\",\"force\":\"%s\",\"moment\":\"%s\",\"energy\":\"%s\"},\n",
                length_unit(model), force_unit(model), moment_unit(model), energy_unit(model));
    text_add(text, "\"stats\":{");
    json_text_member(text, "method", stats.method);
    json_number_member(text, "tolerance", stats.tolerance);
    json_number_member(text, "seconds", stats.seconds);
    text_printf(text, "\"steps\":%lu,\"rejected\":%lu,\"rhs\":%lu,\"jacobians\":%lu,\"stiffSteps\":%lu},\n",
                stats.steps, stats.rejected, stats.rhs, stats.jacobians, stats.stiff_steps);
}

bool page_data_write(struct text *text, fbd_result *result, struct record *record, size_t most)
{
    struct pack pack;
    struct symbolic symbolic = {0};
    size_t bytes = most ? most : most_bytes,
           events = bytes_of_event * listed_events(result->simulation->ensemble);
    bytes -= events < bytes / 2 ? events : bytes / 2;
    if (!pack_begin(&pack, record, bytes)) return false;
    text_add(text, "{");
    write_head(text, result);
    write_columns(text, &pack);
    write_numbers(text, &pack);
    text_add(text, "\"bodies\":[");
    if (!symbolic_begin(&symbolic, result->start)) text->failed = true;
    for (size_t b = 0; b < record->model->body_count && !text->failed; b++) {
        json_comma(text, b);
        page_body_write(text, &symbolic, record, b);
    }
    symbolic_end(&symbolic);
    text_add(text, "],\n");
    page_links_write(text, record);
    page_couplings_write(text, result, record);
    write_events(text, result->simulation->ensemble);
    json_columns_member(text, "energy", record->energy, 4);
    json_columns_member(text, "states", record->energy + 4, record->model->plan.own);
    text_add(text, "\"version\":1}");
    pack_end(&pack);
    return !text->failed;
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The influence and cost of each effect, as text, CSV and JSON.
 */
#include <math.h>
#include <stdio.h>

#include "fbd_study.h"
#include "study/cost.h"
#include "study/effects.h"

enum { all_digits = 17 };

/* Relative change below which an effect is reported as dispensable. */
static const double small = 1e-3;

static void change(struct text *text, const struct fbd_effects *effects, double value)
{
    if (isnan(value))
        text_add(text, "-");
    else if (value <= effects->floor)
        text_printf(text, "<= %.0e", effects->floor);
    else
        text_printf(text, "%.1e", value);
}

/* "block.friction", or the name of an effect of the whole scene. */
static void name(struct text *text, const fbd_effect *effect)
{
    text_printf(text, "%s%s%s", effect->body, effect->body[0] ? "." : "", effect->name);
}

static void row(struct text *text, const struct fbd_effects *effects, const fbd_effect *effect)
{
    text_add(text, "  ");
    name(text, effect);
    text_pad(text, 25);
    text_printf(text, " %s", effect->change);
    text_pad(text, 59);
    if (effect->reason[0]) {
        text_printf(text, " not possible: %s\n", effect->reason);
        return;
    }
    text_add(text, " ");
    change(text, effects, effect->change_end);
    text_pad(text, 70);
    change(text, effects, effect->change_max);
    text_pad(text, 81);
    if (isnan(effect->time))
        text_add(text, "-");
    else
        text_printf(text, "%+4.0f %%", 100 * (1 - effect->time));
    if (effect->events) {
        text_pad(text, 90);
        text_printf(text, "%+ld", effect->events);
    }
    text_add(text, "\n");
}

static void verdict(struct text *text, const struct fbd_effects *effects)
{
    size_t shown = 0;
    for (size_t i = 0; i < effects->count; i++) {
        const fbd_effect *effect = &effects->effects[i];
        if (!(effect->change_max < small)) continue;
        text_add(text, shown++ ? ", " : "\nThese change nothing by more than 1e-3: ");
        name(text, effect);
        text_printf(text, " (%s)", effect->change);
    }
    text_add(text, shown ? ".\n"
                         : "\nEach of these changes something by more than 1e-3: the scene calls for all.\n");
}

char *fbd_effects_text(const fbd_effects *effects)
{
    if (!effects) return NULL;
    struct text text = {0};
    text_heading(&text, fbd_model_title(effects->model));
    text_printf(&text, "Change and cost by each effect, over %.6g s; the unchanged scene takes ",
                effects->until);
    text_seconds(&text, effects->seconds);
    text_add(
        &text,
        "\n\n  effect                   without it                        changes the answer by   costs\n"
        "                                                            at end    largest    of time  "
        "events\n");
    for (size_t i = 0; i < effects->count; i++) row(&text, effects, &effects->effects[i]);
    text_add(&text, "Changes are divided by the size of each quantity; costs are those of having it.\n");
    verdict(&text, effects);
    if (text.failed) text_free(&text);
    return text.data;
}

/* ---- data */

/* Append a number, or nothing if it is NAN. */
static void number(struct text *text, double value)
{
    if (isfinite(value)) text_number(text, value, all_digits);
}

static void quoted(struct text *text, const char *value)
{
    text_add(text, "\"");
    for (const char *c = value; *c; c++) text_printf(text, *c == '"' ? "\"\"" : "%c", *c);
    text_add(text, "\"");
}

char *fbd_effects_csv(const fbd_effects *effects)
{
    if (!effects) return NULL;
    struct text text = {0};
    text_add(&text, "body,effect,without it,change at end,change,noise,quantity,time ratio,events,reason\n");
    for (size_t i = 0; i < effects->count; i++) {
        const fbd_effect *effect = &effects->effects[i];
        text_printf(&text, "%s,%s,", effect->body, effect->name);
        quoted(&text, effect->change);
        text_add(&text, ",");
        number(&text, effect->change_end);
        text_add(&text, ",");
        number(&text, effect->change_max);
        text_printf(&text, ",%d,%s,", effect->noise, effect->worst);
        number(&text, effect->time);
        text_printf(&text, ",%ld,", effect->events);
        quoted(&text, effect->reason);
        text_add(&text, "\n");
    }
    if (text.failed) text_free(&text);
    return text.data;
}

static void member(struct text *text, const char *name, const char *value)
{
    text_json_key(text, name);
    text_json_string(text, value);
    text_add(text, ", ");
}

static void member_number(struct text *text, const char *name, double value)
{
    text_json_key(text, name);
    text_json_number(text, value);
    text_add(text, ", ");
}

char *fbd_effects_json(const fbd_effects *effects)
{
    if (!effects) return NULL;
    struct text text = {0};
    text_add(&text, "{\n  ");
    member(&text, "title", fbd_model_title(effects->model));
    member_number(&text, "until", effects->until);
    member_number(&text, "seconds", effects->seconds);
    member_number(&text, "floor", effects->floor);
    text_add(&text, "\n  \"effects\": [");
    for (size_t i = 0; i < effects->count; i++) {
        const fbd_effect *effect = &effects->effects[i];
        text_add(&text, i ? ",\n    {" : "\n    {");
        member(&text, "body", effect->body);
        member(&text, "name", effect->name);
        member(&text, "change", effect->change);
        member(&text, "reason", effect->reason);
        member_number(&text, "change_end", effect->change_end);
        member_number(&text, "change_max", effect->change_max);
        member(&text, "worst", effect->worst);
        member_number(&text, "time", effect->time);
        text_printf(&text, "\"noise\": %s, \"events\": %ld}", effect->noise ? "true" : "false",
                    effect->events);
    }
    text_add(&text, "\n  ]\n}\n");
    if (text.failed) text_free(&text);
    return text.data;
}

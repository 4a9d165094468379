/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/words.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/format.h"

const char *fbd_event_kind_name(fbd_event_kind kind)
{
    switch (kind) {
    case FBD_EVENT_BREAKAWAY: return "breakaway";
    case FBD_EVENT_STICK: return "stick";
    case FBD_EVENT_REVERSAL: return "reversal";
    case FBD_EVENT_CONTACT_LOST: return "contact_lost";
    case FBD_EVENT_USER: return "user";
    case FBD_EVENT_ROPE_SLACK: return "rope_slack";
    case FBD_EVENT_ROPE_TAUT: return "rope_taut";
    case FBD_EVENT_LIFT_OFF: return "lift_off";
    case FBD_EVENT_LANDING: return "landing";
    case FBD_EVENT_SWITCH: return "switch";
    case FBD_EVENT_IMPACT: return "impact";
    case FBD_EVENT_CONTACT: return "contact";
    case FBD_EVENT_REST: return "rest";
    case FBD_EVENT_JAM: return "jam";
    case FBD_EVENT_SEVERAL: return "several";
    case FBD_EVENT_SLIDING: return "sliding";
    case FBD_EVENT_SLIDING_ENDS: return "sliding_ends";
    case FBD_EVENT_TRACK_END: return "track_end";
    case FBD_EVENT_COUPLING_ENDS: return "coupling_ends";
    case FBD_EVENT_COUPLING_BEGINS: return "coupling_begins";
    case FBD_EVENT_FORCE_ENDS: return "force_ends";
    case FBD_EVENT_FORCE_BEGINS: return "force_begins";
    }
    return "";
}

const char *event_body(const struct fbd_model *model, const struct run_event *event)
{
    return event->body >= 0 ? model->bodies[event->body].name : "";
}

const char *event_name(const struct fbd_model *model, const struct run_event *event)
{
    if (event->watch >= 0) return model->plan.watches[event->watch].source->name;
    if (event->own >= 0) return model->scene->own[event->own].name;
    return event->load >= 0 ? model->loads[event->load].source->name : "";
}

/* A located loss is below zero by rounding; a jump of the forces may lead directly to a tensile force. The
 * load of a `roll` is identified by its friction; the lost force is its normal force. */
static void contact_lost_detail(const struct run_event *event, const char *name, const char *unit,
                                char *detail, size_t size)
{
    const char *dot = strchr(name, '.'), *of = dot ? ".normal" : "";
    int length = (int)(dot ? dot - name : (ptrdiff_t)strlen(name));
    if (event->force < -1e5 * event->limit)
        format_into(detail, size, "%.*s%s would have to pull with %.6g %s", length, name, of, -event->force,
                    unit);
    else
        snprintf(detail, size, "%.*s%s reaches zero", length, name, of);
}

static void impact_detail(const struct fbd_model *model, const struct run_event *event, const char *name,
                          char *detail, size_t size)
{
    const struct impact_record *impact = &event->impact;
    const char *speed = model->scene->units == unit_si ? "m/s" : "ft/s", *of = force_unit(model);
    double taken = impact->makes ? impact->work : impact->work == 0 ? 0 : -impact->work;
    format_into(detail, size,
                "%s strikes: v_n %.6g to %.6g %s, v_t %.6g to %.6g %s, impulses %.6g and %.6g %s*s; %s %.6g "
                "%s%s%s",
                name, impact->v_n[0], impact->v_n[1], speed, impact->v_t[0], impact->v_t[1], speed, impact->p,
                impact->tau, of, impact->makes ? "makes" : "takes", taken, energy_unit(model),
                impact->makes ? ", as its law may: `stronge` does not" : "",
                impact->in_turn ? "; one point after the other, as no impulses of all together were found"
                                : "");
}

/* Write the separation speed of its ends, minus that of a drum, before and after the impact. */
static void rope_taut_detail(const struct fbd_model *model, const struct run_event *event, const char *name,
                             char *detail, size_t size)
{
    const struct impact_record *impact = &event->impact;
    const char *speed = model->scene->units == unit_si ? "m/s" : "ft/s";
    if (impact->p == 0)
        format_into(detail, size, "%s becomes taut; the impact takes %.6g %s", name, event->force,
                    energy_unit(model));
    else
        format_into(
            detail, size,
            "%s becomes taut: it lengthens by %.6g %s before and %.6g %s after; impulse %.6g %s*s; the "
            "impact takes "
            "%.6g %s",
            name, -impact->v_n[0], speed, impact->v_n[1] == 0 ? 0 : -impact->v_n[1], speed, impact->p,
            force_unit(model), event->force, energy_unit(model));
}

static void jam_detail(const struct fbd_model *model, const struct run_event *event, const char *name,
                       char *detail, size_t size)
{
    const struct impact_record *jam = &event->impact;
    const char *speed = model->scene->units == unit_si ? "m/s" : "ft/s", *of = force_unit(model);
    format_into(
        detail, size,
        "%s jams: no finite forces go with its slip, as in Painleve's paradox; impulses %.6g and %.6g "
        "%s*s, v_n %.6g to %.6g %s, v_t %.6g to %.6g %s; takes %.6g %s",
        name, jam->p, jam->tau, of, jam->v_n[0], jam->v_n[1], speed, jam->v_t[0], jam->v_t[1], speed,
        jam->work == 0 ? 0 : -jam->work, energy_unit(model));
}

static bool is_moment(const struct fbd_model *model, const struct run_event *event)
{
    return model->loads[event->load].source->kind == moment_applied;
}

static void stick_detail(const struct run_event *event, const char *name, const char *unit, char *detail,
                         size_t size)
{
    if (fabs(event->force) > event->limit * (1 + 1e-6)) /* decided before another mode */
        format_into(detail, size,
                    "%s is at rest; %+.6g %s would be needed to hold it, with a limit of %.6g %s", name,
                    event->force, unit, fmax(event->limit, 0), unit);
    else
        format_into(detail, size, "%s holds with %+.6g %s, %.3g %% of its static limit %.6g %s", name,
                    event->force, unit, event->limit > 0 ? 100 * fabs(event->force) / event->limit : 0,
                    event->limit, unit);
}

static void sliding_detail(const struct fbd_model *model, const struct run_event *event, const char *name,
                           char *detail, size_t size)
{
    if (event->limit > 0) /* its value is one force or moment */
        format_into(detail, size, "%s slides on its switch, with %+.6g %s", name, event->force,
                    is_moment(model, event) ? moment_unit(model) : force_unit(model));
    else
        format_into(detail, size, "%s slides on its switch", name);
}

/* With the energy that the bodies have in it, if it has a potential. */
static void force_detail(const struct fbd_model *model, const struct run_event *event, const char *name,
                         char *detail, size_t size)
{
    const bool begins = event->kind == FBD_EVENT_FORCE_BEGINS;
    const char *when = model->plan.watches[event->watch].source->text;
    if (model->loads[event->load].potential_kind == potential_none)
        format_into(detail, size, "%s %s: %s", name, begins ? "begins" : "ends", when);
    else
        format_into(detail, size, "%s %s: %s; it %s %.6g %s", name, begins ? "begins" : "ends", when,
                    begins ? "brings" : "takes", event->force, energy_unit(model));
}

static void several_detail(const struct run_event *event, const char *name, const char *unit, char *detail,
                           size_t size)
{
    if (event->impact.several)
        format_into(detail, size,
                    "%s: several velocities agree with the laws of the impact, whose impulses are not "
                    "determined by "
                    "rigid bodies, and one of them is taken",
                    name);
    else if (event->force > 1) /* friction that increases its own normal force */
        format_into(detail, size,
                    "%s: several motions agree with the forces, as in Painleve's paradox, and one of them is "
                    "taken; each %s of its normal force causes %.4g %s more of it",
                    name, unit, event->force, unit);
    else
        format_into(
            detail, size,
            "%s: several motions agree with the law of friction, and one of them is taken; which of the "
            "bodies slip and which stick is not determined",
            name);
}

/* Is it friction of a bearing, or rolling resistance? */
static bool load_is_moment(const struct fbd_model *model, int load)
{
    for (size_t i = 0; i < model->plan.mode_count; i++)
        if (model->plan.modes[i].load == load) return model->plan.modes[i].moment;
    return false;
}

void event_detail(const struct fbd_model *model, const struct run_event *event, char *detail, size_t size)
{
    const char *name = event_name(model, event);
    bool moment = event->load >= 0 && load_is_moment(model, event->load);
    const char *unit = moment ? moment_unit(model) : force_unit(model);
    switch (event->kind) {
    case FBD_EVENT_BREAKAWAY:
        format_into(detail, size, "%s slips with %+.6g %s; the static limit was %.6g %s", name, event->force,
                    unit, event->limit, unit);
        return;
    case FBD_EVENT_STICK: stick_detail(event, name, unit, detail, size); return;
    case FBD_EVENT_REVERSAL:
        format_into(detail, size, "%s cannot hold it: slips back with %+.6g %s; the static limit is %.6g %s",
                    name, event->force, unit, event->limit, unit);
        return;
    case FBD_EVENT_CONTACT_LOST: contact_lost_detail(event, name, unit, detail, size); return;
    case FBD_EVENT_USER: format_into(detail, size, "%s", name); return;
    case FBD_EVENT_ROPE_SLACK: format_into(detail, size, "%s goes slack", name); return;
    case FBD_EVENT_ROPE_TAUT: rope_taut_detail(model, event, name, detail, size); return;
    case FBD_EVENT_IMPACT: impact_detail(model, event, name, detail, size); return;
    case FBD_EVENT_CONTACT: format_into(detail, size, "%s closes", name); return;
    case FBD_EVENT_SEVERAL: several_detail(event, name, unit, detail, size); return;
    case FBD_EVENT_JAM: jam_detail(model, event, name, detail, size); return;
    case FBD_EVENT_REST:
        snprintf(detail, size, "%s is closed after %d impacts and infinitely many too small to see", name,
                 (int)event->limit);
        return;
    case FBD_EVENT_LIFT_OFF:
        if (event->load >= 0 && model->loads[event->load].source->kind == load_contact)
            format_into(detail, size, "%s opens", name);
        else
            snprintf(detail, size, "%.*s leaves its line", (int)strcspn(name, "."), name);
        return;
    case FBD_EVENT_LANDING:
        format_into(detail, size, "%.*s returns to its line; the impact takes %.6g %s",
                    (int)strcspn(name, "."), name, event->force, energy_unit(model));
        return;
    case FBD_EVENT_SWITCH:
        format_into(detail, size, "%s passes to another branch", name[0] ? name : "an event");
        return;
    case FBD_EVENT_SLIDING: sliding_detail(model, event, name, detail, size); return;
    case FBD_EVENT_SLIDING_ENDS: format_into(detail, size, "%s leaves its switch", name); return;
    case FBD_EVENT_TRACK_END: format_into(detail, size, "an end of its track"); return;
    case FBD_EVENT_COUPLING_ENDS:
        format_into(detail, size, "%s ends: %s", name, model->plan.watches[event->watch].source->text);
        return;
    case FBD_EVENT_COUPLING_BEGINS:
        format_into(detail, size, "%s begins: %s; the impact takes %.6g %s", name,
                    model->plan.watches[event->watch].source->text, event->force, energy_unit(model));
        return;
    case FBD_EVENT_FORCE_ENDS:
    case FBD_EVENT_FORCE_BEGINS: force_detail(model, event, name, detail, size); return;
    }
}

const char *length_unit(const struct fbd_model *model)
{
    return model->scene->units == unit_si ? "m" : "ft";
}

const char *force_unit(const struct fbd_model *model)
{
    return model->scene->units == unit_si ? "N" : "lbf";
}

const char *moment_unit(const struct fbd_model *model)
{
    return model->scene->units == unit_si ? "N*m" : "lbf*ft";
}

const char *energy_unit(const struct fbd_model *model)
{
    return unit_name_energy(model->scene->units);
}

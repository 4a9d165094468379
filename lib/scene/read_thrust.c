/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Thrust: the force of a mass flow, f = dm/dt u with u the velocity of the mass relative to the body, at the
 * point where it leaves or enters. Mass that leaves with the exhaust speed c gives f = -dm/dt c along
 * `angle`; mass with the velocity w in the world has u = w - v_P.
 */
#include "scene/load_entry.h"
#include "scene/values.h"

static bool check_form(struct entry *entry)
{
    const char *hint = "give the speed of the exhaust, or the velocity of the mass in the world";
    if (!entry_has(entry, "exhaust") && !entry_has(entry, "velocity")) {
        entry_note(entry, "missing-key", entry->chosen.at,
                   "write for example `thrust: {exhaust: 2 km/s, angle: 90 deg}`",
                   "`thrust` needs `exhaust` or `velocity`: the speed of the mass that leaves or comes");
        return false;
    }
    bool fine = entry_exclude(entry, "exhaust", "velocity", hint);
    if (!entry_exclude(entry, "velocity", "angle", "a velocity has a direction")) fine = false;
    return entry_exclude(entry, "velocity", "frame", "`velocity` is along the axes of the world") && fine;
}

static bool check_direction(struct entry *entry)
{
    if (entry_has(entry, "angle") || !entry->motion || entry_is_slide(entry)) return true;
    entry_note(entry, "missing-key", entry->chosen.at, "add the direction of the thrust, as `angle: 90 deg`",
               "`exhaust` needs `angle`, unless it acts on a slide");
    return false;
}

/* Read a velocity along the line of a slide of the ground, whose v is a velocity in the world. */
static bool read_along(struct entry *entry, const struct node *node, struct value *along)
{
    if (entry->motion && (!entry_is_slide(entry) || entry->motion->parent != ground_body)) {
        entry_note(entry, "wrong-type", node->at, "write for example `velocity: [2 m/s, 0]`",
                   "`velocity` must be a pair [vx, vy], except on a slide or track of the ground");
        return false;
    }
    return value_formula(entry->reader, node, "velocity", a_velocity, 0, &entry->scope, along);
}

bool thrust_finish(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    const struct node *velocity = entry->keys.velocity;
    struct value along = {0}, x = {0}, y = {0};
    if (!check_form(entry)) return false;
    if (!entry->reader->drafts[entry->body].mass_varies) {
        if (entry->reader->drafts[entry->body].mass_known)
            entry_note(entry, "not-here", entry->chosen.at,
                       "give the mass as an expression: `mass: 100[kg] - 5[kg/s]*t`, or by a state; a given "
                       "force is `applied`",
                       "`thrust` needs a body of varying mass: the mass of this one is constant");
        return false;
    }
    if (!velocity) {
        load->body_frame = entry->keys.frame == frame_body;
        return entry->keys.exhaust.expr && check_direction(entry) && derive_exhaust(entry);
    }
    bool pair = velocity->kind == node_list;
    bool read = pair ? entry_pair_read(entry, velocity, "velocity", a_velocity,
                                       "write for example `velocity: [2 m/s, 0]`", &x, &y)
                     : read_along(entry, velocity, &along);
    return read && derive_entering(entry, &along, &x, &y);
}

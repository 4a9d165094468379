/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Laws of forces and moments: the conditions and values that involve several keys, of springs, dampers,
 * friction, normal forces and potentials.
 */
#include "base/format.h"
#include "scene/load_entry.h"
#include "scene/slip_law.h"

/* ---- springs and dampers */

static bool finish_anchored_spring(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    bool fine = true;
    if (entry_has(entry, "neutral")) {
        entry_note(entry, "not-here", node_find(entry->chosen.node, "neutral")->at,
                   "the length without force is `free_length`",
                   "a spring between two points has no `neutral`");
        fine = false;
    }
    if (load->free_length < 0) {
        entry_note(entry, "out-of-range", node_find(entry->chosen.node, "free_length")->value->at, NULL,
                   "`free_length` must be zero or above");
        fine = false;
    }
    return fine;
}

/* True, with a note, if `to` names a body or a point of one: then the spring must be a coupling. */
static bool ends_on_body(struct entry *entry)
{
    const struct node *to = entry->keys.to;
    const struct scene *scene = entry->reader->scene;
    if (to->kind != node_scalar || node_find(entry->reader->points, to->text)) return false;
    size_t length = strcspn(to->text, ".");
    for (size_t b = 0; b < scene->body_count; b++) {
        const char *name = scene->bodies[b].name, *kind = entry->chosen.kind->name;
        if (strlen(name) != length || memcmp(name, to->text, length) != 0) continue;
        diag_add(
            entry->reader->errors, FBD_ERROR, "unknown-point", to->at,
            diag_hint(entry->reader->errors,
                      "write at the top level `couplings: [%s: {between: [%s, %s], %s}]`, and delete it here",
                      kind, scene->bodies[entry->body].name, to->text,
                      strcmp(kind, "spring") == 0 ? "stiffness: ..." : "coefficient: ..."),
            "`%s` is a body: a %s between two bodies is a coupling", name, kind);
        return true;
    }
    return false;
}

bool link_finish(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    if (entry->keys.to) {
        if (ends_on_body(entry)) return false;
        load->anchor = (struct point){.kind = point_fixed, .at = entry->keys.to->at};
        bool anchor = ground_point_read(entry->reader, entry->keys.to, "to", &load->anchor.where);
        return finish_anchored_spring(entry) && anchor;
    }
    if (!entry->motion || entry_has(entry, "to")) return true;
    if (entry_is_slide(entry)) {
        if (entry_has(entry, "neutral")) load->free_length = entry->keys.neutral;
        return entry_exclude(entry, "free_length", "neutral", "on a slide without `to` they mean the same");
    }
    diag_add(entry->reader->errors, FBD_ERROR, "missing-key", entry->chosen.at,
             "add its other end: `to: [x, y]`, or the name of a point of the ground", "%s needs `to`",
             entry->chosen.kind->group->name);
    return false;
}

/* ---- friction */

/* The node of a coefficient; a single value may replace the mapping. */
static const struct node *coefficient_node(const struct entry *entry, const char *key)
{
    const struct pair *pair = node_find(entry->chosen.node, key);
    return pair ? pair->value : entry->chosen.node;
}

/* A coefficient given by one key determines the other one. */
static bool share_coefficient(struct entry *entry, const char *key, const struct value *given,
                              enum slip_name slip, struct value *other)
{
    enum quantity quantity = entry->keys.load.kind == load_friction ? a_number : a_moment;
    return slip_law_share(entry->reader, coefficient_node(entry, key), key, quantity, slip, &entry->scope,
                          given, other);
}

static bool share_friction(struct entry *entry, bool single)
{
    struct load *load = &entry->keys.load;
    if (single) {
        load->mu_k = entry->keys.coefficient;
        return share_coefficient(entry, "coefficient", &load->mu_k, slip_resting, &load->mu_s);
    }
    if (!entry_has(entry, "static"))
        return share_coefficient(entry, "kinetic", &load->mu_k, slip_resting, &load->mu_s);
    if (!entry_has(entry, "kinetic"))
        return share_coefficient(entry, "static", &load->mu_s, slip_moving, &load->mu_k);
    return load->mu_s.expr && load->mu_k.expr;
}

/* The moment of a journal bearing is at most that of its reaction on the friction circle, of radius mu r. */
static bool journal_finish(struct entry *entry)
{
    static const char *const others[] = {"static", "kinetic", "coefficient", "surface_speed"};
    struct load *load = &entry->keys.load;
    char behind[40];
    bool fine = entry_has(entry, "radius");
    if (!fine)
        entry_note(entry, "missing-key", entry->chosen.at, "add for example `radius: 10 mm`",
                   "`bearing` needs the `radius` of the journal");
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        fine &= entry_exclude(entry, "bearing", others[i],
                              "`bearing` is its only coefficient, and the journal does not turn by itself");
    if (!fine || !entry->keys.bearing.expr) return false;
    format_into(behind, sizeof behind, "*%.17g[m]", entry->keys.radius);
    load->journal = true;
    if (!derive_value(entry, "bearing", &entry->keys.bearing, a_number, behind, a_length, &load->mu_k))
        return false;
    load->mu_s = load->mu_k;
    return true;
}

bool friction_finish(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    if (entry_has(entry, "bearing")) return journal_finish(entry);
    if (entry_has(entry, "radius")) {
        entry_note(entry, "missing-key", entry->chosen.at, "add for example `bearing: 0.1`",
                   "`radius` needs the coefficient `bearing` of the journal");
        return false;
    }
    const char *hint = "`coefficient` means both";
    bool single = entry_has(entry, "coefficient") || entry->keys.coefficient.expr;
    bool fine = entry_exclude(entry, "coefficient", "static", hint) &&
                entry_exclude(entry, "coefficient", "kinetic", hint);
    if (!single && !entry_has(entry, "static") && !entry_has(entry, "kinetic")) {
        entry_note(entry, "missing-key", entry->chosen.at, "add for example `static: 0.5, kinetic: 0.4`",
                   "`friction` needs `static`, `kinetic` or one `coefficient` for both");
        return false;
    }
    if (!share_friction(entry, single)) return false;
    bool constant = expr_is_constant(load->mu_s.expr) && expr_is_constant(load->mu_k.expr);
    if (constant && expr_value(load->mu_k.expr) > expr_value(load->mu_s.expr))
        diag_add(entry->reader->errors, FBD_WARNING, "kinetic-above-static", load->mu_k.at,
                 "are the two exchanged?", "kinetic friction is above static friction");
    return fine;
}

bool normal_finish(struct entry *entry)
{
    entry->keys.load.side = (enum normal_side)entry->keys.side;
    return true;
}

bool moment_spring_finish(struct entry *entry)
{
    entry->keys.load.free_length = entry->keys.neutral;
    return true;
}

/* V is differentiated by coordinates, so it may depend on them alone. */
bool potential_finish(struct entry *entry)
{
    const struct value *V = &entry->keys.load.potential;
    if (!V->expr || expr_is_constant(V->expr)) return true;
    const int *slots;
    size_t count = expr_variables(V->expr, &slots), n = entry->reader->scene->coordinate_count;
    if (count == 0 || (size_t)slots[count - 1] <= 2 * n) return true;
    entry_note(entry, "not-here", V->at, "write V in the coordinates of the body",
               "a potential cannot depend on a place in the world or on a state");
    return false;
}

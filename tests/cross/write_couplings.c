/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings as a model file has them. Places of the ground have names Q<coupling>_<end>.
 */
#include "writer.h"

static void say_end(struct writer *w, int c, int k)
{
    const struct end *end = &w->scene->coupling[c].end[k];
    if (end->body < 0)
        say(w, "ground.Q%d_%d", c, k);
    else if (end->at.point == at_G || end->at.point == at_origin)
        say(w, "%s", w->scene->body[end->body].name);
    else
        say(w, "%s.P%d", w->scene->body[end->body].name, end->at.point);
}

static void say_coefficients(struct writer *w, const struct coupling *coupling)
{
    if (!coupling->has_friction) return;
    key_formula(w, "static", -1, &coupling->mu_s);
    key_formula(w, "kinetic", -1, &coupling->mu_k);
}

static void say_roll(struct writer *w, int c)
{
    const struct coupling *coupling = &w->scene->coupling[c];
    say(w, ", body: %s", w->scene->body[coupling->end[0].body].name);
    if (coupling->line >= 0)
        say(w, ", on: L%d", coupling->line);
    else
        say(w, ", on: %s", w->scene->body[coupling->end[1].body].name);
    if (coupling->centered) say(w, ", center: ");
    if (coupling->centered) say_spot(w, coupling->end[0].body, &coupling->end[0].at);
    say_coefficients(w, coupling);
}

static void say_rope(struct writer *w, int c)
{
    static const char *const sides[] = {"left", "right", "top", "bottom"};
    const struct coupling *coupling = &w->scene->coupling[c];
    const char *between = ", wound: [";
    bool any = false;
    for (int k = 0; k < coupling->count; k++) {
        const struct end *end = &coupling->end[k];
        if (!end->wound) continue;
        say(w, "%s{on: ", between);
        say_end(w, c, k);
        say(w, ", side: %s", sides[end->side]);
        if (end->radius > 0) key_number(w, "radius", end->radius);
        say(w, "}");
        between = ", ";
        any = true;
    }
    if (any) say(w, "]");
    if (coupling->rubs) {
        say(w, ", around: {on: ");
        say_end(w, c, 1);
        key_number(w, "radius", coupling->radius[0]);
        key_formula(w, "static", -1, &coupling->mu_s);
        key_formula(w, "kinetic", -1, &coupling->mu_k);
        if (coupling->turns > 0) key_number(w, "turns", coupling->turns);
        say(w, "}");
    }
    if (coupling->reels) key_formula(w, "length", -1, &coupling->reel);
}

static void say_slot(struct writer *w, const struct coupling *coupling)
{
    say_path(w, &coupling->path);
    if (coupling->path.form == path_oval) say(w, ", closed: true");
    if (coupling->one_sided || coupling->radius[0] > 0)
        say(w, ", side: %s", coupling->side == left_side ? "left" : "right");
    if (coupling->radius[0] > 0) key_number(w, "radius", coupling->radius[0]);
    say_coefficients(w, coupling);
}

void say_coupling(struct writer *w, int c)
{
    static const char *const kinds[] = {"spring", "damper", "pin",  "rod",  "rope",
                                        "gear",   "rack",   "roll", "belt", "slot"};
    const struct coupling *coupling = &w->scene->coupling[c];
    say(w, "  - %s: {name: %s", kinds[coupling->kind], coupling->name);
    if (coupling->kind == roll) {
        say_roll(w, c);
    } else {
        say(w, ", %s: [", coupling->kind == rope ? "through" : "between");
        for (int k = 0; k < coupling->count; k++) {
            if (k > 0) say(w, ", ");
            say_end(w, c, k);
        }
        say(w, "]");
    }
    if (coupling->kind == spring_of_two) {
        key_number(w, "stiffness", coupling->stiffness);
        key_number(w, "free_length", coupling->free_length);
    }
    if (coupling->kind == damper_of_two) key_number(w, "coefficient", coupling->coefficient);
    if (coupling->length > 0) key_number(w, "length", coupling->length);
    if ((coupling->kind == rack || coupling->kind == roll) && coupling->radius[0] > 0)
        key_number(w, "radius", coupling->radius[0]);
    if ((coupling->kind == gear || coupling->kind == belt) && coupling->radius[0] > 0) {
        char one[32], two[32];
        say(w, ", radii: [%s, %s]", number_text(coupling->radius[0], one),
            number_text(coupling->radius[1], two));
    }
    if (coupling->kind == rope) say_rope(w, c);
    if (coupling->kind == slot) say_slot(w, coupling);
    if (coupling->inside) say(w, ", inside: true");
    if (coupling->crossed) say(w, ", crossed: true");
    if (coupling->tension > 0) key_number(w, "tension", coupling->tension);
    say(w, "}\n");
}

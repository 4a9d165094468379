/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Curves, tables and states as a model file has them.
 */
#include <math.h>

#include "writer.h"

/* A line as such, a wave that is not turned as y of x; everything else by p. */
void say_path(struct writer *w, const struct path *path)
{
    const char *m = w->scene->us ? "ft" : "m", *per = w->scene->us ? "1/ft" : "1/m";
    double c = cos(path->along), s = sin(path->along);
    if (path->form == path_line) {
        key_number(w, "along", path->along);
        return;
    }
    bool oval = path->form == path_oval, plain = path->along == 0 && !oval;
    if (plain) {
        say(w, ", y: \"%.17g[%s]*sin(%.17g[%s]*x + (%.17g))\"", path->a, m, path->wave, per, path->b);
    } else if (oval) {
        say(w, ", x: \"%.17g[%s]*cos(p) - (%.17g[%s])*sin(p)\"", c * path->a, m, s * path->b, m);
        say(w, ", y: \"%.17g[%s]*cos(p) + %.17g[%s]*sin(p)\"", s * path->a, m, c * path->b, m);
    } else {
        for (int i = 0; i < 2; i++)
            say(w, ", %s: \"%.17g*p + %.17g[%s]*sin(%.17g[%s]*p + (%.17g))\"", i == 0 ? "x" : "y",
                i == 0 ? c : s, (i == 0 ? -s : c) * path->a, m, path->wave, per, path->b);
    }
    if (oval)
        say(w, ", from: %.17g, to: %.17g", path->from, path->to);
    else
        say(w, ", from: %.17g %s, to: %.17g %s", path->from, m, path->to, m);
}

void say_tables(struct writer *w)
{
    static const char *const interpolations[] = {"linear", "step", "cubic", "akima", "steffen"};
    static const char *const beyond[] = {"hold", "zero", "repeat"};
    const struct scene *scene = w->scene;
    if (scene->table_count > 0) say(w, "tables:\n");
    for (int i = 0; i < scene->table_count; i++) {
        const struct table *table = &scene->table[i];
        say(w, "  T%d: {interpolation: %s, beyond: %s, points: [", i, interpolations[table->interpolation],
            beyond[table->beyond]);
        for (int k = 0; k < table->count; k++) {
            if (k > 0) say(w, ", ");
            say_pair(w, (struct vec2){table->x[k], table->y[k]});
        }
        say(w, "]}\n");
    }
}

void say_states(struct writer *w)
{
    const struct scene *scene = w->scene;
    if (scene->state_count > 0) say(w, "states:\n");
    for (int i = 0; i < scene->state_count; i++) {
        say(w, "  z%d: {rate: \"(", i);
        say_summands(w, -1, &scene->state[i].rate);
        say(w, ")/1[s]\", initial: ");
        say_number(w, scene->state[i].initial);
        say(w, ", unit: 1}\n");
    }
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The run: duration, accuracy, output, events.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <float.h>
#include <string.h>

/* ---- events */

/* Set the direction of crossing; that of a comparison is the one in which it becomes true. */
static bool read_direction(struct reader *reader, const struct node *node, char relation,
                           const struct event_keys *keys, struct user_event *event)
{
    int implied = relation == '<' ? -1 : relation == '>' ? 1 : 0;
    const struct pair *given = node_find(node, "direction");
    event->direction = given ? keys->direction : implied;
    if (!given || implied == 0 || implied == keys->direction) return true;
    diag_add(reader->errors, FBD_ERROR, "conflicting-keys", given->at,
             "leave `direction` out, or write the condition with `=`",
             "`when` becomes true when the difference is %s", implied < 0 ? "falling" : "rising");
    return false;
}

/* A condition in the key `key`; `names`: those that need no prefix in it. */
struct condition {
    const struct node *node;
    const char *key, *hint;
    struct names names;
};

static bool read_condition(struct reader *reader, const struct condition *condition, char *relation,
                           struct user_event *event)
{
    const struct node *node = condition->node;
    struct names names = condition->names;
    struct scope scope = names_scope(&names);
    const struct expr_want want = {.any_dim = true, .what = condition->key};
    event->at = node->at;
    event->text = arena_text(reader->arena, node->text, node->length);
    if (node->length == 0) return value_refuse(reader, node, condition->key, "a condition", condition->hint);
    return value_relation(reader, node, &want, &scope, &event->left, relation, &event->right);
}

static struct names names_of_events(struct reader *reader)
{
    return (struct names){.reader = reader,
                          .place = place_event,
                          .body = reader->scene->body_count == 1 ? 0 : ground_body};
}

static bool read_when(struct reader *reader, const struct node *when, char *relation,
                      struct user_event *event)
{
    const struct condition condition = {when, "when", "write for example `x = 2[m]`",
                                        names_of_events(reader)};
    return read_condition(reader, &condition, relation, event);
}

/* ---- the begin and the end of forces and couplings */

struct lifetime lifetime_of(struct reader *reader, const struct node *since, const struct node *until)
{
    if (!since && !until) return (struct lifetime){0};
    return (struct lifetime){.number = ++reader->scene->lifetime_count,
                             .since = since,
                             .until = until,
                             .begins = since != NULL,
                             .ends = until != NULL};
}

/* The key of a begin: `from` of a load along a line is a point. */
static const char *key_of_begin(const struct names *names)
{
    return names->of_load && names->of_load->spread.length > 0 ? "since" : "from";
}

/* The condition in the key `from` or `until` of the force or constraint called `name`. */
static bool read_ending(struct reader *reader, const struct lifetime *lifetime, bool begins, const char *name,
                        const struct names *names)
{
    struct condition condition = {.node = begins ? lifetime->since : lifetime->until,
                                  .key = begins ? key_of_begin(names) : "until",
                                  .hint = begins ? "write for example `t > 2 s`"
                                                 : "write for example `force > 500 N` or `t > 2 s`",
                                  .names = *names};
    struct user_event *event = &reader->scene->events[reader->scene->event_count++];
    char relation = 0;
    *event = (struct user_event){.name = name, .lifetime = lifetime->number, .begins = begins};
    if (begins) { /* it has no reactions before */
        condition.names.of = NULL;
        condition.names.of_coupling = NULL;
        condition.names.of_load = NULL;
    }
    if (!read_condition(reader, &condition, &relation, event)) return false;
    event->direction = relation == '<' ? -1 : 1;
    if (relation == '<' || relation == '>') return true;
    diag_add(reader->errors, FBD_ERROR, "expression-syntax", condition.node->at, condition.hint,
             "`%s` must be a comparison with `<` or `>`, which becomes true", condition.key);
    return false;
}

static bool read_both(struct reader *reader, const struct lifetime *lifetime, const char *name,
                      const struct names *names)
{
    bool fine = true;
    if (lifetime->since) fine = read_ending(reader, lifetime, true, name, names);
    if (lifetime->until) fine = read_ending(reader, lifetime, false, name, names) && fine;
    return fine;
}

/* Append them to the events, which have room for two of each lifetime. Those of rolling resistance are its roll's. */
static bool read_endings(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    bool fine = true;
    for (size_t i = 0; i < scene->constraint_count; i++) {
        const struct constraint *constraint = &scene->constraints[i];
        struct names names = names_of_events(reader);
        names.of = constraint;
        if (constraint->kind != constraint_resistance)
            fine = read_both(reader, &constraint->lifetime, constraint->name, &names) && fine;
    }
    for (size_t i = 0; i < scene->force_coupling_count; i++) {
        const struct force_coupling *coupling = &scene->force_couplings[i];
        struct names names = names_of_events(reader);
        names.of_coupling = coupling;
        fine = read_both(reader, &coupling->load.lifetime, coupling->load.name, &names) && fine;
    }
    for (size_t b = 0; b < scene->body_count; b++)
        for (size_t i = 0; i < scene->bodies[b].load_count; i++) {
            const struct load *load = &scene->bodies[b].loads[i];
            struct names names = names_of_events(reader);
            names.body = (int)b;
            names.of_load = load;
            fine = read_both(reader, &load->lifetime, load->name, &names) && fine;
        }
    return fine;
}

/* ---- events */

static bool read_event(struct reader *reader, const struct node *node, struct user_event *event)
{
    struct event_keys keys = {0};
    char relation = 0;
    bool fine = fields_read(reader, &event_group, node, node->at, &reader->constants, &keys);
    event->at = node->at;
    event->name = keys.name;
    event->stop = keys.stop || keys.then == event_stops;
    if (!fields_exclude(reader, node, "then", "stop", "`stop: true` means `then: stop`")) fine = false;
    if (!keys.when || !read_when(reader, keys.when, &relation, event)) return false;
    return read_direction(reader, node, relation, &keys, event) && fine;
}

static bool is_taken(const struct scene *scene, const char *name, size_t except)
{
    for (size_t i = 0; i < scene->event_count; i++)
        if (i != except && scene->events[i].name && strcmp(scene->events[i].name, name) == 0) return true;
    return false;
}

/* Name events without a name `event`, `event_2`, ...; names are unique. */
static bool name_events(struct reader *reader)
{
    struct scene *scene = reader->scene;
    bool fine = true;
    int number = 0;
    for (size_t i = 0; i < scene->event_count; i++) {
        struct user_event *event = &scene->events[i];
        if (event->name && is_taken(scene, event->name, i)) {
            diag_add(reader->errors, FBD_ERROR, "duplicate-name", event->at, "choose another name",
                     "two events are called `%s`", event->name);
            return false;
        }
        while (!event->name) {
            number++;
            const char *name = number == 1 ? "event" : arena_printf(reader->arena, "event_%d", number);
            if (!name) return false;
            if (!is_taken(scene, name, i)) event->name = name;
        }
    }
    return fine;
}

/* `node` may be NULL. */
static bool read_events(struct reader *reader, const struct node *node)
{
    enum { most_events = 1000 };
    struct scene *scene = reader->scene;
    bool list = node && node->kind == node_list, fine = true;
    size_t count = list ? node->count : node != NULL, endings = 2 * (size_t)scene->lifetime_count;
    if (count > most_events) {
        diag_add(reader->errors, FBD_ERROR, "too-many-events", node->at, NULL, "more than %d events",
                 most_events);
        return false;
    }
    if (count + endings == 0) return true;
    scene->events = ARENA_ARRAY(reader->arena, count + endings, struct user_event);
    if (!scene->events) return false;
    scene->event_count = count;
    for (size_t i = 0; i < count; i++)
        if (!read_event(reader, list ? node->items[i] : node, &scene->events[i])) fine = false;
    fine = name_events(reader) && fine;
    return read_endings(reader) && fine;
}

/* ---- the run */

static bool read_points(struct reader *reader, const struct node *list)
{
    struct scene *scene = reader->scene;
    bool fine = true;
    if (scene->output_points) {
        diag_add(reader->errors, FBD_ERROR, "conflicting-keys", list->at, "give them once",
                 "the points of the output are given already");
        return false;
    }
    scene->output_points = ARENA_ARRAY(reader->arena, list->count, struct output_point);
    if (!scene->output_points) return false;
    for (size_t i = 0; i < list->count; i++) {
        struct output_point *point = &scene->output_points[scene->output_point_count];
        const struct node *node = list->items[i];
        if (!coupling_end_read(reader, node, "points", &point->body, &point->point)) {
            fine = false;
        } else if (point->body == ground_body) {
            diag_add(reader->errors, FBD_ERROR, "unknown-point", node->at,
                     "name a point of a body, as `rod.right`", "`%.80s` does not move", node->text);
            fine = false;
        } else {
            bool centre = !strchr(node->text, '.');
            point->name = centre ? arena_printf(reader->arena, "%s.G", node->text)
                                 : arena_text(reader->arena, node->text, node->length);
            scene->output_point_count++;
        }
    }
    return fine;
}

/* Read `output`, beside `simulate` or in it. `every` may be given once, in either or in `simulate`. */
static bool read_output(struct reader *reader, const struct node *node, const struct pair *key)
{
    struct output_keys keys = {0};
    if (!node) return true;
    bool fine = fields_read(reader, &output_group, node, key->at, &reader->constants, &keys);
    double *every = &reader->scene->simulate.every;
    const struct pair *inner = node_find(node, "every");
    if (*every > 0 && inner) {
        diag_add(reader->errors, FBD_ERROR, "conflicting-keys", inner->at, "give it once",
                 "the output interval is given already");
        return false;
    }
    if (keys.every > 0) *every = keys.every;
    if (keys.points && !read_points(reader, keys.points)) fine = false;
    return fine;
}

static bool check_share(struct reader *reader, const struct node *map, const char *key, double value,
                        const char *hint)
{
    const double most = 0.1;
    const struct pair *pair = node_find(map, key); /* NULL: the value is 0 */
    if (!pair || (value <= most && (value >= DBL_EPSILON || !(value > 0)))) return true;
    if (value > most)
        diag_add(reader->errors, FBD_ERROR, "out-of-range", pair->value->at, hint, "`%s` must be at most %g",
                 key, most);
    else
        diag_add(reader->errors, FBD_ERROR, "out-of-range", pair->value->at,
                 "the smallest useful tolerance is about 1e-13; 1e-10 is the default tolerance",
                 "`%s` is below the resolution of numbers (2.2e-16)", key);
    return false;
}

static bool check_accuracy(struct reader *reader, const struct node *map, const struct simulate_keys *keys)
{
    static const char hint[] = "`accuracy` determines the steps";
    bool fine = check_share(reader, map, "tolerance", keys->tolerance, "1e-9 is careful, 1e-4 is quick");
    if (!check_share(reader, map, "accuracy", keys->accuracy, "1e-8 is careful, 1e-3 is quick")) fine = false;
    if (!fields_exclude(reader, map, "accuracy", "tolerance", hint)) fine = false;
    return fields_exclude(reader, map, "accuracy", "step", hint) && fine;
}

static bool read_run(struct reader *reader, const struct node *map, struct pos at, const struct node **events)
{
    struct simulate *simulate = &reader->scene->simulate;
    struct simulate_keys keys = {0};
    const struct pair *output = node_find(map, "output");
    bool fine = fields_read(reader, &simulate_group, map, at, &reader->constants, &keys);
    if (!check_accuracy(reader, map, &keys)) fine = false;
    *simulate = (struct simulate){.until = keys.until,
                                  .tolerance = keys.tolerance,
                                  .accuracy = keys.accuracy,
                                  .step = keys.step,
                                  .every = keys.every,
                                  .propagate = keys.impacts == impacts_propagate,
                                  .method = method_choices[keys.method].name};
    if (!read_output(reader, keys.output, output)) fine = false;
    *events = keys.events;
    return fine;
}

bool simulate_read(struct reader *reader, const struct scene_keys *keys)
{
    const struct pair *simulate = node_find(reader->root, "simulate");
    const struct node *events = NULL;
    bool run = !keys->simulate || read_run(reader, keys->simulate, simulate->at, &events);
    run = read_events(reader, events) && run;
    return read_output(reader, keys->output, node_find(reader->root, "output")) && run;
}

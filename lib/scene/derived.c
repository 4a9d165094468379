/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Expressions derived from an entry of forces: the direction to a point, the moment of a force with an
 * offset, drag in wind. Each is compiled from text over the names of the file and internal ones, so that it
 * has exact derivatives, switches and divisions as the expressions of the file: where the distance to a point
 * becomes zero, the division by it is found.
 */
#include "base/text.h"
#include "scene/load_entry.h"
#include "scene/quantity.h"

#include <assert.h>

enum { most_terms = 16 };

/* Internal names start with `t.`, which no name of the file does: t is the time. */
struct derived {
    struct entry *entry;
    struct text text;
    int count;
    struct symbol terms[most_terms]; /* t.a, t.b, ... */
};

/* ---- parts of the text */

static bool is_same(const struct symbol *a, const struct symbol *b)
{
    if (a->kind != b->kind) return false;
    return a->kind == symbol_constant ? a->value == b->value && dim_equal(a->dim, b->dim)
                                      : a->slot == b->slot;
}

static void add_term(struct derived *derived, struct symbol symbol)
{
    int i = 0;
    while (i < derived->count && !is_same(&derived->terms[i], &symbol)) i++;
    assert(i < most_terms); /* two positions, an offset, a size, an angle */
    derived->terms[i] = symbol;
    if (i == derived->count) derived->count++;
    text_printf(&derived->text, "t.%c", 'a' + i);
}

static void add_constant(struct derived *derived, double value, struct dim dim)
{
    add_term(derived, (struct symbol){.kind = symbol_constant, .value = value, .dim = dim});
}

static void add_place(struct derived *derived, int body, const struct point *point, enum absolute_kind kind)
{
    struct point place = *point;
    if (place.kind == point_absent) place.kind = point_G;
    if (body == ground_body)
        add_constant(derived, kind == absolute_x ? place.where.x : place.where.y, DIM_LENGTH);
    else
        add_term(derived, name_of_place(derived->entry->reader, body, &place, kind));
}

/* A value of the file: its number if constant, else its text. */
static void add_value(struct derived *derived, const struct node *node, const struct value *value,
                      enum quantity quantity)
{
    if (!value->expr) {
        text_add(&derived->text, "0");
    } else if (expr_is_constant(value->expr)) {
        add_constant(derived, expr_value(value->expr), quantity_dim(quantity));
    } else {
        text_add(&derived->text, "(");
        text_add_bytes(&derived->text, node->text, node->length);
        text_add(&derived->text, ")");
    }
}

static const struct node *node_of(const struct entry *entry, const char *key)
{
    const struct pair *pair = node_find(entry->chosen.node, key);
    return pair ? pair->value : NULL;
}

/* ---- compiling it */

static struct symbol look_up(void *context, const char *name, struct pos at)
{
    struct derived *derived = context;
    const struct scope *file = &derived->entry->scope;
    if (name[0] == 't' && name[1] == '.') return derived->terms[name[2] - 'a'];
    return file->lookup(file->context, name, at);
}

static struct table_symbol look_up_table(void *context, const char *name, struct pos at)
{
    const struct scope *file = &((struct derived *)context)->entry->scope;
    return file->table(file->context, name, at);
}

/* Compile the text. Its parts have been compiled before, so the only errors left are excessive length and too
 * many positions in the world. */
static bool compile_text(struct derived *derived, enum quantity quantity, fbd_errors *errors,
                         struct value *value)
{
    struct reader *reader = derived->entry->reader;
    const struct scope scope = {.lookup = look_up,
                                .table = look_up_table,
                                .context = derived,
                                .units = reader->scene->units};
    const struct expr_want want = {.dim = quantity_dim(quantity), .what = "force"};
    struct pos at = derived->entry->chosen.at;
    *value = (struct value){.at = at};
    if (derived->text.failed || !errors) {
        diag_out_of_memory(reader->errors);
        return false;
    }
    value->expr = expr_compile(reader->derived, derived->text.data, at, &scope, &want, errors);
    if (errors->out_of_memory) diag_out_of_memory(reader->errors);
    if (!value->expr && !errors->out_of_memory && !reader->arena->failed)
        entry_note(derived->entry, "expression-too-long", at,
                   "shorten them, or put a part of them into a table",
                   "the expressions of this force are too long to be used together");
    return value->expr != NULL;
}

static bool compile(struct derived *derived, enum quantity quantity, struct value *value)
{
    fbd_errors *errors = fbd_errors_new(); /* warnings were given for the parts */
    bool compiled = compile_text(derived, quantity, errors, value);
    fbd_errors_free(errors);
    text_free(&derived->text);
    derived->count = 0;
    return compiled;
}

/* ---- toward a point */

/* The vector from the point of application to the target, along x or y. */
static void add_gap(struct derived *derived, enum absolute_kind kind)
{
    const struct entry *entry = derived->entry;
    const struct load *load = &entry->keys.load;
    text_add(&derived->text, "(");
    add_place(derived, load->target, &load->end, kind);
    text_add(&derived->text, " - ");
    add_place(derived, entry->body, &load->point, kind);
    if (load_is_placed(load)) {
        text_add(&derived->text, " - ");
        add_value(derived, entry->offset->items[kind == absolute_y],
                  kind == absolute_x ? &load->offset_x : &load->offset_y, a_length);
    }
    text_add(&derived->text, ")");
}

static void add_distance(struct derived *derived)
{
    text_add(&derived->text, "hypot(");
    add_gap(derived, absolute_x);
    text_add(&derived->text, ", ");
    add_gap(derived, absolute_y);
    text_add(&derived->text, ")");
}

/* A component of the unit vector. */
static void add_direction(struct derived *derived, enum absolute_kind kind)
{
    add_gap(derived, kind);
    text_add(&derived->text, "/");
    add_distance(derived);
}

static bool derive_angle(struct entry *entry, const char *sign, struct value *angle)
{
    struct derived derived = {.entry = entry};
    text_printf(&derived.text, "atan2(%s", sign);
    add_direction(&derived, absolute_y);
    text_printf(&derived.text, ", %s", sign);
    add_direction(&derived, absolute_x);
    text_add(&derived.text, ")");
    return compile(&derived, an_angle, angle);
}

static bool is_of_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
}

/* The text of a force with `distance` replaced by its expression. */
static void add_with_distance(struct derived *derived, const struct node *node)
{
    static const char name[] = "distance";
    const size_t size = sizeof name - 1;
    const char *text = node->text;
    text_add(&derived->text, "(");
    for (size_t i = 0; i < node->length;) {
        size_t end = i;
        while (end < node->length && is_of_name(text[end])) end++;
        if (end - i == size && memcmp(text + i, name, size) == 0)
            add_distance(derived);
        else
            text_add_bytes(&derived->text, text + i, end > i ? end - i : 1);
        i = end > i ? end : i + 1;
    }
    text_add(&derived->text, ")");
}

/* On a slide of the ground: true if the target lies on the line of the point of application; *from_zero is
 * then the distance to the target at x = 0. */
static bool is_on_line(const struct entry *entry, double *from_zero)
{
    const double on_it = 1e-12; /* relative to the lengths involved */
    const struct load *load = &entry->keys.load;
    const struct motion *motion = entry->motion;
    if (!entry_is_slide(entry) || motion->parent != ground_body) return false;
    if (load->target != ground_body || load_is_placed(load)) return false;
    struct vec e = vec_unit(motion->along), T = vec_sub(load->end.where, motion->through);
    struct vec P = load->point.kind == point_fixed
                       ? load->point.where
                       : body_centre_of_mass(&entry->reader->scene->bodies[entry->body]);
    *from_zero = vec_dot(e, T) - P.x; /* the body frame lies along the line */
    double size = vec_norm(load->end.where) + vec_norm(motion->through) + vec_norm(P);
    return fabs(vec_cross(e, T) - P.y) <= on_it * size;
}

/* On its line the force reverses where the body passes the target: multiply by sign(), a switch. */
static bool derive_on_line(struct entry *entry, double from_zero, bool distance_named)
{
    struct derived derived = {.entry = entry};
    struct load *load = &entry->keys.load;
    if (distance_named)
        add_with_distance(&derived, entry->keys.value);
    else
        add_value(&derived, entry->keys.value, &load->value, a_force);
    text_add(&derived.text, "*sign(");
    add_constant(&derived, from_zero, DIM_LENGTH);
    text_add(&derived.text, " - x)");
    return compile(&derived, a_force, &load->value);
}

bool derive_toward(struct entry *entry, bool distance_named)
{
    struct load *load = &entry->keys.load;
    double from_zero;
    if (is_on_line(entry, &from_zero)) return derive_on_line(entry, from_zero, distance_named);
    if (distance_named) {
        struct derived derived = {.entry = entry};
        add_with_distance(&derived, entry->keys.value);
        if (!compile(&derived, a_force, &load->value)) return false;
    }
    if (!derive_angle(entry, "", &load->angle)) return false;
    return load->target == ground_body || derive_angle(entry, "-", &load->return_angle);
}

/* ---- between two points */

bool derive_zero_distance(struct entry *entry, bool distance_named)
{
    struct load *load = &entry->keys.load;
    struct derived derived = {.entry = entry};
    if (distance_named) {
        add_with_distance(&derived, entry->keys.value);
        if (!compile(&derived, a_force, &load->value)) return false;
    }
    add_constant(&derived, 1, DIM_LENGTH);
    text_add(&derived.text, "/");
    add_distance(&derived);
    return compile(&derived, a_number, &load->zero_distance);
}

/* ---- force with an offset */

/* A component of the force in the frame of the force: along x (0) or y (1). */
static void add_component(struct derived *derived, int part, bool distance_named)
{
    const struct entry *entry = derived->entry;
    const struct load *load = &entry->keys.load;
    const struct node *value = entry->keys.value;
    if (load->fx.expr || load->fy.expr) {
        const struct node *node = value ? value->items[part] : node_of(entry, part == 0 ? "fx" : "fy");
        add_value(derived, node, part == 0 ? &load->fx : &load->fy, a_force);
        return;
    }
    if (distance_named)
        add_with_distance(derived, value);
    else
        add_value(derived, value, &load->value, a_force);
    text_add(&derived->text, "*");
    if (load->toward) {
        add_direction(derived, part == 0 ? absolute_x : absolute_y);
    } else if (!load->angle.expr) { /* along the slide */
        text_add(&derived->text, part == 0 ? "1" : "0");
    } else {
        text_add(&derived->text, part == 0 ? "cos(" : "sin(");
        add_value(derived, node_of(entry, "angle"), &load->angle, an_angle);
        text_add(&derived->text, ")");
    }
}

/* The offset in the frame of the force, along x (0) or y (1). `turns`: that is the body frame, so rotate
 * back. */
static void add_arm(struct derived *derived, int part, bool turns)
{
    const struct entry *entry = derived->entry;
    const struct load *load = &entry->keys.load;
    const struct point origin = {.kind = point_fixed};
    const struct value *offset[] = {&load->offset_x, &load->offset_y};
    const char *const turn[2][2] = {{"cos(", "sin("}, {"-sin(", "cos("}};
    text_add(&derived->text, "(");
    for (int k = 0; k < 2; k++) {
        if (!turns && k != part) continue;
        if (turns) {
            text_printf(&derived->text, "%s%s", k == 0 ? "" : " + ", turn[part][k]);
            add_place(derived, entry->body, &origin, absolute_angle);
            text_add(&derived->text, ")*");
        }
        add_value(derived, entry->offset->items[k], offset[k], a_length);
    }
    text_add(&derived->text, ")");
}

bool derive_couple(struct entry *entry, bool distance_named)
{
    struct load *load = &entry->keys.load;
    struct derived derived = {.entry = entry};
    bool along = !load->fx.expr && !load->fy.expr && !load->angle.expr;
    bool turns = load->body_frame || along;
    for (int part = 0; part < 2; part++) {
        if (part == 1) text_add(&derived.text, " - ");
        add_arm(&derived, part, turns);
        text_add(&derived.text, "*");
        add_component(&derived, 1 - part, distance_named);
    }
    return compile(&derived, a_moment, &load->couple);
}

/* ---- a value multiplied or divided: distributed loads, constant power */

bool derive_value(struct entry *entry, const char *key, const struct value *value, enum quantity quantity,
                  const char *behind, enum quantity wanted, struct value *result)
{
    struct derived derived = {.entry = entry};
    const struct node *node = node_of(entry, key);
    add_value(&derived, node ? node : entry->chosen.node, value,
              quantity); /* the value may replace the mapping of keys */
    text_add(&derived.text, behind);
    return compile(&derived, wanted, result);
}

bool derive_scaled(struct entry *entry, double size)
{
    struct derived derived = {.entry = entry};
    if (!entry->keys.factor.expr) return false;
    add_constant(&derived, size, DIM_FORCE);
    text_add(&derived.text, "*");
    add_value(&derived, node_of(entry, "factor"), &entry->keys.factor, a_number);
    return compile(&derived, a_force, &entry->keys.load.value);
}

/* ---- drag in a wind */

/* The velocity relative to the air along x or y. */
static void add_through_air(struct derived *derived, int part)
{
    const struct entry *entry = derived->entry;
    const struct load *load = &entry->keys.load;
    text_add(&derived->text, "(");
    add_place(derived, entry->body, &load->point, part == 0 ? absolute_vx : absolute_vy);
    text_add(&derived->text, " - ");
    add_value(derived, entry->keys.wind->items[part], part == 0 ? &load->wind_x : &load->wind_y, a_velocity);
    text_add(&derived->text, ")");
}

bool derive_wind(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    for (int part = 0; part < 2; part++) {
        struct derived derived = {.entry = entry};
        if (load->quadratic == 0) {
            add_constant(&derived, load->linear, quantity_dim(a_damping));
            text_add(&derived.text, "*");
            add_value(&derived, entry->keys.wind->items[part], part == 0 ? &load->wind_x : &load->wind_y,
                      a_velocity);
        } else {
            text_add(&derived.text, "-(");
            add_constant(&derived, load->linear, quantity_dim(a_damping));
            text_add(&derived.text, " + ");
            add_constant(&derived, load->quadratic, quantity_dim(a_quadratic_drag));
            text_add(&derived.text, "*hypot(");
            add_through_air(&derived, 0);
            text_add(&derived.text, ", ");
            add_through_air(&derived, 1);
            text_add(&derived.text, "))*");
            add_through_air(&derived, part);
        }
        if (!compile(&derived, a_force, part == 0 ? &load->fx : &load->fy)) return false;
    }
    return true;
}

/* ---- mass flow */

static void add_mass_rate(struct derived *derived)
{
    const struct point none = {.kind = point_fixed};
    add_term(derived, name_of_place(derived->entry->reader, derived->entry->body, &none, absolute_mass_rate));
}

bool derive_exhaust(struct entry *entry)
{
    struct derived derived = {.entry = entry};
    text_add(&derived.text, "-");
    add_mass_rate(&derived);
    text_add(&derived.text, "*");
    add_value(&derived, node_of(entry, "exhaust"), &entry->keys.exhaust, a_velocity);
    return compile(&derived, a_force, &entry->keys.load.value);
}

bool derive_entering(struct entry *entry, const struct value *along, const struct value *x,
                     const struct value *y)
{
    struct load *load = &entry->keys.load;
    for (int part = 0; part < (along->expr ? 1 : 2); part++) {
        struct derived derived = {.entry = entry};
        const struct node *node = entry->keys.velocity;
        add_mass_rate(&derived);
        text_add(&derived.text, "*(");
        add_value(&derived, along->expr ? node : node->items[part],
                  along->expr ? along
                  : part == 0 ? x
                              : y,
                  a_velocity);
        text_add(&derived.text, " - ");
        if (along->expr)
            text_add(&derived.text, "v");
        else
            add_place(&derived, entry->body, &load->point, part == 0 ? absolute_vx : absolute_vy);
        text_add(&derived.text, ")");
        struct value *force = along->expr ? &load->value : part == 0 ? &load->fx : &load->fy;
        if (!compile(&derived, a_force, force)) return false;
    }
    return true;
}

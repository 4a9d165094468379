/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ratios: a linear relation of coordinates, sum c_i q_i = constant, so that sum c_i v_i = 0.
 *
 * All products c_i q_i have the same dimension, a length or an angle. An angle is multiplied by a unit of
 * length, so that the row is a length as those of all couplings, and its multiplier a force.
 */
#include "scene/couplings.h"
#include "scene/values.h"

#include <math.h>
#include <string.h>

/* A factor as it is read. */
struct factor {
    const struct pair *pair;
    int body, coordinate;
    double value;
    struct dim dim; /* of the product */
};

static const struct joint_type *joint_of(const struct reader *reader, int body)
{
    return motion_joint(&reader->scene->bodies[body].motion);
}

/* ---- the coordinate that a key names */

/* A hint for a name that is no coordinate of the body. */
static const char *hint_for(struct reader *reader, const struct factor *factor, const char *name)
{
    const struct joint_type *joint = joint_of(reader, factor->body);
    const char *body = reader->scene->bodies[factor->body].name, *key = factor->pair->key,
               *names[most_coordinates_of_a_body];
    if (joint->count == 0) return "name the coordinates of bodies that move on their parent";
    for (int i = 0; i < joint->count; i++) {
        names[i] = arena_printf(reader->arena, "%s.%s", body, joint->coordinates[i].name);
        if (!names[i]) return NULL;
        if (strcmp(name, joint->coordinates[i].rate) == 0)
            return diag_replace(reader->errors, key, names[i], "name the coordinate, `%s`, not its rate",
                                names[i]);
    }
    return diag_nearest(reader->errors, key, names, (size_t)joint->count);
}

static bool no_coordinate(struct reader *reader, const struct factor *factor, const char *name)
{
    diag_add(reader->errors, FBD_ERROR, "unknown-name", factor->pair->at, hint_for(reader, factor, name),
             "`ratio`: the body `%s` has no coordinate called `%s`", reader->scene->bodies[factor->body].name,
             name);
    return false;
}

static bool find_coordinate(struct reader *reader, struct factor *factor)
{
    const char *key = factor->pair->key, *dot = strchr(key, '.');
    const struct node whole = {.kind = node_scalar,
                               .text = key,
                               .length = strlen(key),
                               .at = factor->pair->at};
    const struct node *owner = text_part(reader, &whole, 0, (size_t)(dot - key));
    if (!owner || !body_name_read(reader, owner, "ratio", &factor->body)) return false;
    if (factor->body == ground_body) {
        diag_add(reader->errors, FBD_ERROR, "not-here", factor->pair->at, "name the coordinates of bodies",
                 "`ratio`: the ground has no coordinates");
        return false;
    }
    if (!reader->drafts[factor->body].motion_known) return false; /* noted before */
    const struct joint_type *joint = joint_of(reader, factor->body);
    for (factor->coordinate = 0; factor->coordinate < joint->count; factor->coordinate++)
        if (strcmp(joint->coordinates[factor->coordinate].name, dot + 1) == 0) return true;
    return no_coordinate(reader, factor, dot + 1);
}

/* ---- its factor */

static bool read_factor(struct reader *reader, struct factor *factor)
{
    const struct node *node = factor->pair->value;
    struct value value;
    if (!value_formula(reader, node, factor->pair->key, a_parameter, 0, &reader->constants, &value))
        return false;
    const bool angle = joint_of(reader, factor->body)->coordinates[factor->coordinate].angle;
    factor->value = expr_value(value.expr);
    factor->dim = dim_times(expr_dim(value.expr), angle ? DIM_NONE : DIM_LENGTH);
    if (factor->value != 0) return true;
    diag_add(reader->errors, FBD_ERROR, "out-of-range", node->at, "leave the coordinate out",
             "`%s` has the factor 0: it takes no part in the ratio", factor->pair->key);
    return false;
}

/* The unit of a factor whose product has the dimension `wanted`. */
static const char *unit_wanted(struct reader *reader, const struct factor *factor, struct dim wanted)
{
    const bool angle = joint_of(reader, factor->body)->coordinates[factor->coordinate].angle;
    const struct dim dim = dim_over(wanted, angle ? DIM_NONE : DIM_LENGTH);
    char unit[24];
    unit_name(dim, reader->scene->units, unit, sizeof unit);
    if (dim_equal(dim, DIM_NONE))
        return diag_hint(reader->errors, "give `%s` a number without unit", factor->pair->key);
    if (!dim_equal(dim, DIM_LENGTH))
        return diag_hint(reader->errors, "give `%s` a factor in %s", factor->pair->key, unit);
    return diag_hint(reader->errors, "give `%s` a length per radian, as `%s: 0.2 %s`", factor->pair->key,
                     factor->pair->key, unit);
}

static const char *kind_of(struct dim dim)
{
    return dim_equal(dim, DIM_LENGTH) ? "a length" : dim_equal(dim, DIM_NONE) ? "an angle" : "neither";
}

/* All products are lengths, or all are angles. */
static bool check_dims(struct reader *reader, const struct factor *factors, size_t count)
{
    bool length = false;
    for (size_t i = 0; i < count; i++) length |= dim_equal(factors[i].dim, DIM_LENGTH);
    const struct dim wanted = length ? DIM_LENGTH : DIM_NONE;
    for (size_t i = 0; i < count; i++) {
        if (dim_equal(factors[i].dim, wanted)) continue;
        diag_add(reader->errors, FBD_ERROR, "wrong-dimension", factors[i].pair->value->at,
                 unit_wanted(reader, &factors[i], wanted),
                 "the product of `%s` and its factor is %s, where the products of a ratio are %s",
                 factors[i].pair->key,
                 strcmp(kind_of(factors[i].dim), "neither") == 0 ? "neither a length nor an angle"
                                                                 : kind_of(factors[i].dim),
                 length ? "lengths" : "angles");
        return false;
    }
    return true;
}

/* ---- its ends */

static bool add_end(struct constraint *constraint, struct ratio_term *terms, const struct reader *reader,
                    const struct factor *factor, int body)
{
    const struct joint_type *joint = joint_of(reader, factor->body);
    const int k = constraint->end_count;
    if (k == most_constraint_ends) return false;
    constraint->end_count++;
    constraint->body[k] = body;
    constraint->point[k] = (struct point){.kind = point_fixed, .at = constraint->at};
    const struct motion *motion = &reader->scene->bodies[factor->body].motion;
    constraint->point[k].where = body == factor->body ? motion->point : motion->through;
    constraint->radius[k] = joint->coordinates[factor->coordinate].angle ? fabs(factor->value) : 0;
    terms[k] = (struct ratio_term){factor->coordinate, factor->value, body != factor->body};
    return true;
}

static bool add_ends(struct reader *reader, const struct factor *factors, size_t count,
                     struct constraint *constraint)
{
    struct ratio_term *terms = ARENA_ARRAY(reader->arena, most_constraint_ends, struct ratio_term);
    constraint->terms = terms;
    constraint->angular = dim_equal(factors[0].dim, DIM_NONE);
    for (size_t i = 0; terms && i < count; i++) {
        const int parent = reader->scene->bodies[factors[i].body].motion.parent;
        if (add_end(constraint, terms, reader, &factors[i], factors[i].body) &&
            (parent == ground_body || add_end(constraint, terms, reader, &factors[i], parent)))
            continue;
        diag_add(reader->errors, FBD_ERROR, "wrong-type", factors[i].pair->at,
                 "divide it into several ratios, with the coordinate of a body in between",
                 "a ratio acts on at most %d bodies, counting those that its bodies move on",
                 (int)most_constraint_ends);
        return false;
    }
    return terms != NULL;
}

bool ratio_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    struct factor factors[most_constraint_ends + 1];
    size_t count = 0;
    bool fine = true;
    for (size_t i = 0; keys->terms && i < keys->terms->count && count <= most_constraint_ends; i++) {
        const struct pair *pair = &keys->terms->pairs[i];
        if (!strchr(pair->key, '.')) continue;
        factors[count].pair = pair;
        if (!find_coordinate(reader, &factors[count]) || !read_factor(reader, &factors[count])) fine = false;
        count++;
    }
    if (count < 2) {
        diag_add(reader->errors, FBD_ERROR, "missing-key", constraint->at,
                 "write each with its factor, as `ratio: {a.x: 3, b.x: 1}` for 3 v_a + v_b = 0",
                 "a ratio needs two coordinates or more");
        return false;
    }
    return fine && check_dims(reader, factors, count) && add_ends(reader, factors, count, constraint);
}

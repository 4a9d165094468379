/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/language.h"

static const struct field own_state_fields[] = {
    FIELD_NODE(offsetof(struct own_state_keys, rate), "rate", field_scalar, required, NULL,
               "its rate of change: an expression of time, coordinates, rates and states"),
    FIELD_NODE(offsetof(struct own_state_keys, initial), "initial", field_scalar, 0, NULL,
               "its value at the start; default 0"),
    FIELD_NODE(offsetof(struct own_state_keys, unit), "unit", field_scalar, 0, NULL,
               "its unit, where `initial` does not give it; `1` for a pure number"),
};

const struct group own_state_group = {
    "a state", "rate", FIELDS(own_state_fields),
    NULL,      0,      "a quantity with its rate and its value at the start"};

static const struct field output_fields[] = {
    FIELD_NUMBER(offsetof(struct output_keys, every), "every", a_time, positive,
                 "time between two rows of output"),
    FIELD_ENTRIES(offsetof(struct output_keys, points), "points", field_list, 0, each_word, NULL,
                  "points of bodies, as `rod.right`: columns of their places, velocities and accelerations "
                  "in the world"),
};

#define CONSTANT_FIELDS(value_doc)                                                                           \
    FIELD_NODE(offsetof(struct constant_keys, value), "value", field_scalar, required, NULL, value_doc),     \
        FIELD_NODE(offsetof(struct constant_keys, range), "range", field_list, 0, NULL,                      \
                   "[low, high]: the range of its slider"),                                                  \
        FIELD_TEXT(offsetof(struct constant_keys, description), "description", "one line of description")

static const struct field parameter_fields[] = {
    CONSTANT_FIELDS("quantity or expression of other parameters"),
};

const struct group parameter_group = {"a parameter", "value", FIELDS(parameter_fields),
                                      NULL,          0,       "a named constant"};

static const struct field input_fields[] = {
    CONSTANT_FIELDS("its value at the start, with its unit; it is constant until it is set"),
};

const struct group input_group = {"an input", "value", FIELDS(input_fields),
                                  NULL,       0,       "a quantity that is set from outside"};

const struct group output_group = {"`output`", NULL, FIELDS(output_fields), NULL, 0, "what a run writes"};

static const struct field ground_fields[] = {
    FIELD_ENTRIES(offsetof(struct ground_keys, points), "points", field_map, 0, each_pair, NULL,
                  "name: [x, y]"),
    FIELD_ENTRIES(offsetof(struct ground_keys, lines), "lines", field_map, 0, each_group, &line_group,
                  "name: a line to slide on"),
    FIELD_ENTRIES(offsetof(struct ground_keys, polygons), "polygons", field_map, 0, each_polygon, NULL,
                  "name: corners [[x, y], ...] of a convex surface that contacts meet"),
};

const struct group ground_group = {"`ground`", NULL, FIELDS(ground_fields),
                                   NULL,       0,    "named points and lines that do not move"};

static const struct field line_fields[] = {
    FIELD_NODE(offsetof(struct line_keys, through), "through", field_any, 0, NULL,
               "a point of the line: [x, y] or a point of the ground; default [0, 0]"),
    FIELD_NUMBER(offsetof(struct line_keys, along), "along", an_angle, required,
                 "direction, from the x axis"),
};

const struct group line_group = {"a line", NULL, FIELDS(line_fields), NULL, 0, "a straight line"};

static const struct field place_fields[] = {
    FIELD_NODE(offsetof(struct place_keys, point), "point", field_any, 0, NULL,
               "point of the body: a name or [x, y]; default G"),
    FIELD_ENTRIES(offsetof(struct place_keys, offset), "offset", field_any, required, each_pair, NULL,
                  "from there to where the force acts, [x, y] along the axes of the world, as [0.1 m, 0]: it "
                  "does not turn with the body"),
};
const struct group place_group = {"`at`", "point", FIELDS(place_fields), NULL, 0, "where a force acts"};

/* The methods are in lib/integrate/method.c. */
const struct choice method_choices[] = {
    {"auto", 0, "chosen by the structure and the stiffness of the scene"},
    {"rk8pd", 1, "explicit Runge-Kutta of order 8"},
    {"dop853", 2, "explicit Runge-Kutta of order 8"},
    {"rodas5p", 3, "Rosenbrock of order 5, for stiff systems"},
    {"rkf45", 4, "explicit Runge-Kutta of order 5"},
    {"rkck", 5, "explicit Runge-Kutta of order 5"},
    {"rk4", 6, "explicit Runge-Kutta of order 4"},
    {"rk2", 7, "explicit Runge-Kutta of order 3"},
    {"msadams", 8, "Adams multistep"},
    {"msbdf", 9, "backward differentiation, for stiff systems"},
    {"bsimp", 10, "implicit extrapolation, for stiff systems"},
    {"rk4imp", 11, "implicit Runge-Kutta of order 4"},
    {"rk2imp", 12, "implicit midpoint rule"},
    {"rk1imp", 13, "implicit Euler"},
};

static const struct choice impact_choices[] = {
    {"simultaneous", impacts_simultaneous, "compression of all together, then restitution of all together"},
    {"propagate", impacts_propagate, "one after the other, until all separate"},
};

static const struct field simulate_fields[] = {
    FIELD_VALUE(offsetof(struct simulate_keys, until), "until", a_time, required | positive | stored,
                "time at which the run ends"),
    FIELD_NUMBER(offsetof(struct simulate_keys, tolerance), "tolerance", a_number, positive,
                 "error allowed in one step, relative to the size of the motion; 2.2e-16 to 0.1"),
    FIELD_NUMBER(offsetof(struct simulate_keys, accuracy), "accuracy", a_number, positive,
                 "global error allowed, relative to the size of the motion, instead of a tolerance"),
    FIELD_CHOICE(offsetof(struct simulate_keys, method), "method", method_choices,
                 "name of the stepper, or `auto`"),
    FIELD_NUMBER(offsetof(struct simulate_keys, step), "step", a_time, positive,
                 "fixed step instead of an automatic one"),
    FIELD_NUMBER(offsetof(struct simulate_keys, every), "every", a_time, positive,
                 "the same as `output: {every: ...}`"),
    FIELD_CHOICE(offsetof(struct simulate_keys, impacts), "impacts", impact_choices,
                 "several impacts at one instant"),
    FIELD_NODE(offsetof(struct simulate_keys, output), "output", field_map, 0, &output_group,
               "what a run writes"),
    FIELD_ENTRIES(offsetof(struct simulate_keys, events), "events", field_any, 0, each_group, &event_group,
                  "instants to find: a list of conditions"),
};

const struct group simulate_group = {"`simulate`", NULL, FIELDS(simulate_fields), NULL, 0, "how to run"};

static const struct choice directions[] = {
    {"both", 0, "whenever the two sides are equal"},
    {"rising", 1, "when left minus right grows through zero"},
    {"falling", -1, "when left minus right falls through zero"},
};

static const struct choice outcomes[] = {
    {"go_on", event_goes_on, "log the event and continue"},
    {"stop", event_stops, "end the run there"},
};

static const struct field event_fields[] = {
    FIELD_NAME(offsetof(struct event_keys, name), "name", "name of the event in the report"),
    FIELD_NODE(offsetof(struct event_keys, when), "when", field_scalar, required, NULL,
               "an expression that passes zero, or two sides with `=`, `<` or `>`"),
    FIELD_CHOICE(offsetof(struct event_keys, direction), "direction", directions,
                 "direction of the crossing"),
    FIELD_CHOICE(offsetof(struct event_keys, then), "then", outcomes, "action at the event; default go_on"),
    FIELD_FLAG(offsetof(struct event_keys, stop), "stop", "true: the same as `then: stop`"),
};

const struct group event_group = {"an event", "when", FIELDS(event_fields), NULL, 0, "an instant to find"};

static const struct field hand_fields[] = {
    FIELD_NODE(offsetof(struct hand_keys, equation), "equation", field_scalar, 0, NULL, "left = right"),
    FIELD_NODE(offsetof(struct hand_keys, conserved), "conserved", field_scalar, 0, NULL,
               "in place of an equation: an expression that keeps its value during a run"),
    FIELD_NODE(offsetof(struct hand_keys, when), "when", field_scalar, 0, NULL,
               "a condition: the states at which the equation is to hold"),
    FIELD_NODE(offsetof(struct hand_keys, about), "about", field_scalar, 0, NULL,
               "the point about which it has moments: of the body, `G`, of the ground, or a joint"),
    FIELD_NODE(
        offsetof(struct hand_keys, impact), "impact", field_scalar, 0, NULL,
        "the contact or rope at whose impacts an equation with `before` and `after` holds; default all"),
};

const struct group hand_group = {
    "a derivation", "equation", FIELDS(hand_fields),
    NULL,           0,          "an equation derived by hand, to be compared with the assembled ones"};

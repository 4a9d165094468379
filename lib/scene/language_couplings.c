/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/couplings.h"
#include "scene/language.h"
#include "scene/usual_words.h"

#define COUPLING(member) offsetof(struct coupling_keys, member)

/* The key of every coupling. */
static const struct field name_fields[] = {
    FIELD_NAME(COUPLING(name), "name", "its name in all output; default its kind"),
};
static const struct group named = {"a coupling", NULL, FIELDS(name_fields), NULL, 0, "with a name"};

/* The keys of every constraint. */
#define UNTIL_ROW                                                                                            \
    FIELD_NODE(COUPLING(until), "until", field_scalar, 0, NULL,                                              \
               "the condition at which it ends, as `tension > 500 N` or `t > 2 s`; default never")

static const struct field until_fields[] = {UNTIL_ROW};
static const struct field since_fields[] = {
    FIELD_NODE(COUPLING(since), "from", field_scalar, 0, NULL,
               "the condition at which it begins, as `t > 2 s`; default from the start"),
    UNTIL_ROW,
};
static const struct group ending = {"a coupling", NULL, FIELDS(until_fields), &named, 0, "which may end"};
static const struct group beginning = {"a coupling", NULL, FIELDS(since_fields),
                                       &named,       0,    "which may begin and end"};

#define BETWEEN_ROW                                                                                          \
    FIELD_ENTRIES(COUPLING(between), "between", field_list, required, each_word, NULL,                       \
                  "its two ends: body.point, ground.point or, for the centre of mass, a body")

#define CONSTRAINT_GROUP(title, table, doc)                                                                  \
    {                                                                                                        \
        title, NULL, FIELDS(table), &ending, 0, doc                                                          \
    }
#define BEGINNING_GROUP(title, table, doc)                                                                   \
    {                                                                                                        \
        title, NULL, FIELDS(table), &beginning, 0, doc                                                       \
    }

static const struct field spring_fields[] = {
    BETWEEN_ROW,
    FIELD_NUMBER(COUPLING(stiffness), "stiffness", a_stiffness, required | not_negative | stored,
                 "force per length"),
    FIELD_NUMBER(COUPLING(free_length), "free_length", a_length, not_negative | stored,
                 "length without force; default 0"),
};
static const struct group spring_group =
    BEGINNING_GROUP("a spring", spring_fields, "a linear spring between two points");

static const struct field damper_fields[] = {
    BETWEEN_ROW,
    FIELD_NUMBER(COUPLING(coefficient), "coefficient", a_damping, required | not_negative | stored,
                 "force per velocity"),
};
static const struct group damper_group =
    BEGINNING_GROUP("a damper", damper_fields, "a linear damper between two points");

static const struct field actuator_fields[] = {
    FIELD_ENTRIES(
        COUPLING(between), "between", field_list, required, each_word, NULL,
        "of a moment two bodies, the second one also `ground`; of a force two points as for a spring"),
    FIELD_VALUE(COUPLING(moment), "moment", a_moment, stored,
                "on the first body, counter-clockwise; its opposite acts on the second"),
    FIELD_NODE(COUPLING(force), "force", field_scalar, 0, NULL,
               "on the line of both points: above zero it pulls them together, below zero it pushes them "
               "apart; it may name their `distance`"),
    FIELD_NUMBER(COUPLING(along), "along", an_angle, 0,
                 "of a force at the first point: its direction in the frame of the second body, in place of "
                 "the line of the points"),
};
static const struct group actuator_group =
    BEGINNING_GROUP("an actuator", actuator_fields,
                    "a motor or cylinder: a given moment or force between two bodies");

static const struct law actuator_law = {.effect = "actuator",
                                        .written_as_c = true,
                                        .drawing = "applied",
                                        .work = "counted as work: a given force between two bodies",
                                        .between = "on one of two bodies, its opposite on the other"};

static const struct field pin_fields[] = {BETWEEN_ROW};
static const struct group pin_group = BEGINNING_GROUP("a pin", pin_fields, "holds two points together");

static const struct group weld_group =
    BEGINNING_GROUP("a weld", pin_fields,
                    "a body stays as it is relative to another one, in place and angle");

static const struct field rod_fields[] = {
    BETWEEN_ROW,
    FIELD_NUMBER(COUPLING(length), "length", a_length, positive | stored,
                 "distance; default that at the start"),
};
static const struct group rod_group =
    BEGINNING_GROUP("a rod", rod_fields, "massless: keeps two points at their distance");

static const struct field gear_fields[] = {
    FIELD_ENTRIES(COUPLING(between), "between", field_list, required, each_word, NULL,
                  "two bodies that turn"),
    FIELD_ENTRIES(COUPLING(radii), "radii", field_list, 0, each_number, NULL,
                  "their pitch radii; default those of their shapes"),
    FIELD_FLAG(COUPLING(inside), "inside", "true: the first turns inside the second, a ring"),
    FIELD_NUMBER(COUPLING(efficiency), "efficiency", a_number, positive,
                 "power at the second over that of the first while the first drives, at most 1; default 1"),
};
static const struct group gear_group =
    BEGINNING_GROUP("a gear", gear_fields, "two pitch circles that roll on each other without slip");

static const struct field ratio_fields[] = {
    FIELD_PLAIN("body.coordinate", field_terms, a_number, 0, 0,
                "the factor of that coordinate; of an angle among lengths a length, as `wheel.theta: 0.2 m`"),
};
static const struct group ratio_group =
    BEGINNING_GROUP("a ratio", ratio_fields,
                    "coordinates in proportion: the sum of factor times rate is zero");

static const struct field rope_fields[] = {
    FIELD_ENTRIES(COUPLING(through), "through", field_list, required, each_word, NULL,
                  "its path: ends and points as in `between`; a disc that turns is a pulley"),
    FIELD_VALUE(COUPLING(reel), "length", a_length, positive,
                "its length, also as an expression of t; default taut at the start"),
    FIELD_ENTRIES(COUPLING(wound), "wound", field_any, 0, each_group, &wound_group,
                  "the disc at an end of it that it is wound on"),
    FIELD_NODE(COUPLING(around), "around", field_map, 0, &around_group, "the drum on which it has friction"),
};
static const struct group rope_group = BEGINNING_GROUP("a rope", rope_fields, "inextensible and massless");

static const struct field belt_fields[] = {
    FIELD_ENTRIES(COUPLING(between), "between", field_list, required, each_word, NULL,
                  "two bodies that turn"),
    FIELD_ENTRIES(COUPLING(radii), "radii", field_list, 0, each_number, NULL,
                  "of the discs; default those of their shapes"),
    FIELD_FLAG(COUPLING(crossed), "crossed",
               "true: it crosses itself, and the discs turn against each other"),
    FIELD_NUMBER(COUPLING(tension), "tension", a_force, positive | stored,
                 "of both strands while it drives nothing, where the axes keep their distance"),
};
static const struct group belt_group =
    CONSTRAINT_GROUP("a belt", belt_fields, "round two discs that it takes along without slip");

static const struct field roll_fields[] = {
    FIELD_NODE(COUPLING(body), "body", field_scalar, required, NULL, "the body that rolls"),
    FIELD_NODE(COUPLING(on), "on", field_scalar, required, NULL,
               "the line that it rolls on: of the ground, or a body on a slide"),
    FIELD_NUMBER(COUPLING(radius), "radius", a_length, positive, "its radius; default that of its shape"),
    FIELD_NODE(
        COUPLING(center), "center", field_any, 0, NULL,
        "centre of its circle: a point of the body, a name or [x, y]; default that of its round shape, "
        "without one G"),
    FIELD_VALUE(COUPLING(mu_s), "static", a_number, not_negative | slips_not | stored,
                "coefficient of static friction"),
    FIELD_VALUE(COUPLING(mu_k), "kinetic", a_number, not_negative | slips | stored,
                "coefficient of kinetic friction"),
    FIELD_VALUE(COUPLING(surface_speed), "surface_speed", a_velocity, stored,
                "of the surface along the line, as of a conveyor belt; an expression of t; default 0"),
    FIELD_VALUE(COUPLING(resistance), "rolling_resistance", a_length, not_negative | stored,
                "its arm b: a moment of at most b N against rolling; default 0"),
};
static const struct group roll_group =
    CONSTRAINT_GROUP("`roll`", roll_fields, "a round body on a line; without coefficients it never slips");

static const struct field rack_fields[] = {
    FIELD_ENTRIES(COUPLING(between), "between", field_list, required, each_word, NULL,
                  "a body that turns, and one whose x axis is the rack"),
    FIELD_NUMBER(COUPLING(radius), "radius", a_length, positive, "pitch radius; default that of its shape"),
};
static const struct group rack_group =
    BEGINNING_GROUP("a rack", rack_fields, "a pitch circle and a line that move along together");

static const struct choice slot_sides[] = {
    {"left", 1, "to the left of growing length"},
    {"right", -1, "to its right"},
};

static const struct field slot_fields[] = {
    FIELD_ENTRIES(
        COUPLING(between), "between", field_list, required, each_word, NULL,
        "the point that is guided, and the body that the slot is in: through its origin, or a point of it"),
    FIELD_NUMBER(COUPLING(along), "along", an_angle, 0, "direction of a straight one; default the x axis"),
    FIELD_NODE(COUPLING(x), "x", field_scalar, 0, NULL, "of a curve: x as an expression of p"),
    FIELD_NODE(COUPLING(y), "y", field_scalar, 0, NULL, "of a curve: y as an expression of p, or of x"),
    FIELD_NODE(COUPLING(from), "from", field_scalar, 0, NULL,
               "p, or x, where it begins; of a straight one the length"),
    FIELD_NODE(COUPLING(to), "to", field_scalar, 0, NULL, "where it ends"),
    FIELD_FLAG(COUPLING(closed), "closed", "true: the ends of the curve meet, as those of a cam"),
    FIELD_CHOICE(COUPLING(side), "side", slot_sides,
                 "the side on which the point lies and from which it may lift off; default: guided on both"),
    FIELD_NUMBER(COUPLING(radius), "radius", a_length, positive,
                 "of a roller about the point, which rolls on that side without friction"),
    FIELD_VALUE(COUPLING(mu_s), "static", a_number, not_negative | slips_not | stored,
                "coefficient of static friction; default that of kinetic friction"),
    FIELD_VALUE(COUPLING(mu_k), "kinetic", a_number, not_negative | slips | stored,
                "coefficient of kinetic friction; default that of static friction"),
};
static const struct group slot_group =
    CONSTRAINT_GROUP("a slot", slot_fields, "a point of a body stays on a line or curve of another one");

static const struct field plane_fields[] = {
    FIELD_NODE(COUPLING(body), "body", field_scalar, required, NULL, "the body that lies on the plane"),
    FIELD_NODE(COUPLING(on), "on", field_scalar, 0, NULL,
               "the body whose upper face is the plane, as a turntable or a belt; default the ground"),
    FIELD_NODE(COUPLING(at), "at", field_any, 0, NULL,
               "the point of the body that it rests on, a name or [x, y]; default G"),
    FIELD_ENTRIES(COUPLING(points), "points", field_list, 0, each_point, NULL,
                  "two or three points that it rests on, which share the weight by equilibrium"),
    FIELD_VALUE(COUPLING(mu_s), "static", a_number, not_negative | stored,
                "coefficient of static friction; default that of kinetic friction"),
    FIELD_VALUE(COUPLING(mu_k), "kinetic", a_number, not_negative | stored,
                "coefficient of kinetic friction; default that of static friction"),
    FIELD_VALUE(COUPLING(normal), "normal", a_force, not_negative | stored,
                "force of the body on the plane, at its center of mass where it has `points`; default its "
                "weight m g, with `plane: horizontal`"),
};
static const struct group plane_group =
    CONSTRAINT_GROUP("`plane_friction`", plane_fields,
                     "friction of a body on a horizontal plane, seen from above");

static const struct choice laws[] = {
    {"stronge", 0, "the work of restitution is e^2 times that of compression"},
    {"poisson", 1, "the impulse of restitution is e times that of compression"},
    {"newton", 2, "the normal velocity after is -e times that before"},
    {"moreau", 3, "the same, with the friction of the velocity after"},
};

static const struct choice contact_sides[] = {
    {"start", contact_side_start, "where it is at the start"},
    {"up", contact_side_up, "the side of the line that is up"},
    {"left", contact_side_left, "to the left of the direction of the line"},
    {"right", contact_side_right, "to its right"},
};

static const struct field contact_fields[] = {
    FIELD_NAME(COUPLING(name), "name", "its name in all output; default `contact`"),
    FIELD_ENTRIES(COUPLING(between), "between", field_list, 0, each_word, NULL,
                  "a body or body.point, and its partner: the same of another body, or a line, polygon or "
                  "point of the ground"),
    FIELD_ENTRIES(COUPLING(among), "among", field_any, 0, each_word, NULL,
                  "instead of `between`: all pairs of a list of bodies, lines and polygons of the ground; or "
                  "`all`, of all of them"),
    FIELD_VALUE(COUPLING(restitution), "restitution", a_number, not_negative | stored,
                "e of an impact, 0 to 1; may depend on the approach speed, `approach`; default 0"),
    FIELD_VALUE(COUPLING(mu_s), "static", a_number, not_negative | stored,
                "coefficient of static friction; default that of kinetic friction"),
    FIELD_VALUE(COUPLING(mu_k), "kinetic", a_number, not_negative | stored,
                "coefficient of kinetic friction; default that of static friction"),
    FIELD_CHOICE(COUPLING(law), "law", laws, "the law of impact, which defines e"),
    FIELD_CHOICE(COUPLING(side), "side", contact_sides,
                 "with a line of the ground: the side of it on which the body stays; default `start`"),
    FIELD_VALUE(COUPLING(surface_speed), "surface_speed", a_velocity, stored,
                "of the surface of the partner: of a line along it, of a polygon or body counter-clockwise "
                "round it; an expression of t; default 0"),
    UNTIL_ROW,
};
const struct group contact_group = {"a contact", "among", FIELDS(contact_fields),
                                    NULL,        0,       "two bodies, or a body and the ground, that meet"};

static const struct kind kinds[] = {
    {"spring", load_spring, &spring_group, ~0u, NULL, NULL},
    {"damper", load_damper, &damper_group, ~0u, NULL, NULL},
    {"actuator", load_actuator, &actuator_group, ~0u, NULL, &actuator_law},
    {"pin", coupling_constraint + constraint_pin, &pin_group, ~0u, NULL, NULL},
    {"weld", coupling_constraint + constraint_weld, &weld_group, ~0u, NULL, NULL},
    {"rod", coupling_constraint + constraint_rod, &rod_group, ~0u, NULL, NULL},
    {"rope", coupling_constraint + constraint_rope, &rope_group, ~0u, NULL, NULL},
    {"gear", coupling_constraint + constraint_gear, &gear_group, ~0u, NULL, NULL},
    {"belt", coupling_constraint + constraint_belt, &belt_group, ~0u, NULL, NULL},
    {"rack", coupling_constraint + constraint_rack, &rack_group, ~0u, NULL, NULL},
    {"ratio", coupling_constraint + constraint_ratio, &ratio_group, ~0u, NULL, NULL},
    {"roll", coupling_constraint + constraint_roll, &roll_group, ~0u, NULL, NULL},
    {"slot", coupling_constraint + constraint_slot, &slot_group, ~0u, NULL, NULL},
    {"plane_friction", coupling_constraint + constraint_plane, &plane_group, ~0u, NULL, NULL},
    {"contact", coupling_constraint + constraint_contact, &contact_group, ~0u, NULL, NULL},
};

const struct kind *const contact_kind = &kinds[sizeof kinds / sizeof *kinds - 1];

const struct kinds coupling_kinds = {"coupling", FIELDS(kinds), usual_couplings, kinds_in_list};

/* clang-format off */
const struct constraint_law constraint_laws[constraint_kinds] = {
    [constraint_pin] = {
        .read = points_read, .drawing = "pin", .letters = {"R", "R"},
        .words = "pin: two points are one",
        .not_as_c = "a pin closes a loop, whose forces are found together with the accelerations",
        .rows = 2, .row_names = {{"", " in x"}, {"", " in y"}}},
    [constraint_weld] = {
        .read = points_read, .drawing = "weld", .letters = {"R", "R"},
        .words = "weld: a body stays as it is relative to another one",
        .not_as_c = "a weld closes a loop, whose forces are found together with the accelerations",
        .rows = 3, .row_names = {{"", " in x"}, {"", " in y"}, {"", " (couple)"}}},
    [constraint_rod] = {
        .read = points_read, .drawing = "rod", .letters = {"S"},
        .words = "rod: two points keep their distance",
        .not_as_c = "a rod closes a loop, whose force is found together with the accelerations",
        .rows = 1, .length = true},
    [constraint_gear] = {
        .read = wheels_read, .drawing = "gear", .letters = {"F"},
        .words = "gear: two circles roll on each other",
        .not_as_c = "a gear is a constraint beside the joints",
        .rows = 1},
    [constraint_rack] = {
        .read = rack_read, .drawing = "rack", .letters = {"F"},
        .words = "rack: a circle and a line move along together",
        .not_as_c = "a rack is a constraint beside the joints",
        .rows = 1, .line = true},
    [constraint_ratio] = {
        .read = ratio_read, .drawing = "ratio", .letters = {"F"},
        .words = "ratio: a sum of coordinates, each times its factor, stays constant",
        .not_as_c = "a ratio is a constraint beside the joints",
        .rows = 1},
    [constraint_roll] = {
        .read = roll_read, .drawing = "roll", .letters = {"N", "f"},
        .words = "roll: a circle on a line",
        .not_as_c = "rolling is a constraint beside the joints",
        .rows = 2, .row_names = {{"", ".normal"}, {"", ".friction"}}, .end_names = {".normal", ".friction"},
        .surface = true, .line = true,
        .load = always_load, .load_kind = load_normal, .load_name = ".friction"},
    [constraint_resistance] = {
        .drawing = "roll", .letters = {"M"},
        .words = "rolling resistance: a moment against rolling, at most its arm times the normal force; or friction of a "
                 "gear: at most its arm times the force of the teeth",
        .not_as_c = "rolling is a constraint beside the joints",
        .rows = 1,
        .load = always_load, .load_kind = load_normal},
    [constraint_slot] = {
        .read = slot_read, .drawing = "slot", .letters = {"N"},
        .words = "slot: a point stays on a line or curve of another body",
        .not_as_c = "a slot is a constraint beside the joints",
        .rows = 1, .line = true,
        .load = load_if_it_presses, .load_kind = load_contact},
    [constraint_groove] = {
        .read = slot_read, .drawing = "slot", .letters = {"N", "f"},
        .words = "slot with friction: a point stays on a line or curve of another body, sticks or slips",
        .not_as_c = "a slot is a constraint beside the joints",
        .rows = 2, .row_names = {{"", ".normal"}, {"", ".friction"}}, .end_names = {".normal", ".friction"},
        .surface = true, .line = true,
        .load = always_load, .load_kind = load_normal, .load_name = ".friction"},
    [constraint_belt] = {
        .read = wheels_read, .drawing = "belt", .letters = {"T", "T"},
        .words = "belt: two discs turn together; its length, where the axes move",
        .not_as_c = "a belt is a constraint beside the joints",
        .rows = 2, .row_names = {{NULL, NULL}, {"length of ", ""}}, .end_names = {".right", ".left"},
        .strands = true, .way = true,
        .load = always_load, .load_kind = load_belt},
    [constraint_capstan] = {
        .read = rope_read, .drawing = "rope", .letters = {"T", "T"},
        .words = "rope with friction: its path has constant length, and it sticks to its drum or slips",
        .not_as_c = "a rope with friction on a drum is a constraint beside the joints, and sticks",
        .rows = 2, .row_names = {{NULL, NULL}, {"", ".friction"}},
        .surface = true, .strands = true, .way = true,
        .load = always_load, .load_kind = load_normal},
    [constraint_rope] = {
        .read = rope_read, .drawing = "rope", .letters = {"T"},
        .words = "rope: its path has constant length while it is taut",
        .not_as_c = "a rope is a constraint beside the joints, and goes slack",
        .rows = 1, .way = true, .length = true,
        .load = always_load, .load_kind = load_rope},
    [constraint_plane] = {
        .read = plane_read, .drawing = "plane", .letters = {"f", "f"},
        .words = "friction on a plane: a point sticks to it or slips, with a force in any direction",
        .not_as_c = "friction on a plane sticks as a constraint beside the joints",
        .rows = 2, .row_names = {{"", " along"}, {"", " across"}},
        .load = always_load, .load_kind = load_normal},
    [constraint_contact] = {
        .read = contact_read, .drawing = "contact", .letters = {"N", "f"},
        .not_as_c = "contacts and stops need impacts",
        .rows = 2, .row_names = {{"", ".normal"}, {"", ".friction"}}, .end_names = {".normal", ".friction"},
        .surface = true,
        .load = always_load, .load_kind = load_contact},
};
/* clang-format on */

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The laws of forces and moments: the entries of `forces` and `moments`, each as one row. To add one whose
 * force is a formula: its fields, a function that makes the formula (derive_value) and its row.
 */
#include "scene/language.h"
#include "scene/load_entry.h"
#include "scene/usual_words.h"

enum {
    on_slide = 1u << motion_slide,
    on_pivot = 1u << motion_pivot,
    on_planar = 1u << motion_planar,
    on_track = 1u << motion_track,
    on_moving = on_slide | on_pivot | on_planar | on_track | 1u << motion_particle,
    on_weld = 1u << motion_weld,
    on_all = on_moving | on_weld,
    on_turning = on_pivot | on_planar,
};

#define LOAD(member) offsetof(struct load_keys, load.member)

/* `name`, which every load may have. */
static const struct field name_fields[] = {
    FIELD_NAME(offsetof(struct load_keys, name), "name", "its name in all output; default its kind"),
};
static const struct group named = {"a load", NULL, FIELDS(name_fields), NULL, 0, "anything with a name"};

/* The keys of a load that need not be there all the time. */
#define SINCE_ROW(key)                                                                                       \
    FIELD_NODE(offsetof(struct load_keys, since), key, field_scalar, 0, NULL,                                \
               "the condition at which it begins, as `t > 2 s`; default from the start")
#define UNTIL_ROW                                                                                            \
    FIELD_NODE(offsetof(struct load_keys, until), "until", field_scalar, 0, NULL,                            \
               "the condition at which it ends, as `tension > 500 N` or `t > 2 s`; default never")
static const struct field lifetime_fields[] = {SINCE_ROW("from"), UNTIL_ROW};
static const struct group passing = {"a load", NULL, FIELDS(lifetime_fields),
                                     &named,   0,    "which may begin and end"};

/* Those of a load along a line, whose `from` is a point. */
static const struct field spread_fields[] = {SINCE_ROW("since"), UNTIL_ROW};
static const struct group passing_spread = {"a load", NULL, FIELDS(spread_fields),
                                            &named,   0,    "which may begin and end"};

#define LOAD_GROUP(title, brief, table, doc)                                                                 \
    {                                                                                                        \
        title, brief, FIELDS(table), &named, 0, doc                                                          \
    }
#define PASSING_GROUP(title, brief, table, doc)                                                              \
    {                                                                                                        \
        title, brief, FIELDS(table), &passing, 0, doc                                                        \
    }
#define BARE_GROUP(title, doc)                                                                               \
    {                                                                                                        \
        title, NULL, NULL, 0, &named, 0, doc                                                                 \
    }

/* ---- forces */

static const struct choice sides[] = {
    {"up", side_up, "the side of the line that is up"},
    {"left", side_left, "to the left of +x"},
    {"right", side_right, "to the right of +x"},
};

static const struct choice frames[] = {
    {"world", frame_world, "directions stay as the body turns"},
    {"body", frame_body, "directions turn with the body; on a slide they are counted from +x"},
};

#define AT_ROW                                                                                               \
    FIELD_NODE(offsetof(struct load_keys, at), "at", field_any, 0, NULL,                                     \
               "point of the body: a name or [x, y]; default G")
#define TO_ROW                                                                                               \
    FIELD_NODE(offsetof(struct load_keys, to), "to", field_any, 0, NULL,                                     \
               "point of the ground: a name or [x, y]")

static const struct group gravity_group = BARE_GROUP("`gravity`", "the weight, at G");

static const struct field normal_fields[] = {
    FIELD_CHOICE(offsetof(struct load_keys, side), "side", sides,
                 "which side of the line the body is on; default up"),
    FIELD_FLAG(LOAD(two_sided), "two_sided", "true: a guide, which also pulls; contact is never lost"),
};
static const struct group normal_group =
    LOAD_GROUP("`normal`", NULL, normal_fields, "the force of the surface across a slide");

static const struct field friction_fields[] = {
    FIELD_VALUE(LOAD(mu_s), "static", a_number, not_negative | slips_not | stored,
                "coefficient of static friction"),
    FIELD_VALUE(LOAD(mu_k), "kinetic", a_number, not_negative | slips | stored,
                "coefficient of kinetic friction"),
    FIELD_VALUE(offsetof(struct load_keys, coefficient), "coefficient", a_number,
                not_negative | slips | stored, "both coefficients"),
    FIELD_VALUE(LOAD(surface_speed), "surface_speed", a_velocity, stored,
                "velocity of the surface along +x, as of a belt; default 0"),
};
static const struct group friction_group =
    LOAD_GROUP("`friction`", "coefficient", friction_fields, "dry friction on a slide with `normal`");

#define CONSERVATIVE_ROW                                                                                     \
    FIELD_FLAG(LOAD(conservative), "conservative",                                                           \
               "true: its work counts as potential energy, where it has one; default: as work")

static const struct field applied_fields[] = {
    FIELD_NODE(offsetof(struct load_keys, value), "value", field_any, 0, NULL,
               "its size along `angle` (on a slide: along +x), or a pair [fx, fy]"),
    FIELD_VALUE(LOAD(angle), "angle", an_angle, stored, "its direction, from the x axis of `frame`"),
    FIELD_VALUE(LOAD(fx), "fx", a_force, stored, "component along x"),
    FIELD_VALUE(LOAD(fy), "fy", a_force, stored, "component along y"),
    FIELD_NODE(offsetof(struct load_keys, toward), "toward", field_any, 0, NULL,
               "its direction: to a point of the ground ([x, y] or ground.P) or of another body (body.P), on "
               "which the reaction acts"),
    FIELD_CHOICE(offsetof(struct load_keys, frame), "frame", frames,
                 "what angle and components refer to; default world"),
    FIELD_NODE(offsetof(struct load_keys, at), "at", field_any, 0, &place_group,
               "point of the body, a name or [x, y], default G; or {point: ..., offset: [x, y]}, that far "
               "from it along the axes of the world"),
    CONSERVATIVE_ROW,
};
static const struct group applied_group =
    PASSING_GROUP("an applied force", "value", applied_fields, "a given force");

static const struct field distributed_fields[] = {
    FIELD_NODE(offsetof(struct load_keys, from), "from", field_any, required, NULL,
               "where it begins: a point of the body, a name or [x, y]"),
    FIELD_NODE(offsetof(struct load_keys, to), "to", field_any, required, NULL, "where it ends, likewise"),
    FIELD_NODE(
        offsetof(struct load_keys, value), "value", field_any, required, NULL,
        "force per length: an expression of `s`, the length from `from`, or a pair of its values at both "
        "ends"),
    FIELD_VALUE(LOAD(angle), "angle", an_angle, 0, "its direction, from the x axis of `frame`"),
    FIELD_CHOICE(offsetof(struct load_keys, frame), "frame", frames,
                 "what the angle refers to; default world"),
    FIELD_VALUE(offsetof(struct load_keys, factor), "factor", a_number, 0,
                "a factor of the whole load, such as `sin(w*t)`; default 1"),
};
static const struct group distributed_group = {
    "a distributed load", NULL, FIELDS(distributed_fields),
    &passing_spread,      0,    "a force per length along a line of the body"};

static const struct field spring_fields[] = {
    FIELD_NUMBER(LOAD(stiffness), "stiffness", a_stiffness, required | not_negative | stored,
                 "force per length"),
    FIELD_NUMBER(LOAD(free_length), "free_length", a_length, stored, "length without force; default 0"),
    FIELD_NUMBER(offsetof(struct load_keys, neutral), "neutral", a_length, stored,
                 "on a slide without `to`: the coordinate without force; default 0"),
    AT_ROW,
    TO_ROW,
};
static const struct group spring_group =
    PASSING_GROUP("a spring", "stiffness", spring_fields,
                  "a linear spring to a point of the ground, or along a slide");

static const struct field damper_fields[] = {
    FIELD_NUMBER(LOAD(coefficient), "coefficient", a_damping, required | not_negative | stored,
                 "force per velocity"),
    AT_ROW,
    TO_ROW,
};
static const struct group damper_group =
    PASSING_GROUP("a damper", "coefficient", damper_fields,
                  "a linear damper to a point of the ground, or along a slide");

static const struct field drag_fields[] = {
    FIELD_NUMBER(LOAD(linear), "linear", a_damping, not_negative | stored, "force per velocity"),
    FIELD_NUMBER(LOAD(quadratic), "quadratic", a_quadratic_drag, not_negative | stored,
                 "force per velocity squared"),
    FIELD_ENTRIES(offsetof(struct load_keys, wind), "wind", field_any, 0, each_pair, NULL,
                  "velocity of the air, [x, y]; default still air"),
    AT_ROW,
};
static const struct group drag_group =
    PASSING_GROUP("`drag`", NULL, drag_fields, "resistance against the velocity of a point through the air");

static const struct field thrust_fields[] = {
    FIELD_VALUE(offsetof(struct load_keys, exhaust), "exhaust", a_velocity, 0,
                "speed relative to the body at which mass leaves, against the direction of the thrust"),
    FIELD_VALUE(LOAD(angle), "angle", an_angle, 0, "direction of the thrust, from the x axis of `frame`"),
    FIELD_CHOICE(offsetof(struct load_keys, frame), "frame", frames,
                 "what the angle refers to; default world"),
    FIELD_NODE(offsetof(struct load_keys, velocity), "velocity", field_any, 0, NULL,
               "velocity in the world that mass has before it comes or after it has left: [vx, vy], on a "
               "slide of the ground along +x"),
    AT_ROW,
};
static const struct group thrust_group = PASSING_GROUP(
    "`thrust`", NULL, thrust_fields,
    "the thrust of mass that leaves or comes with a relative velocity, for a body of varying mass");

static const struct field power_fields[] = {
    FIELD_VALUE(LOAD(value), "value", a_power, required | stored,
                "above zero: in the direction of the motion"),
};
static const struct group power_group =
    PASSING_GROUP("`power`", "value", power_fields,
                  "a drive of given power: the force P/v, the moment P/omega");

/* f v = P, M omega = P: the formula divides by the rate, and the force is infinite where that is zero. The
 * rate has to be the velocity in the world, so that P is the power on the body. */
static bool power_finish(struct entry *entry)
{
    const struct value P = entry->keys.load.value;
    const bool turns = entry->keys.load.kind == moment_applied;
    if (!P.expr || !entry->motion) return P.expr != NULL;
    if (entry->motion->parent != ground_body) {
        entry_note(
            entry, "not-here", entry->chosen.at,
            "write it out: `applied: {value: P/v}`, of the velocity meant",
            "`power` acts on bodies that move on the ground: of two moving bodies there are two velocities");
        return false;
    }
    return derive_value(entry, "value", &P, a_power, turns ? "/omega" : "/v", turns ? a_moment : a_force,
                        &entry->keys.load.value);
}

static const struct field potential_fields[] = {
    FIELD_VALUE(LOAD(potential), "V", an_energy, required | stored,
                "potential energy, of the body's coordinates"),
};
static const struct group potential_group =
    PASSING_GROUP("`potential`", "V", potential_fields, "a force f = -dV/dx");

/* ---- across a slide */

static bool weight_across(const struct load *load, struct vec gravity, double along)
{
    const double aside = 1e-12; /* of g: the rounding of an angle */
    (void)load;
    return fabs(vec_cross(vec_unit(along), gravity)) > aside * vec_norm(gravity);
}

static bool applied_across(const struct load *load, struct vec gravity, double along)
{
    (void)gravity;
    (void)along;
    return load->angle.expr || load->fx.expr || load->fy.expr;
}

static bool link_across(const struct load *load, struct vec gravity, double along)
{
    (void)gravity;
    (void)along;
    return load->anchor.kind != point_absent;
}

static bool drag_across(const struct load *load, struct vec gravity, double along)
{
    (void)gravity;
    (void)along;
    return load_has_wind(load);
}

/* ---- the rows */

#define LAW(...) (&(const struct law){__VA_ARGS__})

static const char dissipates[] = "not conservative: it depends on velocity",
                  opposes[] = "not conservative: it opposes the motion in either direction";

static const struct kind forces[] = {
    {"gravity", load_gravity, &gravity_group, on_all, NULL,
     LAW(.effect = "gravity", .written_as_c = true, .drawing = "gravity", .letter = "m g", .rate = rate_never,
         .across = weight_across)},
    {"normal", load_normal, &normal_group, on_slide | on_track,
     "a surface belongs to a slide: motion: {slide: {along: 30 deg}}",
     LAW(.effect = "normal force", .written_as_c = true, .drawing = "reaction", .letter = "N",
         .place = acts_in_joint, .rate = rate_never, .follows = true, .finish = normal_finish)},
    {"friction", load_friction, &friction_group, on_slide | on_track,
     "dry friction of a surface belongs to a slide; a pivot has `friction` under `moments`",
     LAW(.effect = "dry friction", .written_as_c = true, .drawing = "friction", .letter = "f",
         .place = acts_in_joint, .work = opposes, .follows = true, .finish = friction_finish)},
    {"applied", load_applied, &applied_group, on_all, NULL,
     LAW(.effect = "applied force", .written_as_c = true, .drawing = "applied", .finish = applied_finish,
         .across = applied_across)},
    {"distributed", load_applied, &distributed_group, on_all, NULL,
     LAW(.effect = "applied force", .drawing = "applied", .finish = distributed_finish,
         .across = applied_across)},
    {"spring", load_spring, &spring_group, on_all, NULL,
     LAW(.effect = "spring", .written_as_c = true, .drawing = "spring", .letter = "F",
         .place = acts_in_joint_without_end, .rate = rate_never, .finish = link_finish,
         .formula = "-k (# - #0)", .centered = "-k #", .between = "k (l - l0) toward its end",
         .across = link_across)},
    {"damper", load_damper, &damper_group, on_all, NULL,
     LAW(.effect = "damper", .written_as_c = true, .drawing = "damper", .letter = "D", .work = dissipates,
         .place = acts_in_joint_without_end, .rate = rate_always, .finish = link_finish, .formula = "-c @",
         .between = "-c l' along its line", .across = link_across)},
    {"drag", load_drag, &drag_group, on_all, NULL,
     LAW(.effect = "drag", .written_as_c = true, .drawing = "damper", .letter = "D", .rate = rate_always,
         .finish = drag_finish, .across = drag_across)},
    {"potential", load_potential, &potential_group, on_moving, "list it where the coordinates are",
     LAW(.effect = "potential", .written_as_c = true, .drawing = "potential", .letter = "F",
         .place = acts_in_joint, .finish = potential_finish, .formula = "-dV/d#")},
    {"thrust", load_applied, &thrust_group, on_all, NULL,
     LAW(.effect = "thrust", .drawing = "applied", .rate = rate_always, .finish = thrust_finish,
         .work = "not conservative: it comes with the mass that does", .formula = "u_$ dm/dt",
         .across = applied_across)},
    {"power", load_applied, &power_group, on_slide | on_track,
     "a drive of given power goes along a slide; under `moments` it turns a pivot",
     LAW(.effect = "constant power", .written_as_c = true, .drawing = "applied", .finish = power_finish,
         .formula = "P/@", .singular = "which is P/v and infinite at rest (give it an initial velocity)")},
};

const struct kinds force_kinds = {"force", FIELDS(forces), usual_forces, kinds_in_list};

/* ---- moments */

static const struct field moment_applied_fields[] = {
    FIELD_VALUE(LOAD(value), "value", a_moment, required | stored, "counter-clockwise"),
    FIELD_NODE(offsetof(struct load_keys, at), "at", field_any, 0, NULL,
               "where it acts on the body: a name or [x, y]; for section forces (--cut) alone"),
    CONSERVATIVE_ROW,
};
static const struct group moment_applied_group =
    PASSING_GROUP("an applied moment", "value", moment_applied_fields, "a given moment");

/* Warn of a moment on a body that moves on another one, which is rarely meant to come from outside. */
static bool moment_applied_finish(struct entry *entry)
{
    const struct motion *motion = entry->motion;
    if (!motion || motion->parent == ground_body) return true;
    struct reader *reader = entry->reader;
    const char *body = reader->bodies->pairs[entry->body].key,
               *on = reader->bodies->pairs[motion->parent].key;
    diag_add(
        reader->errors, FBD_WARNING, "no-reaction", entry->chosen.at,
        diag_hint(reader->errors,
                  "a motor between the two is under `couplings`: `- actuator: {between: [%s, %s], moment: "
                  "...}`; where it does come from outside, `between: [%s, ground]`",
                  body, on, body),
        "this moment acts on `%s` from outside: it has no reaction on `%s`, on which that body moves", body,
        on);
    return true;
}

static const struct field moment_spring_fields[] = {
    FIELD_NUMBER(LOAD(stiffness), "stiffness", a_torsional_stiffness, required | not_negative | stored,
                 "moment per angle"),
    FIELD_NUMBER(offsetof(struct load_keys, neutral), "neutral", an_angle, stored,
                 "angle without moment; default 0"),
};
static const struct group moment_spring_group =
    PASSING_GROUP("a torsional spring", "stiffness", moment_spring_fields,
                  "a linear torsional spring to the ground");

static const struct field moment_damper_fields[] = {
    FIELD_NUMBER(LOAD(coefficient), "coefficient", a_torsional_damping, required | not_negative | stored,
                 "moment per angular velocity"),
};
static const struct group moment_damper_group =
    PASSING_GROUP("a torsional damper", "coefficient", moment_damper_fields,
                  "a linear torsional damper to the ground");

static const struct field moment_friction_fields[] = {
    FIELD_VALUE(LOAD(mu_s), "static", a_moment, not_negative | slips_not | stored,
                "largest friction moment of the bearing at rest"),
    FIELD_VALUE(LOAD(mu_k), "kinetic", a_moment, not_negative | slips | stored, "moment while it turns"),
    FIELD_VALUE(offsetof(struct load_keys, coefficient), "coefficient", a_moment,
                not_negative | slips | stored, "both"),
    FIELD_VALUE(LOAD(surface_speed), "surface_speed", an_angular_velocity, stored,
                "angular velocity of the bearing; default 0"),
    FIELD_VALUE(offsetof(struct load_keys, bearing), "bearing", a_number, not_negative,
                "coefficient mu of a journal bearing: a moment of at most mu r R, R the reaction of the pin"),
    FIELD_NUMBER(offsetof(struct load_keys, radius), "radius", a_length, positive,
                 "radius r of the journal, with `bearing`"),
};
static const struct group moment_friction_group =
    LOAD_GROUP("`friction`", "coefficient", moment_friction_fields, "dry friction of a bearing, as a moment");

static const struct group moment_potential_group =
    PASSING_GROUP("`potential`", "V", potential_fields, "a moment M = -dV/dtheta");

#define NO_TURNING "a slide and a particle do not turn: use `pivot` or `planar`"

static const struct kind moments[] = {
    {"applied", moment_applied, &moment_applied_group, on_turning | on_weld | on_track, NO_TURNING,
     LAW(.effect = "applied moment", .written_as_c = true, .drawing = "applied",
         .finish = moment_applied_finish)},
    {"spring", moment_spring, &moment_spring_group, on_turning, NO_TURNING,
     LAW(.effect = "spring (moment)", .written_as_c = true, .drawing = "spring", .letter = "M",
         .place = acts_in_joint, .rate = rate_never, .finish = moment_spring_finish, .formula = "-k (# - #0)",
         .centered = "-k #")},
    {"damper", moment_damper, &moment_damper_group, on_turning, NO_TURNING,
     LAW(.effect = "damper (moment)", .written_as_c = true, .drawing = "damper", .letter = "M",
         .work = dissipates, .place = acts_in_joint, .rate = rate_always, .formula = "-c @")},
    {"friction", moment_friction, &moment_friction_group, on_turning, NO_TURNING,
     LAW(.effect = "bearing friction", .written_as_c = true, .drawing = "friction", .letter = "M",
         .work = opposes, .place = acts_in_joint, .follows = true, .finish = friction_finish)},
    {"potential", moment_potential, &moment_potential_group, on_turning, NO_TURNING,
     LAW(.effect = "potential (moment)", .written_as_c = true, .drawing = "potential", .letter = "M",
         .place = acts_in_joint, .finish = potential_finish, .formula = "-dV/d#")},
    {"power", moment_applied, &power_group, on_pivot, "a drive of given power turns a pivot",
     LAW(.effect = "constant power", .written_as_c = true, .drawing = "applied", .finish = power_finish,
         .formula = "P/@",
         .singular = "which is P/omega and infinite at rest (give it an initial velocity)")},
};

const struct kinds moment_kinds = {"moment", FIELDS(moments), usual_moments, kinds_in_list};

/* ---- laws that are not listed */

static const struct {
    enum load_kind form;
    struct law law;
} others[] = {
    {load_drive,
     {.effect = "prescribed motion",
      .drawing = "applied",
      .letter = "F",
      .follows = true,
      .work = "not conservative: the force of the prescribed motion"}},
    {load_carried,
     {.effect = "mass that varies",
      .drawing = "applied",
      .letter = "F",
      .rate = rate_always,
      .follows = true,
      .work = "the kinetic energy that mass brings or takes at the speed of the body"}},
    {load_rope,
     {.effect = "rope",
      .drawing = "reaction",
      .letter = "T",
      .rate = rate_never,
      .follows = true,
      .of_constraint = true}},
    {load_contact,
     {.effect = "contact",
      .drawing = "reaction",
      .letter = "f",
      .follows = true,
      .of_constraint = true,
      .work = "not conservative: impacts and friction take energy"}},
    {load_belt,
     {.effect = "belt",
      .drawing = "reaction",
      .letter = "T",
      .rate = rate_never,
      .follows = true,
      .of_constraint = true,
      .work = "does no work: it passes it on"}},
};

const struct law *law_of_form(enum load_kind form)
{
    const struct kinds *const lists[] = {&force_kinds, &moment_kinds};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i].form == form) return &others[i].law;
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < lists[k]->count; i++)
            if (lists[k]->kinds[i].value == (int)form) return lists[k]->kinds[i].law;
    return NULL;
}

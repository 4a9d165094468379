/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The table of moments of inertia, the parallel-axis theorem, parts and holes, each through a small model
 * given as text (A06).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_view.h"
#include "gallery.h"

#include <string.h>

/* The inertia of a body that is `keys` (lines of YAML with an indentation of four) and moves as `motion`. */
static fbd_inertia inertia_of(const char *keys, const char *motion)
{
    char text[2048];
    snprintf(text, sizeof text, "fbd: 1\nbodies:\n  body:\n%s    motion: %s\n", keys, motion);
    struct trial trial = trial_parse(text);
    fbd_inertia inertia = fbd_model_inertia(trial.model, 0);
    trial_close(&trial);
    return inertia;
}

#define SPHERE "    shape: sphere\n    mass: 3 kg\n    radius: 0.2 m\n"
#define TUBE                                                                                                 \
    "    shape: hollow_cylinder\n    mass: 4 kg\n    outer_radius: 0.15 m\n    inner_radius: 0.1 m\n"        \
    "    length: 0.6 m\n"
#define PRISM "    shape: prism\n    mass: 6 kg\n    a: 0.5 m\n    b: 0.3 m\n    c: 0.2 m\n"
#define ROD   "    shape: rod\n    mass: 2 kg\n    length: 1.2 m\n"
#define DISC  "    shape: disc\n    mass: 8 kg\n    radius: 0.35 m\n"

/* A row of the table: about G, or about the pivot when there is one. */
static const struct {
    const char *reference, *keys, *motion;
    double mass;
} rows[] = {
    {"A06.sphere_G", SPHERE, "planar", 3},
    {"A06.point", "    mass: 1.5 kg\n    center: [0, -0.4 m]\n", "{pivot: {at: [0, 0]}}", 1.5},
    {"A06.hollow_x", TUBE, "planar", 4},
    {"A06.hollow_x", TUBE "    axis: x\n", "planar", 4},
    {"A06.hollow_yz", TUBE "    axis: y\n", "planar", 4},
    {"A06.hollow_yz", TUBE "    axis: z\n", "planar", 4},
    {"A06.prism_x", PRISM "    axis: x\n", "planar", 6},
    {"A06.prism_y", PRISM "    axis: y\n", "planar", 6},
    {"A06.prism_z", PRISM "    axis: z\n", "planar", 6},
    {"A06.prism_z", PRISM, "planar", 6},
    {"A06.rod_G", ROD, "planar", 2},
    {"A06.rod_G", ROD "    axis: y\n", "planar", 2},
    {"A06.rod_end", ROD, "{pivot: {at: [0, 0], point: left}}", 2},
    {"A06.rod_end", ROD, "{pivot: {at: [3 m, 1 m], point: right}}", 2},
    {"A06.disc_G", DISC, "planar", 8},
    {"A06.disc_G", DISC, "{pivot: {at: [0, 0], point: G}}", 8},
    {"A06.disc_rim", DISC, "{pivot: {at: [0, 0], point: [0, 0.35 m]}}", 8},
    {"A06.sphere_offset_0.5", SPHERE "    center: [0.3 m, -0.4 m]\n", "{pivot: {at: [0, 0]}}", 3},
    {"A06.prism_corner_z", PRISM, "{pivot: {at: [0, 0], point: [-0.25 m, 0.15 m]}}", 6},
};

static void every_row_of_the_table_holds_for_the_axis_that_faces_the_plane(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        fbd_inertia got = inertia_of(rows[i].keys, rows[i].motion);
        bool pivot = strstr(rows[i].motion, "pivot") != NULL;
        check_reference(&checks, rows[i].reference, pivot ? got.I_O : got.I_G);
        check_close(&checks, "mass", got.mass, rows[i].mass, 0);
    }
    check_covered(&checks, "A06.");
    checks_end(&checks);
}

/* A triangle of base b and height h: m (b^2 + h^2)/18 about G for a right angle, G at a third; a regular hexagon of side a:
 * 5 m a^2/12; corners in either order; a rectangle is a prism; a plate of an L is two rectangles. */
static void polygons_follow_their_formulas(void **unused)
{
    (void)unused;
    const double m = 3, b = 0.6, h = 0.4, a = 0.2, arithmetic = 1e-14;
    struct checks checks = {0};
    const fbd_inertia right =
        inertia_of("    shape: polygon\n    mass: 3 kg\n    corners: [[1, 2], [1.6, 2], [1, 2.4]]\n",
                   "planar");
    check_close(&checks, "triangle", right.I_G, m * (b * b + h * h) / 18, arithmetic);
    check_close(&checks, "G.x", right.G[0], 1 + b / 3, arithmetic);
    check_close(&checks, "G.y", right.G[1], 2 + h / 3, arithmetic);
    const fbd_inertia clockwise =
        inertia_of("    shape: polygon\n    mass: 3 kg\n    corners: [[1, 2.4], [1.6, 2], [1, 2]]\n",
                   "planar");
    check_close(&checks, "clockwise", clockwise.I_G, right.I_G, arithmetic);
    const fbd_inertia hexagon =
        inertia_of("    shape: polygon\n    mass: 3 kg\n    corners: [[0.2, 0], [0.1, 0.173205080756887729], "
                   "[-0.1, 0.173205080756887729], [-0.2, 0], [-0.1, -0.173205080756887729], "
                   "[0.1, -0.173205080756887729]]\n",
                   "planar");
    check_close(&checks, "hexagon", hexagon.I_G, 5 * m * a * a / 12, arithmetic);
    const fbd_inertia pivot =
        inertia_of("    shape: polygon\n    mass: 3 kg\n    corners: [[0, 0], [-0.3, -0.4], [0.3, -0.4]]\n",
                   "pivot");
    check_close(&checks, "about a corner", pivot.I_O, m * (b * b / 24 + h * h / 2), arithmetic);
    const fbd_inertia by_polygons = inertia_of(
        "    parts:\n"
        "      p: {shape: polygon, mass: 4 kg, corners: [[0, 0], [0.4, 0], [0.4, 0.1], [0, 0.1]]}\n"
        "      q: {shape: polygon, mass: 3 kg, corners: [[0, 0.1], [0.1, 0.1], [0.1, 0.4], [0, 0.4]]}\n",
        "planar");
    const fbd_inertia by_prisms =
        inertia_of("    parts:\n"
                   "      p: {shape: prism, mass: 4 kg, a: 0.4, b: 0.1, center: [0.2, 0.05]}\n"
                   "      q: {shape: prism, mass: 3 kg, a: 0.1, b: 0.3, center: [0.05, 0.25]}\n",
                   "planar");
    check_close(&checks, "an L", by_polygons.I_G, by_prisms.I_G, arithmetic);
    check_close(&checks, "its G", by_polygons.G[0], by_prisms.G[0], arithmetic);
    checks_end(&checks);
}

static void rings_and_cylinders_across_follow_their_formulas(void **unused)
{
    (void)unused;
    const double m = 4, R = 0.3, h = 0.9, arithmetic = 1e-14;
#define RING     "    shape: ring\n    mass: 4 kg\n    radius: 0.3 m\n"
#define CYLINDER "    shape: cylinder\n    mass: 4 kg\n    radius: 0.3 m\n    length: 0.9 m\n"
    const struct {
        const char *keys;
        double want;
    } shapes[] = {{RING, m * R * R},
                  {RING "    axis: y\n", m * R * R / 2},
                  {CYLINDER, m * R * R / 2},
                  {CYLINDER "    axis: z\n", m * (3 * R * R + h * h) / 12},
                  {ROD "    axis: x\n    center: [0, 1 m]\n", 0}};
    struct checks checks = {0};
    for (size_t i = 0; i < 4; i++)
        check_close(&checks, shapes[i].keys, inertia_of(shapes[i].keys, "planar").I_G, shapes[i].want,
                    arithmetic);
    /* A slender rod seen along its axis is a point; it can still swing about another one. */
    check_close(&checks, "rod along its axis", inertia_of(shapes[4].keys, "{pivot: {at: [0, 0]}}").I_O, 2,
                arithmetic);
    checks_end(&checks);
}

/* One body three ways: by its shape, by I_G, and by the moment of inertia about a point that is named, given
 * or on the pivot. */
static void an_inertia_may_be_stated_about_any_point(void **unused)
{
    (void)unused;
    static const char *const ways[] = {
        "    inertia: 0.24 kg*m^2\n",
        "    inertia: {value: 0.24 kg*m^2, about: G}\n",
        "    inertia: {value: 0.96 kg*m^2, about: end}\n    points: {end: [-0.6 m, 0]}\n",
        "    inertia: {value: 0.96 kg*m^2, about: [0.6 m, 0]}\n",
        "    inertia: {value: 0.96 kg*m^2, about: O}\n",
    };
    const double arithmetic = 1e-12; /* of differences such as 0.96 - 2 * 0.6^2 */
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        char keys[256];
        snprintf(keys, sizeof keys, "    mass: 2 kg\n%s", ways[i]);
        fbd_inertia got = inertia_of(keys, "{pivot: {at: [0, 0], point: [0, 0.6 m]}}");
        check_close(&checks, ways[i], got.I_G, 0.24, arithmetic);
        check_close(&checks, ways[i], got.I_O, 0.96, arithmetic);
        check_close(&checks, ways[i], got.L, 0.6, arithmetic);
    }
    checks_end(&checks);
}

/* m = sum m_k, m r_G = sum m_k r_k, I_G = sum (I_k + m_k |r_k - r_G|^2) */
static void parts_add_up_about_their_common_centre(void **unused)
{
    (void)unused;
    static const char keys[] = "    parts:\n"
                               "      bar: {shape: rod, mass: 1.5 kg, from: [0, 0], to: [0.8 m, 0.6 m]}\n"
                               "      ball: {shape: sphere, mass: 2 kg, radius: 0.1 m, center: [1 m, 0]}\n"
                               "      clip: {mass: 0.25 kg, center: [0, -0.5 m]}\n";
    const double m[] = {1.5, 2, 0.25}, x[] = {0.4, 1, 0}, y[] = {0.3, 0, -0.5};
    const double own[] = {1.5 * 1 / 12, 0.4 * 2 * 0.01, 0};
    double mass = 0, Gx = 0, Gy = 0, I_G = 0;
    for (int k = 0; k < 3; k++) mass += m[k], Gx += m[k] * x[k], Gy += m[k] * y[k];
    Gx /= mass, Gy /= mass;
    for (int k = 0; k < 3; k++)
        I_G += own[k] + m[k] * ((x[k] - Gx) * (x[k] - Gx) + (y[k] - Gy) * (y[k] - Gy));
    const double arithmetic = 1e-14;
    struct checks checks = {0};
    fbd_inertia got = inertia_of(keys, "planar");
    check_close(&checks, "mass", got.mass, mass, arithmetic);
    check_close(&checks, "G x", got.G[0], Gx, arithmetic);
    check_close(&checks, "G y", got.G[1], Gy, arithmetic);
    check_close(&checks, "I_G", got.I_G, I_G, arithmetic);
    got = inertia_of(keys, "{pivot: {at: [2 m, 0], point: ball.G}}");
    double L = hypot(1 - Gx, 0 - Gy);
    check_close(&checks, "L", got.L, L, arithmetic);
    check_close(&checks, "I_O", got.I_O, I_G + mass * L * L, arithmetic);
    checks_end(&checks);
}

static void a_body_cut_in_two_and_put_together_is_the_same(void **unused)
{
    (void)unused;
    static const char whole[] = "    shape: prism\n    mass: 6 kg\n    a: 0.5 m\n    b: 0.3 m\n";
    static const char halves[] =
        "    parts:\n"
        "      left: {shape: prism, mass: 2 kg, a: 0.5/3, b: 0.3 m, center: [-0.5/3, 0]}\n"
        "      right: {shape: prism, mass: 4 kg, a: 1/3, b: 0.3 m, center: [0.5/6, 0]}\n";
    const double arithmetic = 1e-14;
    struct checks checks = {0};
    fbd_inertia one = inertia_of(whole, "planar"), two = inertia_of(halves, "planar");
    check_close(&checks, "mass", two.mass, one.mass, arithmetic);
    check_close(&checks, "I_G", two.I_G, one.I_G, arithmetic);
    check_close(&checks, "G x", two.G[0], 0, arithmetic);
    checks_end(&checks);
}

/* A hollow cylinder is a cylinder with a hole of negative mass: m/(R_o^2 - R_i^2) per area. */
static void a_hole_is_a_part_of_negative_mass(void **unused)
{
    (void)unused;
    static const char keys[] = "    parts:\n"
                               "      full: {shape: disc, mass: 7.2 kg, radius: 0.15 m}\n"
                               "      hole: {shape: disc, mass: -3.2 kg, radius: 0.1 m}\n";
    const double arithmetic = 1e-14;
    struct checks checks = {0};
    fbd_inertia got = inertia_of(keys, "planar");
    check_close(&checks, "mass", got.mass, 4, arithmetic);
    check_reference(&checks, "A06.hollow_x", got.I_G);
    /* An eccentric hole moves G to the other side. */
    static const char eccentric[] = "    parts:\n"
                                    "      full: {shape: disc, mass: 5 kg, radius: 0.2 m}\n"
                                    "      hole: {shape: disc, mass: -0.8 kg, radius: 0.08 m, "
                                    "center: [0.1 m, 0]}\n";
    got = inertia_of(eccentric, "planar");
    double G = -0.8 * 0.1 / 4.2;
    double I_G = 5 * 0.04 / 2 + 5 * G * G - (0.8 * 0.0064 / 2 + 0.8 * (0.1 - G) * (0.1 - G));
    check_close(&checks, "mass", got.mass, 4.2, arithmetic);
    check_close(&checks, "G", got.G[0], G, arithmetic);
    check_close(&checks, "I_G", got.I_G, I_G, arithmetic);
    checks_end(&checks);
}

/* A turned part brings the same moment of inertia; its named ends turn with it. */
static void turning_a_part_moves_its_ends_and_no_inertia(void **unused)
{
    (void)unused;
    static const char keys[] = ROD "    angle: 90 deg\n    center: [0.25 m, 0]\n";
    const double arithmetic = 1e-14;
    struct checks checks = {0};
    fbd_inertia got = inertia_of(keys, "{pivot: {at: [0, 0], point: left}}");
    check_close(&checks, "I_G", got.I_G, 0.24, arithmetic);
    check_close(&checks, "I_O", got.I_O, 0.96, arithmetic);
    check_close(&checks, "G x", got.G[0], 0.25, arithmetic);
    got = inertia_of(keys, "{pivot: {at: [0, 0]}}"); /* about the origin of the body frame */
    check_close(&checks, "I_O", got.I_O, 0.24 + 2 * 0.0625, arithmetic);
    checks_end(&checks);
}

/* The same disc in slugs and feet: 1 slug ft^2 = 14.593902937206364 kg * 0.09290304 m^2. */
static void the_table_knows_no_units(void **unused)
{
    (void)unused;
    static const char text[] = "fbd: 1\nunits: US\nbodies:\n  disc:\n    shape: disc\n    mass: 8 kg\n"
                               "    radius: 35 cm\n    motion: planar\n";
    const double slug = 4.4482216152605 / 0.3048, foot = 0.3048;
    struct checks checks = {0};
    struct trial trial = trial_parse(text);
    double I_G = fbd_model_inertia(trial.model, 0).I_G;
    check_reference(&checks, "A06.disc_G", I_G * slug * foot * foot);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_of_the_table_holds_for_the_axis_that_faces_the_plane),
        cmocka_unit_test(polygons_follow_their_formulas),
        cmocka_unit_test(rings_and_cylinders_across_follow_their_formulas),
        cmocka_unit_test(an_inertia_may_be_stated_about_any_point),
        cmocka_unit_test(parts_add_up_about_their_common_centre),
        cmocka_unit_test(a_body_cut_in_two_and_put_together_is_the_same),
        cmocka_unit_test(a_hole_is_a_part_of_negative_mass),
        cmocka_unit_test(turning_a_part_moves_its_ends_and_no_inertia),
        cmocka_unit_test(the_table_knows_no_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The scenes in MuJoCo: its x axis to the right, z up, hinges about -y, so that angles are counter-clockwise. Its defaults,
 * Euler steps and soft constraints with a time constant of 20 ms or of two steps, whichever is longer, but elliptic
 * cones of friction, which are those of Coulomb's law. It has no coefficient of restitution: `bounce` is not computed.
 */
#include <mujoco/mujoco.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>

#include "scenes.h"

enum { most = 4000 }; /* characters of a scene */

/* Joints of a body that moves in the plane. */
#define PLANAR                                                                                               \
    "<joint type=\"slide\" axis=\"1 0 0\"/><joint type=\"slide\" axis=\"0 0 1\"/><joint type=\"hinge\" "     \
    "axis=\"0 -1 0\"/>"
#define HEAD                                                                                                 \
    "<mujoco><compiler angle=\"radian\"/><option gravity=\"0 0 -9.81\" timestep=\"%.17g\" "                  \
    "cone=\"elliptic\"/><worldbody>"

static void add(char text[most], const char *format, ...)
{
    size_t length = strlen(text);
    va_list values;
    va_start(values, format);
    vsnprintf(text + length, most - length, format, values);
    va_end(values);
}

/* The scene of this text, or NULL with a message. */
static mjModel *load(const char *text)
{
    char error[500] = "out of memory";
    mjVFS *files = malloc(sizeof *files);
    if (!files) return NULL;
    mj_defaultVFS(files);
    if (mj_makeEmptyFileVFS(files, "scene.xml", (int)strlen(text)) == 0)
        memcpy(files->filedata[files->nfile - 1], text, strlen(text));
    mjModel *model = mj_loadXML("scene.xml", files, error, sizeof error);
    if (!model) fprintf(stderr, "MuJoCo: %s\n", error);
    mj_deleteVFS(files);
    free(files);
    return model;
}

/* Step from these velocities to the end; the coordinates and velocities are put into q and v. Returns whether that was done. */
static bool run(const char *text, const struct scene *scene, const double *v0, double moment, double q[3],
                double v[3])
{
    mjModel *model = load(text);
    mjData *data = model ? mj_makeData(model) : NULL;
    if (!data) return false;
    if (v0) memcpy(data->qvel, v0, (size_t)model->nv * sizeof *v0);
    if (moment != 0) data->qfrc_applied[0] = moment;
    for (int n = scene_steps(scene); n > 0; n--) mj_step(model, data);
    memcpy(q, data->qpos, (size_t)model->nv * sizeof *q);
    memcpy(v, data->qvel, (size_t)model->nv * sizeof *v);
    mj_deleteData(data);
    mj_deleteModel(model);
    return true;
}

/* A plane through the origin at this angle. */
static void add_plane(char text[most], double angle, double mu)
{
    add(text, "<geom type=\"plane\" size=\"100 100 1\" euler=\"0 %.17g 0\" friction=\"%.17g 0 0\"/>", -angle,
        mu);
}

static int incline(const struct scene *scene, double result[4])
{
    double mu = scene->number[0], angle = scene->number[1], v0 = scene->number[2], q[3], v[3], c = cos(angle),
           s = sin(angle);
    char text[most] = "";
    add(text, HEAD, scene->h);
    add_plane(text, angle, mu);
    add(text, "<body pos=\"%.17g 0 %.17g\" euler=\"0 %.17g 0\">", -box_height / 2 * s, box_height / 2 * c,
        -angle);
    /* Joints in the axes of the body: along the slope, across it. */
    add(text,
        PLANAR "<geom type=\"box\" size=\"%.17g %.17g %.17g\" mass=\"%.17g\" friction=\"%.17g 0 "
               "0\"/></body></worldbody></mujoco>",
        box_length / 2, box_length / 2, box_height / 2, box_mass, mu);
    if (!run(text, scene, (double[]){v0, 0, 0}, 0, q, v)) return 0;
    result[0] = q[0];
    result[1] = v[0];
    return 2;
}

static int disc(const struct scene *scene, double result[4])
{
    double mu = scene->number[0], angle = scene->number[1], q[3], v[3],
           I = disc_mass * disc_radius * disc_radius / 2;
    char text[most] = "";
    add(text, HEAD, scene->h);
    add_plane(text, -angle, mu);
    add(text, "<body pos=\"%.17g 0 %.17g\" euler=\"0 %.17g 0\">", disc_radius * sin(angle),
        disc_radius * cos(angle), angle);
    add(text, "<inertial pos=\"0 0 0\" mass=\"%.17g\" diaginertia=\"%.17g %.17g %.17g\"/>", disc_mass, I, I,
        I);
    add(text,
        PLANAR "<geom type=\"sphere\" size=\"%.17g\" friction=\"%.17g 0 0\"/></body></worldbody></mujoco>",
        disc_radius, mu);
    if (!run(text, scene, NULL, 0, q, v)) return 0;
    result[0] = q[0];
    result[1] = v[0];
    result[2] = v[2];
    return 3;
}

static int bounce(const struct scene *scene, double result[4])
{
    (void)scene;
    (void)result;
    return 0;
}

static int rope(const struct scene *scene, double result[4])
{
    double q[3], v[3];
    char text[most] = "";
    add(text, HEAD "<site name=\"A\"/><body pos=\"%.17g 0 0\">", scene->h, rope_length);
    add(text, "<joint type=\"slide\" axis=\"1 0 0\"/><joint type=\"slide\" axis=\"0 0 1\"/>");
    add(text,
        "<inertial pos=\"0 0 0\" mass=\"%.17g\" diaginertia=\"1 1 1\"/><site "
        "name=\"bob\"/></body></worldbody>",
        bob_mass);
    add(text, "<tendon><spatial limited=\"true\" range=\"0 %.17g\">", rope_length);
    add(text, "<site site=\"A\"/><site site=\"bob\"/></spatial></tendon></mujoco>");
    if (!run(text, scene, (double[]){0, scene->number[0]}, 0, q, v)) return 0;
    result[0] = rope_length + q[0];
    result[1] = q[1];
    result[2] = v[0];
    result[3] = v[1];
    return 4;
}

/* A rod whose first end has this place in the frame that it is put into, turned by this angle in it; left open. */
static void add_bar(char text[most], int n, double x, double y, double angle)
{
    double l = bar_length[n], I = bar_mass[n] * l * l / 12;
    add(text, "<body name=\"bar%d\" pos=\"%.17g 0 %.17g\" euler=\"0 %.17g 0\">", n, x, y, -angle);
    add(text, "<inertial pos=\"%.17g 0 0\" mass=\"%.17g\" diaginertia=\"%.17g %.17g %.17g\"/>", l / 2,
        bar_mass[n], I / 2, I, I);
    add(text, "<joint type=\"hinge\" axis=\"0 -1 0\"/>");
}

static int fourbar(const struct scene *scene, double result[4])
{
    double q[3], v[3];
    char text[most] = "";
    add(text, HEAD, scene->h);
    add_bar(text, 0, 0, 0, bar_angle[0]);
    add_bar(text, 1, bar_length[0], 0, bar_angle[1] - bar_angle[0]);
    add(text, "</body></body>");
    add_bar(text, 2, bar_pivot, 0, bar_angle[2]);
    add(text,
        "</body></worldbody><equality><connect body1=\"bar1\" body2=\"bar2\" anchor=\"%.17g 0 "
        "0\"/></equality></mujoco>",
        bar_length[1]);
    if (!run(text, scene, NULL, bar_moment, q, v)) return 0;
    result[0] = bar_angle[0] + q[0];
    result[1] = v[0];
    result[2] = bar_angle[2] + q[2];
    result[3] = v[2];
    return 4;
}

int main(void)
{
    scene_run *const runs[] = {incline, disc, bounce, rope, fourbar};
    return scene_answer(runs);
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The chain in MuJoCo: the x axis to the right, z up, hinges about -y, so that angles are counter-clockwise.
 * Contacts, constraints, sensors and everything else that this chain does not need are switched off.
 */
#include <mujoco/mujoco.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"

struct chain {
    mjModel *model;
    mjData *data;
};

/* A rod of no thickness has the moment of inertia m l^2 / 12 about two axes; about its own MuJoCo wants what
 * is positive, and the plane does not ask for it. */
static const char head[] =
    "<mujoco><compiler angle=\"radian\"/><option gravity=\"0 0 -%.17g\" timestep=\"1e-3\"><flag "
    "constraint=\"disable\" equality=\"disable\" frictionloss=\"disable\" limit=\"disable\" "
    "contact=\"disable\" passive=\"disable\" clampctrl=\"disable\" warmstart=\"disable\" "
    "filterparent=\"disable\" actuation=\"disable\" refsafe=\"disable\"/></option><worldbody>";
static const char rod[] =
    "<body pos=\"0 0 %.17g\"><inertial pos=\"0 0 %.17g\" mass=\"%.17g\" diaginertia=\"%.17g %.17g 1e-4\"/>"
    "<joint type=\"hinge\" axis=\"0 -1 0\"/>";

/* Its XML reader takes some hundred elements inside each other: longer chains go on in another file. */
enum { rods_in_a_file = 64 };

static void file_name(int first, char *name, size_t size)
{
    snprintf(name, size, "from%d.xml", first);
}

/* The MJCF text of the rods from number `first` on; release it with free(). */
static char *text_of(int first, int n, size_t *length)
{
    char *text = NULL, next[32];
    FILE *file = open_memstream(&text, length);
    if (!file) return NULL;
    double m = CHAIN_MASS, l = CHAIN_LENGTH, I = m * l * l / 12;
    int end = first + rods_in_a_file < n ? first + rods_in_a_file : n;
    if (first == 0) fprintf(file, head, CHAIN_GRAVITY);
    if (first > 0) fputs("<mujoco>", file);
    for (int i = first; i < end; i++) fprintf(file, rod, i == 0 ? 0 : -l, -l / 2, m, I, I);
    file_name(end, next, sizeof next);
    if (end < n) fprintf(file, "<include file=\"%s\"/>", next);
    for (int i = first; i < end; i++) fputs("</body>", file);
    fputs(first == 0 ? "</worldbody></mujoco>" : "</mujoco>", file);
    fclose(file);
    return text;
}

static bool add_file(mjVFS *files, int first, int n)
{
    char name[32];
    size_t length;
    char *text = text_of(first, n, &length);
    file_name(first, name, sizeof name);
    bool added = text && mj_makeEmptyFileVFS(files, name, (int)length) == 0;
    if (added) memcpy(files->filedata[files->nfile - 1], text, length);
    free(text);
    return added;
}

static mjModel *load(int n)
{
    char name[32], error[500] = "out of memory";
    mjVFS *files = malloc(sizeof *files);
    if (!files) return NULL;
    mj_defaultVFS(files);
    bool added = true;
    for (int first = 0; added && first < n; first += rods_in_a_file) added = add_file(files, first, n);
    file_name(0, name, sizeof name);
    mjModel *model = added ? mj_loadXML(name, files, error, sizeof error) : NULL;
    if (!model) fprintf(stderr, "MuJoCo: %s\n", error);
    mj_deleteVFS(files);
    free(files);
    return model;
}

static void chain_close(void *data)
{
    struct chain *chain = data;
    if (!chain) return;
    mj_deleteData(chain->data);
    mj_deleteModel(chain->model);
    free(chain);
}

static void *chain_open(int n)
{
    struct chain *chain = calloc(1, sizeof *chain);
    if (chain) chain->model = load(n);
    if (chain && chain->model) chain->data = mj_makeData(chain->model);
    if (chain && chain->data) return chain;
    chain_close(chain);
    return NULL;
}

static void chain_rates(void *data, const double *y, double *dydt)
{
    struct chain *chain = data;
    size_t n = (size_t)chain->model->nv, size = n * sizeof *y;
    memcpy(chain->data->qpos, y, size);
    memcpy(chain->data->qvel, y + n, size);
    mj_forwardSkip(chain->model, chain->data, mjSTAGE_NONE, 1);
    memcpy(dydt, y + n, size);
    memcpy(dydt + n, chain->data->qacc, size);
}

const struct chain_solver chain_by_mujoco = {"MuJoCo", chain_open, chain_rates, chain_close};

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a time stepping that knows no events (moreau.h) and the library say of one random scene, side by side. cmocka.h comes
 * first.
 */
#ifndef FBD_TESTS_STEPPED_H
#define FBD_TESTS_STEPPED_H

#include <stdbool.h>
#include <stdint.h>

#include "gallery.h"
#include "written.h"

/* Coordinates and rates by the names of the model. */
enum { stepped_most = 30 };
struct stepped_values {
    int count;
    char name[stepped_most][24];
    double value[stepped_most];
    double scale[stepped_most]; /* by which a difference is multiplied: 0.1 s for a rate */
};

/* One more. */
void stepped_name(struct stepped_values *values, const char *owner, int number, const char *what,
                  double value, double scale);

/* Two runs of the stepping, one with half the steps, and one of the library. */
struct stepped_answers {
    struct stepped_values rough, fine, ours;
};

double stepped_doubt(const struct stepped_answers *answers);
bool stepped_agree(const struct stepped_answers *answers);

/* Beyond it the stepping itself is in doubt, and is no judge. */
static const double stepped_sensitive = 2e-3;

/* What the library says at its end, of what the stepping names. */
void stepped_ask(struct stepped_answers *answers, struct trial *trial);

/* Print what both say. */
void stepped_tell(const char *name, unsigned long long seed, const struct stepped_answers *answers);

/* A kind of random scene. */
struct stepped_kind {
    const char *
        name; /* of its variables: <name>=1000 tries so many, <name>_FIRST=100 begins there, <name>_SEED=17 tries one
                         and prints its model, <name>_STEPS is how many steps, <name>_UNTIL when to look */
    int scenes; /* as many are drawn (thorough.h) */
    void *scene;
    double *until; /* of the scene */
    void (*draw)(uint64_t seed, void *scene);
    void (*write)(const void *scene, struct written *text);
    struct stepped_values (*step)(void *scene, int steps);
};

/* Draw scenes as the environment says, and compare. */
void stepped_try(const struct stepped_kind *kind);

/* Each of these has to be compared, and to agree. */
void stepped_try_each(const struct stepped_kind *kind, const unsigned *seeds, int count);

#endif

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random scenes by seed.
 *
 * Sizes are of the order of one, so that a scene of a second is neither stiff nor chaotic, and rounding stays
 * rounding. Loops are closed by construction: the second point of a pin is put where the first one is,
 * lengths are those of the start, and velocities are brought onto all conditions by the independent assembly.
 * Rolling resistance is left out: its closed forms are in tests/unit/test_rolling_resistance.c.
 */
#ifndef CROSS_GENERATE_H
#define CROSS_GENERATE_H

#include "absolute.h"
#include "random.h"

/* What a scene is about. */
enum focus { any_scene, of_tracks, of_slots, of_windings, of_masses, of_rolls, of_spools, focus_count };

/* What may be in a scene. */
struct taste {
    enum focus focus;
    bool couplings, frictions, kinks;
    int least_bodies, most_bodies;
};

/* False when the seed leads to nothing that can be compared (no consistent start, ill-conditioned);
 * `absolute` is then of no use, else at its start, settled and solved. */
bool scene_generate(struct scene *scene, struct absolute *absolute, uint64_t seed, enum focus focus);

/* Velocities that fit; false when positions do not. `absolute` is at that start. */
bool scene_fit(struct scene *scene, struct absolute *absolute);

/* Start, settle and solve a scene as it is; false as above. */
bool scene_settle(const struct scene *scene, struct absolute *absolute);

/* generate_loads.c */
struct formula random_formula(struct random *random, const struct scene *scene, int body,
                              enum dimension dimension, double size, bool kinks);
/* Perhaps, of a body of one piece: before its loads. */
void random_mass(struct random *random, struct scene *scene, int body, const struct taste *taste);
void random_loads(struct random *random, struct scene *scene, int body, const struct taste *taste);
struct formula random_drive(struct random *random, enum dimension dimension);

void random_tables(struct random *random, struct scene *scene, bool kinks);
void random_states(struct random *random, struct scene *scene);

/* generate_couplings.c; `absolute` has the bodies so far at their start */
void random_coupling(struct random *random, struct scene *scene, const struct taste *taste);
int random_point(struct random *random, struct body *body);

/* generate.c */
/* A curve that is not closed, for a length of at least 3 to both sides of p = 0; or round. */
struct path random_path(struct random *random, bool closed);
struct body *random_body(struct random *random, struct scene *scene, enum motion motion, int on);
void random_disc(struct random *random, struct body *body, double radius);

#endif

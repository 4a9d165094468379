/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random ropes: over pulleys, wound on discs, round a drum that they rub on.
 */
#include <string.h>

#include "generate_parts.h"

/* A disc on an axis in the world, to be a pulley. */
static int add_pulley(struct random *random, struct scene *scene)
{
    struct body *body = random_body(random, scene, pivot, -1);
    double radius = random_between(random, 0.1, 0.4);
    random_disc(random, body, radius);
    body->point = (struct spot){.point = at_origin};
    return scene->body_count - 1;
}

static bool far_apart(const struct absolute *absolute, const struct coupling *rope_between)
{
    struct vec2 p[most_ends];
    for (int k = 0; k < rope_between->count; k++) {
        p[k] = end_world(absolute, &rope_between->end[k]);
        if (k > 0 && hypot(p[k].x - p[k - 1].x, p[k].y - p[k - 1].y) < 0.9) return false;
    }
    for (int k = 1; k + 1 < rope_between->count; k++) {
        if (!rope_between->end[k].pulley && !rope_between->rubs) continue;
        /* Nearly straight over a pulley: on which side it runs would be a matter of rounding. */
        double ax = p[k].x - p[k - 1].x, ay = p[k].y - p[k - 1].y;
        double bx = p[k + 1].x - p[k].x, by = p[k + 1].y - p[k].y;
        if (fabs(ax * by - ay * bx) < 0.2 * hypot(ax, ay) * hypot(bx, by)) return false;
    }
    return true;
}

/* Round a disc at that end, where it is clear on which side. */
static void wind(struct random *random, const struct absolute *absolute, struct coupling *coupling, int k)
{
    struct end *end = &coupling->end[k], before = *end;
    const struct piece *piece = end->body < 0 ? NULL : round_piece(&absolute->scene->body[end->body]);
    double margin;
    end->wound = end->pulley = true;
    end->radius = random_between(random, 0.05, 0.4);
    if (piece && piece->size[0] < 0.4 && random_chance(random, 0.5)) end->radius = 0;
    end->side = (enum wound_side)random_below(random, 4);
    wound_turn(absolute, coupling, k, &margin);
    /* In the file the first of two ends at one place is wound first. */
    const struct end *first = &coupling->end[0];
    bool same = k > 0 && first->body == end->body && first->at.point == end->at.point && !first->wound;
    if (!(margin > 0.2) || same) *end = before;
}

static void wind_spool(struct random *random, struct scene *scene, int spool, struct end other)
{
    struct coupling *coupling = add_coupling(scene, rope);
    struct absolute absolute;
    int k = random_below(random, 2);
    coupling->end[k] = (struct end){.body = spool, .at = {.point = at_G}};
    coupling->end[1 - k] = other;
    start(&absolute, scene);
    if (other.body != spool && far_apart(&absolute, coupling)) wind(random, &absolute, coupling, k);
    if (!coupling->end[k].wound) scene->coupling_count--;
}

/* The pin of a slot, or what is on a track. */
static struct end guided_end(struct random *random, struct scene *scene, const struct taste *taste)
{
    int before = scene->coupling_count;
    if (scene->coupling_count + 2 < most_couplings && random_chance(random, 0.4))
        add_slot(random, scene, taste);
    if (scene->coupling_count > before) return scene->coupling[before].end[0];
    if (scene->body_count == most_bodies || random_chance(random, 0.3))
        return random_end(random, scene, random_below(random, scene->body_count + 1) - 1);
    random_body(random, scene, track, -1);
    return random_end(random, scene, scene->body_count - 1);
}

/* Yo-yo and spool: a rope is wound on a disc that is free, or rolls on its line. */
void add_spool(struct random *random, struct scene *scene, const struct taste *taste)
{
    if (scene->body_count + 2 > most_bodies || scene->coupling_count + 3 > most_couplings) return;
    struct end end = guided_end(random, scene, taste);
    int spool = scene->body_count;
    if (random_chance(random, 0.5)) add_roll(random, scene, taste);
    if (scene->body_count == spool)
        random_disc(random, random_body(random, scene, planar, -1), random_between(random, 0.1, 0.4));
    wind_spool(random, scene, spool, end);
}

/* A pulley of two radii, with a rope wound on each of them. */
void add_steps(struct random *random, struct scene *scene)
{
    if (scene->body_count == most_bodies || scene->coupling_count + 2 > most_couplings) return;
    int before = scene->body_count, pulley = add_pulley(random, scene);
    for (int i = 0; i < 2; i++)
        wind_spool(random, scene, pulley, random_end(random, scene, random_below(random, before)));
}

/* Its length goes with the time, from what it is at the start; of a rope in pieces only by how much matters. */
static void reel(struct random *random, const struct absolute *absolute, struct coupling *coupling)
{
    coupling->reel = random_drive(random, dim_length);
    double length = straight_way(absolute, coupling) - formula_value(absolute, &coupling->reel);
    coupling->reel.summand[coupling->reel.count] = constant_formula(dim_length, length).summand[0];
    coupling->reel.count++;
    coupling->reels = true;
}

void add_rope(struct random *random, struct scene *scene)
{
    int before = scene->body_count, count = 2 + random_below(random, 3);
    int pulley =
        count > 2 && before < most_bodies && random_chance(random, 0.6) ? add_pulley(random, scene) : -1;
    struct coupling *coupling = add_coupling(scene, rope);
    struct absolute absolute;
    coupling->count = count;
    int last = -2;
    bool moves = false;
    for (int k = 0; k < count; k++) {
        int b = random_below(random, before + 1) - 1;
        if (b == last || (k == 0 && b < 0)) b = b == 0 ? -1 : b < 0 ? 0 : b - 1;
        coupling->end[k] = random_end(random, scene, b);
        if (pulley >= 0 && k == count / 2)
            coupling->end[k] = (struct end){.body = pulley, .at = {.point = at_G}, .pulley = true};
        else if (k > 0 && k + 1 < count && b >= 0 && coupling->end[k].at.point == at_G)
            coupling->end[k].at.point = random_point(random, &scene->body[b]);
        last = coupling->end[k].body;
        moves |= last >= 0;
    }
    for (int k = 1; k < count; k++) moves &= coupling->end[k].body != coupling->end[k - 1].body;
    start(&absolute, scene);
    if (moves && far_apart(&absolute, coupling)) {
        for (int k = 0; k < count; k += count - 1)
            if (random_chance(random, 0.3)) wind(random, &absolute, coupling, k);
        if (random_chance(random, 0.2)) reel(random, &absolute, coupling);
        return;
    }
    scene->coupling_count--;
    scene->body_count = before;
}

/* Round a drum of the ground, or of a body, which may turn, far enough that it stays on it. */
void add_capstan(struct random *random, struct scene *scene)
{
    struct coupling *coupling = add_coupling(scene, rope);
    struct absolute absolute;
    coupling->count = 3;
    for (int k = 0, last = -2; k < 3; k++) {
        int b = random_below(random, scene->body_count + 1) - 1;
        if (b == last || (k == 0 && b < 0)) b = b == 0 ? -1 : b < 0 ? 0 : b - 1;
        coupling->end[k] = random_end(random, scene, b);
        if (k == 1 && b >= 0) coupling->end[k].at.point = random_point(random, &scene->body[b]);
        last = b;
    }
    double kinetic = random_between(random, 0.05, 0.5);
    coupling->rubs = true;
    coupling->held = random_chance(random, 0.4);
    coupling->turns = random_chance(random, 0.3) ? 1 + random_below(random, 2) : 0;
    coupling->radius[0] = random_between(random, 0.05, 0.4);
    coupling->mu_k = constant_formula(dim_number, kinetic);
    coupling->mu_s = constant_formula(dim_number, kinetic + random_between(random, 0, 0.3));
    start(&absolute, scene);
    if (coupling->end[0].body == coupling->end[1].body || coupling->end[1].body == coupling->end[2].body ||
        !far_apart(&absolute, coupling))
        scene->coupling_count--;
}

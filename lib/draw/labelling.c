/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/labelling.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Costs, as equivalent distance from the anchor in mm. */
static const double on_a_label = 1e4, leader_on_label = 200, off_direction = 2.5, needs_leader = 6;

static const double padding = 0.6, pi = 3.141592653589793;

enum { directions = 16, rings = 48, most_sweeps = 30 };

/* Ensure room for one more element; NULL when memory is out. */
static void *grow(struct arena *arena, void *array, size_t count, size_t *room, size_t size)
{
    if (count < *room) return array;
    size_t more = *room ? 2 * *room : 64;
    void *larger = arena_array(arena, more, size);
    if (!larger) return NULL;
    if (count) memcpy(larger, array, count * size);
    *room = more;
    return larger;
}

size_t labelling_add(struct labelling *labelling, const char *text, double size, struct vec anchor,
                     struct vec toward, double gap)
{
    struct label_place *labels = grow(labelling->arena, labelling->labels, labelling->label_count,
                                      &labelling->label_room, sizeof *labels);
    if (!labels || !text) return labelling->label_count;
    labelling->labels = labels;
    labels[labelling->label_count] = (struct label_place){.text = text,
                                                          .anchor = anchor,
                                                          .toward = toward,
                                                          .gap = gap,
                                                          .size = {svg_text_width(text, size), 1.1 * size},
                                                          .center = anchor};
    return labelling->label_count++;
}

void labelling_avoid(struct labelling *labelling, struct vec from, struct vec to, double cost)
{
    struct obstacle *obstacles = grow(labelling->arena, labelling->obstacles, labelling->obstacle_count,
                                      &labelling->obstacle_room, sizeof *obstacles);
    if (!obstacles) return;
    labelling->obstacles = obstacles;
    obstacles[labelling->obstacle_count++] = (struct obstacle){from, to, cost};
}

static double distance(struct vec point, const struct obstacle *line)
{
    const struct vec d = vec_sub(line->to, line->from), way = vec_sub(point, line->from);
    const double square = vec_dot(d, d), share = square > 0 ? vec_dot(way, d) / square : 0;
    return vec_norm(vec_sub(way, vec_scale(fmin(fmax(share, 0), 1), d)));
}

/* Samples closer to each other than the distance that counts as touching. */
static bool touches(struct vec from, struct vec to, const struct obstacle *line)
{
    const double near = 0.5;
    const struct vec d = vec_sub(to, from);
    const int count = (int)ceil(vec_norm(d) / near);
    for (int i = 0; i <= count; i++)
        if (distance(vec_add(from, vec_scale(count > 0 ? (double)i / count : 0, d)), line) < near)
            return true;
    return false;
}

double labelling_crossed(const struct labelling *labelling, struct vec from, struct vec to)
{
    double cost = 0;
    for (size_t i = 0; i < labelling->obstacle_count; i++)
        if (touches(from, to, &labelling->obstacles[i])) cost += labelling->obstacles[i].cost;
    return cost;
}

struct box labelling_box(const struct label_place *label)
{
    struct vec half = vec_scale(0.5, label->size);
    return (struct box){vec_sub(label->center, half), vec_add(label->center, half)};
}

struct vec labelling_leader(const struct label_place *label)
{
    struct box box = labelling_box(label);
    return (struct vec){fmin(fmax(label->anchor.x, box.low.x), box.high.x),
                        fmin(fmax(label->anchor.y, box.low.y), box.high.y)};
}

/* ---- costs */

static bool boxes_meet(const struct label_place *a, const struct label_place *b)
{
    return fabs(a->center.x - b->center.x) < (a->size.x + b->size.x) / 2 + padding &&
           fabs(a->center.y - b->center.y) < (a->size.y + b->size.y) / 2 + padding / 2;
}

/* The length of the segment inside the label's box (Liang-Barsky clipping). */
static double covered(const struct label_place *label, const struct obstacle *segment)
{
    struct box box = labelling_box(label);
    struct vec d = vec_sub(segment->to, segment->from);
    const double from[] = {segment->from.x, segment->from.y}, step[] = {d.x, d.y};
    const double low[] = {box.low.x - padding, box.low.y}, high[] = {box.high.x + padding, box.high.y};
    double enter = 0, leave = 1;
    for (int k = 0; k < 2; k++) {
        if (step[k] == 0) {
            if (from[k] < low[k] || from[k] > high[k]) return 0;
            continue;
        }
        double a = (low[k] - from[k]) / step[k], b = (high[k] - from[k]) / step[k];
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    return leave > enter ? (leave - enter) * vec_norm(d) : 0;
}

static struct obstacle leader_of(const struct label_place *label)
{
    return (struct obstacle){.from = label->anchor, .to = labelling_leader(label)};
}

/* The cost of labels that overlap, or of which one is crossed by the other's leader. */
static double cost_of_labels(const struct label_place *a, const struct label_place *b)
{
    const struct obstacle from_a = leader_of(a), from_b = leader_of(b);
    double cost = boxes_meet(a, b) ? on_a_label : 0;
    if (a->leader && covered(b, &from_a) > 0) cost += leader_on_label;
    if (b->leader && covered(a, &from_b) > 0) cost += leader_on_label;
    return cost;
}

static double cost_of_place(const struct labelling *labelling, size_t index, const struct label_place *label)
{
    double cost = 0;
    for (size_t i = 0; i < labelling->label_count; i++)
        if (i != index) cost += cost_of_labels(label, &labelling->labels[i]);
    for (size_t i = 0; i < labelling->obstacle_count; i++) {
        double length = covered(label, &labelling->obstacles[i]);
        if (length > 0) cost += labelling->obstacles[i].cost * (1 + length / 4);
    }
    return cost;
}

/* ---- candidates */

/* Place the label in direction k of ring r: its box touches the ray at the gap. Returns the cost of the
 * position without overlaps. */
static double try_place(struct label_place *label, int ring, int k)
{
    double wanted =
        label->toward.x != 0 || label->toward.y != 0 ? atan2(label->toward.y, label->toward.x) : 0;
    /* 0, +1, -1, +2, -2, ...: the preferred direction first */
    int turn = (k + 1) / 2 * (k % 2 ? 1 : -1);
    double angle = wanted + 2 * pi * turn / directions;
    struct vec ray = {cos(angle), sin(angle)};
    /* from the centre of the box to its edge along the ray */
    double reach = fmin(fabs(ray.x) > 1e-9 ? label->size.x / 2 / fabs(ray.x) : HUGE_VAL,
                        fabs(ray.y) > 1e-9 ? label->size.y / 2 / fabs(ray.y) : HUGE_VAL);
    double beyond = ring * 1.6;
    label->center = vec_add(label->anchor, vec_scale(label->gap + reach + beyond, ray));
    label->leader = ring > 3;
    double cost = 1.2 * beyond + (label->leader ? needs_leader : 0);
    bool free = label->toward.x == 0 && label->toward.y == 0;
    return free ? cost : cost + off_direction * abs(turn) * 2 / directions;
}

static bool choose(struct labelling *labelling, size_t index)
{
    struct label_place *label = &labelling->labels[index], best = *label, place = *label;
    double least = HUGE_VAL;
    for (int ring = 0; ring < rings; ring++) {
        if (1.2 * 1.6 * ring > least) break; /* distance alone costs more from here on */
        for (int k = 0; k < directions; k++) {
            double cost = try_place(&place, ring, k);
            if (cost < least) cost += cost_of_place(labelling, index, &place);
            if (cost < least) {
                least = cost;
                best = place;
            }
        }
    }
    bool moved = vec_norm(vec_sub(best.center, label->center)) > 1e-9;
    *label = best;
    return moved;
}

bool labelling_solve(struct labelling *labelling)
{
    if (labelling->arena->failed) return false;
    for (int sweep = 0; sweep < most_sweeps; sweep++) {
        bool moved = false;
        for (size_t i = 0; i < labelling->label_count; i++) moved |= choose(labelling, i);
        if (!moved) break;
    }
    return true;
}

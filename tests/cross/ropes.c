/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Conditions of ropes and belts: straight pieces between rims, and what lies on these.
 */
#include "absolute.h"

static const double turn = 6.283185307179586;

/* ---- ropes
 *
 * A straight piece of direction u from the rim of circle 1 to that of circle 2, of radii R1 and R2 (0: a
 * point), round which the rope runs counter-clockwise (s = +1) or clockwise (s = -1). Counter-clockwise it
 * has its circle on its left, so it touches at C - s R left(u), and with d from centre to centre and rho = s2
 * R2 - s1 R1
 *
 *     d = l u + rho left(u),   l = sqrt(d^2 - rho^2),   angle of u = angle of d - atan2(rho, l)
 *
 * Beside l there is what lies on the rims, counted from a point of the rope that does not slip there: at the
 * beginning s1 R1 (angle of u - theta1), more as u turns that way and less as the circle does; at the end
 * s2 R2 (theta2 - angle of u).
 */

struct straight {
    struct series length, angle;
};

static struct straight straight_piece(struct place one, double sR1, struct place two, double sR2)
{
    double rho = sR2 - sR1;
    struct place d = place_sub(two, one);
    struct straight piece;
    piece.length = ser_sqrt(ser_sub(place_dot(d, d), ser(rho * rho)));
    piece.angle = place_angle(d);
    struct series tilt = place_angle((struct place){piece.length, ser(rho)});
    piece.angle = ser_sub(piece.angle, tilt);
    return piece;
}

struct series rope_value(const struct absolute *absolute, const struct row *row)
{
    const struct coupling *coupling = &absolute->scene->coupling[row->owner];
    struct series length = ser(0);
    double rim = 0;
    struct vec2 unused;
    for (int k = row->from; k < row->to; k++) {
        double sR1 = 0, sR2 = 0;
        const struct end *one = &coupling->end[k], *two = &coupling->end[k + 1];
        if (one->pulley) sR1 = row->turn[0] * circle_of(absolute->scene, coupling, k, &unused);
        if (two->pulley) sR2 = row->turn[1] * circle_of(absolute->scene, coupling, k + 1, &unused);
        struct straight piece =
            straight_piece(end_place(absolute, coupling, k), sR1, end_place(absolute, coupling, k + 1), sR2);
        length = ser_add(length, piece.length);
        if (one->pulley)
            length = ser_add(length, ser_scale(sR1, ser_sub(piece.angle, angle_of(absolute, one->body))));
        if (two->pulley)
            length = ser_add(length, ser_scale(sR2, ser_sub(angle_of(absolute, two->body), piece.angle)));
        rim += fabs(sR1) + fabs(sR2);
    }
    double grown = row->drive ? formula_value(absolute, row->drive) : 0;
    length = ser_sub(length, ser(row->zero));
    if (rim > 0) length.u = grown + remainder(length.u - grown, turn * rim); /* angles: but for whole turns */
    return length;
}

/* ---- a rope that rubs on a drum
 *
 * Its strands are counted from a mark on the drum: l1 + sR (theta - psi1) and l2 + sR (psi2 - theta). Their sum is
 * the rope, whichever way the drum turns, and half their difference is by how far it has slipped. With the multipliers
 * L and S of these, T1 = S/2 - L and T2 = -S/2 - L; and slipping to the second strand, T2 = T1 exp(mu beta) is
 *
 *     S = T1 - T2 = -tanh(mu beta/2) (T1 + T2),   T1 + T2 = -2 L
 *
 * which is dry friction of the coefficient tanh(mu beta/2), with T1 + T2 as what it presses by. */

static struct straight capstan_strand(const struct absolute *absolute, const struct row *row, int k)
{
    const struct coupling *coupling = &absolute->scene->coupling[row->owner];
    double sR = row->turn[0] * coupling->radius[0];
    return straight_piece(end_place(absolute, coupling, k), k == 0 ? 0 : sR,
                          end_place(absolute, coupling, k + 1), k == 0 ? sR : 0);
}

struct series capstan_value(const struct absolute *absolute, const struct row *row)
{
    const struct coupling *coupling = &absolute->scene->coupling[row->owner];
    double sR = row->turn[0] * coupling->radius[0], slips = row->kind == row_capstan_slip ? 0.5 : 1;
    struct series drum = angle_of(absolute, coupling->end[1].body), way[2];
    for (int k = 0; k < 2; k++) {
        struct straight piece = capstan_strand(absolute, row, k);
        struct series round = ser_sub(piece.angle, drum);
        way[k] = ser_add(piece.length, ser_scale(k == 0 ? -sR : sR, round));
    }
    struct series first = ser_scale(row->kind == row_capstan_slip ? -slips : slips, way[0]);
    struct series g = ser_sub(ser_add(first, ser_scale(slips, way[1])), ser(row->zero));
    g.u = remainder(g.u, slips * turn * sR); /* angles: but for whole turns */
    return g;
}

double wrap_of(const struct absolute *absolute, const struct row *row)
{
    double in = capstan_strand(absolute, row, 0).angle.u, out = capstan_strand(absolute, row, 1).angle.u;
    double quarter = turn / 4, lies = quarter + remainder(row->turn[0] * (out - in) - quarter, turn);
    return lies + turn * absolute->scene->coupling[row->owner].turns;
}

/* Of a belt, in each strand, counted as on a rope between where the discs take it along. Strand 0 leaves disc 0 on
 * its right, so that it runs counter-clockwise there, and strand 1 comes back. With the angles of both it is known
 * but for whole turns of the line of centres. */
struct series belt_value(const struct absolute *absolute, const struct row *row)
{
    const struct coupling *coupling = &absolute->scene->coupling[row->owner];
    const struct end *end = coupling->end;
    struct series strand[2];
    struct vec2 unused;
    double sR[2];
    for (int k = 0; k < 2; k++)
        sR[k] = circle_of(absolute->scene, coupling, k, &unused) * (k == 1 && coupling->crossed ? -1 : 1);
    for (int i = 0; i < 2; i++) {
        int from = i, to = 1 - i;
        struct straight piece = straight_piece(end_place(absolute, coupling, from), sR[from],
                                               end_place(absolute, coupling, to), sR[to]);
        struct series left = ser_sub(piece.angle, angle_of(absolute, end[from].body));
        struct series come = ser_sub(angle_of(absolute, end[to].body), piece.angle);
        strand[i] = ser_add(piece.length, ser_add(ser_scale(sR[from], left), ser_scale(sR[to], come)));
    }
    bool turns = row->kind == row_belt_turn;
    struct series g = ser_scale(0.5, turns ? ser_sub(strand[0], strand[1]) : ser_add(strand[0], strand[1]));
    double whole = 0.5 * turn * (sR[0] - sR[1]);
    g.u -= row->zero;
    if (whole != 0) g.u = remainder(g.u, whole);
    return g;
}

double straight_way(const struct absolute *absolute, const struct coupling *coupling)
{
    struct vec2 unused;
    double sum = 0, ignored;
    for (int k = 0; k + 1 < coupling->count; k++) {
        double sR[2] = {0, 0};
        for (int i = 0; i < 2; i++)
            if (coupling->end[k + i].wound)
                sR[i] = wound_turn(absolute, coupling, k + i, &ignored) *
                        circle_of(absolute->scene, coupling, k + i, &unused);
        sum += straight_piece(end_place(absolute, coupling, k), sR[0], end_place(absolute, coupling, k + 1),
                              sR[1])
                   .length.u;
    }
    return sum;
}

double shortest_piece(const struct absolute *absolute)
{
    double shortest = INFINITY;
    struct vec2 unused;
    for (int j = 0; j < absolute->row_count; j++) {
        const struct row *row = &absolute->row[j];
        const struct coupling *coupling = &absolute->scene->coupling[row->owner];
        for (int k = row->from; row->kind == row_rope && k < row->to; k++) {
            double sR[2] = {0, 0};
            for (int i = 0; i < 2; i++)
                if (coupling->end[k + i].pulley)
                    sR[i] = row->turn[i] * circle_of(absolute->scene, coupling, k + i, &unused);
            struct straight piece = straight_piece(end_place(absolute, coupling, k), sR[0],
                                                   end_place(absolute, coupling, k + 1), sR[1]);
            shortest = piece.length.u > 0 ? fmin(shortest, piece.length.u) : 0;
        }
        for (int k = 0; k < 2 && row->kind == row_capstan; k++) {
            double length = capstan_strand(absolute, row, k).length.u;
            shortest = length > 0 ? fmin(shortest, length) : 0;
        }
    }
    return shortest;
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The scenes in Chipmunk 7: 10 iterations, its default. Coefficients of two shapes are multiplied: those of planes are 1.
 */
#include <chipmunk/chipmunk.h>

#include "scenes.h"

/* A space, and all that is in it. */
struct world {
    cpSpace *space;
    cpShape *shape[2];
    cpBody *body[bars];
    cpConstraint *joint[4];
    int shapes, bodies, joints;
};

static struct world new_world(void)
{
    struct world world = {.space = cpSpaceNew()};
    cpSpaceSetGravity(world.space, cpv(0, -gravity));
    return world;
}

static void free_world(struct world *world)
{
    for (int n = 0; n < world->joints; n++) cpSpaceRemoveConstraint(world->space, world->joint[n]);
    for (int n = 0; n < world->joints; n++) cpConstraintFree(world->joint[n]);
    for (int n = 0; n < world->shapes; n++) cpSpaceRemoveShape(world->space, world->shape[n]);
    for (int n = 0; n < world->shapes; n++) cpShapeFree(world->shape[n]);
    for (int n = 0; n < world->bodies; n++) cpSpaceRemoveBody(world->space, world->body[n]);
    for (int n = 0; n < world->bodies; n++) cpBodyFree(world->body[n]);
    cpSpaceFree(world->space);
}

/* Steps to the end; a moment has to be given anew for each step. */
static void run(struct world *world, const struct scene *scene, double moment)
{
    for (int n = scene_steps(scene); n > 0; n--) {
        if (moment != 0) cpBodySetTorque(world->body[0], moment);
        cpSpaceStep(world->space, scene->h);
    }
}

static cpBody *add_body(struct world *world, double mass, double inertia, cpVect place, double angle,
                        cpVect velocity)
{
    cpBody *body = cpSpaceAddBody(world->space, cpBodyNew(mass, inertia));
    cpBodySetPosition(body, place);
    cpBodySetAngle(body, angle);
    cpBodySetVelocity(body, velocity);
    return world->body[world->bodies++] = body;
}

static void add_shape(struct world *world, cpShape *shape, double mu, double e)
{
    cpShapeSetFriction(shape, mu);
    cpShapeSetElasticity(shape, e);
    world->shape[world->shapes++] = cpSpaceAddShape(world->space, shape);
}

/* A long plane through the origin at this angle. */
static void add_plane(struct world *world, double angle)
{
    cpVect along = cpvmult(cpvforangle(angle), 100);
    add_shape(world, cpSegmentShapeNew(cpSpaceGetStaticBody(world->space), cpvneg(along), along, 0), 1, 1);
}

static void add_joint(struct world *world, cpConstraint *joint)
{
    world->joint[world->joints++] = cpSpaceAddConstraint(world->space, joint);
}

static int incline(const struct scene *scene, double result[4])
{
    cpVect up = cpvforangle(scene->number[1]);
    struct world world = new_world();
    add_plane(&world, scene->number[1]);
    cpBody *box =
        add_body(&world, box_mass, cpMomentForBox(box_mass, box_length, box_height),
                 cpvmult(cpvperp(up), box_height / 2), scene->number[1], cpvmult(up, scene->number[2]));
    add_shape(&world, cpBoxShapeNew(box, box_length, box_height, 0), scene->number[0], 0);
    run(&world, scene, 0);
    result[0] = cpvdot(cpBodyGetPosition(box), up);
    result[1] = cpvdot(cpBodyGetVelocity(box), up);
    free_world(&world);
    return 2;
}

static int disc(const struct scene *scene, double result[4])
{
    cpVect down = cpvforangle(-scene->number[1]);
    struct world world = new_world();
    add_plane(&world, -scene->number[1]);
    cpBody *body = add_body(&world, disc_mass, cpMomentForCircle(disc_mass, 0, disc_radius, cpvzero),
                            cpvmult(cpvperp(down), disc_radius), 0, cpvzero);
    add_shape(&world, cpCircleShapeNew(body, disc_radius, cpvzero), scene->number[0], 0);
    run(&world, scene, 0);
    result[0] = cpvdot(cpBodyGetPosition(body), down);
    result[1] = cpvdot(cpBodyGetVelocity(body), down);
    result[2] = cpBodyGetAngularVelocity(body);
    free_world(&world);
    return 3;
}

static int bounce(const struct scene *scene, double result[4])
{
    struct world world = new_world();
    add_plane(&world, 0);
    cpBody *ball = add_body(&world, ball_mass, 0.4 * ball_mass * ball_radius * ball_radius,
                            cpv(0, scene->number[1] + ball_radius), 0, cpvzero);
    add_shape(&world, cpCircleShapeNew(ball, ball_radius, cpvzero), 0, scene->number[0]);
    run(&world, scene, 0);
    result[0] = cpBodyGetPosition(ball).y - ball_radius;
    result[1] = cpBodyGetVelocity(ball).y;
    free_world(&world);
    return 2;
}

static int rope(const struct scene *scene, double result[4])
{
    struct world world = new_world();
    cpBody *bob = add_body(&world, bob_mass, 1, cpv(rope_length, 0), 0, cpv(0, scene->number[0]));
    add_joint(&world,
              cpSlideJointNew(cpSpaceGetStaticBody(world.space), bob, cpvzero, cpvzero, 0, rope_length));
    run(&world, scene, 0);
    cpVect place = cpBodyGetPosition(bob), velocity = cpBodyGetVelocity(bob);
    result[0] = place.x;
    result[1] = place.y;
    result[2] = velocity.x;
    result[3] = velocity.y;
    free_world(&world);
    return 4;
}

static int fourbar(const struct scene *scene, double result[4])
{
    struct world world = new_world();
    cpBody *bar[bars], *ground = cpSpaceGetStaticBody(world.space);
    cpVect start[bars], end[bars];
    for (int n = 0; n < bars; n++) {
        bar_start(n, &start[n].x, &start[n].y);
        end[n] = cpvadd(start[n], cpvmult(cpvforangle(bar_angle[n]), bar_length[n]));
        bar[n] = add_body(&world, bar_mass[n], bar_mass[n] * bar_length[n] * bar_length[n] / 12,
                          cpvlerp(start[n], end[n], 0.5), bar_angle[n], cpvzero);
    }
    add_joint(&world, cpPivotJointNew(ground, bar[0], start[0]));
    add_joint(&world, cpPivotJointNew(bar[0], bar[1], start[1]));
    add_joint(&world, cpPivotJointNew(ground, bar[2], start[2]));
    add_joint(&world, cpPivotJointNew(bar[1], bar[2], end[1]));
    run(&world, scene, bar_moment);
    result[0] = cpBodyGetAngle(bar[0]);
    result[1] = cpBodyGetAngularVelocity(bar[0]);
    result[2] = cpBodyGetAngle(bar[2]);
    result[3] = cpBodyGetAngularVelocity(bar[2]);
    free_world(&world);
    return 4;
}

int main(void)
{
    scene_run *const runs[] = {incline, disc, bounce, rope, fourbar};
    return scene_answer(runs);
}

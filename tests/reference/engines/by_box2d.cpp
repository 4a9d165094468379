/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The scenes in Box2D 2.4 (single precision): 8 velocity and 3 position iterations, as its manual advises.
 */
#include <box2d/box2d.h>

#include "scenes.h"

/* Polygons and edges have skins, and rest where these overlap by the slop. */
static const float gap = 2 * b2_polygonRadius - b2_linearSlop;

static b2Vec2 at(double x, double y)
{
    return b2Vec2(float(x), float(y));
}

static void run(b2World &world, const scene &scene, b2Body *pushed = nullptr, double moment = 0)
{
    for (int n = scene_steps(&scene); n > 0; n--) {
        if (pushed) pushed->ApplyTorque(float(moment), true);
        world.Step(float(scene.h), 8, 3);
    }
}

/* A long plane through the origin at this angle. */
static b2Body *add_plane(b2World &world, double angle, double mu, double e)
{
    b2BodyDef def;
    b2Body *ground = world.CreateBody(&def);
    b2EdgeShape edge;
    edge.SetTwoSided(at(-100 * cos(angle), -100 * sin(angle)), at(100 * cos(angle), 100 * sin(angle)));
    b2FixtureDef fixture;
    fixture.shape = &edge;
    fixture.friction = float(mu);
    fixture.restitution = float(e);
    fixture.restitutionThreshold = 0;
    ground->CreateFixture(&fixture);
    return ground;
}

static b2Body *add_body(b2World &world, b2Vec2 place, double angle, b2Vec2 velocity)
{
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = place;
    def.angle = float(angle);
    def.linearVelocity = velocity;
    def.allowSleep = false;
    return world.CreateBody(&def);
}

static void give_shape(b2Body *body, const b2Shape &shape, double mass, double inertia, double mu, double e)
{
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density = 1;
    fixture.friction = float(mu);
    fixture.restitution = float(e);
    fixture.restitutionThreshold = 0;
    body->CreateFixture(&fixture);
    b2MassData data = {float(mass), b2Vec2(0, 0), float(inertia)};
    body->SetMassData(&data);
}

static int incline(const scene *scene, double result[4])
{
    double mu = scene->number[0], angle = scene->number[1], v0 = scene->number[2], height = box_height / 2 + gap;
    b2World world(at(0, -gravity));
    add_plane(world, angle, mu, 0);
    b2Body *box = add_body(world, at(-height * sin(angle), height * cos(angle)), angle, at(v0 * cos(angle), v0 * sin(angle)));
    b2PolygonShape shape;
    shape.SetAsBox(float(box_length / 2), float(box_height / 2));
    give_shape(box, shape, box_mass, box_mass * (box_length * box_length + box_height * box_height) / 12, mu, 0);
    run(world, *scene);
    b2Vec2 up = at(cos(angle), sin(angle));
    result[0] = b2Dot(box->GetPosition(), up);
    result[1] = b2Dot(box->GetLinearVelocity(), up);
    return 2;
}

static int disc(const scene *scene, double result[4])
{
    double mu = scene->number[0], angle = scene->number[1], height = disc_radius + b2_polygonRadius - b2_linearSlop;
    b2World world(at(0, -gravity));
    add_plane(world, -angle, mu, 0);
    b2Body *body = add_body(world, at(height * sin(angle), height * cos(angle)), 0, at(0, 0));
    b2CircleShape shape;
    shape.m_radius = float(disc_radius);
    give_shape(body, shape, disc_mass, disc_mass * disc_radius * disc_radius / 2, mu, 0);
    run(world, *scene);
    b2Vec2 down = at(cos(angle), -sin(angle));
    result[0] = b2Dot(body->GetPosition(), down);
    result[1] = b2Dot(body->GetLinearVelocity(), down);
    result[2] = body->GetAngularVelocity();
    return 3;
}

static int bounce(const scene *scene, double result[4])
{
    double skin = b2_polygonRadius;
    b2World world(at(0, -gravity));
    add_plane(world, 0, 0, scene->number[0]);
    b2Body *ball = add_body(world, at(0, scene->number[1] + ball_radius + skin), 0, at(0, 0));
    b2CircleShape shape;
    shape.m_radius = float(ball_radius);
    give_shape(ball, shape, ball_mass, 0.4 * ball_mass * ball_radius * ball_radius, 0, scene->number[0]);
    run(world, *scene);
    result[0] = ball->GetPosition().y - ball_radius - skin;
    result[1] = ball->GetLinearVelocity().y;
    return 2;
}

static int rope(const scene *scene, double result[4])
{
    b2World world(at(0, -gravity));
    b2BodyDef def;
    b2Body *ground = world.CreateBody(&def), *bob = add_body(world, at(rope_length, 0), 0, at(0, scene->number[0]));
    b2CircleShape shape;
    shape.m_radius = 0.02f;
    give_shape(bob, shape, bob_mass, bob_mass * 0.0002, 0, 0);
    b2DistanceJointDef joint;
    joint.Initialize(ground, bob, at(0, 0), bob->GetPosition());
    joint.minLength = 0;
    joint.maxLength = float(rope_length);
    world.CreateJoint(&joint);
    run(world, *scene);
    result[0] = bob->GetPosition().x;
    result[1] = bob->GetPosition().y;
    result[2] = bob->GetLinearVelocity().x;
    result[3] = bob->GetLinearVelocity().y;
    return 4;
}

static void pin(b2World &world, b2Body *one, b2Body *other, b2Vec2 place)
{
    b2RevoluteJointDef joint;
    joint.Initialize(one, other, place);
    world.CreateJoint(&joint);
}

static int fourbar(const scene *scene, double result[4])
{
    b2World world(at(0, -gravity));
    b2BodyDef def;
    b2Body *ground = world.CreateBody(&def), *bar[bars];
    b2Vec2 start[bars], end[bars];
    for (int n = 0; n < bars; n++) {
        double x, y, dx = bar_length[n] * cos(bar_angle[n]), dy = bar_length[n] * sin(bar_angle[n]);
        bar_start(n, &x, &y);
        start[n] = at(x, y);
        end[n] = at(x + dx, y + dy);
        bar[n] = add_body(world, at(x + dx / 2, y + dy / 2), bar_angle[n], at(0, 0));
        b2MassData data = {float(bar_mass[n]), b2Vec2(0, 0), float(bar_mass[n] * bar_length[n] * bar_length[n] / 12)};
        bar[n]->SetMassData(&data);
    }
    pin(world, ground, bar[0], start[0]);
    pin(world, bar[0], bar[1], start[1]);
    pin(world, ground, bar[2], start[2]);
    pin(world, bar[1], bar[2], end[1]);
    run(world, *scene, bar[0], bar_moment);
    result[0] = bar[0]->GetAngle();
    result[1] = bar[0]->GetAngularVelocity();
    result[2] = bar[2]->GetAngle();
    result[3] = bar[2]->GetAngularVelocity();
    return 4;
}

int main()
{
    scene_run *const runs[] = {incline, disc, bounce, rope, fourbar};
    return scene_answer(runs);
}

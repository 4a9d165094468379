/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reactions in events, and couplings that end: against closed forms, and against a second run that starts without the
 * coupling from the state at its end.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_view.h"
#include "random_numbers.h"
#include "run_checks.h"

/* ---- closed forms */

/* A pendulum from rest at theta_0: T = m g (3 cos theta - 2 cos theta_0), v^2 = 2 g L (cos theta - cos theta_0). From the end
 * of its string on the bob flies along a parabola. */
static void a_string_breaks(void **unused)
{
    static const char *const kinds[] = {
        "rope: {name: cord, through: [ground.A, bob], until: tension > 30 N}",
        "rod: {name: cord, between: [bob, ground.A], until: tension > 30 N}",
        "rope: {name: cord, through: [ground.A, bob], until: cord.force > 30}",
        "rod: {name: cord, between: [ground.A, bob], until: -30 > -tension}"};
    const double m = 1.5, L = 2, start = 1.4, c0 = cos(start), c = (30 / (m * g) + 2 * c0) / 3;
    const double v = sqrt(2 * g * L * (c - c0)), s = sqrt(1 - c * c);
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        char text[text_room];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {A: [0, 0]}}\nbodies:\n  bob: {mass: %.17g, motion: particle, "
                 "initial: {x: "
                 "%.17g, y: %.17g}, forces: [gravity]}\ncouplings:\n  - %s\nsimulate: {until: 3, tolerance: "
                 "1e-12}\n",
                 m, L * sin(start), -L * c0, kinds[i]);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        const double t = trial_to_event(&trial, FBD_EVENT_COUPLING_ENDS, "cord", 0), then = t + 0.5;
        check_close(&checks, "x", trial_get(&trial, "x"), L * s, same);
        check_close(&checks, "y", trial_get(&trial, "y"), -L * c, same);
        check_close(&checks, "vx", trial_get(&trial, "vx"), -v * c, same);
        check_close(&checks, "vy", trial_get(&trial, "vy"), -v * s, same);
        trial_to(&trial, then);
        check_close(&checks, "x then", trial_get(&trial, "x"), L * s - v * c * 0.5, same);
        check_close(&checks, "y then", trial_get(&trial, "y"), -L * c - v * s * 0.5 - g / 8, same);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Events name reactions: of ropes, pivots, guides, rolling bodies, springs and actuators. */
static const struct {
    const char *scene, *when;
    double t;
} named[] = {
    /* A load that grows by 2 N/s, over a rope. */
    {"bodies: {b: {mass: 1, motion: {slide: {along: 90 deg}}, initial: {x: -1}, forces: [gravity, "
     "applied: {value: \"-2[N/s]*t\"}]}}\n"
     "couplings: [rope: {name: cord, through: [ground.A, b]}]\n",
     "cord.tension > 11.81 N", 1},
    /* The pin of a balanced wheel with a growing force on it. */
    {"bodies: {b: {mass: 1, inertia: 1, motion: pivot, forces: [gravity, applied: {fx: \"3[N/s]*t\", fy: "
     "9.81}]}}\n",
     "b.pin.x < -4.5 N", 1.5},
    {"bodies: {b: {mass: 1, inertia: 1, motion: pivot, forces: [gravity, applied: {fx: \"3[N/s]*t\", fy: "
     "9.81}]}}\n",
     "b.pin.force > 4.5 N", 1.5},
    /* A block pressed on its floor, and its friction, which is positive while it slips to the right. */
    {"bodies: {b: {mass: 1, motion: slide, initial: {v: 30}, forces: [gravity, normal, friction: 0.5, "
     "applied: {value: \"4[N/s]*t\", angle: -90 deg}]}}\n",
     "b.normal > 13.81 N", 1},
    {"bodies: {b: {mass: 1, motion: slide, initial: {v: 30}, forces: [gravity, normal, friction: 0.5, "
     "applied: {value: \"4[N/s]*t\", angle: -90 deg}]}}\n",
     "b.friction > 6.905 N", 1},
    {"bodies: {b: {mass: 1, motion: slide, forces: [gravity, normal: {two_sided: true}, "
     "applied: {value: \"4[N/s]*t\", angle: -90 deg}]}}\n",
     "b.normal > 13.81 N", 1},
    /* A disc that is pulled at its centre rolls: f = F/3 to the left. */
    {"bodies: {b: {shape: disc, mass: 1, radius: 1, motion: planar, initial: {y: 1}, forces: [gravity, "
     "applied: {fx: \"3[N/s]*t\", fy: 0}]}}\ncouplings: [roll: {name: tread, body: b, on: floor}]\n",
     "tread.friction > 1 N", 1},
    {"bodies: {b: {shape: disc, mass: 1, radius: 1, motion: planar, initial: {y: 1}, forces: [gravity, "
     "applied: {fx: 0, fy: \"-3[N/s]*t\"}]}}\ncouplings: [roll: {name: tread, body: b, on: floor}]\n",
     "tread.normal > 12.81 N", 1},
    /* A mass on a spring, k/m = pi^2/4: at t = 2/3 the force is k cos(pi/3). */
    {"bodies: {b: {mass: 1, motion: slide, initial: {x: 1}}}\ncouplings: [spring: {name: coil, between: "
     "[b, "
     "ground.A], stiffness: 2.4674011002723395}]\n",
     "coil.tension < 1.2337005501361697 N", 2.0 / 3},
    {"bodies: {b: {mass: 1, motion: slide, initial: {x: 1}}}\ncouplings: [spring: {name: coil, between: "
     "[b, "
     "ground.A], stiffness: 2.4674011002723395}]\n",
     "coil.x > -1.2337005501361697 N", 2.0 / 3},
    /* An actuator pushes its two bodies apart: below zero. */
    {"bodies: {b: {mass: 1, motion: particle, initial: {x: 1}}, c: {mass: 2, motion: "
     "particle}}\ncouplings: "
     "[actuator: {name: ram, between: [b, c], force: \"-3[N] - 4[N/s]*t\"}]\n",
     "ram.tension < -5 N", 0.5},
    {"bodies: {b: {mass: 1, motion: particle, initial: {x: 1}}, c: {mass: 2, motion: "
     "particle}}\ncouplings: "
     "[actuator: {name: ram, between: [b, c], force: \"-3[N] - 4[N/s]*t\"}]\n",
     "ram.x > 5 N", 0.5},
    /* A contact: a box under a growing load, on two corners. */
    {"bodies: {b: {shape: prism, a: 1, b: 1, mass: 1, motion: planar, initial: {y: 0.5}, forces: "
     "[gravity, "
     "applied: {fx: 0, fy: \"-3[N/s]*t\"}]}}\ncontacts: [{name: touch, between: [b, ground.floor]}]\n",
     "touch.normal > 12.81 N", 1},
};

static void events_name_reactions(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof named / sizeof *named; i++) {
        char text[text_room];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {A: [0, 0]}, lines: {floor: {along: 0}}}\n%ssimulate: {until: 3, "
                 "tolerance: "
                 "1e-12, events: [{name: hit, when: %s}]}\n",
                 named[i].scene, named[i].when);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        check_close(&checks, named[i].when, trial_to_event(&trial, FBD_EVENT_USER, "hit", 0), named[i].t,
                    same);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A jump of the load ends the upper of two ropes, and the lower one at once where it is too weak. A condition that is
 * true at the start ends its coupling there. */
static void jumps_and_starts_end_couplings(void **unused)
{
    static const struct {
        const char *upper, *lower;
        double t[2];
    } cases[] = {{"tension > 25 N", "tension > 30 N", {0.5, NAN}},
                 {"tension > 25 N", "tension > 15 N", {0.5, 0.5}},
                 {"tension > 35 N", "tension > 15 N", {NAN, 0.5}},
                 {"tension > 19 N", "tension > 30 N", {0, NAN}},
                 {"t > 0.25 s", "t > 0.75 s", {0.25, 0.75}}};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[text_room];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {A: [0, 0]}}\nbodies:\n  b: {mass: 1, motion: particle, initial: "
                 "{y: -1}, "
                 "forces: [gravity]}\n  c: {mass: 1, motion: particle, initial: {y: -2}, forces: [gravity, "
                 "applied: "
                 "{value: \"if(t > 0.5, 10[N], 0)\", angle: -90 deg}]}\ncouplings:\n  - rope: {name: upper, "
                 "through: "
                 "[ground.A, b], until: %s}\n  - rope: {name: lower, through: [b, c], until: %s}\nsimulate: "
                 "{until: 1}\n",
                 cases[i].upper, cases[i].lower);
        struct trial trial = run_of(text);
        static const char *const names[] = {"upper", "lower"};
        for (int k = 0; k < 2; k++) {
            const double t = trial_event(&trial, FBD_EVENT_COUPLING_ENDS, names[k], 0);
            if (isnan(cases[i].t[k]))
                check_that(&checks, names[k], isnan(t));
            else
                check_close(&checks, names[k], t, cases[i].t[k], same);
        }
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* The number that determines the further motion includes the couplings that have ended. */
static void a_packed_state_goes_on(void **unused)
{
    enum { room = 100 };
    double numbers[room];
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse("fbd: 1\nground: {points: {A: [0, 0]}}\nbodies: {b: {mass: 1, motion: "
                                     "particle, initial: {y: -1}, forces: "
                                     "[gravity]}}\ncouplings: [rope: {name: cord, through: [ground.A, b], "
                                     "until: t > 0.5 s}]\nsimulate: {until: 2}\n");
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    const size_t count = fbd_state_pack(trial.state, numbers, room);
    fbd_state *state = fbd_state_new(trial.model);
    assert_true(fbd_state_unpack(state, numbers, count));
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_errors *errors = fbd_errors_new();
    fbd_simulation *later = fbd_simulation_from(state, &options, errors);
    assert_non_null(later);
    while (fbd_simulation_advance(later) == FBD_GOING) {
    }
    assert_true(fbd_simulation_state(later, 2, state));
    double y;
    assert_true(fbd_state_get(state, "b.y", &y));
    check_close(&checks, "y", y, -1 - g * 1.5 * 1.5 / 2, same);
    fbd_simulation_free(later);
    fbd_errors_free(errors);
    fbd_state_free(state);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- couplings that begin */

/* A bullet stays in the block of a pendulum: m u L = (I + m L^2) omega. The impact takes the rest of its energy. */
static void a_bullet_stays(void **unused)
{
    const double m = 0.02, M = 2, L = 1, u = 300, r = 0.05, I = M * (0.4 * r * r + L * L),
                 omega = m * u * L / (I + m * L * L);
    const double taken = m * u * u / 2 - (I + m * L * L) * omega * omega / 2;
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse("fbd: 1\nground: {points: {A: [0, 0]}}\nbodies:\n  bullet: {mass: 0.02, "
                                     "motion: particle, initial: {x: -3, y: -1, "
                                     "vx: 300}}\n  block: {shape: sphere, radius: 0.05, mass: 2, motion: "
                                     "{pivot: {at: A, point: [0, 1]}}, forces: "
                                     "[gravity]}\ncouplings:\n  - pin: {name: stuck, between: [bullet, "
                                     "block], from: bullet.x > block.G.x}\n"
                                     "simulate: {until: 0.5, tolerance: 1e-12}\n");
    trial_start(&trial, NULL);
    check_close(&checks, "t", trial_to_event(&trial, FBD_EVENT_COUPLING_BEGINS, "stuck", 0), 0.01, same);
    check_close(&checks, "omega", trial_get(&trial, "block.omega"), omega, same);
    check_close(&checks, "vx", trial_get(&trial, "bullet.vx"), omega * L, same);
    trial_close(&trial);
    trial = run_of("fbd: 1\nground: {points: {A: [0, 0]}}\nbodies:\n  bullet: {mass: 0.02, motion: particle, "
                   "initial: {x: -3, y: -1, "
                   "vx: 300}}\n  block: {shape: sphere, radius: 0.05, mass: 2, motion: {pivot: {at: A, "
                   "point: [0, 1]}}, forces: "
                   "[gravity]}\ncouplings:\n  - pin: {name: stuck, between: [bullet, block], from: bullet.x "
                   "> block.G.x}\n"
                   "simulate: {until: 0.5, tolerance: 1e-12}\n");
    check_close(&checks, "work", fbd_result_work(trial.result, "bullet", "stuck"), -taken, 1e-6);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* A rod catches a block, m v^2/2 is lost, and lets go of it. A rope whose ends approach each other begins slack. A rope
 * takes the velocity along it. */
static void couplings_begin(void **unused)
{
    static const struct {
        const char *coupling;
        double takes, vx, vy;
    } cases[] = {{"rod: {name: grip, between: [b, ground.A], from: t > 0.5 s}", 8, 0, 3},
                 {"rope: {name: grip, through: [b, ground.A], from: t > 0.5 s}", 8, 0, 3},
                 {"rope: {name: grip, through: [b, ground.B], from: t > 0.5 s}", 0, 4, 3},
                 {"rope: {name: grip, through: [b, ground.A], length: 5, from: t > 0.5 s}", 0, 4, 3}};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[text_room], takes[60];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {A: [0, 1.5], B: [9, 1.5]}}\nbodies: {b: {mass: 1, motion: "
                 "particle, initial: "
                 "{vx: 4, vy: 3}}}\ncouplings:\n  - %s\nsimulate: {until: 0.6, tolerance: 1e-12}\n",
                 cases[i].coupling);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        check_close(&checks, "t", trial_to_event(&trial, FBD_EVENT_COUPLING_BEGINS, "grip", 0), 0.5, same);
        check_close(&checks, "vx", trial_get(&trial, "vx"), cases[i].vx, same);
        check_close(&checks, "vy", trial_get(&trial, "vy"), cases[i].vy, same);
        const fbd_event event = fbd_simulation_event(trial.simulation, 0);
        snprintf(takes, sizeof takes, "takes %.6g J", cases[i].takes);
        check_that(&checks, takes, strstr(event.detail, takes));
        check_that(&checks, "one event", fbd_simulation_event_count(trial.simulation) < 3);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A hook of 2 kg catches a box of 1 kg on its floor at 1 m/s: both rise with 2/3 m/s, a third of a joule is lost, and
 * the weight of the box stops them after 2/3 m/s : (g/3), when the box is back on its floor. */
static void a_hook_lifts_a_box(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_of("fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n  box: {shape: "
                                "prism, a: 0.4, b: 0.2, mass: 1, motion: "
                                "planar, initial: {y: 0.1}, forces: [gravity]}\n  hook: {mass: 2, motion: "
                                "{slide: {along: 90 deg}}, initial: {x: 2, "
                                "v: 1}}\ncontacts: [{name: floor, between: [box, ground.floor], static: "
                                "0.5}]\ncouplings:\n  - rod: {name: link, "
                                "between: [box.G, hook], from: t > 0.5 s}\nsimulate: {until: 0.6}\n");
    check_close(&checks, "begins", trial_event(&trial, FBD_EVENT_COUPLING_BEGINS, "link", 0), 0.5, same);
    check_close(&checks, "lifts", trial_event(&trial, FBD_EVENT_LIFT_OFF, NULL, 0), 0.5, same);
    check_close(&checks, "v", get(&trial, "box.vy"), 2.0 / 3 - g / 3 * 0.1, same);
    check_close(&checks, "v", get(&trial, "hook.v"), 2.0 / 3 - g / 3 * 0.1, same);
    check_close(&checks, "work", fbd_result_work(trial.result, "box", "link"), -1.0 / 3, same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* Positions that do not fit, and friction of a guide in the impact, are refused by name. */
static void other_begins_are_refused(void **unused)
{
    static const struct {
        const char *body, *coupling, *words;
    } cases[] = {
        {"motion: particle, initial: {vx: 1}", "pin: {name: grip, between: [b, ground.A], from: t > 0.5 s}",
         "`grip` begins (t > 0.5 s), and does not fit: it is off by 1.58"},
        {"motion: slide, initial: {v: 9}, forces: [gravity, normal, friction: {name: rub, coefficient: 0.1}]",
         "rod: {name: grip, between: [b, ground.A], from: t > 0.5 s}", "friction `rub` of a guide"}};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[text_room];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {A: [0, 1.5]}}\nbodies: {b: {mass: 1, %s}}\ncouplings:\n  - "
                 "%s\nsimulate: "
                 "{until: 1}\n",
                 cases[i].body, cases[i].coupling);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        while (fbd_simulation_advance(trial.simulation) == FBD_GOING) {
        }
        check_that(&checks, cases[i].words, strstr(fbd_simulation_reason(trial.simulation), cases[i].words));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- random chains of bodies, one of whose couplings ends */

enum { most_links = 3 };

struct chain {
    int count, kind[most_links], cut; /* coupling k joins body k with the one before, or with the ground */
    double mass[most_links], start[most_links][6];
};

enum { joined_by_rod, joined_by_pin, joined_kinds };

/* Bodies are rods of length 1; rods of the file join their ends at a distance. */
static struct chain draw_chain(struct random_numbers *numbers)
{
    struct chain chain = {.count = 1 + (int)random_between(numbers, 0, most_links)};
    chain.cut = (int)random_between(numbers, 0, chain.count);
    double x = 0, y = 0, vx = 0, vy = 0;
    for (int k = 0; k < chain.count; k++) {
        const double angle = random_between(numbers, -3, 3), omega = random_between(numbers, -2, 2);
        chain.mass[k] = random_between(numbers, 0.5, 2);
        chain.kind[k] = (int)random_between(numbers, 0, joined_kinds);
        if (chain.kind[k] == joined_by_rod) { /* turned about its end by its own angular velocity */
            const double turn = random_between(numbers, -3, 3), rate = random_between(numbers, -2, 2);
            x += 0.7 * cos(turn), y += 0.7 * sin(turn);
            vx -= 0.7 * rate * sin(turn), vy += 0.7 * rate * cos(turn);
        }
        const double c = cos(angle), s = sin(angle);
        const double place[] = {x + c / 2, y + s / 2, angle, vx - omega * s / 2, vy + omega * c / 2, omega};
        memcpy(chain.start[k], place, sizeof place);
        x += c, y += s, vx -= omega * s, vy += omega * c;
    }
    return chain;
}

/* With the condition `until` of the coupling that ends; NULL: without that coupling, "": it does not end. */
static void write_chain(const struct chain *chain, const char *until, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "fbd: 1\nground: {points: {A: [0, 0]}}\nbodies:\n");
    for (int k = 0; k < chain->count; k++) {
        const double *q = chain->start[k];
        used += (size_t)snprintf(
            text + used, size - used,
            "  b%d: {shape: rod, length: 1, mass: %.17g, motion: planar, forces: [gravity], initial: "
            "{x: %.17g, y: %.17g, theta: %.17g rad, vx: %.17g, vy: %.17g, omega: %.17g}}\n",
            k, chain->mass[k], q[0], q[1], q[2], q[3], q[4], q[5]);
    }
    bool any = false;
    for (int k = 0; k < chain->count; k++) {
        char end[20] = "ground.A";
        if (k > 0) snprintf(end, sizeof end, "b%d.right", k - 1);
        if (k == chain->cut && !until) continue;
        const bool ends = k == chain->cut && until[0];
        used +=
            (size_t)snprintf(text + used, size - used, "%s  - %s: {name: j%d, between: [b%d.left, %s]%s%s}\n",
                             any ? "" : "couplings:\n", chain->kind[k] == joined_by_rod ? "rod" : "pin", k, k,
                             end, ends ? ", until: " : "", ends ? until : "");
        any = true;
    }
    snprintf(text + used, size - used, "simulate: {until: 2, tolerance: 1e-12}\n");
}

static const char *const names_of_state[] = {"x", "y", "theta", "vx", "vy", "omega"};

static void take_chain(const struct trial *trial, struct chain *chain)
{
    for (int k = 0; k < chain->count; k++)
        for (int i = 0; i < 6; i++) {
            char name[20];
            snprintf(name, sizeof name, "b%d.%s", k, names_of_state[i]);
            chain->start[k][i] = get(trial, name);
        }
}

/* The magnitude of the force of the coupling that ends, at t of a run in which it does not. */
static double force_without_end(const struct chain *chain, double t)
{
    char text[text_room], name[20];
    write_chain(chain, "", text, sizeof text);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_to(&trial, t);
    snprintf(name, sizeof name, "j%d", chain->cut);
    const fbd_arrow arrow = arrow_of(&trial, (size_t)chain->cut, name);
    trial_close(&trial);
    return hypot(arrow.fx, arrow.fy);
}

/* Errors of 1e-12 for each step grow in half a second of a chain that whirls, by a factor of a thousand at most. */
static void check_chain(struct checks *checks, const struct chain *given, struct random_numbers *numbers)
{
    const double grown = 1e-7, later = 0.5, wanted = random_between(numbers, 0.1, 1);
    const bool by_force = random_chance(numbers, 0.7);
    const double force = by_force ? force_without_end(given, wanted) : 0;
    char text[text_room], until[60];
    snprintf(until, sizeof until, by_force ? "force %c %.17g N" : "t %c %.17g s",
             by_force && force_without_end(given, 0) > force ? '<' : '>', by_force ? force : wanted);
    write_chain(given, until, text, sizeof text);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    const double t = trial_to_event(&trial, FBD_EVENT_COUPLING_ENDS, NULL, 0);
    check_that(checks, "it ends by then", t <= wanted + grown);
    if (by_force)
        check_close(checks, "force at the end", force_without_end(given, t), force, grown * (1 + force));
    struct chain rest = *given, after = *given, without = *given;
    take_chain(&trial, &rest);
    trial_to(&trial, t + later);
    take_chain(&trial, &after);
    trial_close(&trial);
    write_chain(&rest, NULL, text, sizeof text);
    trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_to(&trial, later);
    take_chain(&trial, &without);
    trial_close(&trial);
    for (int k = 0; k < given->count; k++)
        for (int i = 0; i < 6; i++)
            check_close(checks, names_of_state[i], after.start[k][i], without.start[k][i],
                        grown * (1 + fabs(without.start[k][i])));
}

static void chains_go_on_without(void **unused)
{
    const int first = number_of("FBD_SEED", 1), count = number_of("FBD_SCENES", 100);
    struct checks checks = {0};
    (void)unused;
    for (int seed = first; seed < first + count; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        const struct chain chain = draw_chain(&numbers);
        const size_t failed = checks.failed;
        check_chain(&checks, &chain, &numbers);
        if (checks.failed > failed) printf("with FBD_SEED=%d FBD_SCENES=1\n", seed);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_string_breaks),
        cmocka_unit_test(events_name_reactions),
        cmocka_unit_test(jumps_and_starts_end_couplings),
        cmocka_unit_test(a_packed_state_goes_on),
        cmocka_unit_test(a_bullet_stays),
        cmocka_unit_test(couplings_begin),
        cmocka_unit_test(a_hook_lifts_a_box),
        cmocka_unit_test(other_begins_are_refused),
        cmocka_unit_test(chains_go_on_without),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

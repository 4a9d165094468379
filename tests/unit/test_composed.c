/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A scene put together of systems that do not touch gives each what it gives alone, bit for bit: states,
 * works, events, names.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "model/model.h"
#include "random_numbers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* In a system `#` stands for its number and `$` for a number between 0.5 and 1.5. */
struct system {
    const char *bodies, *couplings;
};

static const struct system systems[] = {
    {"  p#: {mass: $, motion: {slide: {x: \"0.$[m]*sin(2.$[rad/s]*t)\"}}, forces: [gravity]}\n"
     "  q#: {mass: $, shape: rod, length: 1, motion: {pivot: {on: p#, at: [0, 0], point: left}}, forces: "
     "[gravity]}\n",
     ""},
    {"  w#: {mass: $, shape: disc, radius: 0.3, motion: {pivot: {at: [0, 0], theta: "
     "\"1.$[rad/s^2]*t^2\"}}}\n",
     ""},
    {"  s#: {mass: $, motion: slide, initial: {v: $}, forces: [gravity, normal, friction: 0.3]}\n", ""},
    {"  r#: {mass: $, shape: disc, radius: 0.2 m, motion: planar, initial: {x: 0, y: 0.2}, forces: [gravity, "
     "applied: {value: $, angle: 0}]}\n",
     "  - roll: {name: tread#, body: r#, on: floor, static: 0.3, kinetic: 0.2}\n"},
    {"  m#: {mass: 2.$, motion: {slide: {along: -90 deg, through: [-0.1, -1]}}, forces: [gravity]}\n"
     "  n#: {mass: $, motion: {slide: {along: -90 deg, through: [0.1, -1]}}, forces: [gravity]}\n"
     "  k#: {mass: $, shape: disc, radius: 0.1, motion: {pivot: {at: [0, 0]}}}\n",
     "  - rope: {name: cord#, through: [m#, k#, n#]}\n"},
    {"  b#: {mass: $, motion: particle, initial: {x: 0.6, vx: $}, forces: [gravity, drag: {linear: 0.2}]}\n",
     "  - rope: {name: line#, through: [ground.A, b#], length: 1 m}\n"},
    {"  x#: {mass: $, shape: rod, length: 1, motion: {pivot: {at: [0, 0], point: left}}, initial: {theta: 60 "
     "deg}, "
     "forces: [gravity]}\n"
     "  y#: {mass: $, shape: rod, length: 1, motion: {pivot: {on: x#, at: right, point: left}}, initial: "
     "{theta: "
     "-60 deg}, forces: [gravity]}\n",
     "  - rod: {name: bar#, between: [y#.right, ground.B]}\n"},
    {"  e#: {mass: $, motion: particle, initial: {x: 1}, forces: [gravity]}\n"
     "  f#: {mass: $, motion: particle, initial: {x: 2}}\n",
     "  - spring: {name: coil#, between: [e#, f#], stiffness: 3$, free_length: 0.5}\n"
     "  - damper: {name: pot#, between: [e#, ground.A], coefficient: $}\n"},
};
enum { system_count = sizeof systems / sizeof *systems, most_together = 5 };

struct choice {
    int which, number;
    uint64_t seed;
};

static void write_part(FILE *out, const char *text, int number, struct random_numbers *numbers)
{
    for (; *text; text++) {
        if (*text == '#')
            fprintf(out, "%d", number);
        else if (*text == '$' && (text[-1] == '.' || (text[-1] >= '0' && text[-1] <= '9')))
            fprintf(out, "%d", 10 + (int)(random_bits(numbers) % 90)); /* digits of a number */
        else if (*text == '$')
            fprintf(out, "%.6g", random_between(numbers, 0.5, 1.5));
        else
            fputc(*text, out);
    }
}

static char *scene_of(const struct choice *choices, int count)
{
    struct random_numbers numbers[most_together];
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(out, "fbd: 1\nground: {points: {A: [0, 0], B: [2, 0]}, lines: {floor: {along: 0}}}\nbodies:\n");
    for (int i = 0; i < count; i++) {
        numbers[i].state = choices[i].seed;
        write_part(out, systems[choices[i].which].bodies, choices[i].number, &numbers[i]);
    }
    bool coupled = false;
    for (int i = 0; i < count; i++) coupled |= systems[choices[i].which].couplings[0] != '\0';
    if (coupled) fprintf(out, "couplings:\n");
    for (int i = 0; i < count; i++)
        write_part(out, systems[choices[i].which].couplings, choices[i].number, &numbers[i]);
    fprintf(out, "simulate: {until: 0.7 s}\n");
    fclose(out);
    return text;
}

static void same_states(struct checks *checks, struct trial *alone, struct trial *whole)
{
    const fbd_model *model = alone->model;
    for (int i = 0; i < model->plan.n; i++) {
        const char *names[] = {model->labels[i].name, model->labels[i].rate_name};
        for (int k = 0; k < 2; k++) {
            double got = NAN, want = NAN;
            fbd_state_get(fbd_result_state(whole->result), names[k], &got);
            fbd_state_get(fbd_result_state(alone->result), names[k], &want);
            check_close(checks, names[k], got, want, 0);
        }
    }
}

static void same_works(struct checks *checks, struct trial *alone, struct trial *whole)
{
    const fbd_model *model = alone->model;
    for (size_t i = 0; i < model->load_count; i++) {
        const char *body = model->bodies[model->loads[i].body].name, *load = model->loads[i].source->name;
        double want = fbd_result_work(alone->result, body, load);
        check_close(checks, load, fbd_result_work(whole->result, body, load), want, 0);
    }
}

/* The events of one system are a part of those of all, in the same order. */
static void same_events(struct checks *checks, struct trial *alone, struct trial *whole)
{
    size_t next = 0;
    for (size_t i = 0; i < fbd_simulation_event_count(alone->simulation); i++) {
        fbd_event want = fbd_simulation_event(alone->simulation, i), got = {.t = NAN};
        for (; next < fbd_simulation_event_count(whole->simulation); next++) {
            got = fbd_simulation_event(whole->simulation, next);
            if (strcmp(got.body, want.body) == 0 && got.kind == want.kind) break;
        }
        next++;
        check_close(checks, want.name, got.t, want.t, 0);
        if (strcmp(got.name, want.name) != 0 || strcmp(got.detail, want.detail) != 0)
            check_close(checks, want.detail, 1, 0, 0);
    }
}

static void compare(struct checks *checks, const struct choice *choices, int count)
{
    char *text = scene_of(choices, count);
    struct trial whole = trial_parse(text);
    const fbd_options options = FBD_OPTIONS_DEFAULT;
    trial_run(&whole, &options);
    for (int i = 0; i < count; i++) {
        char *part = scene_of(&choices[i], 1);
        struct trial alone = trial_parse(part);
        trial_run(&alone, &options);
        same_states(checks, &alone, &whole);
        same_works(checks, &alone, &whole);
        same_events(checks, &alone, &whole);
        trial_close(&alone);
        free(part);
    }
    trial_close(&whole);
    free(text);
}

static void systems_side_by_side_move_as_they_do_alone(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (uint64_t seed = 1; seed <= 60; seed++) {
        struct random_numbers numbers = {seed};
        struct choice choices[most_together];
        int count = 2 + (int)(random_bits(&numbers) % (most_together - 1));
        for (int i = 0; i < count; i++)
            choices[i] =
                (struct choice){(int)(random_bits(&numbers) % system_count), i, random_bits(&numbers)};
        compare(&checks, choices, count);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(systems_side_by_side_move_as_they_do_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

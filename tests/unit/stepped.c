/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random_numbers.h"
#include "stepped.h"
#include "thorough.h"

static const int usual_steps = 8000;

struct census {
    int tried, unfit, skipped, agree, ended, differ;
};

void stepped_name(struct stepped_values *values, const char *owner, int number, const char *what,
                  double value, double scale)
{
    int i = values->count++;
    assert_true(i < stepped_most);
    snprintf(values->name[i], sizeof values->name[i], "%s%d%s%s", owner, number, *what ? "." : "", what);
    values->value[i] = value;
    values->scale[i] = scale;
}

static double apart(const struct stepped_values *a, const struct stepped_values *b)
{
    double most = 0;
    for (int i = 0; i < a->count; i++) {
        double off = a->scale[i] * fabs(a->value[i] - b->value[i]);
        if (!(off <= most)) most = off;
    }
    return most;
}

double stepped_doubt(const struct stepped_answers *answers)
{
    return apart(&answers->rough, &answers->fine);
}

bool stepped_agree(const struct stepped_answers *answers)
{
    return apart(&answers->ours, &answers->fine) <= fmax(10 * stepped_doubt(answers), 3e-4);
}

void stepped_ask(struct stepped_answers *answers, struct trial *trial)
{
    answers->ours = answers->fine;
    for (int i = 0; i < answers->ours.count; i++)
        answers->ours.value[i] = trial_get(trial, answers->ours.name[i]);
}

void stepped_tell(const char *name, unsigned long long seed, const struct stepped_answers *answers)
{
    print_message("# %s %llu: %.3g apart (half the steps: %.2g):", name, seed,
                  apart(&answers->ours, &answers->fine), stepped_doubt(answers));
    for (int i = 0; i < answers->ours.count; i++)
        print_message(" %s %.6g for %.6g", answers->ours.name[i], answers->ours.value[i],
                      answers->fine.value[i]);
    print_message("\n");
}

/* More than one motion agrees with the forces, or two impacts are within a few steps, which take them for one. */
static bool is_open(struct trial *trial, double step)
{
    double last = -1;
    for (size_t i = 0; i < fbd_simulation_event_count(trial->simulation); i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind == FBD_EVENT_SEVERAL) return true;
        if (event.kind != FBD_EVENT_IMPACT) continue;
        if (event.t != last && event.t - last < 4 * step) return true;
        last = event.t;
    }
    return false;
}

/* What is asked of a run that ends: to agree with the stepping, eight times as fine where it has to be. */
static void judge(struct checks *checks, const struct stepped_kind *kind, uint64_t seed, int steps,
                  struct trial *trial, struct stepped_answers *answers, struct census *census)
{
    const int finer = 8;
    stepped_ask(answers, trial);
    if (!stepped_agree(answers) && stepped_doubt(answers) <= stepped_sensitive) {
        answers->rough = kind->step(kind->scene, steps * finer / 2);
        answers->fine = kind->step(kind->scene, steps * finer);
    }
    bool agree = stepped_agree(answers);
    if (stepped_doubt(answers) > stepped_sensitive ||
        (!agree && is_open(trial, *kind->until / (finer * steps)))) {
        census->skipped++;
    } else if (check_that(checks, "time stepping says the same", agree)) {
        census->agree++;
    } else {
        census->differ++;
        stepped_tell(kind->name, seed, answers);
    }
}

static int asked(const struct stepped_kind *kind, const char *what, int usual)
{
    char name[60];
    snprintf(name, sizeof name, "%s%s", kind->name, what);
    return number_of(name, usual);
}

static void compare(struct checks *checks, const struct stepped_kind *kind, uint64_t seed, bool show,
                    struct census *census)
{
    static struct written text;
    char name[60];
    const int steps = asked(kind, "_STEPS", usual_steps);
    snprintf(name, sizeof name, "%s_UNTIL", kind->name);
    kind->draw(seed, kind->scene);
    if (getenv(name)) *kind->until = strtod(getenv(name), NULL);
    kind->write(kind->scene, &text);
    if (show) puts(text.all), fflush(stdout);
    struct stepped_answers answers = {kind->step(kind->scene, steps / 2),
                                      kind->step(kind->scene, steps),
                                      {0}};
    census->tried++;
    struct trial trial = trial_parse(text.all);
    trial_run(&trial, NULL);
    if (trial.outcome == FBD_DONE) {
        judge(checks, kind, seed, steps, &trial, &answers, census);
        if (show) stepped_tell(kind->name, seed, &answers);
    } else if (strstr(fbd_simulation_reason(trial.simulation), "does not fit")) {
        census->unfit++;
    } else {
        bool open = stepped_doubt(&answers) > stepped_sensitive;
        census->ended += !open;
        census->skipped += open;
        if (!open) check_that(checks, "the run comes to its end", false);
        print_message("# %s %llu%s: %s\n", kind->name, (unsigned long long)seed, open ? " (sensitive)" : "",
                      fbd_simulation_reason(trial.simulation));
    }
    trial_close(&trial);
}

void stepped_try(const struct stepped_kind *kind)
{
    struct checks checks = {0};
    struct census census = {0};
    const int count = asked(kind, "", draws_of(kind->scenes)), seed = asked(kind, "_SEED", -1),
              first = seed < 0 ? asked(kind, "_FIRST", 0) : seed;
    for (int i = first; i < first + (seed < 0 ? count : 1); i++)
        compare(&checks, kind, (uint64_t)i, seed >= 0, &census);
    print_message("# %d tried, %d agree, %d differ, %d end, %d too sensitive, %d do not fit\n", census.tried,
                  census.agree, census.differ, census.ended, census.skipped, census.unfit);
    checks_end(&checks);
}

void stepped_try_each(const struct stepped_kind *kind, const unsigned *seeds, int count)
{
    struct checks checks = {0};
    struct census census = {0};
    for (int i = 0; i < count; i++) compare(&checks, kind, seeds[i], false, &census);
    check_that(&checks, "all are compared", census.agree == count);
    checks_end(&checks);
}

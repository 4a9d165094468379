/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random scenes by the library and by the independent assembly.
 *
 *     cross_check [--scenes N] [--seed FIRST] [--runs K] [--variants K] [--rest K] [--jobs J] [--of KIND] [--tap]
 *     cross_check [--of KIND] --show SEED
 *     cross_check [--of KIND] [--scenes N] [--seed FIRST] --write FOLDER
 *
 * Scenes FIRST, FIRST + 1, ...; every K-th (default: each) is also run for a second. With `rest`
 * every K-th is brought to rest, for its statics and its linearisation (rest.h). Scenes that fail are shrunk and printed. Exit code 1 when any has failed.
 * `write` compares nothing: it writes each scene that has a start to FOLDER/SEED.yaml. KIND: tracks, slots, windings,
 * masses, rolls, spools.
 */
#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "compare.h"
#include "generate.h"
#include "invariance.h"
#include "rest.h"
#include "shrink.h"
#include "write.h"

struct counts {
    unsigned long scenes, unfit, runs, broke_off, sensitive, pulsed, jammed, verdicts[verdict_count];
    double acceleration, force, state;
    unsigned long variants[variant_count], variant_runs, variant_failures[variant_count];
    unsigned long balanced[2], rest_failures[2]; /* statics, linearisations */
    double rest_force, rest_slope;
    double variant_force, variant_state; /* of those that are not moved by 1e6 m */
};

struct plan {
    uint64_t scenes, first, stride;
    unsigned runs, variants, rest;
    enum focus focus;
    bool tap;
};

/* Most of a run's time goes into scenes that print: more than these are counted alone. */
enum { most_printed = 10 };

static const double run_length = 1;

/* ---- one that fails */

struct wanted {
    enum verdict verdict;
    double until;
    struct outcome outcome;
};

static bool fails_alike(void *context, struct scene *scene)
{
    struct wanted *wanted = context;
    static struct absolute absolute;
    if (!scene_fit(scene, &absolute) || !scene_settle(scene, &absolute)) return false;
    struct outcome outcome;
    scene_compare(scene, &absolute, wanted->until, &outcome);
    if (outcome.verdict != wanted->verdict) return false;
    wanted->outcome = outcome;
    return true;
}

static void print_scene(const struct scene *scene)
{
    static char text[text_room];
    scene_write(scene, run_length, text);
    for (char *line = text; *line; line = strchr(line, '\n') + 1)
        printf("#     %.*s\n", (int)(strchr(line, '\n') - line), line);
}

static void print_failure(struct scene *scene, const struct outcome *outcome)
{
    struct wanted wanted = {.verdict = outcome->verdict,
                            .until = outcome->verdict >= run_failed ? run_length : 0,
                            .outcome = *outcome};
    printf("# seed %llu: %s: %s\n", (unsigned long long)scene->seed, verdict_name(outcome->verdict),
           outcome->what);
    fflush(stdout);
    scene_shrink(scene, fails_alike, &wanted);
    printf("# shrunk: %s\n", wanted.outcome.what);
    print_scene(scene);
    fflush(stdout);
}

/* ---- many */

static unsigned long failures(const struct counts *counts)
{
    unsigned long sum = counts->scenes - counts->unfit - counts->verdicts[agrees];
    for (int i = 0; i < variant_count; i++) sum += counts->variant_failures[i];
    return sum + counts->rest_failures[0] + counts->rest_failures[1];
}

static void check_scene(uint64_t seed, enum focus focus, bool run, struct counts *counts)
{
    static struct scene scene;
    static struct absolute absolute;
    struct outcome outcome;
    counts->scenes++;
    if (!scene_generate(&scene, &absolute, seed, focus)) {
        counts->unfit++;
        return;
    }
    scene_compare(&scene, &absolute, run ? run_length : 0, &outcome);
    counts->runs += outcome.ran;
    counts->broke_off += outcome.broke_off;
    counts->sensitive += outcome.sensitive;
    counts->pulsed += outcome.pulsed;
    counts->jammed += outcome.jammed;
    counts->acceleration = fmax(counts->acceleration, outcome.worst_acceleration);
    counts->force = fmax(counts->force, outcome.worst_force);
    counts->state = fmax(counts->state, outcome.worst_state);
    counts->verdicts[outcome.verdict]++;
    if (outcome.verdict != agrees && failures(counts) <= most_printed) print_failure(&scene, &outcome);
}

struct wanted_variant {
    enum variant variant;
    enum verdict verdict;
};

static bool varies_alike(void *context, struct scene *scene)
{
    const struct wanted_variant *wanted = context;
    static struct absolute absolute;
    struct outcome outcome;
    if (!scene_fit(scene, &absolute) || !scene_settle(scene, &absolute)) return false;
    return scene_compare_variant(scene, &absolute, wanted->variant, &outcome) &&
           outcome.verdict == wanted->verdict;
}

static void check_variants(uint64_t seed, enum focus focus, struct counts *counts)
{
    static struct scene scene;
    static struct absolute absolute;
    for (int i = 0; i < variant_count; i++) {
        struct outcome outcome;
        if (!scene_generate(&scene, &absolute, seed, focus)) return;
        if (!scene_compare_variant(&scene, &absolute, (enum variant)i, &outcome)) continue;
        counts->variants[i]++;
        counts->variant_runs += outcome.ran;
        counts->sensitive += outcome.sensitive;
        if (i != variant_moved) {
            counts->variant_force = fmax(counts->variant_force, outcome.worst_force);
            counts->variant_state = fmax(counts->variant_state, outcome.worst_state);
        }
        if (outcome.verdict == agrees) continue;
        counts->variant_failures[i]++;
        if (failures(counts) > most_printed) continue;
        struct wanted_variant wanted = {(enum variant)i, outcome.verdict};
        printf("# seed %llu %s: %s: %s\n", (unsigned long long)seed, variant_name((enum variant)i),
               verdict_name(outcome.verdict), outcome.what);
        scene_shrink(&scene, varies_alike, &wanted);
        print_scene(&scene);
        fflush(stdout);
    }
}

/* ---- at rest */

static bool compare_at_rest(const struct scene *scene, bool freely, struct outcome *outcome)
{
    static struct absolute absolute;
    static struct scene balanced;
    if (freely)
        return scene_balance_freely(scene, &balanced, &absolute) &&
               scene_compare_linear(&balanced, &absolute, outcome);
    return scene_balance(scene, &balanced, &absolute) && scene_compare_statics(&balanced, &absolute, outcome);
}

struct wanted_rest {
    bool freely;
    enum verdict verdict;
    struct outcome outcome;
};

static bool rests_alike(void *context, struct scene *scene)
{
    struct wanted_rest *wanted = context;
    struct outcome outcome;
    if (!compare_at_rest(scene, wanted->freely, &outcome) || outcome.verdict != wanted->verdict) return false;
    wanted->outcome = outcome;
    return true;
}

/* The scene is printed as it is in balance. */
static void print_at_rest(struct scene *scene, bool freely, const struct outcome *outcome)
{
    static struct absolute absolute;
    static struct scene balanced;
    struct wanted_rest wanted = {freely, outcome->verdict, *outcome};
    printf("# seed %llu at rest: %s: %s\n", (unsigned long long)scene->seed, verdict_name(outcome->verdict),
           outcome->what);
    scene_shrink(scene, rests_alike, &wanted);
    printf("# shrunk: %s\n", wanted.outcome.what);
    bool balances = freely ? scene_balance_freely(scene, &balanced, &absolute)
                           : scene_balance(scene, &balanced, &absolute);
    print_scene(balances ? &balanced : scene);
    fflush(stdout);
}

static void check_rest(uint64_t seed, enum focus focus, struct counts *counts)
{
    static struct scene scene;
    static struct absolute absolute;
    for (int freely = 0; freely < 2; freely++) {
        struct outcome outcome;
        if (!scene_generate(&scene, &absolute, seed, focus)) return;
        if (!compare_at_rest(&scene, freely, &outcome)) continue;
        counts->balanced[freely]++;
        counts->rest_force = fmax(counts->rest_force, outcome.worst_force);
        counts->rest_slope = fmax(counts->rest_slope, outcome.worst_state);
        if (outcome.verdict == agrees) continue;
        counts->rest_failures[freely]++;
        if (failures(counts) <= most_printed) print_at_rest(&scene, freely, &outcome);
    }
}

static void check_share(const struct plan *plan, uint64_t share, struct counts *counts)
{
    for (uint64_t i = share; i < plan->scenes; i += plan->stride) {
        uint64_t seed = plan->first + i;
        check_scene(seed, plan->focus, plan->runs > 0 && seed % plan->runs == 0, counts);
        if (plan->variants > 0 && seed % plan->variants == 0) check_variants(seed, plan->focus, counts);
        if (plan->rest > 0 && seed % plan->rest == 0) check_rest(seed, plan->focus, counts);
    }
}

static void add_counts(struct counts *sum, const struct counts *counts)
{
    sum->scenes += counts->scenes;
    sum->unfit += counts->unfit;
    sum->runs += counts->runs;
    sum->broke_off += counts->broke_off;
    sum->sensitive += counts->sensitive;
    sum->pulsed += counts->pulsed;
    sum->jammed += counts->jammed;
    for (int i = 0; i < verdict_count; i++) sum->verdicts[i] += counts->verdicts[i];
    sum->acceleration = fmax(sum->acceleration, counts->acceleration);
    sum->force = fmax(sum->force, counts->force);
    sum->state = fmax(sum->state, counts->state);
    sum->variant_runs += counts->variant_runs;
    sum->variant_force = fmax(sum->variant_force, counts->variant_force);
    sum->variant_state = fmax(sum->variant_state, counts->variant_state);
    sum->rest_force = fmax(sum->rest_force, counts->rest_force);
    sum->rest_slope = fmax(sum->rest_slope, counts->rest_slope);
    for (int i = 0; i < 2; i++) {
        sum->balanced[i] += counts->balanced[i];
        sum->rest_failures[i] += counts->rest_failures[i];
    }
    for (int i = 0; i < variant_count; i++) {
        sum->variants[i] += counts->variants[i];
        sum->variant_failures[i] += counts->variant_failures[i];
    }
}

/* Each share in a process of its own, which sends its counts through a pipe. */
static bool check_all(const struct plan *plan, struct counts *sum)
{
    int ends[2];
    bool fine = true;
    if (plan->stride == 1) {
        check_share(plan, 0, sum);
        return true;
    }
    if (pipe(ends) != 0) return false;
    for (uint64_t share = 0; share < plan->stride; share++) {
        if (fork() != 0) continue;
        struct counts counts = {0};
        check_share(plan, share, &counts);
        fflush(stdout);
        _exit(write(ends[1], &counts, sizeof counts) == (ssize_t)sizeof counts ? 0 : 1);
    }
    close(ends[1]);
    for (uint64_t share = 0; share < plan->stride; share++) {
        struct counts counts;
        int status;
        if (read(ends[0], &counts, sizeof counts) == (ssize_t)sizeof counts)
            add_counts(sum, &counts);
        else
            fine = false;
        if (wait(&status) < 0 || status != 0) fine = false;
    }
    return fine;
}

static void report(const struct plan *plan, const struct counts *counts)
{
    unsigned long compared = counts->scenes - counts->unfit;
    const char *mark = plan->tap ? "# " : "";
    printf("%s%lu scenes from seed %llu: %lu compared, %lu left out (no consistent or no well-conditioned "
           "start)\n",
           mark, counts->scenes, (unsigned long long)plan->first, compared, counts->unfit);
    printf("%s%lu runs, of these %lu up to their first event, %lu too sensitive to compare, %lu with pulses "
           "shorter than steps, %lu that jam\n",
           mark, counts->runs, counts->broke_off, counts->sensitive, counts->pulsed, counts->jammed);
    printf("%slargest differences: accelerations %.2g, forces %.2g of the largest term, states %.2g\n", mark,
           counts->acceleration, counts->force, counts->state);
    for (int i = agrees + 1; i < run_verdicts; i++) {
        if (plan->tap)
            printf("%s %d - %s\n", counts->verdicts[i] ? "not ok" : "ok", i,
                   (const char *const[]){"", "scenes are accepted", "forces agree", "accelerations agree",
                                         "terms add up", "runs reach their end", "states agree"}[i]);
        else if (counts->verdicts[i])
            printf("%s: %lu\n", verdict_name((enum verdict)i), counts->verdicts[i]);
    }
}

static void report_variants(const struct plan *plan, const struct counts *counts)
{
    const char *mark = plan->tap ? "# " : "";
    if (plan->variants == 0) return;
    printf("%svariants: %lu runs; largest differences: forces %.2g, states %.2g (not counting those moved by "
           "1e6 m)\n",
           mark, counts->variant_runs, counts->variant_force, counts->variant_state);
    for (int i = 0; i < variant_count; i++)
        if (plan->tap)
            printf("%s %d - %lu scenes %s\n", counts->variant_failures[i] ? "not ok" : "ok", run_verdicts + i,
                   counts->variants[i], variant_name((enum variant)i));
        else
            printf("%lu scenes %s: %lu differ\n", counts->variants[i], variant_name((enum variant)i),
                   counts->variant_failures[i]);
}

static void report_rest(const struct plan *plan, const struct counts *counts)
{
    static const char *const what[] = {"statics", "linearisations"};
    const char *mark = plan->tap ? "# " : "";
    if (plan->rest == 0) return;
    printf("%sat rest: largest differences: forces %.2g of the largest, slopes %.2g\n", mark,
           counts->rest_force, counts->rest_slope);
    for (int i = 0; i < 2; i++)
        if (plan->tap)
            printf("%s %d - %lu %s agree\n", counts->rest_failures[i] ? "not ok" : "ok",
                   run_verdicts + (plan->variants > 0 ? variant_count : 0) + i, counts->balanced[i], what[i]);
        else
            printf("%lu %s: %lu differ\n", counts->balanced[i], what[i], counts->rest_failures[i]);
}

static enum focus focus_called(const char *name)
{
    static const char *const names[] = {"", "tracks", "slots", "windings", "masses", "rolls", "spools"};
    for (int i = 1; i < focus_count; i++)
        if (strcmp(name, names[i]) == 0) return (enum focus)i;
    return any_scene;
}

static int show(uint64_t seed, enum focus focus)
{
    static struct scene scene;
    static struct absolute absolute;
    static char text[text_room];
    bool fit = scene_generate(&scene, &absolute, seed, focus);
    scene_write(&scene, run_length, text);
    fputs(text, stdout);
    if (!fit) puts("# left out: no consistent or no well-conditioned start");
    return 0;
}

static bool write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    if (!file) return false;
    bool fine = fputs(text, file) >= 0;
    return fclose(file) == 0 && fine;
}

static int write_scenes(const struct plan *plan, const char *folder)
{
    static struct scene scene;
    static struct absolute absolute;
    static char text[text_room];
    for (uint64_t i = 0; i < plan->scenes; i++) {
        char path[4096];
        unsigned long long seed = plan->first + i;
        if (!scene_generate(&scene, &absolute, seed, plan->focus)) continue;
        scene_write(&scene, run_length, text);
        int length = snprintf(path, sizeof path, "%s/%llu.yaml", folder, seed);
        if (length < 0 || (size_t)length >= sizeof path || !write_file(path, text)) {
            perror(folder);
            return 2;
        }
    }
    return 0;
}

int main(int count, char **arguments)
{
    struct plan plan = {.scenes = 2000, .first = 1, .stride = 1, .runs = 1};
    const char *folder = NULL;
    for (int i = 1; i < count; i++) {
        const char *value = i + 1 < count ? arguments[i + 1] : "";
        uint64_t number = strtoull(value, NULL, 10);
        if (strcmp(arguments[i], "--tap") == 0) plan.tap = true;
        if (strcmp(arguments[i], "--show") == 0) return show(number, plan.focus);
        if (strcmp(arguments[i], "--write") == 0) folder = value;
        if (strcmp(arguments[i], "--of") == 0) plan.focus = focus_called(value);
        if (strcmp(arguments[i], "--scenes") == 0) plan.scenes = number;
        if (strcmp(arguments[i], "--seed") == 0) plan.first = number;
        if (strcmp(arguments[i], "--runs") == 0) plan.runs = (unsigned)number;
        if (strcmp(arguments[i], "--variants") == 0) plan.variants = (unsigned)number;
        if (strcmp(arguments[i], "--rest") == 0) plan.rest = (unsigned)number;
        if (strcmp(arguments[i], "--jobs") == 0 && number > 0) plan.stride = number;
    }
    struct counts counts = {0};
    gsl_set_error_handler_off();
    if (folder) return write_scenes(&plan, folder);
    if (plan.tap)
        printf("1..%d\n",
               run_verdicts - 1 + (plan.variants > 0 ? variant_count : 0) + (plan.rest > 0 ? 2 : 0));
    fflush(stdout);
    if (!check_all(&plan, &counts)) return 2;
    report(&plan, &counts);
    report_variants(&plan, &counts);
    report_rest(&plan, &counts);
    return failures(&counts) == 0 ? 0 : 1;
}

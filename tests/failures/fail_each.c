/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Usage: fail_each [--most NUMBER] [--only TEXT] [--verbose] memory|files LAYER COMMAND_LINES
 * Run each command line as often as it makes calls of a kind (layer.h), with another one of them failing each
 * time, and then again with all after it failing too. Prints TAP, a claim for each command line. `--most`: of
 * more calls than that, the first half of so many each and from there on ever the same number apart.
 */
#include "judge.h"

#include <err.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

struct plan {
    enum layer_kind kind;
    const char *layer, *only;
    long most; /* runs of a command line, each for one call and for all after it */
    bool verbose;
    char place[64]; /* where the programs run */
};

struct tally {
    long claims, failed, runs, calls;
    FILE *notes; /* on what is wrong with the claim that is being made; they are printed behind it */
};

static const struct piece before = {"before", "before\n", 7};

/* ---- a command line */

enum { most_words = 64 };

struct command {
    char text[1024]; /* as it stands in the list */
    char words[1024];
    char program[1024];
    char *argv[most_words + 1];
};

/* `run --json - MODEL` is `BUILD/tests/failures/fbd-run --json - MODEL`; words are separated by blanks. */
static void read_command(struct command *command, const char *line)
{
    const char *build = getenv("FBD_BUILD_ROOT");
    snprintf(command->text, sizeof command->text, "%.*s", (int)strcspn(line, "\n"), line);
    memcpy(command->words, command->text, sizeof command->words);
    char *rest, *word = strtok_r(command->words, " ", &rest);
    int count = 0;
    snprintf(command->program, sizeof command->program, "%s/tests/failures/fbd-%s", build ? build : "build",
             word);
    command->argv[count++] = command->program;
    while ((word = strtok_r(NULL, " ", &rest)) != NULL && count < most_words) command->argv[count++] = word;
    command->argv[count] = NULL;
}

/* ---- the files that a run finds */

/* Where the undisturbed run writes a file, another one lies there already. */
static void prepare(const struct plan *plan, const struct snapshot *start, const struct snapshot *whole)
{
    place_clear(plan->place);
    for (size_t i = 0; i < start->count; i++)
        place_put(plan->place, start->files[i].name, start->files[i].data, start->files[i].size);
    for (size_t i = 0; i < whole->count; i++)
        place_put(plan->place, whole->files[i].name, before.data, before.size);
}

/* A sweep to be gone on with: what is left of one that could not move its table into place, cut off within
 * its rows. */
static struct snapshot interrupted_sweep(const struct plan *plan, struct command *command)
{
    char *argv[most_words + 1];
    int count = 0;
    for (char **word = command->argv; *word; word++)
        if (strcmp(*word, "--resume") != 0) argv[count++] = *word;
    argv[count] = NULL;
    place_clear(plan->place);
    struct server server = server_start(plan->layer, plan->place, argv);
    server_run(&server, layer_files, 0, false);
    long calls = server.page->calls[layer_files];
    place_clear(plan->place);
    int status = server_run(&server, layer_files, calls, false);
    struct snapshot left = snapshot_take(&server, plan->place, status);
    server_end(&server);
    for (size_t i = 0; i < left.count; i++)
        if (strstr(left.files[i].name, ".part") && !strstr(left.files[i].name, ".key"))
            left.files[i].size = left.files[i].size * 2 / 3;
    return left;
}

static bool resumes(const struct command *command)
{
    return strstr(command->text, " --resume") != NULL;
}

/* ---- all calls of it */

static long next_call(const struct plan *plan, long call, long calls)
{
    long half = plan->most / 2;
    if (plan->most == 0 || calls <= plan->most || call < half) return call + 1;
    long stride = (calls - half + half - 1) / half;
    return call + stride;
}

static void explain(FILE *notes, const struct snapshot *run, const struct layer_page *page, long call,
                    bool stay, const char *wrong)
{
    fprintf(notes, "# call %ld, %s, fails%s: %s\n", call, page->what, stay ? " and all after it" : "", wrong);
    if (WIFEXITED(run->status))
        fprintf(notes, "#   exit code %d\n", WEXITSTATUS(run->status));
    else
        fprintf(notes, "#   signal %d\n", WTERMSIG(run->status));
    if (page->lost > 0) fprintf(notes, "#   %ld blocks, one of %s\n", page->lost, page->lost_by);
    for (char *line = run->err.data; *line; line += strcspn(line, "\n") + (strchr(line, '\n') != NULL))
        fprintf(notes, "#   says: %.*s\n", (int)strcspn(line, "\n"), line);
    for (size_t i = 0; i < run->count; i++)
        fprintf(notes, "#   leaves: %s, %zu bytes\n", run->files[i].name, run->files[i].size);
}

/* True when the run is as it should be. */
static bool try_call(const struct plan *plan, const struct server *server, const struct snapshot *start,
                     const struct snapshot *whole, long call, bool stay, FILE *notes)
{
    prepare(plan, start, whole);
    int status = server_run(server, plan->kind, call, stay);
    struct snapshot run = snapshot_take(server, plan->place, status);
    const char *wrong = judge(whole, &run, server->page, &before);
    if (wrong && notes) explain(notes, &run, server->page, call, stay, wrong);
    snapshot_free(&run);
    return !wrong;
}

static long fail_calls(const struct plan *plan, struct command *command, struct tally *tally, long *calls)
{
    struct snapshot start = {0};
    long wrong = 0;
    if (resumes(command)) start = interrupted_sweep(plan, command);
    struct server server = server_start(plan->layer, plan->place, command->argv);
    prepare(plan, &start, &(struct snapshot){0});
    int status = server_run(&server, plan->kind, 0, false);
    struct snapshot whole = snapshot_take(&server, plan->place, status);
    *calls = server.page->calls[plan->kind];
    if (!WIFEXITED(status) || server.page->lost != 0) {
        explain(tally->notes, &whole, server.page, 0, false, "undisturbed");
        wrong++;
    }
    for (int stay = 0; stay < 2; stay++) {
        for (long call = 1;; call = next_call(plan, call, *calls)) {
            FILE *notes = plan->verbose || wrong < 3 ? tally->notes : NULL;
            wrong += !try_call(plan, &server, &start, &whole, call, stay, notes);
            tally->runs++;
            if (server.page->refused == 0) break;
        }
    }
    server_end(&server);
    snapshot_free(&whole);
    if (resumes(command)) snapshot_free(&start);
    return wrong;
}

static void claim(const struct plan *plan, const char *line, struct tally *tally)
{
    struct command command;
    long calls;
    char *notes = NULL;
    size_t length;
    read_command(&command, line);
    tally->notes = open_memstream(&notes, &length);
    if (!tally->notes) err(70, "open_memstream");
    long wrong = fail_calls(plan, &command, tally, &calls);
    fclose(tally->notes);
    tally->claims++;
    tally->calls += calls;
    tally->failed += wrong > 0;
    printf("%s %ld - %s: %ld calls failed in turn", wrong ? "not ok" : "ok", tally->claims, command.text,
           calls);
    if (wrong) printf(", %ld of them wrongly", wrong);
    printf("\n%s", notes);
    free(notes);
    fflush(stdout);
}

/* ---- all command lines */

static struct plan read_arguments(int argc, char **argv)
{
    struct plan plan = {.place = "/tmp/fail-each-XXXXXX"};
    int i = 1;
    for (; i < argc && strncmp(argv[i], "--", 2) == 0; i++) {
        if (strcmp(argv[i], "--verbose") == 0) plan.verbose = true;
        if (strcmp(argv[i], "--most") == 0 && i + 1 < argc) plan.most = atol(argv[++i]);
        if (strcmp(argv[i], "--only") == 0 && i + 1 < argc) plan.only = argv[++i];
    }
    if (argc - i != 3)
        errx(2, "usage: fail_each [--most NUMBER] [--only TEXT] memory|files LAYER COMMAND_LINES");
    plan.kind = strcmp(argv[i], "memory") == 0 ? layer_memory : layer_files;
    plan.layer = argv[i + 1];
    if (!freopen(argv[i + 2], "r", stdin)) err(2, "%s", argv[i + 2]);
    return plan;
}

static void make_place(struct plan *plan)
{
    char link[128], target[1024];
    const char *root = getenv("FBD_SOURCE_ROOT");
    if (!mkdtemp(plan->place)) err(70, "%s", plan->place);
    static const char *const folders[][2] = {{"models", "models"}, {"scenes", "tests/failures/scenes"}};
    for (int i = 0; i < 2; i++) {
        snprintf(link, sizeof link, "%s/%s", plan->place, folders[i][0]);
        snprintf(target, sizeof target, "%s/%s", root ? root : ".", folders[i][1]);
        if (symlink(target, link) != 0) err(70, "%s", link);
    }
}

static void remove_place(const struct plan *plan)
{
    char link[128];
    place_clear(plan->place);
    snprintf(link, sizeof link, "%s/models", plan->place);
    unlink(link);
    snprintf(link, sizeof link, "%s/scenes", plan->place);
    unlink(link);
    rmdir(plan->place);
}

int main(int argc, char **argv)
{
    struct plan plan = read_arguments(argc, argv);
    struct tally tally = {0};
    char line[1024];
    make_place(&plan);
    while (fgets(line, sizeof line, stdin))
        if (line[0] != '#' && line[0] != '\n' && (!plan.only || strstr(line, plan.only)))
            claim(&plan, line, &tally);
    remove_place(&plan);
    printf("1..%ld\n", tally.claims);
    printf("# %ld calls of %ld command lines, %ld runs\n", tally.calls, tally.claims, tally.runs);
    return tally.failed > 0;
}

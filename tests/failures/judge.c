/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge.h"

#include <signal.h>
#include <string.h>
#include <sys/wait.h>

/* ---- what it says */

/* A line that the undisturbed run has printed too is no news. */
static bool is_news(const struct piece *usual, const char *line, size_t length)
{
    for (const char *at = usual->data; at && *at; at = strchr(at, '\n')) {
        at += *at == '\n';
        if (strncmp(at, line, length) == 0) return false;
    }
    return true;
}

static bool has(const char *line, size_t length, const char *text)
{
    const char *found = strstr(line, text);
    return found && found + strlen(text) <= line + length;
}

static bool tells(enum layer_kind kind, const char *line, size_t length)
{
    static const char *const reasons[] = {"No space left on device", "Permission denied",
                                          "Input/output error", "Too many open files in system"};
    if (kind == layer_memory) return has(line, length, "memory");
    static const char *const names[] = {"`", "standard output", "the input of gnuplot", ".yaml: ", ".csv: "};
    bool named = false;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) named |= has(line, length, names[i]);
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++)
        if (has(line, length, reasons[i])) return named;
    return false;
}

static const char *judge_message(const struct snapshot *whole, const struct snapshot *run,
                                 enum layer_kind kind)
{
    int news = 0, told = 0; /* lines; of files each may have its own */
    for (const char *line = run->err.data; *line;) {
        size_t length = strcspn(line, "\n") + 1;
        if (is_news(&whole->err, line, length)) {
            news++;
            told += tells(kind, line, length);
        }
        line += line[length - 1] ? length : length - 1;
    }
    if (news == 0) return "it does not say why";
    if (told == news && (news == 1 || kind == layer_files)) return NULL;
    if (told > 0) return "it says other things, too";
    return kind == layer_memory ? "it does not speak of memory" : "it does not say which file and why";
}

/* ---- what it leaves behind */

static bool is_partial(const char *name)
{
    size_t length = strlen(name);
    return (length > 5 && strcmp(name + length - 5, ".part") == 0) ||
           (length > 9 && strcmp(name + length - 9, ".part.key") == 0);
}

static const char *judge_files(const struct snapshot *whole, const struct snapshot *run,
                               const struct piece *before)
{
    for (size_t i = 0; i < run->count; i++) {
        const struct piece *file = &run->files[i], *wanted = snapshot_find(whole, file->name);
        if (!wanted && is_partial(file->name)) continue;
        if (!wanted) return "it leaves a file behind";
        if (!piece_same(file, wanted) && !piece_same(file, before)) return "it leaves half a file";
    }
    return run->count < whole->count ? "a file is gone" : NULL;
}

static bool is_whole(const struct snapshot *whole, const struct snapshot *run)
{
    bool same = run->status == whole->status && run->count == whole->count &&
                piece_same(&run->out, &whole->out) && piece_same(&run->err, &whole->err);
    for (size_t i = 0; same && i < run->count; i++) {
        const struct piece *wanted = snapshot_find(whole, run->files[i].name);
        same = wanted && piece_same(wanted, &run->files[i]);
    }
    return same;
}

/* A model file that cannot be read is a wrong model file. */
static bool no_model(const struct snapshot *run, enum layer_kind kind)
{
    return kind == layer_files && WEXITSTATUS(run->status) == 3 &&
           strstr(run->err.data, "cannot read the file: ");
}

const char *judge(const struct snapshot *whole, const struct snapshot *run, const struct layer_page *page,
                  const struct piece *before)
{
    if (!WIFEXITED(run->status)) return WTERMSIG(run->status) == SIGXCPU ? "it hangs" : "it ends by a signal";
    if (page->lost != 0) return "it loses memory";
    if (is_whole(whole, run)) return NULL;
    if (WEXITSTATUS(run->status) == 0) return "it ends with 0 and is not whole";
    if (WEXITSTATUS(run->status) != 1 && !no_model(run, page->kind)) return "its exit code is not 1";
    const char *wrong = judge_message(whole, run, page->kind);
    return wrong ? wrong : judge_files(whole, run, before);
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "server.h"

#include <err.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/* An unnamed file that is always written at its end, so that it can be emptied between runs. */
static int paper(void)
{
    int descriptor = memfd_create("paper", MFD_CLOEXEC);
    if (descriptor < 0 || fcntl(descriptor, F_SETFL, O_APPEND) != 0) err(70, "memfd_create");
    return descriptor;
}

static void set_number(const char *name, int value)
{
    char text[16];
    snprintf(text, sizeof text, "%d", value);
    setenv(name, text, 1);
}

static void __attribute__((noreturn)) become(const struct server *server, const char *layer,
                                             const char *place, char **argv, int shared, const int *ends)
{
    int nothing = open("/dev/null", O_RDONLY);
    if (chdir(place) != 0) err(70, "%s", place);
    dup2(nothing, STDIN_FILENO);
    dup2(server->out, STDOUT_FILENO);
    dup2(server->err, STDERR_FILENO);
    set_number(LAYER_PAGE, dup(shared));
    set_number(LAYER_ASK, ends[0]);
    set_number(LAYER_ANSWER, ends[1]);
    setenv("LD_PRELOAD", layer, 1);
    setenv("LD_BIND_NOW", "1", 1); /* names are looked up once, not in each run */
    setenv("TERM", "dumb", 1);
    execv(argv[0], argv);
    err(70, "%s", argv[0]);
}

struct server server_start(const char *layer, const char *place, char **argv)
{
    struct server server = {.out = paper(), .err = paper()};
    int shared = memfd_create("page", MFD_CLOEXEC), ask[2], answer[2];
    if (shared < 0 || ftruncate(shared, sizeof *server.page) != 0) err(70, "memfd_create");
    server.page = mmap(NULL, sizeof *server.page, PROT_READ | PROT_WRITE, MAP_SHARED, shared, 0);
    if (server.page == MAP_FAILED || pipe(ask) != 0 || pipe(answer) != 0) err(70, "cannot share a page");
    fcntl(ask[1], F_SETFD, FD_CLOEXEC);
    fcntl(answer[0], F_SETFD, FD_CLOEXEC);
    fflush(stdout);
    server.process = fork();
    if (server.process < 0) err(70, "fork");
    if (server.process == 0) become(&server, layer, place, argv, shared, (int[]){ask[0], answer[1]});
    close(shared);
    close(ask[0]);
    close(answer[1]);
    server.ask = ask[1];
    server.answer = answer[0];
    return server;
}

int server_run(const struct server *server, enum layer_kind kind, long at, bool stay)
{
    int status;
    *server->page = (struct layer_page){.kind = kind, .at = at, .stay = stay, .lost = -1};
    if (ftruncate(server->out, 0) != 0 || ftruncate(server->err, 0) != 0) err(70, "ftruncate");
    bool asked = write(server->ask, "", 1) == 1;
    if (!asked || read(server->answer, &status, sizeof status) != sizeof status)
        errx(70, "the program has gone");
    return status;
}

void server_end(struct server *server)
{
    close(server->ask); /* it ends when nothing is asked any more */
    close(server->answer);
    waitpid(server->process, NULL, 0);
    munmap(server->page, sizeof *server->page);
    close(server->out);
    close(server->err);
}

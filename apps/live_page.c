/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "live_page.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "place.h"
#include "whole_file.h"

/* The two places in which a live page differs: the first occurrence of the policy, and a script at the end. */
static const char policy[] = "script-src 'unsafe-inline'",
                  loose[] = "script-src 'unsafe-inline' 'self' file:";
static const char page_end[] = "</body>\n</html>\n";
static const char script_start[] = "<script id=\"watch\">\n", call_start[] = "fbd.live(\"",
                  call_end[] = "\");\n", script_end[] = "</script>\n";

/* The last occurrence of `part`; the data before it may contain the same text. */
static char *last_place(char *text, const char *part)
{
    char *last = NULL;
    for (char *at = text; (at = strstr(at, part)) != NULL; at++) last = at;
    return last;
}

char *live_page_make(char *page, const char *stamp)
{
    char *rule = page ? strstr(page, policy) : NULL, *end = page ? last_place(page, page_end) : NULL;
    if (!rule || !end || end < rule) return page;
    size_t size = strlen(page) + strlen(stamp) + watched_page_length + sizeof loose + sizeof script_start +
                  sizeof call_start + sizeof call_end + sizeof script_end;
    char *live = malloc(size);
    char *rest = rule + strlen(policy);
    if (live)
        snprintf(live, size, "%.*s%s%.*s%s%.*s%s%s%s%s%s", (int)(rule - page), page, loose, (int)(end - rest),
                 rest, script_start, (int)watched_page_length, (const char *)watched_page, call_start, stamp,
                 call_end, script_end, end);
    fbd_free(page);
    return live;
}

/* The path of the stamp; false when it is too long. */
static bool stamp_path(const char *path, char stamp[place_size])
{
    int length = snprintf(stamp, place_size, "%s.stamp.js", path);
    if (length >= 0 && length < place_size) return true;
    errno = ENAMETOOLONG;
    return false;
}

bool live_page_announce(const char *path, const char *stamp)
{
    char name[place_size], text[200];
    snprintf(text, sizeof text, "fbd.stamp(\"%s\");\n", stamp);
    return stamp_path(path, name) && whole_file_put(name, text);
}

/* ---- the end */

static char *read_page(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    char *text = size >= 0 && fseek(file, 0, SEEK_SET) == 0 ? malloc((size_t)size + 1) : NULL;
    if (text) text[fread(text, 1, (size_t)size, file)] = '\0';
    fclose(file);
    return text;
}

static void cut(char *from, const char *to)
{
    memmove(from, to, strlen(to) + 1);
}

void live_page_settle(const char *path)
{
    char name[place_size];
    char *page = read_page(path);
    char *script = page ? last_place(page, script_start) : NULL, *rule = page ? strstr(page, loose) : NULL;
    char *end = script ? strstr(script, script_end) : NULL;
    if (end && rule && rule < script) {
        cut(script, end + strlen(script_end));
        cut(rule + strlen(policy), rule + strlen(loose));
        (void)whole_file_put(path, page); /* on failure the live page stays, without effect */
    }
    fbd_free(page);
    if (stamp_path(path, name)) unlink(name);
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deliver.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "complain.h"
#include "fbd.h"
#include "gnuplot.h"
#include "picture.h"
#include "standard_streams.h"
#include "whole_file.h"

static bool lacks_memory(void)
{
    complain("fbd-run: out of memory");
    return false;
}

static bool cannot_write(const char *path)
{
    complain("fbd-run: cannot write `%s`: %s", path, strerror(errno));
    return false;
}

bool deliver_text(const char *path, char *text)
{
    if (!text) return lacks_memory();
    bool written = true;
    if (path)
        written = whole_file_put(path, text) || cannot_write(path);
    else
        fputs(text, stdout);
    fbd_free(text);
    return written && (path || standard_output_arrives("fbd-run"));
}

bool deliver_picture(const char *path, char *svg)
{
    if (!svg) return lacks_memory();
    bool written = picture_write(path, svg);
    fbd_free(svg);
    return written;
}

bool deliver_plot(const char *path, char *script)
{
    if (!script) return lacks_memory();
    struct whole_file file;
    const bool open = whole_file_open(&file, path), made = open && gnuplot_run(script, fileno(file.stream)),
               written = open && whole_file_close(&file, made);
    fbd_free(script);
    if (!open || (made && !written)) return cannot_write(path);
    return made;
}

size_t cut_list(char *list, const char **names, size_t room)
{
    size_t count = 0;
    for (char *name = list ? strtok(list, ", ") : NULL; name && count < room; name = strtok(NULL, ", "))
        names[count++] = name;
    return count;
}

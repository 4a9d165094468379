/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "picture.h"

#include <errno.h>
#include <string.h>
#include <strings.h>

#include "complain.h"
#include "program.h"
#include "whole_file.h"

/* 200 dots per inch are sufficient for a printed page, and give about two thousand pixels. */
static const char *const converters[][2][14] = {
    {{"rsvg-convert", "--format", "pdf", NULL},
     {"rsvg-convert", "--format", "png", "--dpi-x", "200", "--dpi-y", "200", "--background-color", "white",
      NULL}},
    {{"inkscape", "--pipe", "--export-type", "pdf", "--export-filename", "-", NULL},
     {"inkscape", "--pipe", "--export-type", "png", "--export-dpi", "200", "--export-background", "white",
      "--export-filename", "-", NULL}},
};

enum format { format_pdf, format_png, format_svg };

static enum format format_of(const char *file)
{
    const char *end = strrchr(file, '.');
    if (end && strcasecmp(end, ".pdf") == 0) return format_pdf;
    return end && strcasecmp(end, ".png") == 0 ? format_png : format_svg;
}

/* True if the file name has the ending of another image format. */
static bool is_another_kind(const char *file)
{
    static const char *const others[] = {".jpg",  ".jpeg", ".gif", ".webp", ".bmp",
                                         ".tiff", ".tif",  ".eps", ".ps"};
    const char *end = strrchr(file, '.');
    for (size_t i = 0; end && i < sizeof others / sizeof *others; i++)
        if (strcasecmp(end, others[i]) == 0) return true;
    return false;
}

/* The first converter in PATH, or NULL. */
static const char *const *converter_for(enum format format)
{
    for (size_t i = 0; i < sizeof converters / sizeof *converters; i++)
        if (program_is_there(converters[i][format][0])) return converters[i][format];
    return NULL;
}

bool picture_can_be_written(const struct command_line *line, const char *file)
{
    enum format format = format_of(file);
    if (is_another_kind(file)) return command_line_usage(line, "--svg makes .svg, .pdf and .png, not ", file);
    if (format == format_svg || converter_for(format)) return true;
    return command_line_usage(
        line,
        "--svg makes .pdf and .png by rsvg-convert (Debian: librsvg2-bin) or inkscape, and "
        "neither is installed; a file that ends in .svg needs none, not ",
        file);
}

bool picture_converts_to_pdf(void)
{
    return converter_for(format_pdf) != NULL;
}

bool picture_write_pdf(struct whole_file *file, const char *svg)
{
    const char *const *arguments = converter_for(format_pdf);
    return arguments && program_run(arguments, svg, fileno(file->stream));
}

bool picture_write(const char *file, const char *svg)
{
    enum format format = format_of(file);
    struct whole_file out;
    bool done = whole_file_open(&out, file);
    if (done) {
        const char *const *arguments = format == format_svg ? NULL : converter_for(format);
        bool made = format == format_svg ? whole_file_write(&out, svg, strlen(svg)) == 0
                                         : arguments && program_run(arguments, svg, fileno(out.stream));
        if (!made && format != format_svg) {
            whole_file_close(&out, false);
            return false;
        }
        done = whole_file_close(&out, true);
    }
    if (!done) complain("fbd-run: cannot write `%s`: %s", file, strerror(errno));
    return done;
}

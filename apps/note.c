/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "note.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "complain.h"
#include "picture.h"
#include "place.h"
#include "program.h"

enum ending { ending_html, ending_markdown, ending_latex, ending_pdf, ending_count };

static const char *const endings[ending_count] = {".html", ".md", ".tex", ".pdf"};

static enum ending ending_of(const char *file)
{
    const char *end = strrchr(file, '.');
    enum ending ending = ending_html;
    while (ending < ending_count && (!end || strcasecmp(end, endings[ending]) != 0)) ending++;
    return ending;
}

/* The name without folders and ending; drawings are called by it. */
static void stem_of(const char *file, char *stem, size_t size)
{
    const char *slash = strrchr(file, '/'), *base = slash ? slash + 1 : file, *end = strrchr(base, '.');
    snprintf(stem, size, "%.*s", (int)(end ? end - base : (ptrdiff_t)strlen(base)), base);
}

/* Names that LaTeX and Markdown read without quotes. */
static bool is_plain_name(const char *file)
{
    char stem[place_size];
    stem_of(file, stem, sizeof stem);
    return stem[0] &&
           strspn(stem, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.") == strlen(stem);
}

static bool latex_is_there(void)
{
    return program_is_there("pdflatex") && picture_converts_to_pdf();
}

bool note_can_be_written(const struct command_line *line, const char *file)
{
    const enum ending ending = ending_of(file);
    if (ending == ending_count)
        return command_line_usage(line,
                                  "--note wants a file whose name ends in .html, .md, .tex or .pdf, not ",
                                  file);
    if ((ending == ending_markdown || ending == ending_latex) && !is_plain_name(file))
        return command_line_usage(
            line, "the drawings of --note are named after its file: letters, digits, `_`, `-`, not ", file);
    if (ending == ending_latex && !picture_converts_to_pdf())
        return command_line_usage(
            line,
            "--note makes .tex with drawings by rsvg-convert (Debian: librsvg2-bin) or inkscape, and "
            "neither is installed; .html and .md need none, not ",
            file);
    if (ending == ending_pdf && !program_is_there("chromium") && !latex_is_there())
        return command_line_usage(
            line,
            "--note makes .pdf by chromium (Debian: chromium) or by pdflatex and rsvg-convert (Debian: "
            "texlive-latex-recommended, librsvg2-bin), and neither is installed; .html needs none, not ",
            file);
    return true;
}

/* ---- PDF, in a temporary folder */

struct workshop {
    char folder[place_size];
};

static bool path_in(const struct workshop *shop, const char *name, char path[static place_size])
{
    const int length = snprintf(path, place_size, "%s/%s", shop->folder, name);
    return length > 0 && length < place_size;
}

static bool begin_workshop(struct workshop *shop)
{
    const char *folder = getenv("TMPDIR");
    const int length = snprintf(shop->folder, sizeof shop->folder, "%s/fbd-note-XXXXXX",
                                folder && folder[0] ? folder : "/tmp");
    if (length > 0 && (size_t)length < sizeof shop->folder && mkdtemp(shop->folder)) return true;
    complain("fbd-run: cannot make a folder for the PDF: %s", strerror(errno));
    return false;
}

/* The folder and all within it. */
static void end_workshop(const struct workshop *shop)
{
    const char *const remove[] = {"rm", "-rf", "--", shop->folder, NULL};
    program_run(remove, "", STDERR_FILENO);
}

static bool put_in(const struct workshop *shop, const char *name, const char *text)
{
    char path[place_size];
    if (path_in(shop, name, path) && whole_file_put(path, text)) return true;
    complain("fbd-run: cannot write `%s` in `%s`: %s", name, shop->folder, strerror(errno));
    return false;
}

/* Copy note.pdf of the folder into the document. */
static bool fetch(const struct workshop *shop, struct whole_file *document)
{
    char path[place_size], piece[1 << 14];
    size_t length, whole = 0;
    FILE *made = path_in(shop, "note.pdf", path) ? fopen(path, "rb") : NULL;
    while (made && (length = fread(piece, 1, sizeof piece, made)) > 0) {
        whole_file_write(document, piece, length);
        whole += length;
    }
    if (made) fclose(made);
    if (whole == 0) complain("fbd-run: no PDF was made");
    return whole > 0;
}

/* Chromium refuses its sandbox to root; the page has no script, and its policy loads nothing. */
static bool print_html(const struct workshop *shop, const fbd_note *note)
{
    char profile[place_size + 40], output[place_size + 40], page[place_size + 40];
    char *html = fbd_note_write(note, FBD_NOTE_HTML, "note");
    if (!html) return complain("fbd-run: out of memory"), false;
    const bool put = put_in(shop, "note.html", html);
    fbd_free(html);
    snprintf(profile, sizeof profile, "--user-data-dir=%s/profile", shop->folder);
    snprintf(output, sizeof output, "--print-to-pdf=%s/note.pdf", shop->folder);
    snprintf(page, sizeof page, "file://%s/note.html", shop->folder);
    const char *const arguments[] = {"chromium",
                                     "--headless",
                                     "--disable-gpu",
                                     "--log-level=3",
                                     "--no-pdf-header-footer",
                                     profile,
                                     output,
                                     page,
                                     geteuid() == 0 ? "--no-sandbox" : NULL,
                                     NULL};
    return put && program_run_in(arguments, shop->folder);
}

static bool put_drawings(const struct workshop *shop, const fbd_note *note)
{
    for (size_t i = 0; i < fbd_note_drawing_count(note); i++) {
        char name[40], path[place_size];
        snprintf(name, sizeof name, "note-%zu.pdf", i + 1);
        if (!path_in(shop, name, path) || !picture_write(path, fbd_note_drawing(note, i))) return false;
    }
    return true;
}

/* Twice, since the widths of long tables are known after the first run. */
static bool typeset(const struct workshop *shop, const fbd_note *note)
{
    static const char *const arguments[] = {"pdflatex",       "-interaction=batchmode",
                                            "-halt-on-error", "-no-shell-escape",
                                            "note.tex",       NULL};
    char *latex = fbd_note_write(note, FBD_NOTE_LATEX, "note");
    if (!latex) return complain("fbd-run: out of memory"), false;
    const bool put = put_in(shop, "note.tex", latex) && put_drawings(shop, note);
    fbd_free(latex);
    return put && program_run_in(arguments, shop->folder) && program_run_in(arguments, shop->folder);
}

static bool write_pdf(struct whole_file *document, const fbd_note *note)
{
    struct workshop shop;
    if (!begin_workshop(&shop)) return false;
    const bool made = program_is_there("chromium") ? print_html(&shop, note) : typeset(&shop, note);
    const bool done = made && fetch(&shop, document);
    end_workshop(&shop);
    return done;
}

/* ---- drawings beside the document */

/* Open and write a drawing, as PDF or SVG; *path receives its path within the room for names. */
static bool write_drawing(struct whole_file *file, const char *path, const char *svg, bool pdf)
{
    if (!whole_file_open(file, path)) {
        complain("fbd-run: cannot write `%s`: %s", path, strerror(errno));
        *file = (struct whole_file){0};
        return false;
    }
    if (pdf) return picture_write_pdf(file, svg);
    whole_file_write(file, svg, strlen(svg)); /* an error is reported at closing */
    return true;
}

static bool write_drawings(struct note_files *files, const fbd_note *note, bool pdf)
{
    const char *path = files->document.path, *end = strrchr(path, '.');
    const size_t count = fbd_note_drawing_count(note), room = strlen(path) + 32;
    files->drawings = calloc(count + 1, sizeof *files->drawings);
    files->names = calloc(count + 1, room);
    if (!files->drawings || !files->names) return complain("fbd-run: out of memory"), false;
    for (; files->count < count; files->count++) {
        char *name = files->names + files->count * room;
        snprintf(name, room, "%.*s-%zu.%s", (int)(end - path), path, files->count + 1, pdf ? "pdf" : "svg");
        if (!write_drawing(&files->drawings[files->count], name, fbd_note_drawing(note, files->count), pdf)) {
            files->count++;
            return false;
        }
    }
    return true;
}

bool note_write(struct note_files *files, const fbd_note *note)
{
    static const fbd_note_format formats[] = {FBD_NOTE_HTML, FBD_NOTE_MARKDOWN, FBD_NOTE_LATEX};
    const enum ending ending = ending_of(files->document.path);
    char stem[place_size];
    if (ending == ending_pdf) return write_pdf(&files->document, note);
    stem_of(files->document.path, stem, sizeof stem);
    char *text = fbd_note_write(note, formats[ending], stem);
    if (!text) return complain("fbd-run: out of memory"), false;
    whole_file_write(&files->document, text, strlen(text)); /* an error is reported at closing */
    fbd_free(text);
    return ending == ending_html || write_drawings(files, note, ending == ending_latex);
}

bool note_close(struct note_files *files, bool keep, const char **path)
{
    bool done = true;
    int reason = 0;
    for (size_t i = 0; i <= files->count; i++) { /* the document last: it is there if all drawings are */
        struct whole_file *file = i < files->count ? &files->drawings[i] : &files->document;
        if (whole_file_close(file, keep && done)) continue;
        done = false;
        reason = errno;
        *path = file->path;
    }
    free(files->drawings);
    free(files->names);
    *files = (struct note_files){.count = 0};
    errno = reason;
    return done;
}

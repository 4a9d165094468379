/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_export: outputs of a model or run: texts, JSON, LaTeX, plots, drawings, pages, C programs, models for other simulators.
 * The rules of fbd.h apply.
 */
#ifndef FBD_EXPORT_H
#define FBD_EXPORT_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- texts */

/* Make a text safe to print: characters that a terminal would execute (escape sequences), that change the
 * direction of the text or are invisible are written as `\x1b`, `\u202e`, `\U000e0001`; the rest stays.
 * Titles, paths and other texts of users should be printed so; messages and texts of the library are safe
 * already. Fills `shown` with whole characters and a final zero, as far as there is room; returns the length
 * of the complete text in bytes, without that zero. */
FBD_API size_t fbd_escape(const char *text, char *shown, size_t room);

/* Select degrees for angles and their rates in the texts of the state, of its statics and of its
 * linearisation. Equations, matrices and the numbers of structures stay in radians. */
FBD_API void fbd_state_show_degrees(fbd_state *state, bool degrees);

/* ---------------------------------------------------------------- equations */

typedef enum fbd_format {
    /* the assembled equations, term by term, with the laws of the terms; of bodies cut free also FBD_SYMBOLS */
    FBD_TEXT,
    /* of every body cut free in symbols of the scene, reactions included, one equation per line, with the
     * acceleration of G where it follows from the coordinates */
    FBD_SYMBOLS,
    /* for amsmath, each equation in symbols of the scene and with the numbers of the state */
    FBD_LATEX,
    FBD_JSON, /* the equations and the free-body diagrams as one object: docs/output.md */
    /* as FBD_LATEX, for HTML: paragraphs with MathML, without a style of their own */
    FBD_MATHML,
} fbd_format;

typedef struct fbd_equations_options {
    size_t size; /* sizeof(fbd_equations_options), or 0 */
    fbd_format format;
    /* cut free every body, as in fbd_assemble_components; false: only joined bodies. Without effect on
     * FBD_SYMBOLS */
    bool components;
} fbd_equations_options;

/* Write the assembled equations of a state. To be freed with fbd_free, as all texts below; NULL with a note
 * in `errors`: `bad-call` for a format that this library does not have, or memory is out. */
FBD_API char *fbd_equations_write(fbd_state *state, const fbd_equations_options *options, fbd_errors *errors);

/* A description of the plan: effects that are simulated, with their number and why they are conservative or
 * not; effects that are not, and the entries that would add them; the right-hand side, events, structure, the
 * method and its reason. */
FBD_API char *fbd_explain(const fbd_model *model, const fbd_options *options);

/* ---------------------------------------------------------------- results */

/* The result as text, to be freed with fbd_free; NULL when memory is out. For a scene of more than twelve
 * bodies the report is short, unless `full`: totals, events by their kinds, some of the states, the largest
 * forces. */
FBD_API char *fbd_result_report(fbd_result *result, bool full);

/* A column of the rows of a run: "t", "block.x", with error bars followed by "block.x ±"; and its unit. */
typedef struct fbd_column {
    const char *name, *unit;
} fbd_column;

/* The rows of a run, bitwise the values of the CSV. */
typedef struct fbd_table {
    size_t rows, columns;
    const fbd_column *heads; /* of each column */
    const double *values;    /* rows x columns, row by row; INFINITY for an unknown error */
} fbd_table;

/* The rows of a run recorded with `table`; otherwise there are no rows and columns. Lives as long as the
 * result. */
FBD_API fbd_table fbd_result_table(const fbd_result *result);

/* The result as one JSON object: docs/output.md. */
FBD_API char *fbd_result_json(fbd_result *result);

/* Plots of a run as a script for gnuplot that carries its data. `columns`: names of the CSV's columns with
 * ledger, without units, separated by commas ("block.v,block.friction"), one plot for each unit; NULL for
 * coordinates and energies. `file` (may be NULL) chooses gnuplot's terminal by its ending, .svg, .png or
 * .pdf; the script writes to gnuplot's standard output. NULL with a note in `errors`: `unknown-column`,
 * `not-recorded`, or memory is out. */
FBD_API char *fbd_result_gnuplot(fbd_result *result, const char *file, const char *columns,
                                 fbd_errors *errors);

/* Check that the model has all these columns. Returns false with notes in `errors`. */
FBD_API bool fbd_model_has_columns(const fbd_model *model, const char *columns, fbd_errors *errors);

/* The model language as JSON Schema (draft 07), for editors and other programs: keys, kinds, words and types
 * with their descriptions. To be freed with fbd_free; NULL when memory is out. */
FBD_API char *fbd_schema(void);

/* True if the library was built with the page (which needs a library for its plots). */
FBD_API bool fbd_has_html(void);

/* One self-contained HTML page (UTF-8) that plays the run, with plots, equations and ledger at every time; at
 * most some 5 MB for any length of run. NULL with a note in `errors`: `no-page` if the library was built
 * without it, `not-recorded` for a run without `keep`, or memory is out. */
FBD_API char *fbd_result_html(fbd_result *result, fbd_errors *errors);

/* The scene as one C program for GSL, without memory allocation, with the numbers of the file in a structure:
 * see docs/emit-c.md. `options` (may be NULL) gives the end time and accuracy of its `main`; only `until` and
 * `tolerance` are used. To be freed with fbd_free. NULL with notes in `errors`: `cannot-emit` for a scene
 * with unsupported elements, `no-end-time`, `bad-option`, or memory is out. */
FBD_API char *fbd_emit_c(const fbd_model *model, const fbd_options *options, fbd_errors *errors);

/* ---------------------------------------------------------------- calculation notes */

/* A calculation note: the model, its assumptions and data, free-body diagrams, equations, results with their
 * errors, checks, plots and limits of validity, as one document. */
typedef struct fbd_note fbd_note;

typedef enum fbd_note_format {
    FBD_NOTE_HTML,     /* one file, which contains the drawings; A4 in print */
    FBD_NOTE_MARKDOWN, /* with drawings beside it, STEM-1.svg, ... */
    FBD_NOTE_LATEX,    /* with drawings beside it, STEM-1.pdf, ... */
} fbd_note_format;

typedef struct fbd_note_options {
    size_t size;                 /* sizeof(fbd_note_options), or 0 */
    const fbd_setting *settings; /* those that the model was read with, to be listed */
    size_t setting_count;
    bool degrees; /* angles and their rates in degrees; as in the recording of the result */
    /* the day, as it is printed; NULL: that of the environment variable SOURCE_DATE_EPOCH (seconds), else today, in UTC */
    const char *date;
    fbd_watch *
        progress; /* called during the second run of its checks, or NULL; nonzero ends the note (`stopped`) */
    void *progress_context;
} fbd_note_options;

/* Make the note of a run that was recorded with `table`; with error bars it states the errors of all results.
 * For its checks it makes a second run by another method. To be freed with fbd_note_free; it is independent of
 * the result and the model from then on. NULL with a note in `errors`: `not-recorded` for a run without
 * `table`, `no-note` for a run that failed or was interrupted, `stopped`, those of fbd_diagram_svg, or
 * memory is out. */
FBD_API fbd_note *fbd_note_new(fbd_simulation *simulation, fbd_result *result,
                               const fbd_note_options *options, fbd_errors *errors);
FBD_API void fbd_note_free(fbd_note *note);

/* The document, to be freed with fbd_free; NULL when memory is out. `stem`: name of the drawings beside it. */
FBD_API char *fbd_note_write(const fbd_note *note, fbd_note_format format, const char *stem);

/* The drawings as SVG, in the order of their numbers; NULL past the last one. They live as long as the note. */
FBD_API size_t fbd_note_drawing_count(const fbd_note *note);
FBD_API const char *fbd_note_drawing(const fbd_note *note, size_t index);

/* The checks of the note (balance, derivations by hand, energy, another method), and how many are not met. */
FBD_API size_t fbd_note_check_count(const fbd_note *note);
FBD_API size_t fbd_note_failed_check_count(const fbd_note *note);

/* ---------------------------------------------------------------- drawings */

typedef struct fbd_drawing {
    size_t size;      /* sizeof(fbd_drawing), or 0 */
    const char *body; /* only this body; NULL for all */
    bool components;  /* with the components of each force: along x and y, on a slide along and across it */
    bool supports;    /* with the ground, surfaces and bearings that the bodies are cut free from */
    bool symbols;     /* arrows labelled by symbols, m g, N, T_1, instead of names and values */
    bool worksheet;   /* the bodies cut free and no arrows, with lines to write on */
    bool solution;    /* of that worksheet: arrows by symbols, and the value of each symbol on its line */
    /* the force, in the scene's unit, that corresponds to 10 mm; 0: a round one that suits all bodies */
    double scale;
    bool untitled; /* without the title of the scene and the time */
    bool system;   /* the bodies joined, with supports, springs, ropes and applied forces; no free bodies */
} fbd_drawing;

/* The free-body diagrams of a state as an SVG 1.1 document in millimetres, to be freed with fbd_free. `drawing`
 * may be NULL. Ids are `BODY` for a diagram, `BODY-FORCE` for an arrow (`BODY-FORCE-x`, `-y`, `-n` for
 * components). NULL with a note in `errors` (`unknown-body`, or memory is out). */
FBD_API char *fbd_diagram_svg(fbd_state *state, const fbd_drawing *drawing, fbd_errors *errors);

/* ---------------------------------------------------------------- pages that run */

/* The values of the file that a slider can change and the effects that can be switched off, with their
 * positions in the text, as one JSON object (its format: lib/live/controls.c). To be freed with fbd_free;
 * NULL with a note in `errors` when memory is out. */
FBD_API char *fbd_model_controls(const fbd_model *model, fbd_errors *errors);

/* The text of the file without some of the effects that it lists: "block.friction", or the name of a coupling
 * or contact. An entry on lines of its own becomes a comment; so do derivations by hand of the bodies
 * concerned. To be freed with fbd_free; NULL with a note in `errors`: `unknown-effect`, or memory is out. */
FBD_API char *fbd_model_without(const fbd_model *model, const char *const *effects, size_t count,
                                fbd_errors *errors);

/* A pull by hand: a spring and a damper from a point of a body to a pointer. */
typedef struct fbd_pull {
    size_t size; /* sizeof(fbd_pull), or 0 */
    const char *body;
    double at[2];       /* the grabbed point, in the frame of the body */
    double stiffness;   /* in the model's units; the damping is half of critical for the body's mass */
    double from, to;    /* s */
    const double *path; /* count times t, x, y of the pointer in the world, between which it moves evenly */
    size_t count;
} fbd_pull;

/* The text of the file with that pull as an `applied` force `pull` (`pull_2`, ... if it has that word) of the body,
 * with its path as a table. On a slide of the ground it acts along the line; on particles, tracks and other slides at
 * G. Derivations by hand and known solutions become comments. To be freed with fbd_free; NULL with a note in
 * `errors`: `unknown-body`, `not-pulled` for a prescribed motion, or where the text has no place for it, `bad-call`,
 * or memory is out. */
FBD_API char *fbd_model_pulled(const fbd_model *model, const fbd_pull *pull, fbd_errors *errors);

/* The notes of a list, as one JSON list of {severity, id, message, hint, see, file, line, column,
 * context_line, context_column, fix}, with null for an unknown hint, section of the guide (see), file or fix, and fix {line, column, replace, with} as fbd_fix. To be
 * freed with fbd_free; NULL when memory is out. */
FBD_API char *fbd_errors_json(fbd_errors *errors);

/* The data of a page of --html about a run, as one JSON object (its format: lib/api/page_data.c), for a run
 * recorded with `keep`. To be freed with fbd_free; NULL with a note in `errors`: `not-recorded`, or memory is
 * out. */
FBD_API char *fbd_result_page_data(fbd_result *result, size_t most_bytes, fbd_errors *errors);

/* True if the library was built with the parts of live pages: itself as WebAssembly (`make live`). */
FBD_API bool fbd_has_live(void);

/* The initial settings of the page, beside the file: how the model was read and run; all may be omitted. */
typedef struct fbd_live_options {
    size_t size; /* sizeof(fbd_live_options), or 0 */
    const fbd_setting *settings;
    size_t setting_count;
    const fbd_options *run; /* until, method and tolerance; NULL for the file's */
} fbd_live_options;

/* As fbd_result_html, with the library and the text of the model included: the page has sliders, an editor
 * and checkboxes, and repeats the run after every change. At most 2 MB. NULL with a note in `errors`:
 * `no-live` where the library was built without it, `unknown-output`, `cannot-read` for the data file of a table, and those of
 * fbd_result_html. */
FBD_API char *fbd_result_live_html(fbd_result *result, const fbd_live_options *options, fbd_errors *errors);

/* ---------------------------------------------------------------- models for other simulators */

/* A model as a Functional Mock-up Unit (fmi-standard.org): docs/fmi.md. */
typedef struct fbd_fmu_options {
    size_t size;                 /* sizeof(fbd_fmu_options), or 0 */
    int version;                 /* of FMI: 3, or 2 for tools that do not support 3; 0 is 3 */
    const char *library;         /* the binary to include, of this version of fbd, or its gzip ... */
    size_t library_length;       /* ... and its length in bytes; fbd-run contains it */
    const char *name;            /* of the FMU; NULL for that of the model file */
    const fbd_setting *settings; /* those that the model was read with: they become its start values */
    size_t setting_count;
    const fbd_options *run; /* NULL for the file's; without error bars and accuracy */
    /* forces, reactions, energies and works that are outputs, by their names in the CSV with ledger, separated by commas;
     * NULL: forces, reactions, kinetic and potential energy are local variables, and there may be directional
     * derivatives. With a work the FMU is for co-simulation only. */
    const char *outputs;
} fbd_fmu_options;

/* The FMU for co-simulation, and for model exchange where that can be had (fbd_model_exchanges), with that binary, as
 * bytes of a zip archive, to be freed with fbd_free; *length is their number. NULL with notes in `errors`: those of wrong
 * options (see fbd_simulation_new), also for an input that a callback computes, of an inadmissible start (see
 * fbd_state_close), `unknown-output`, `duplicate-name` where two variables would have one name, `cannot-read` for the data
 * file of a table, `bad-call`, or memory is out. */
FBD_API char *fbd_fmu(const fbd_model *model, const fbd_fmu_options *options, size_t *length,
                      fbd_errors *errors);

#ifdef __cplusplus
}
#endif

#endif

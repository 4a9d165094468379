/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pieces of SVG 1.1 as text. One user unit is a millimetre on paper, x to the right and y down.
 */
#ifndef FBD_DRAW_SVG_H
#define FBD_DRAW_SVG_H

#include "base/text.h"
#include "base/vec.h"

/* A rectangle on paper. */
struct box {
    struct vec low, high;
};

/* The empty box; extended by box_take. */
extern const struct box box_nothing;

void box_take(struct box *box, struct vec point);
void box_join(struct box *box, const struct box *other);

/* Append `string` with the characters & < > " escaped and control characters, which XML forbids, removed. */
void svg_escape(struct text *text, const char *string);

/* "x,y" */
void svg_point(struct text *text, struct vec point);

/* <line class="..." .../>; the class is not escaped. */
void svg_line(struct text *text, const char *css, struct vec from, struct vec to);

void svg_circle(struct text *text, const char *css, struct vec center, double radius);

/* A closed polygon. */
void svg_polygon(struct text *text, const char *css, const struct vec *corners, size_t count);

/* A line of text, in which "N_{1}" is N with an index, centred at `center` (its middle is about 0.35 of its size above its base line). */
void svg_text(struct text *text, const char *css, struct vec center, double size, const char *string);

/* The same, starting at `start` on the base line. */
void svg_text_at(struct text *text, const char *css, struct vec start, const char *string);

/* The width of a line of text of this font size in Helvetica or a similar font, with a margin for a wider
 * substitute. */
double svg_text_width(const char *string, double size);

/* The style sheet of the classes, for elements inside another document: below an element of class `fbd`. */
extern const char svg_style[];

/* Open the document: its size in millimetres, printed `scale` times as large; style sheet, background,
 * <title>. Close with "</svg>\n". */
void svg_begin(struct text *text, struct vec size, double scale, const char *title, const char *description);

#endif

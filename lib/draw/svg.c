/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/svg.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format.h"
#include "base/utf8.h"

const struct box box_nothing = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};

void box_take(struct box *box, struct vec point)
{
    box->low = (struct vec){fmin(box->low.x, point.x), fmin(box->low.y, point.y)};
    box->high = (struct vec){fmax(box->high.x, point.x), fmax(box->high.y, point.y)};
}

void box_join(struct box *box, const struct box *other)
{
    if (other->low.x > other->high.x) return;
    box_take(box, other->low);
    box_take(box, other->high);
}

void svg_escape(struct text *text, const char *string)
{
    while (*string) {
        struct utf8_shown next = utf8_show(string);
        switch (*string) {
        case '&': text_add(text, "&amp;"); break;
        case '<': text_add(text, "&lt;"); break;
        case '>': text_add(text, "&gt;"); break;
        case '"': text_add(text, "&quot;"); break;
        default: text_add_bytes(text, next.text, next.length);
        }
        string += next.taken;
    }
}

/* Append a length or coordinate in mm to 1/1000 mm, without trailing zeros and never -0. */
static void write_number(struct text *text, double value)
{
    char digits[40];
    double rounded = round(value * 1000) / 1000;
    format_into(digits, sizeof digits, "%.3f", rounded == 0 ? 0.0 : rounded);
    text->odd |= !(fabs(rounded) < 1e30); /* mm: too large for a drawing */
    char *end = digits + strlen(digits);
    while (end[-1] == '0') end--;
    if (end[-1] == '.') end--;
    text_add_bytes(text, digits, (size_t)(end - digits));
}

void svg_point(struct text *text, struct vec point)
{
    write_number(text, point.x);
    text_add(text, ",");
    write_number(text, point.y);
}

static void attribute(struct text *text, const char *name, double value)
{
    text_printf(text, " %s=\"", name);
    write_number(text, value);
    text_add(text, "\"");
}

void svg_line(struct text *text, const char *css, struct vec from, struct vec to)
{
    text_printf(text, "<line class=\"%s\"", css);
    attribute(text, "x1", from.x);
    attribute(text, "y1", from.y);
    attribute(text, "x2", to.x);
    attribute(text, "y2", to.y);
    text_add(text, "/>\n");
}

void svg_circle(struct text *text, const char *css, struct vec center, double radius)
{
    text_printf(text, "<circle class=\"%s\"", css);
    attribute(text, "cx", center.x);
    attribute(text, "cy", center.y);
    attribute(text, "r", radius);
    text_add(text, "/>\n");
}

void svg_polygon(struct text *text, const char *css, const struct vec *corners, size_t count)
{
    text_printf(text, "<polygon class=\"%s\" points=\"", css);
    for (size_t i = 0; i < count; i++) {
        if (i) text_add(text, " ");
        svg_point(text, corners[i]);
    }
    text_add(text, "\"/>\n");
}

/* The next index of a line, "_{k}": its letters without the braces; NULL when there is none. */
static const char *next_index(const char *string, size_t *length)
{
    for (const char *c = strstr(string, "_{"); c; c = strstr(c + 2, "_{")) {
        *length = strcspn(c + 2, "}");
        if (*length > 0 && c[2 + *length] == '}') return c + 2;
    }
    return NULL;
}

static void escape_bytes(struct text *text, const char *string, size_t length)
{
    struct text part = {0};
    text_add_bytes(&part, string, length);
    if (part.data) svg_escape(text, part.data);
    text->failed |= part.failed;
    text_free(&part);
}

/* Write the text between two indices; `low` behind an index, from whose shift it returns. The blank at the start of such
 * a piece would be dropped. */
static void write_piece(struct text *text, const char *string, size_t length, bool low)
{
    if (length == 0) return;
    if (low) text_add(text, "<tspan dy=\"-.2em\" xml:space=\"preserve\">");
    if (low && *string == ' ') {
        text_add(text, "\u00a0");
        string++;
        length--;
    }
    escape_bytes(text, string, length);
    if (low) text_add(text, "</tspan>");
}

/* Write a line with its indices lower; a shift `dy` holds for the rest of the line. */
static void write_line(struct text *text, const char *string)
{
    size_t length;
    bool low = false;
    for (const char *index; (index = next_index(string, &length)); low = true) {
        const size_t before = (size_t)(index - 2 - string);
        write_piece(text, string, before, low);
        text_printf(text, "<tspan class=\"index\"%s>", low && before == 0 ? "" : " dy=\".286em\"");
        escape_bytes(text, index, length);
        text_add(text, "</tspan>");
        string = index + length + 1;
    }
    write_piece(text, string, strlen(string), low);
}

static void write_text(struct text *text, const char *css, const char *middle, struct vec start,
                       const char *string)
{
    text_printf(text, "<text class=\"%s%s\"", css, middle);
    attribute(text, "x", start.x);
    attribute(text, "y", start.y);
    text_add(text, ">");
    write_line(text, string);
    text_add(text, "</text>\n");
}

void svg_text(struct text *text, const char *css, struct vec center, double size, const char *string)
{
    write_text(text, css, " middle", (struct vec){center.x, center.y + 0.35 * size}, string);
}

void svg_text_at(struct text *text, const char *css, struct vec start, const char *string)
{
    write_text(text, css, "", start, string);
}

/* The width of the characters in a thousandth of the font size. */
static double advance(const char *string, size_t length)
{
    /* Advance widths of Helvetica, ' ' to '~', in thousandths of the font size (Adobe's font metrics). */
    static const short widths[] = {
        278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333,  278, 278, 556, 556, 556,
        556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
        611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667,  611, 722, 667, 944, 667,
        667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278,  556, 556, 222, 222, 500,
        222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500,  500, 334, 260, 334, 584,
    };
    const short other = 600; /* Greek letters and signs */
    long sum = 0;
    for (const char *c = string; c < string + length; c++) {
        if (*c >= ' ' && *c <= '~')
            sum += widths[*c - ' '];
        else if ((*c & 0xC0) != 0x80) /* the first byte of a character */
            sum += other;
    }
    return (double)sum;
}

double svg_text_width(const char *string, double size)
{
    const double substitute = 1.12, low = 0.7; /* DejaVu Sans is wider; size of an index */
    double sum = 0;
    size_t length;
    for (const char *index; (index = next_index(string, &length)); string = index + length + 1)
        sum += advance(string, (size_t)(index - 2 - string)) + low * advance(index, length);
    return substitute * size * (sum + advance(string, strlen(string))) / 1000;
}

/* All rules are restricted to class `fbd`, so that the style does not affect the page around it. Dark only on
 * a screen: paper is white. */
const char svg_style[] =
    ".fbd text{font-family:Arial,Helvetica,'Liberation Sans','Nimbus "
    "Sans',sans-serif;font-size:3.4px;fill:#111}\n"
    ".fbd .middle{text-anchor:middle}\n"
    ".fbd .index{font-size:.7em}\n"
    ".fbd .heading{font-size:4.6px;font-weight:bold}\n"
    ".fbd .note{font-size:2.9px;fill:#555}\n"
    ".fbd .paper{fill:#fff}\n"
    ".fbd .body{fill:#dfe6ee;stroke:#222;stroke-width:.45;stroke-linejoin:round}\n"
    ".fbd .hole{fill:#fff;stroke:#222;stroke-width:.35}\n"
    ".fbd .mass{fill:#222;stroke:#222;stroke-width:.3}\n"
    ".fbd .bar{fill:none;stroke:#222;stroke-width:2.6;stroke-linecap:round}\n"
    ".fbd .bar-inside{fill:none;stroke:#dfe6ee;stroke-width:1.7;stroke-linecap:round}\n"
    ".fbd .thread{stroke:#222;stroke-width:.35}.fbd .rope{fill:none;stroke:#222;stroke-width:.6}\n"
    ".fbd .ground{stroke:#777;stroke-width:.5}\n"
    ".fbd .hatch{fill:none;stroke:#aaa;stroke-width:.25}\n"
    ".fbd .support{fill:#fff;stroke:#777;stroke-width:.4}\n"
    ".fbd .axis{fill:none;stroke:#777;stroke-width:.3}\n"
    ".fbd .axis-head{fill:#777}\n"
    ".fbd .dimension{stroke:#555;stroke-width:.25}\n"
    ".fbd .reference{fill:none;stroke:#999;stroke-width:.3;stroke-dasharray:1.6 .9}\n"
    ".fbd .leader{stroke:#999;stroke-width:.2}\n"
    ".fbd .axis-label{fill:#555;font-style:italic}\n"
    ".fbd .center{fill:#fff;stroke:#111;stroke-width:.3}\n"
    ".fbd .center-dark{fill:#111}\n"
    ".fbd .shaft{fill:none;stroke-width:.7}\n"
    ".fbd .row .shaft{stroke-width:.35}\n"
    ".fbd .small .shaft{stroke-dasharray:1.2 .7}\n"
    ".fbd .component .shaft{stroke-width:.4;stroke-dasharray:1.6 .9}\n"
    ".fbd .head{stroke:none}\n"
    ".fbd .gravity .shaft{stroke:#2b7a2b}.fbd .gravity .head,.fbd .gravity text{fill:#2b7a2b}\n"
    ".fbd .reaction .shaft{stroke:#b3261e}.fbd .reaction .head,.fbd .reaction text{fill:#b3261e}\n"
    ".fbd .friction .shaft{stroke:#a85a00}.fbd .friction .head,.fbd .friction text{fill:#a85a00}\n"
    ".fbd .applied .shaft{stroke:#1656b8}.fbd .applied .head,.fbd .applied text{fill:#1656b8}\n"
    ".fbd .spring .shaft{stroke:#7a3aa8}.fbd .spring .head,.fbd .spring text{fill:#7a3aa8}\n"
    ".fbd .damper .shaft{stroke:#0f7078}.fbd .damper .head,.fbd .damper text{fill:#0f7078}\n"
    ".fbd .potential .shaft{stroke:#8a2a6a}.fbd .potential .head,.fbd .potential text{fill:#8a2a6a}\n"
    ".fbd .stable{fill:#1656b8}.fbd .unstable{fill:#b3261e}.fbd .neutral{fill:#555}\n"
    "@media screen and (prefers-color-scheme:dark){\n"
    ".fbd text{fill:#e8e8e8}.fbd .note,.fbd .axis-label{fill:#a8adb5}\n"
    ".fbd .paper,.fbd .hole,.fbd .support,.fbd .center{fill:#14171c}\n"
    ".fbd .body{fill:#2c3644;stroke:#ccd}.fbd .hole,.fbd .mass,.fbd .bar,.fbd .thread,.fbd "
    ".rope{stroke:#ccd}\n"
    ".fbd .mass{fill:#ccd}.fbd .bar-inside{stroke:#2c3644}\n"
    ".fbd .ground,.fbd .support,.fbd .axis{stroke:#99a}.fbd .hatch{stroke:#667}\n"
    ".fbd .axis-head{fill:#99a}.fbd .dimension,.fbd .reference,.fbd .leader{stroke:#889}\n"
    ".fbd .center{stroke:#e8e8e8}.fbd .center-dark{fill:#e8e8e8}\n"
    ".fbd .gravity .shaft{stroke:#6fce6f}.fbd .gravity .head,.fbd .gravity text{fill:#6fce6f}\n"
    ".fbd .reaction .shaft{stroke:#ff8a80}.fbd .reaction .head,.fbd .reaction text{fill:#ff8a80}\n"
    ".fbd .friction .shaft{stroke:#ffb35c}.fbd .friction .head,.fbd .friction text{fill:#ffb35c}\n"
    ".fbd .applied .shaft{stroke:#7db4ff}.fbd .applied .head,.fbd .applied text{fill:#7db4ff}\n"
    ".fbd .spring .shaft{stroke:#d09bff}.fbd .spring .head,.fbd .spring text{fill:#d09bff}\n"
    ".fbd .damper .shaft{stroke:#5ed0da}.fbd .damper .head,.fbd .damper text{fill:#5ed0da}\n"
    ".fbd .potential .shaft{stroke:#f08ccc}.fbd .potential .head,.fbd .potential text{fill:#f08ccc}\n"
    ".fbd .stable{fill:#7db4ff}.fbd .unstable{fill:#ff8a80}.fbd .neutral{fill:#a8adb5}\n"
    "}\n";

void svg_begin(struct text *text, struct vec size, double scale, const char *title, const char *description)
{
    text_add(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" class=\"fbd\" width=\"");
    write_number(text, size.x * scale);
    text_add(text, "mm\" height=\"");
    write_number(text, size.y * scale);
    text_add(text, "mm\" viewBox=\"0 0 ");
    write_number(text, size.x);
    text_add(text, " ");
    write_number(text, size.y);
    text_add(text, "\">\n<title>");
    svg_escape(text, title);
    text_add(text, "</title>\n<desc>");
    svg_escape(text, description);
    text_add(text, "</desc>\n<style type=\"text/css\">\n");
    text_add(text, svg_style);
    text_add(text, "</style>\n<rect class=\"paper\" x=\"0\" y=\"0\"");
    attribute(text, "width", size.x);
    attribute(text, "height", size.y);
    text_add(text, "/>\n");
}

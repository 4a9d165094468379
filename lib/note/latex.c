/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A document as LaTeX, for pdflatex and lualatex, with packages of a small installation: amsmath, array, geometry,
 * graphicx, longtable. Drawings are PDF files beside it.
 */
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "base/utf8.h"
#include "note/document.h"

static const double text_width = 170, picture_height = 160; /* [mm] */

static const char preamble[] = "\\documentclass[a4paper,10pt]{article}\n"
                               "\\usepackage{ifthen,amsmath,textcomp,array,longtable,graphicx}\n"
                               "\\usepackage[a4paper,left=22mm,right=18mm,top=20mm,bottom=22mm]{geometry}\n"
                               "\\ifdefined\\directlua\n"
                               "\\usepackage{fontspec}\n"
                               "\\else\n"
                               "\\usepackage[T1]{fontenc}\n"
                               "\\usepackage[utf8]{inputenc}\n"
                               "\\IfFileExists{lmodern.sty}{\\usepackage{lmodern}}{}\n"
                               "\\fi\n"
                               "\\setlength{\\parindent}{0pt}\\setlength{\\parskip}{1.5mm}\\setlength{"
                               "\\LTleft}{0pt}\\setlength{\\LTpre}{2mm}\n"
                               "\\setlength{\\tabcolsep}{1.5mm}\\setlength{\\extrarowheight}{1.2pt}"
                               "\\allowdisplaybreaks\\sloppy\\raggedbottom\n"
                               "\\begin{document}\n";

/* ---- texts */

/* Characters that LaTeX reads as commands, and those beyond Latin letters that a note contains. */
static const struct replacement {
    const char *character, *latex;
} replacements[] = {
    {"\\", "\\textbackslash{}"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"$", "\\$"},
    {"&", "\\&"},
    {"#", "\\#"},
    {"%", "\\%"},
    {"_", "\\_"},
    {"^", "\\textasciicircum{}"},
    {"~", "\\textasciitilde{}"},
    {"\"", "\\textquotedbl{}"},
    {"-", "-{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    {"`", "\\textasciigrave{}"},
    {"−", "\\ensuremath{-}"},
    {"·", "\\ensuremath{\\cdot}"},
    {"±", "\\ensuremath{\\pm}"},
    {"°", "\\ensuremath{^\\circ}"},
    {"–", "--"},
    {"—", "---"},
    {"…", "\\ldots{}"},
    {"×", "\\ensuremath{\\times}"},
    {"≤", "\\ensuremath{\\le}"},
    {"≥", "\\ensuremath{\\ge}"},
    {"→", "\\ensuremath{\\to}"},
    {"∞", "\\ensuremath{\\infty}"},
    {"\u00a0", "~"},
    {"\u2009", "\\,"},
    {"\u0307", ""},
    {"\u0308", ""},
    {"⁻", "\\ensuremath{^-}"},
    {"⁰", "\\ensuremath{^0}"},
    {"¹", "\\ensuremath{^1}"},
    {"²", "\\ensuremath{^2}"},
    {"³", "\\ensuremath{^3}"},
    {"⁴", "\\ensuremath{^4}"},
    {"⁵", "\\ensuremath{^5}"},
    {"⁶", "\\ensuremath{^6}"},
    {"⁷", "\\ensuremath{^7}"},
    {"⁸", "\\ensuremath{^8}"},
    {"⁹", "\\ensuremath{^9}"},
    {"₀", "\\ensuremath{_0}"},
    {"₁", "\\ensuremath{_1}"},
    {"₂", "\\ensuremath{_2}"},
    {"₃", "\\ensuremath{_3}"},
    {"₄", "\\ensuremath{_4}"},
    {"₅", "\\ensuremath{_5}"},
    {"₆", "\\ensuremath{_6}"},
    {"₇", "\\ensuremath{_7}"},
    {"₈", "\\ensuremath{_8}"},
    {"₉", "\\ensuremath{_9}"},
    {"ₖ", "\\ensuremath{_k}"},
    {"ₛ", "\\ensuremath{_s}"},
    {"α", "\\ensuremath{\\alpha}"},
    {"β", "\\ensuremath{\\beta}"},
    {"γ", "\\ensuremath{\\gamma}"},
    {"δ", "\\ensuremath{\\delta}"},
    {"ε", "\\ensuremath{\\varepsilon}"},
    {"ζ", "\\ensuremath{\\zeta}"},
    {"η", "\\ensuremath{\\eta}"},
    {"θ", "\\ensuremath{\\theta}"},
    {"κ", "\\ensuremath{\\kappa}"},
    {"λ", "\\ensuremath{\\lambda}"},
    {"μ", "\\ensuremath{\\mu}"},
    {"ν", "\\ensuremath{\\nu}"},
    {"ξ", "\\ensuremath{\\xi}"},
    {"π", "\\ensuremath{\\pi}"},
    {"ρ", "\\ensuremath{\\rho}"},
    {"σ", "\\ensuremath{\\sigma}"},
    {"τ", "\\ensuremath{\\tau}"},
    {"φ", "\\ensuremath{\\varphi}"},
    {"χ", "\\ensuremath{\\chi}"},
    {"ψ", "\\ensuremath{\\psi}"},
    {"ω", "\\ensuremath{\\omega}"},
    {"Δ", "\\ensuremath{\\Delta}"},
    {"Σ", "\\ensuremath{\\Sigma}"},
    {"Φ", "\\ensuremath{\\Phi}"},
    {"Ω", "\\ensuremath{\\Omega}"},
    {"µ", "\\ensuremath{\\mu}"},
    {"½", "1/2"},
};

static const char *replacement_of(const char *character, size_t length)
{
    for (size_t i = 0; i < sizeof replacements / sizeof *replacements; i++)
        if (strlen(replacements[i].character) == length &&
            memcmp(replacements[i].character, character, length) == 0)
            return replacements[i].latex;
    return NULL;
}

/* Other characters than those of European languages have no glyph in the usual fonts of pdflatex. */
static bool is_european(const char *character, size_t length)
{
    enum { last_latin = 0x17F };
    unsigned code = 0;
    return utf8_decode(character, length, &code) > 0 && code <= last_latin;
}

static void write_character(struct text *text, const struct utf8_shown *next, bool exact)
{
    const char *latex = replacement_of(next->text, next->length);
    if (exact && next->length == 1 && next->text[0] == ' ')
        text_add(text, "\\ ");
    else if (latex && !(!exact && next->text[0] == '-'))
        text_add(text, latex);
    else if (next->plain && is_european(next->text, next->length))
        text_add_bytes(text, next->text, next->length);
    else
        text_add(text, "?");
}

/* `exact`: in a typewriter font, with every blank and hyphen. */
static void write_length(struct text *text, const char *content, size_t length, bool exact)
{
    const char *end = content + length;
    while (content < end && *content) {
        const struct utf8_shown next = utf8_show(content);
        write_character(text, &next, exact);
        content += next.taken;
    }
}

static void write_text(struct text *text, const char *content)
{
    write_length(text, content, strlen(content), false);
}

/* ---- blocks */

static double characters(const char *content)
{
    double count = 0;
    for (const char *c = content; *c; c++) count += (*c & 0xC0) != 0x80;
    return count;
}

/* The width [mm] that the longest text of a column takes. */
static double column_width(const struct block *block, size_t column, size_t count)
{
    const double of_character = 1.75, gap = 3;
    double most = 1.1 * characters(block->table.heads[column]);
    size_t at = 0;
    for (const struct cell *cell = block->first; cell; cell = cell->next, at++)
        if (at % count == column) most = fmax(most, characters(cell->text));
    return of_character * most + gap;
}

/* The columns with long texts share the width that the others leave. */
static void write_columns(struct text *text, const struct block *block, size_t count)
{
    const char *columns = block->table.columns;
    const double least = 25;
    double room = text_width, wide = 0;
    for (size_t i = 0; i < count; i++) {
        const double width = column_width(block, i, count);
        if (columns[i] == 'w')
            wide += width;
        else
            room -= width;
    }
    for (size_t i = 0; i < count; i++)
        if (columns[i] == 'w') {
            const double width = column_width(block, i, count);
            text_add(text, ">{\\raggedright\\arraybackslash}p{");
            text_number(text, fmax(wide <= room ? width : room * width / wide - 3, least), 4);
            text_add(text, "mm}");
        } else {
            text_add_bytes(text, columns + i, 1);
        }
}

static void write_heads(struct text *text, const struct table *table, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        text_add(text, i ? " & \\textbf{" : "\\textbf{");
        write_text(text, table->heads[i]);
        text_add(text, "}");
    }
    text_add(text, " \\\\ \\hline\n");
}

static void write_table(struct text *text, const struct block *block)
{
    const size_t count = strlen(block->table.columns);
    size_t column = 0;
    text_printf(text, "\\par{\\small Table %zu: ", block->number);
    write_text(text, block->text);
    text_add(text, "\\par\\nopagebreak\n\\begin{longtable}{");
    write_columns(text, block, count);
    text_add(text, "}\n");
    write_heads(text, &block->table, count);
    text_add(text, "\\endhead\n");
    for (const struct cell *cell = block->first; cell; cell = cell->next) {
        write_text(text, cell->text);
        column = (column + 1) % count;
        text_add(text, column > 0 ? " & " : " \\\\\n");
    }
    text_add(text, "\\end{longtable}}\n\n");
}

static void write_list(struct text *text, const struct block *block)
{
    if (!block->first) return;
    text_add(text, "\\begin{itemize}\\setlength{\\itemsep}{0pt}\n");
    for (const struct cell *item = block->first; item; item = item->next) {
        text_add(text, "\\item ");
        write_text(text, item->text);
        text_add(text, "\n");
    }
    text_add(text, "\\end{itemize}\n\n");
}

static double millimetres(const char *svg, const char *attribute)
{
    const char *at = svg ? strstr(svg, attribute) : NULL;
    if (!at) return 0;
    at += strlen(attribute);
    return number_value(at, number_length(at, strlen(at)));
}

/* A drawing in its size, as far as the page has room. */
static void write_picture(struct text *text, const struct block *block, const char *stem)
{
    const double width = millimetres(block->svg, " width=\""), height = millimetres(block->svg, " height=\"");
    double scale = width > text_width ? text_width / width : 1;
    if (height * scale > picture_height) scale = picture_height / height;
    text_add(text, "\\par\\begin{minipage}{\\linewidth}\n\\includegraphics[width=");
    text_number(text, width * scale, 5);
    text_printf(text, "mm]{%s-%zu.pdf}\\par\n{\\small Figure %zu: ", stem, block->number, block->number);
    write_text(text, block->text);
    text_add(text, "}\n\\end{minipage}\n\n");
}

static void write_verbatim(struct text *text, const char *content)
{
    text_add(text, "{\\scriptsize\\ttfamily\\raggedright\\setlength{\\parskip}{0pt}\n");
    while (*content) {
        const size_t length = strcspn(content, "\n");
        text_add(text, "\\mbox{}");
        write_length(text, content, length, true);
        text_add(text, "\\par\n");
        content += length + (content[length] == '\n');
    }
    text_add(text, "}\n\n");
}

/* The comment above each equation, its name, is printed; that in the first line, the time, stands in the document. */
static void write_equations(struct text *text, const char *content)
{
    content += strcspn(content, "\n");
    text_add(text, "{\\small\n");
    while (*content) {
        const size_t length = strcspn(content, "\n");
        if (content[0] == '%') {
            text_add(text, "\\par\\textit{");
            write_length(text, content + 2, length > 2 ? length - 2 : 0, false);
            text_add(text, "}\\nopagebreak");
        } else {
            text_add_bytes(text, content, length);
        }
        text_add(text, "\n");
        content += length + (content[length] == '\n');
    }
    text_add(text, "}\n\n");
}

static void write_block(struct text *text, const struct block *block, const char *stem)
{
    switch (block->kind) {
    case block_heading:
        text_add(text, block->level == 2 ? "\\section*{" : "\\subsection*{");
        write_text(text, block->text);
        text_add(text, "}\n");
        break;
    case block_paragraph:
        write_text(text, block->text);
        text_add(text, "\n\n");
        break;
    case block_list: write_list(text, block); break;
    case block_table: write_table(text, block); break;
    case block_picture: write_picture(text, block, stem); break;
    case block_equations: write_equations(text, block->forms[FBD_NOTE_LATEX]); break;
    case block_verbatim: write_verbatim(text, block->text); break;
    }
}

void write_latex(struct text *text, const struct document *document, const char *stem)
{
    text_add(text, preamble);
    text_add(text, "{\\LARGE\\bfseries ");
    write_text(text, document->title);
    text_add(text, "\\par}\n\n");
    for (const struct block *block = document->first; block; block = block->next)
        write_block(text, block, stem);
    text_add(text, "\\end{document}\n");
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A document as one HTML file: no network, no scripts, white paper on every screen, A4 in print. Drawings are inlined as
 * SVG; their ids get a prefix, since each drawing has its own, and the style of all drawings stands once.
 */
#include <string.h>

#include "draw/svg.h"
#include "note/document.h"

static const char style[] =
    "@page{size:A4;margin:20mm 18mm 20mm 22mm;@bottom-right{content:counter(page) ' / ' "
    "counter(pages);font:8pt "
    "Arial,'Liberation Sans',sans-serif;color:#555}}\n"
    ":root{color-scheme:only light}\n"
    "html{background:#fff;color:#111;font:10pt/1.42 Arial,Helvetica,'Liberation Sans',sans-serif}\n"
    "body{margin:0 auto;max-width:172mm;padding:8mm 5mm}\n"
    "h1{font-size:18pt;line-height:1.2;margin:0 0 4mm}\n"
    "h2{font-size:13pt;margin:9mm 0 2.5mm;border-bottom:.3mm solid #999;padding-bottom:.8mm}\n"
    "h3{font-size:11pt;margin:5mm 0 1.5mm}\n"
    "h2,h3,caption,.equation-name{break-after:avoid}\n"
    "p{margin:0 0 2.5mm;orphans:3;widows:3}ul{margin:0 0 3mm;padding-left:6mm}li{margin:.6mm 0}\n"
    "table{border-collapse:collapse;margin:2mm 0 4mm;font-size:9pt;max-width:100%}\n"
    "caption{text-align:left;white-space:nowrap;font-size:9pt;color:#333;padding-bottom:1mm}\n"
    "th,td{text-align:left;vertical-align:top;padding:.7mm 3mm .7mm 0;border-bottom:.15mm solid #bbb;"
    "font-weight:normal;overflow-wrap:anywhere}\n"
    "thead th{font-weight:bold;border-bottom:.3mm solid "
    "#555}thead{display:table-header-group}tr{break-inside:avoid}"
    "thead,tbody tr:first-child{break-after:avoid}\n"
    "table.whole{break-inside:avoid}\n"
    ".r{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}.l{overflow-wrap:normal}\n"
    ".yes{color:#1b5e20;font-weight:bold}.no{color:#b3261e;font-weight:bold}\n"
    "figure{margin:3mm 0 5mm;break-inside:avoid}figure "
    "svg{max-width:100%;max-height:160mm;height:auto;display:block}\n"
    "figcaption{font-size:9pt;color:#333;margin-top:1mm}\n"
    ".scroll{overflow-x:auto}\n"
    ".equation{margin:0 0 .8mm 8mm;text-indent:-5mm;padding-left:5mm;break-inside:avoid}\n"
    ".numbers{color:#333;margin-bottom:2.5mm}.equation-name{font-size:9pt;color:#555;margin:2mm 0 .5mm}\n"
    ".dotted{font-style:italic}\n"
    "pre{font:7.5pt/1.35 'Liberation "
    "Mono',monospace;white-space:pre-wrap;overflow-wrap:anywhere;background:#f5f5f5;"
    "padding:2mm 3mm;border:.15mm solid #ddd}\n"
    "@media print{body{padding:0;max-width:none}pre{background:none}.scroll{overflow:visible}}\n";

/* ---- drawings */

/* The styles of a drawing end in rules for dark screens, which a note leaves out. */
static void write_drawing_style(struct text *text)
{
    const char *dark = strstr(svg_style, "@media");
    text_add_bytes(text, svg_style, dark ? (size_t)(dark - svg_style) : strlen(svg_style));
}

/* The text from `from` to before `end`, with the prefix in front of each id. */
static void write_with_prefix(struct text *text, const char *from, const char *end, size_t number)
{
    static const char mark[] = " id=\"";
    for (const char *at = from; (at = strstr(at, mark)) != NULL && at < end;) {
        at += strlen(mark);
        text_add_bytes(text, from, (size_t)(at - from));
        text_printf(text, "figure-%zu-", number);
        from = at;
    }
    text_add_bytes(text, from, (size_t)(end - from));
}

/* The drawing without the declaration of a file and without its style sheet, as one picture for screen readers. */
static void write_drawing(struct text *text, const struct block *block)
{
    const char *svg = block->svg ? strstr(block->svg, "<svg") : NULL;
    if (!svg) return;
    const char *end = block->svg + strlen(block->svg), *from = strstr(svg, "<style"),
               *behind = strstr(svg, "</style>");
    text_add(text, "<svg role=\"img\" aria-label=\"");
    svg_escape(text, block->alternative);
    text_add(text, "\"");
    svg += strlen("<svg");
    if (!from || !behind) from = behind = end;
    write_with_prefix(text, svg, from, block->number);
    if (behind < end) write_with_prefix(text, behind + strlen("</style>\n"), end, block->number);
}

/* ---- tables */

static void write_cell(struct text *text, const struct table *table, size_t column, const char *cell)
{
    const size_t count = strlen(table->columns);
    const char *verdict =
        table->marked && column + 1 == count ? (strcmp(cell, "yes") == 0 ? " yes" : " no") : "";
    if (verdict[0] && strcmp(cell, "yes") != 0 && strcmp(cell, "NO") != 0) verdict = "";
    text_printf(text, column == 0 ? "<th scope=\"row\" class=\"%c%s\">" : "<td class=\"%c%s\">",
                table->columns[column], verdict);
    svg_escape(text, cell);
    text_add(text, column == 0 ? "</th>" : "</td>");
}

static void write_heads(struct text *text, const struct table *table, size_t count)
{
    text_add(text, "<thead><tr>");
    for (size_t i = 0; i < count; i++) {
        text_printf(text, "<th scope=\"col\" class=\"%c\">", table->columns[i]);
        svg_escape(text, table->heads[i]);
        text_add(text, "</th>");
    }
    text_add(text, "</tr></thead>\n");
}

/* True for a table that is not divided between pages. */
static bool is_short(const struct block *block, size_t columns)
{
    enum { most_rows = 15 };
    size_t cells = 0;
    for (const struct cell *cell = block->first; cell; cell = cell->next) cells++;
    return cells <= most_rows * columns;
}

static void write_table(struct text *text, const struct block *block)
{
    const struct table *table = &block->table;
    const size_t count = strlen(table->columns);
    size_t column = 0;
    text_printf(text, "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Table %zu\">",
                block->number);
    text_printf(text, "<table%s>\n<caption>Table %zu: ", is_short(block, count) ? " class=\"whole\"" : "",
                block->number);
    svg_escape(text, block->text);
    text_add(text, "</caption>\n");
    write_heads(text, table, count);
    text_add(text, "<tbody>\n");
    for (const struct cell *cell = block->first; cell; cell = cell->next) {
        if (column == 0) text_add(text, "<tr>");
        write_cell(text, table, column, cell->text);
        column = (column + 1) % count;
        if (column == 0) text_add(text, "</tr>\n");
    }
    text_add(text, "</tbody>\n</table></div>\n");
}

/* ---- blocks */

static void write_element(struct text *text, const char *element, const char *content)
{
    text_printf(text, "<%s>", element);
    svg_escape(text, content);
    text_printf(text, "</%s>\n", element);
}

/* Lines as they are: control characters other than their ends are left out. */
static void write_verbatim(struct text *text, const char *content)
{
    text_add(text, "<pre>");
    while (*content) {
        const size_t length = strcspn(content, "\n");
        struct text line = {0};
        text_add_bytes(&line, content, length);
        if (line.data) svg_escape(text, line.data);
        text->failed |= line.failed;
        text_free(&line);
        text_add(text, "\n");
        content += length + (content[length] == '\n');
    }
    text_add(text, "</pre>\n");
}

static void write_list(struct text *text, const struct block *block)
{
    text_add(text, "<ul>\n");
    for (const struct cell *item = block->first; item; item = item->next)
        write_element(text, "li", item->text);
    text_add(text, "</ul>\n");
}

static void write_figure(struct text *text, const struct block *block)
{
    text_add(text, "<figure>\n");
    write_drawing(text, block);
    text_printf(text, "<figcaption>Figure %zu: ", block->number);
    svg_escape(text, block->text);
    text_add(text, "</figcaption>\n</figure>\n");
}

static void write_block(struct text *text, const struct block *block)
{
    switch (block->kind) {
    case block_heading: write_element(text, block->level == 2 ? "h2" : "h3", block->text); break;
    case block_paragraph: write_element(text, "p", block->text); break;
    case block_list: write_list(text, block); break;
    case block_table: write_table(text, block); break;
    case block_picture: write_figure(text, block); break;
    case block_equations: text_add(text, block->forms[FBD_NOTE_HTML]); break;
    case block_verbatim: write_verbatim(text, block->text); break;
    }
}

void write_html(struct text *text, const struct document *document)
{
    text_add(text, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                   "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
                   "'unsafe-inline'\"/>\n<meta name=\"viewport\" content=\"width=device-width\"/>\n");
    write_element(text, "title", document->title);
    text_add(text, "<style>\n");
    text_add(text, style);
    write_drawing_style(text);
    text_add(text, "</style>\n</head>\n<body>\n<main>\n");
    write_element(text, "h1", document->title);
    for (const struct block *block = document->first; block; block = block->next) write_block(text, block);
    text_add(text, "</main>\n</body>\n</html>\n");
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <stdint.h>
#include <string.h>

#include "claims.h"
#include "fuzz.h"

enum { deepest = 64, most_attributes = 32, most_ids = 512 };

struct name {
    const char *text;
    size_t length;
};

struct xml {
    const char *what, *start, *at;
    struct name open[deepest], ids[most_ids];
    size_t depth, id_count;
};

static _Noreturn void refuse(const struct xml *xml, const char *why)
{
    size_t before = (size_t)(xml->at - xml->start);
    fuzz_fail("%s: %s at byte %zu: %.200s", xml->what, why, before, xml->at - (before < 60 ? before : 60));
}

static bool same(struct name a, struct name b)
{
    return a.length == b.length && memcmp(a.text, b.text, a.length) == 0;
}

static struct name read_name(struct xml *xml)
{
    struct name name = {xml->at, 0};
    if (!isalpha((unsigned char)*xml->at) && *xml->at != '_') refuse(xml, "no name");
    while (isalnum((unsigned char)*xml->at) || (*xml->at && strchr("_-.:", *xml->at))) xml->at++;
    name.length = (size_t)(xml->at - name.text);
    return name;
}

/* Characters up to `end`, which is left. */
static void read_characters(struct xml *xml, char end)
{
    static const char *const references[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#"};
    for (; *xml->at && *xml->at != end; xml->at++) {
        bool known = *xml->at != '&';
        for (size_t i = 0; !known && i < sizeof references / sizeof *references; i++)
            known = strncmp(xml->at, references[i], strlen(references[i])) == 0;
        if (!known) refuse(xml, "raw &");
        if (*xml->at == '<') refuse(xml, "raw <");
        if ((unsigned char)*xml->at < 0x20 && !isspace((unsigned char)*xml->at))
            refuse(xml, "control character");
        if (end == '<' && strncmp(xml->at, "]]>", 3) == 0) refuse(xml, "raw ]]>");
    }
}

static void note_id(struct xml *xml, struct name id)
{
    for (size_t i = 0; i < xml->id_count; i++)
        if (same(xml->ids[i], id)) refuse(xml, "an id twice");
    if (xml->id_count < most_ids) xml->ids[xml->id_count++] = id;
}

static void read_attributes(struct xml *xml)
{
    struct name seen[most_attributes];
    size_t count = 0;
    for (;;) {
        size_t blanks = strspn(xml->at, " \t\r\n");
        xml->at += blanks;
        if (!*xml->at || strchr("/>?", *xml->at)) return;
        if (blanks == 0) refuse(xml, "no blank before an attribute");
        struct name name = read_name(xml);
        for (size_t i = 0; i < count; i++)
            if (same(seen[i], name)) refuse(xml, "an attribute twice");
        if (count < most_attributes) seen[count++] = name;
        if (xml->at[0] != '=' || (xml->at[1] != '"' && xml->at[1] != '\'')) refuse(xml, "no quoted value");
        char quote = xml->at[1];
        xml->at += 2;
        const char *value = xml->at;
        read_characters(xml, quote);
        if (!*xml->at) refuse(xml, "ends in an attribute");
        if (same(name, (struct name){"id", 2})) note_id(xml, (struct name){value, (size_t)(xml->at - value)});
        xml->at++;
    }
}

/* Past `end`, which has to come. */
static void skip_past(struct xml *xml, const char *end)
{
    const char *found = strstr(xml->at, end);
    if (!found) refuse(xml, "not closed");
    xml->at = found + strlen(end);
}

static void read_tag(struct xml *xml)
{
    bool closes = xml->at[1] == '/';
    xml->at += closes ? 2 : 1;
    struct name name = read_name(xml);
    if (closes) {
        if (xml->depth == 0 || !same(xml->open[--xml->depth], name)) refuse(xml, "closes another element");
    } else {
        read_attributes(xml);
        bool empty = *xml->at == '/';
        xml->at += empty;
        if (!empty && xml->depth == deepest) refuse(xml, "too deep");
        if (!empty) xml->open[xml->depth++] = name;
    }
    if (*xml->at != '>') refuse(xml, "no end of a tag");
    xml->at++;
}

void claim_xml(const char *what, const char *text)
{
    struct xml xml = {.what = what, .start = text, .at = text};
    while (*xml.at) {
        if (*xml.at != '<')
            read_characters(&xml, '<');
        else if (strncmp(xml.at, "<?", 2) == 0)
            skip_past(&xml, "?>");
        else if (strncmp(xml.at, "<!--", 4) == 0)
            skip_past(&xml, "-->");
        else if (strncmp(xml.at, "<!", 2) == 0)
            skip_past(&xml, ">");
        else
            read_tag(&xml);
    }
    if (xml.depth > 0) refuse(&xml, "an element is not closed");
}

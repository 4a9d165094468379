/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "examples.h"

#include <stdio.h>
#include <string.h>

#include "complain.h"
#include "completion.h"
#include "standard_streams.h"

enum { name_size = 80 };

static bool is_shared(const struct example *example)
{
    for (size_t i = 0; i < example_count; i++)
        if (&examples[i] != example && strcmp(examples[i].name, example->name) == 0) return true;
    return false;
}

/* The shortest name that is unique: with the topic where two topics have one of this name. */
static const char *short_name(const struct example *example, char name[name_size])
{
    const bool shared = is_shared(example);
    snprintf(name, name_size, "%s%s%s", shared ? example->topic : "", shared ? "/" : "", example->name);
    return name;
}

/* `wanted` with or without the topic. */
static bool is_called(const struct example *example, const char *wanted)
{
    const size_t topic = strlen(example->topic);
    const bool full = strncmp(wanted, example->topic, topic) == 0 && wanted[topic] == '/';
    return strcmp(full ? wanted + topic + 1 : wanted, example->name) == 0;
}

enum exit_code examples_list(void)
{
    char name[name_size];
    for (size_t i = 0; i < example_count; i++) {
        const bool first = i == 0 || strcmp(examples[i].topic, examples[i - 1].topic) != 0;
        if (first) printf("%s%s\n", i == 0 ? "" : "\n", examples[i].topic);
        printf("  %-28s  %s\n", short_name(&examples[i], name), examples[i].title);
    }
    printf("\n`fbd-run --example NAME > NAME.yaml` writes one.\n");
    return standard_output_arrives("fbd-run") ? exit_done : exit_failed;
}

void examples_write_names(void)
{
    char name[name_size];
    for (size_t i = 0; i < example_count; i++) puts(short_name(&examples[i], name));
}

/* ---- one of them */

static bool is_similar(const struct example *example, const char *wanted)
{
    const char *slash = strchr(wanted, '/'), *name = slash ? slash + 1 : wanted;
    return completion_distance(name, example->name) <= 2 || (strlen(name) > 2 && strstr(example->name, name));
}

static enum exit_code refuse(const char *wanted, bool shared)
{
    char list[400] = "", name[name_size];
    size_t length = 0;
    for (size_t i = 0; i < example_count; i++) {
        if (!(shared ? is_called(&examples[i], wanted) : is_similar(&examples[i], wanted))) continue;
        const int size = snprintf(list + length, sizeof list - length, "%s%s", length > 0 ? ", " : "",
                                  short_name(&examples[i], name));
        if (length + (size_t)size >= sizeof list) break;
        length += (size_t)size;
    }
    list[length] = '\0';
    complain("fbd-run: %s example is called `%s`%s%s%s", shared ? "more than one" : "no", wanted,
             *list ? ": did you mean " : "", list, *list ? "?" : "");
    complain("`fbd-run --examples` lists them.");
    return exit_usage;
}

enum exit_code examples_print(const char *name)
{
    char wanted[name_size];
    const size_t length = strlen(name);
    const bool ends = length > 5 && strcmp(name + length - 5, ".yaml") == 0;
    snprintf(wanted, sizeof wanted, "%.*s", (int)(ends ? length - 5 : length), name);
    const struct example *found = NULL;
    for (size_t i = 0; i < example_count; i++) {
        if (!is_called(&examples[i], wanted)) continue;
        if (found) return refuse(wanted, true);
        found = &examples[i];
    }
    if (!found) return refuse(wanted, false);
    fwrite(found->text, 1, found->length, stdout);
    return standard_output_arrives("fbd-run") ? exit_done : exit_failed;
}

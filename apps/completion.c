/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "completion.h"

#include <string.h>

/* ---- descriptions of options */

struct piece {
    const char *text;
    int length;
};

enum { longest_words = 40 };

/* The text behind `--name` at the begin of a line of the help, or NULL. */
static const char *behind_in(const char *help, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = help; (at = strstr(at, "\n  --")) != NULL; at += 5)
        if (strncmp(at + 5, name, length) == 0 && strchr(" ,\n|", at[5 + length])) return at + 5 + length;
    return NULL;
}

static const char *behind(const struct command_line *line, const char *name)
{
    const char *at = behind_in(line->help[0], name);
    return at || !line->help[1] ? at : behind_in(line->help[1], name);
}

/* The first line of the description after `--name ...   ` in the help, without characters special to shells
 * or lists. */
static struct piece doc_of(const struct command_line *line, const char *name)
{
    const char *at = behind(line, name), *doc = at ? strstr(at, "  ") : NULL;
    if (!doc || doc > at + strcspn(at, "\n")) return (struct piece){"", 0};
    doc += strspn(doc, " ");
    return (struct piece){doc, (int)strcspn(doc, "'[]:(;\n")};
}

/* The word for its value in the help: FILE, NAME, 2|3. */
static struct piece value_of(const struct command_line *line, const char *name)
{
    const char *at = behind(line, name);
    if (!at || at[0] != ' ') return (struct piece){"", 0};
    return (struct piece){at + 1, (int)strcspn(at + 1, " \n")};
}

/* ---- shells */

/* Options whose values are names, which the program lists by `--completion KIND MODEL`; `end` follows a name. */
struct named {
    const char *option, *kind, *end;
};

static const struct named *named_by(const char *option)
{
    static const struct named all[] = {
        {"set", "parameters", "="},    {"vary", "parameters", "="}, {"method", "methods", ""},
        {"body", "bodies", ""},        {"without", "effects", ""},  {"example", "examples", ""},
        {"fmu-outputs", "forces", ""},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (strcmp(option, all[i].option) == 0) return &all[i];
    return NULL;
}

static bool ends_in(struct piece piece, const char *end)
{
    const int length = (int)strlen(end);
    return piece.length >= length && strncmp(piece.text + piece.length - length, end, (size_t)length) == 0;
}

static bool takes_file(const struct command_line *line, const char *name)
{
    const struct piece value = value_of(line, name);
    return ends_in(value, "FILE") || ends_in(value, "KEY") || ends_in(value, ".csv");
}

/* The words that the value may be, separated by blanks; "" for others. */
static const char *words_of(const struct command_line *line, const char *name, char words[longest_words])
{
    struct piece value = value_of(line, name);
    if (strcmp(name, "completion") == 0) return "bash zsh fish";
    words[0] = '\0';
    if (!memchr(value.text, '|', (size_t)value.length) || memchr(value.text, '=', (size_t)value.length) ||
        value.length >= longest_words)
        return words;
    for (int i = 0; i < value.length; i++) words[i] = value.text[i] == '|' ? ' ' : value.text[i];
    words[value.length] = '\0';
    return words;
}

static void write_bash_value(const struct command_line *line, const char *option)
{
    const struct named *named = named_by(option);
    char room[longest_words];
    const char *words = words_of(line, option, room);
    printf("    --%s)", option);
    if (named)
        printf(" COMPREPLY=($(compgen -S '%s' -W \"$(%s --completion %s \"$model\" 2>/dev/null)\" -- "
               "\"$word\"));",
               named->end, line->program, named->kind);
    if (named && *named->end) printf(" compopt -o nospace 2>/dev/null;");
    if (*words) printf(" COMPREPLY=($(compgen -W '%s' -- \"$word\"));", words);
    printf(" return ;;\n");
}

static void write_bash(const struct command_line *line)
{
    const char *function = strchr(line->program, '-') + 1;
    printf("# eval \"$(%s --completion bash)\"\n_fbd_%s() {\n    local word=${COMP_WORDS[COMP_CWORD]} "
           "before=${COMP_WORDS[COMP_CWORD-1]} model\n    for model in \"${COMP_WORDS[@]:1}\"; do\n        "
           "[[ $model == *.y?(a)ml ]] && break\n        model=\n    done\n    case $before in\n",
           line->program, function);
    for (const struct option *o = line->options; o->name; o++)
        if (o->has_arg == required_argument && !takes_file(line, o->name)) write_bash_value(line, o->name);
    printf("    esac\n    if [[ $word == -* ]]; then\n        COMPREPLY=($(compgen -W '");
    for (const struct option *o = line->options; o->name; o++)
        printf("%s--%s", o == line->options ? "" : " ", o->name);
    printf("' -- \"$word\"))\n    else\n        COMPREPLY=($(compgen -f -- \"$word\"))\n    fi\n}\ncomplete "
           "-o filenames -F "
           "_fbd_%s %s\n",
           function, line->program);
}

static void write_zsh(const struct command_line *line)
{
    printf("#compdef %s\n# eval \"$(%s --completion zsh)\", after compinit\n_%s() {\n    _arguments \\\n",
           line->program, line->program, line->program);
    for (const struct option *o = line->options; o->name; o++) {
        struct piece doc = doc_of(line, o->name);
        bool value = o->has_arg == required_argument;
        const struct named *named = named_by(o->name);
        if (named) {
            printf("        '*--%s[%.*s]:name:{compadd -S \"%s\" -- $(%s --completion %s "
                   "\"${words[(r)*.y(a|)ml]}\" 2>/dev/null)}' \\\n",
                   o->name, doc.length, doc.text, *named->end ? named->end : " ", line->program, named->kind);
            continue;
        }
        char room[longest_words];
        const char *words = value ? words_of(line, o->name, room) : "";
        printf("        '*--%s[%.*s]%s%s%s%s' \\\n", o->name, doc.length, doc.text,
               !value                      ? ""
               : takes_file(line, o->name) ? ":file:_files"
                                           : ":value:",
               *words ? "(" : "", words, *words ? ")" : "");
    }
    printf("        '*:model:_files -g \"*.yaml\"'\n}\n"
           /* When autoloaded from fpath, the function completes at once. */
           "if [ \"${funcstack[1]}\" = _%s ]; then\n    _%s \"$@\"\nelse\n    compdef _%s %s\nfi\n",
           line->program, line->program, line->program, line->program);
}

static void write_fish(const struct command_line *line)
{
    printf("# %s --completion fish | source\n", line->program);
    for (const struct option *o = line->options; o->name; o++) {
        struct piece doc = doc_of(line, o->name);
        bool value = o->has_arg == required_argument;
        const struct named *named = named_by(o->name);
        if (named) {
            printf("complete -c %s -l %s -x -a '(%s --completion %s (string match -r \"\\S+\\.ya?ml\" "
                   "(commandline)) "
                   "2>/dev/null)%s' -d '%.*s'\n",
                   line->program, o->name, line->program, named->kind, named->end, doc.length, doc.text);
            continue;
        }
        char room[longest_words];
        const char *words = value ? words_of(line, o->name, room) : "";
        printf("complete -c %s -l %s%s", line->program, o->name,
               !value                      ? ""
               : takes_file(line, o->name) ? " -r -F"
                                           : " -x");
        if (*words) printf(" -a '%s'", words);
        printf(" -d '%.*s'\n", doc.length, doc.text);
    }
}

bool completion_write(const struct command_line *line, const char *shell)
{
    if (strcmp(shell, "bash") == 0)
        write_bash(line);
    else if (strcmp(shell, "zsh") == 0)
        write_zsh(line);
    else if (strcmp(shell, "fish") == 0)
        write_fish(line);
    else
        return false;
    return true;
}

/* ---- misspellings */

static int least(int a, int b)
{
    return a < b ? a : b;
}

int completion_distance(const char *a, const char *b)
{
    enum { longest = 32 };
    int d[longest + 1][longest + 1], n = (int)strlen(a), m = (int)strlen(b);
    if (n > longest || m > longest) return longest;
    for (int i = 0; i <= n; i++) d[i][0] = i;
    for (int j = 0; j <= m; j++) d[0][j] = j;
    for (int i = 1; i <= n; i++)
        for (int j = 1; j <= m; j++) {
            d[i][j] = least(least(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[n][m];
}

const char *completion_nearest(const struct command_line *line, const char *wrong)
{
    char name[32] = "";
    size_t dashes = strspn(wrong, "-"), length = strcspn(wrong + dashes, "=");
    if (dashes == 0 || length == 0 || length >= sizeof name) return NULL;
    memcpy(name, wrong + dashes, length);
    const char *nearest = NULL;
    int fewest = length <= 4 ? 2 : 3; /* distance must be less */
    for (const struct option *o = line->options; o->name; o++) {
        int d = completion_distance(name, o->name);
        if (d >= fewest) continue;
        fewest = d;
        nearest = o->name;
    }
    return nearest;
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdint.h>
#include <string.h>

#include "claims.h"
#include "fuzz.h"

struct json {
    const char *what, *start, *at;
};

static _Noreturn void refuse(const struct json *json, const char *why)
{
    size_t before = (size_t)(json->at - json->start);
    fuzz_fail("%s: %s at byte %zu: %.200s", json->what, why, before, json->at - (before < 60 ? before : 60));
}

static void skip_blanks(struct json *json)
{
    json->at += strspn(json->at, " \t\r\n");
}

static void expect(struct json *json, char c)
{
    skip_blanks(json);
    if (*json->at != c) refuse(json, "unexpected character");
    json->at++;
}

static void read_text(struct json *json)
{
    expect(json, '"');
    for (; *json->at != '"'; json->at++) {
        if ((unsigned char)*json->at < 0x20) refuse(json, "raw control character");
        if (*json->at != '\\') continue;
        json->at++;
        if (*json->at == 'u' && strspn(json->at + 1, "0123456789abcdefABCDEF") < 4) refuse(json, "bad \\u");
        if (!*json->at || !strchr("\"\\/bfnrtu", *json->at)) refuse(json, "bad escape");
    }
    json->at++;
}

static void read_digits(struct json *json)
{
    size_t digits = strspn(json->at, "0123456789");
    if (digits == 0) refuse(json, "no number");
    json->at += digits;
}

static void read_number(struct json *json)
{
    if (*json->at == '-') json->at++;
    if (json->at[0] == '0' && json->at[1] >= '0' && json->at[1] <= '9') refuse(json, "leading zero");
    read_digits(json);
    if (*json->at == '.') {
        json->at++;
        read_digits(json);
    }
    if (*json->at != 'e' && *json->at != 'E') return;
    json->at++;
    if (*json->at == '+' || *json->at == '-') json->at++;
    read_digits(json);
}

static void read_value(struct json *json);

enum { most_keys = 256 }; /* beyond so many, keys are not compared any more */

static void read_object(struct json *json)
{
    struct {
        const char *text;
        size_t length;
    } keys[most_keys];
    size_t count = 0;
    expect(json, '{');
    skip_blanks(json);
    while (*json->at != '}') {
        skip_blanks(json);
        const char *key = json->at;
        read_text(json);
        size_t length = (size_t)(json->at - key);
        for (size_t i = 0; i < count; i++)
            if (keys[i].length == length && memcmp(keys[i].text, key, length) == 0)
                refuse(json, "a key twice");
        if (count < most_keys) {
            keys[count].text = key;
            keys[count++].length = length;
        }
        expect(json, ':');
        read_value(json);
        skip_blanks(json);
        if (*json->at == '}') break;
        expect(json, ',');
    }
    json->at++;
}

static void read_list(struct json *json)
{
    expect(json, '[');
    skip_blanks(json);
    while (*json->at != ']') {
        read_value(json);
        skip_blanks(json);
        if (*json->at == ']') break;
        expect(json, ',');
    }
    json->at++;
}

static void read_value(struct json *json)
{
    static const char *const words[] = {"true", "false", "null"};
    skip_blanks(json);
    if (*json->at == '{') {
        read_object(json);
    } else if (*json->at == '[') {
        read_list(json);
    } else if (*json->at == '"') {
        read_text(json);
    } else {
        for (int i = 0; i < 3; i++)
            if (strncmp(json->at, words[i], strlen(words[i])) == 0) {
                json->at += strlen(words[i]);
                return;
            }
        read_number(json);
    }
}

void claim_json(const char *what, const char *text)
{
    struct json json = {what, text, text};
    read_value(&json);
    skip_blanks(&json);
    if (*json.at) refuse(&json, "more behind the value");
}

/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/utf8.h"
#include "emit/live.h"

const char *emit_number(struct emitter *emitter, double value)
{
    struct text text = {0};
    text_exact(&text, value);
    if (text.data && !strpbrk(text.data, ".e")) text_add(&text, ".0");
    const char *copy = text.failed ? NULL : arena_text(&emitter->arena, text.data, text.length);
    if (!copy) emitter->arena.failed = true;
    text_free(&text);
    return copy ? copy : "";
}

/* Also avoids trigraphs (`??/`) and backslashes, which older compilers interpret in comments. */
void emit_comment(struct text *text, const char *words)
{
    for (const char *at = words; *at;) {
        struct utf8_shown shown = utf8_show(at);
        if (shown.plain && (*at == '\\' || *at == '?'))
            text_add(text, *at == '?' && at[1] == '?' ? "? " : *at == '\\' ? "/" : "?");
        else
            text_add_bytes(text, shown.text, shown.length);
        if (!shown.plain && text->length > 0 && !text->failed)
            for (char *c = text->data + text->length - shown.length; *c; c++)
                if (*c == '\\') *c = '/';
        if ((*at == '*' && at[1] == '/') || (*at == '/' && (at[1] == '*' || at[1] == '/')))
            text_add(text, " ");
        at += shown.taken;
    }
}

static void unit_behind(const struct emitter *emitter, struct text *text, struct dim dim)
{
    char unit[64];
    unit_name(dim, emitter->model->scene->units, unit, sizeof unit);
    if (*unit) text_printf(text, " /* %s */", unit);
    text_add(text, "\n");
}

const char *emit_parameter(struct emitter *emitter, const char *wanted, double value,
                           struct emit_origin origin)
{
    const char *name = emit_name(emitter, wanted);
    text_printf(&emitter->parameters, "    double %s;", name);
    unit_behind(emitter, &emitter->parameters, origin.dim);
    text_printf(&emitter->defaults, "    p->%s = %s;\n", name, emit_live_number(emitter, value, origin));
    const char *member = arena_printf(&emitter->arena, "p->%s", name);
    return member ? member : "";
}

static const char *pair_of_numbers(struct emitter *emitter, struct vec value)
{
    return emit_printf(emitter, "(struct vec){%s, %s}", emit_number(emitter, value.x),
                       emit_number(emitter, value.y));
}

bool emit_tells_points(const struct emitter *emitter, int b)
{
    if (b < 0) return true;
    const struct model_body *body = &emitter->model->bodies[b];
    return !body->alone || body->joint->has_axis;
}

const char *emit_vector(struct emitter *emitter, const char *wanted, struct vec value,
                        struct emit_origin origin)
{
    bool tells = emit_tells_points(emitter, origin.body);
    const struct node *node = tells ? emit_live_find(emitter, origin) : NULL;
    const char *end = node && node->kind == node_scalar && origin.body >= 0
                          ? emit_rod_end(emitter, origin.body, node->text, value)
                          : NULL;
    if (end) return end;
    const char *pair = node ? emit_live_vector(emitter, node, value) : NULL;
    if (!pair && (value.x != 0 || value.y != 0)) emit_live_spoil_body(emitter, origin.body);
    const char *name = emit_name(emitter, wanted);
    text_printf(&emitter->parameters, "    struct vec %s;", name);
    unit_behind(emitter, &emitter->parameters, DIM_LENGTH);
    text_printf(&emitter->defaults, "    p->%s = %s;\n", name, pair ? pair : pair_of_numbers(emitter, value));
    return emit_printf(emitter, "p->%s", name);
}

const char *emit_constant(struct emitter *emitter, const char *type, const char *wanted)
{
    const char *name = emit_name(emitter, wanted);
    text_printf(&emitter->constants, "    %s %s;\n", type, name);
    return name;
}

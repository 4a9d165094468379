/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * C identifiers. All names of a program are in one list, so that none clash; keywords and the names of the
 * program's own functions are reserved.
 */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "emit/emit.h"

struct emit_name {
    const char *name;
    const struct emit_name *before;
};

/* Keywords, object-like macros of the included headers, and names used by the program. */
static const char *const reserved[] = {
    "auto",        "break",
    "case",        "char",
    "const",       "continue",
    "default",     "do",
    "double",      "else",
    "enum",        "extern",
    "float",       "for",
    "goto",        "if",
    "inline",      "int",
    "long",        "register",
    "restrict",    "return",
    "short",       "signed",
    "sizeof",      "static",
    "struct",      "switch",
    "typedef",     "union",
    "unsigned",    "void",
    "volatile",    "while",
    "bool",        "true",
    "false",       "errno",
    "stdin",       "stdout",
    "stderr",      "linux",
    "unix",        "i386",
    "asm",         "typeof",
    "constexpr",   "nullptr",
    "alignas",     "alignof",
    "main",        "scene",
    "parameters",  "constants",
    "link",        "joint",
    "vec",         "motion",
    "wrench",      "t",
    "y",           "p",
    "c",           "s",
    "a",           "f",
    "n",           "l",
    "g",           "gravity",
    "until",       "tolerance",
    "coordinates", "places",
    "pairs",       "branches",
    "slots",       "watches",
    "derive",      "set_parameters",
    "forces",      "accelerations",
    "rates",       "balance",
    "settle",      "initial",
    "size",        "events",
    "branch",
};

static bool is_taken(const struct emitter *emitter, const char *name)
{
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++)
        if (strcmp(reserved[i], name) == 0) return true;
    for (const struct emit_name *taken = emitter->taken; taken; taken = taken->before)
        if (strcmp(taken->name, name) == 0) return true;
    return false;
}

/* True for names like macros (capitals), of the implementation (`_`) and of libraries. */
static bool is_foreign(const char *name)
{
    bool small = false;
    for (const char *c = name; *c; c++) small = small || (*c >= 'a' && *c <= 'z');
    return !small || *name == '_' || strncmp(name, "gsl_", 4) == 0 || strncmp(name, "vec_", 4) == 0;
}

const char *emit_name(struct emitter *emitter, const char *wanted)
{
    struct arena *arena = &emitter->arena;
    char *name = arena_printf(arena, is_foreign(wanted) ? "the_%s" : "%s", wanted);
    if (!name) return "";
    for (char *c = name; *c; c++)
        if (*c == '.') *c = '_';
    const char *first = name;
    for (int k = 2; name && is_taken(emitter, name); k++) name = arena_printf(arena, "%s_%d", first, k);
    struct emit_name *entry = ARENA_NEW(arena, struct emit_name);
    if (!name || !entry) return "";
    *entry = (struct emit_name){name, emitter->taken};
    emitter->taken = entry;
    return name;
}

const char *emit_join(struct emitter *emitter, const char *first, const char *second)
{
    const char *joined = arena_printf(&emitter->arena, "%s_%s", first, second);
    return joined ? joined : "";
}

const char *emit_printf(struct emitter *emitter, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = length < 0 ? NULL : arena_array(&emitter->arena, (size_t)length + 1, 1);
    if (text) vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    if (!text) emitter->arena.failed = true;
    return text ? text : "";
}

bool emit_has_places(const struct emitter *emitter)
{
    for (size_t k = 0; k < emitter->model->absolute_count; k++)
        if (emitter->used[k]) return true;
    return false;
}

static const char **names_of(struct emitter *emitter, size_t count)
{
    return ARENA_ARRAY(&emitter->arena, count, const char *);
}

static const char *place_name(struct emitter *emitter, size_t index)
{
    static const char *const kinds[] = {"x", "y", "vx", "vy", "angle", "angle_dot", "acceleration", "slip"};
    const struct absolute *absolute = &emitter->model->scene->absolutes[index];
    const char *body = emitter->model->bodies[absolute->body].name;
    const char *point = arena_printf(&emitter->arena, "%s_place_%s", body, kinds[absolute->kind]);
    return point ? point : "";
}

static void use_places(struct emitter *emitter, const struct formula *formula)
{
    const int *slots, first = 1 + 2 * emitter->model->plan.n + hand_slots;
    size_t count = formula->expr ? expr_variables(formula->expr, &slots) : 0;
    for (size_t i = 0; i < count; i++)
        if (slots[i] >= first) emitter->used[slots[i] - first] = true;
}

/* Mark positions that the program uses; derivations by hand, which also name some, are not written. */
static void find_used_places(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    const struct plan *plan = &model->plan;
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        const struct formula *all[] = {&load->value,  &load->angle,     &load->fx,       &load->fy,
                                       &load->couple, &load->potential, &load->offset_x, &load->offset_y};
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) use_places(emitter, all[k]);
    }
    for (size_t i = 0; i < plan->mode_count; i++) {
        use_places(emitter, &plan->modes[i].mu_s);
        use_places(emitter, &plan->modes[i].mu_k);
        use_places(emitter, &plan->modes[i].surface_speed);
    }
    for (size_t i = 0; i < plan->watch_count; i++) {
        use_places(emitter, &plan->watches[i].left);
        use_places(emitter, &plan->watches[i].right);
    }
}

/* Name the slots of forces across slides and of reactions along sticking joint coordinates. */
static void name_slots(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    const struct plan *plan = &model->plan;
    for (int i = 0; i < plan->slots; i++) emitter->slot[i] = i < plan->n ? emitter->coordinate[i] : "";
    for (size_t b = 0; b < model->body_count; b++)
        if (model->bodies[b].normal_slot >= 0)
            emitter->slot[model->bodies[b].normal_slot] =
                emit_name(emitter, emit_join(emitter, model->bodies[b].name, "across"));
    for (size_t i = 0; i < plan->mode_count; i++)
        if (plan->modes[i].hold_slot >= plan->n)
            emitter->slot[plan->modes[i].hold_slot] =
                emit_name(emitter, emit_join(emitter, model->bodies[plan->modes[i].body].name, "hold"));
}

static void name_branches(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    for (size_t i = 0; i < model->plan.kink_count; i++) {
        const struct kink *kink = &model->plan.kinks[i];
        const char *owner = kink->load >= 0 ? emitter->load[kink->load] : "event";
        for (size_t k = 0; k < kink->count; k++)
            emitter->branch[(size_t)kink->formula.branch + k] =
                emit_name(emitter, emit_join(emitter, owner, "branch"));
    }
}

bool emit_names(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    size_t n = (size_t)model->plan.n;
    emitter->body = names_of(emitter, model->body_count);
    emitter->coordinate = names_of(emitter, n);
    emitter->rate = names_of(emitter, n);
    emitter->load = names_of(emitter, model->load_count);
    emitter->place = names_of(emitter, model->absolute_count);
    emitter->branch = names_of(emitter, (size_t)model->plan.branches);
    emitter->pair = names_of(emitter, model->plan.mode_count);
    size_t parts = 0;
    for (size_t b = 0; b < model->body_count; b++) parts += model->bodies[b].source->part_count;
    emitter->rods = names_of(emitter, parts);
    emitter->pose = names_of(emitter, model->body_count);
    emitter->forces_on = names_of(emitter, model->body_count);
    emitter->slot = names_of(emitter, (size_t)model->plan.slots);
    emitter->used = ARENA_ARRAY(&emitter->arena, model->absolute_count, bool);
    if (emitter->arena.failed) return false;
    for (size_t b = 0; b < model->body_count; b++)
        emitter->body[b] = emit_name(emitter, model->bodies[b].name);
    for (size_t i = 0; i < n; i++) {
        emitter->coordinate[i] = emit_name(emitter, model->labels[i].name);
        emitter->rate[i] = emit_name(emitter, model->labels[i].rate_name);
    }
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        emitter->load[i] = emit_join(emitter, model->bodies[load->body].name, load->source->name);
    }
    find_used_places(emitter);
    for (size_t k = 0; k < model->absolute_count; k++)
        if (emitter->used[k]) emitter->place[k] = emit_name(emitter, place_name(emitter, k));
    for (size_t i = 0; i < model->plan.mode_count; i++)
        emitter->pair[i] =
            emit_name(emitter, emit_join(emitter, emitter->load[model->plan.modes[i].load], "pair"));
    name_slots(emitter);
    name_branches(emitter);
    return !emitter->arena.failed;
}

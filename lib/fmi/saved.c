/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fmi/instance.h"

struct saved_head {
    char magic[8];
    char token[package_token_size];
    unsigned phase, stopped;
    size_t count;
    uint64_t check; /* checksum of the rest */
};

struct saved {
    struct saved_head head;
    double numbers[];
};

static const char magic[8] = {'f', 'b', 'd', ' ', 'f', 'm', 'u', '1'};

/* The checksum of the header, with 0 as `check`, and of the numbers. */
static uint64_t check_of(const struct saved *saved)
{
    struct saved_head head = saved->head;
    head.check = 0;
    uint64_t check = package_hash(package_hash_start, &head, sizeof head);
    return package_hash(check, saved->numbers, saved->head.count * sizeof(double));
}

static bool is_one(const struct saved_head *head, size_t size)
{
    return memcmp(head->magic, magic, sizeof magic) == 0 && size >= sizeof *head &&
           (size - sizeof *head) / sizeof(double) == head->count &&
           (size - sizeof *head) % sizeof(double) == 0;
}

static const char of_importer[] = "in model exchange the importer holds the state";

enum instance_status saved_get(struct instance *instance, struct saved **saved)
{
    if (instance->continuous) return instance_fail(instance, "GetFMUState", of_importer);
    const struct plant *plant = instance->plant;
    size_t count = plant_save(plant, NULL);
    struct saved *new = calloc(1, sizeof *new + count * sizeof(double));
    if (!new) return instance_fail(instance, "GetFMUState", "out of memory");
    memcpy(new->head.magic, magic, sizeof magic);
    memcpy(new->head.token, plant->token, sizeof new->head.token);
    new->head.phase = (unsigned)instance->phase;
    new->head.stopped = instance->stopped;
    new->head.count = count;
    plant_save(plant, new->numbers);
    new->head.check = check_of(new);
    free(*saved);
    *saved = new;
    return instance_ok;
}

static bool is_phase(unsigned phase)
{
    return phase == phase_instantiated || phase == phase_initialization || phase == phase_step ||
           phase == phase_event || phase == phase_terminated;
}

enum instance_status saved_set(struct instance *instance, const struct saved *saved)
{
    const char *function = "SetFMUState";
    struct plant *plant = instance->plant;
    if (instance->continuous) return instance_fail(instance, function, of_importer);
    if (!saved || memcmp(saved->head.magic, magic, sizeof magic) != 0)
        return instance_fail(instance, function, "that is no saved state");
    if (memcmp(saved->head.token, plant->token, sizeof saved->head.token) != 0)
        return instance_fail(instance, function, "the state is of another FMU");
    if (!is_phase(saved->head.phase) || !plant_restore(plant, saved->numbers, saved->head.count))
        return instance_fail(instance, function, "the state is not complete, or memory is out");
    instance->phase = (enum phase)saved->head.phase;
    if (!instance->event_mode && instance->phase == phase_event) instance->phase = phase_step;
    instance->stopped = saved->head.stopped != 0;
    return instance_ok;
}

size_t saved_size(const struct saved *saved)
{
    return sizeof saved->head + saved->head.count * sizeof(double);
}

const unsigned char *saved_bytes(const struct saved *saved)
{
    return (const unsigned char *)saved;
}

struct saved *saved_from_bytes(const unsigned char *bytes, size_t size)
{
    struct saved_head head;
    if (!bytes || size < sizeof head) return NULL;
    memcpy(&head, bytes, sizeof head);
    struct saved *saved = is_one(&head, size) ? malloc(size) : NULL;
    if (!saved) return NULL;
    memcpy(saved, bytes, size);
    if (saved->head.check == check_of(saved)) return saved;
    free(saved);
    return NULL;
}

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Instance: a plant with the state machine of the standard, common to all versions. Functions return a status
 * of the standard, whose first five have the same numbers in both versions: 0 ok, 1 warning, 2 discard, 3
 * error, 4 fatal.
 *
 * A call that is not allowed in the present phase returns an error with a message, and ends the simulation,
 * as the standard requires for every error; restoring a saved state, or a reset, makes the instance usable
 * again.
 */
#ifndef FBD_FMI_INSTANCE_H
#define FBD_FMI_INSTANCE_H

#include "fmi/continuous.h"
#include "fmi/plant.h"

enum phase {
    phase_instantiated = 1,
    phase_initialization = 2,
    phase_step = 4,
    phase_event = 8,
    phase_terminated = 16,
    phase_continuous = 32, /* of model exchange, which has no phase_step */
    phase_running = phase_step | phase_event | phase_continuous,
    phase_begun = phase_initialization | phase_running | phase_terminated,
    phase_any = phase_instantiated | phase_begun,
};

enum instance_status { instance_ok, instance_warning, instance_discard, instance_error };

enum log_category { log_error, log_warning, log_events, log_categories };
extern const char *const log_category_names[log_categories];

struct instance;
typedef void instance_log(const struct instance *instance, enum instance_status status, const char *category,
                          const char *message);

struct instance {
    struct plant *plant;
    struct continuous *continuous; /* of model exchange; NULL in co-simulation */
    enum phase phase;
    bool logs[log_categories];
    bool event_mode, early_return; /* capabilities of the importer */
    bool stopped;                  /* an event of the file has ended the run */
    instance_log *log;
    char *name;
    void *environment;
    void (*callback)(void); /* function pointer of the standard's version */
};

/* Open the files in `resources`, if `token` is theirs. Returns false with messages; the instance has no plant
 * then. */
bool instance_open(struct instance *instance, const char *name, const char *resources, const char *token);

/* The same for model exchange. */
bool instance_open_exchange(struct instance *instance, const char *name, const char *resources,
                            const char *token);
void instance_close(struct instance *instance);

void instance_say(const struct instance *instance, enum instance_status status, enum log_category category,
                  const char *format, ...) __attribute__((format(printf, 4, 5)));

/* Report an error in `function`, and end the simulation. */
enum instance_status instance_fail(struct instance *instance, const char *function, const char *what);

/* Check that `function` may be called in the present phase; if not, report an error. `instance` may be NULL. */
bool instance_allows(struct instance *instance, unsigned phases, const char *function);

enum instance_status instance_set_logging(struct instance *instance, bool on, size_t count,
                                          const char *const categories[]);

enum instance_status instance_initialize(struct instance *instance, double start, double stop,
                                         double tolerance);
enum instance_status instance_begin(struct instance *instance);
enum instance_status instance_reset(struct instance *instance);

/* Get, or set, values of variables by reference. */
enum instance_status instance_get(struct instance *instance, const char *function, const unsigned *references,
                                  size_t count, double *values);
enum instance_status instance_set(struct instance *instance, const char *function, const unsigned *references,
                                  size_t count, const double *values);

/* One communication step from t to t + h. */
struct instance_step {
    bool event, terminate, early;
    double reached;
};
enum instance_status instance_step(struct instance *instance, double t, double h, struct instance_step *step);

/* ---- model exchange (exchange.c): calls of both versions, allowed in `phases` */

enum instance_status instance_change(struct instance *instance, enum phase from, enum phase to,
                                     const char *function);
enum instance_status instance_set_time(struct instance *instance, const char *function, double t);
enum instance_status instance_set_states(struct instance *instance, const char *function,
                                         const double *states, size_t count);
enum instance_status instance_get_states(struct instance *instance, const char *function, double *states,
                                         size_t count);
enum instance_status instance_get_derivatives(struct instance *instance, const char *function,
                                              double *derivatives, size_t count);
enum instance_status instance_get_indicators(struct instance *instance, const char *function,
                                             double *indicators, size_t count);
enum instance_status instance_get_nominals(struct instance *instance, const char *function, double *nominals,
                                           size_t count);
enum instance_status instance_get_counts(struct instance *instance, const char *function, size_t *states,
                                         size_t *indicators);
enum instance_status instance_complete(struct instance *instance, const char *function, bool *event);
enum instance_status instance_update(struct instance *instance, const char *function,
                                     struct continuous_event *event);

/* ---- saved states (saved.c): bytes with a header that identifies them */

struct saved;
enum instance_status saved_get(struct instance *instance, struct saved **saved);
enum instance_status saved_set(struct instance *instance, const struct saved *saved);
size_t saved_size(const struct saved *saved);
const unsigned char *saved_bytes(const struct saved *saved);
/* NULL if the bytes are not a saved state, or memory is out. */
struct saved *saved_from_bytes(const unsigned char *bytes, size_t size);

#endif

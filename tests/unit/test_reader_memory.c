/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A reader whose memory runs out says so, gives no scene and leaks nothing.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fail_alloc.h"
#include "scene/scene.h"

#include <string.h>

static const char right_file[] =
    "fbd: 1\n"
    "title: everything at once\n"
    "parameters: {w: 2*phi, phi: 30 deg, unused: 3}\n"
    "ground: {points: {A: [0, 1]}, lines: {ramp: {along: phi, through: A}}}\n"
    "bodies:\n"
    "  block:\n"
    "    mass: 2 kg\n"
    "    motion: {slide: {line: ramp}}\n"
    "    forces: [gravity, normal, {friction: 0.3}, {applied: \"sin(w)*1[N]\"}]\n"
    "    hand: >\n"
    "      m*v_dot =\n"
    "      -m*g*sin(phi) - mu*N\n"
    "  pendulum:\n"
    "    parts:\n"
    "      rod: &rod {shape: rod, mass: 1, from: [0, 0], to: [0, -1]}\n"
    "      twin: *rod\n"
    "    motion: {pivot: {point: rod.left}}\n"
    "    moments: [{damper: 1}, {applied: {name: drive, value: 2}}]\n"
    "    hand:\n"
    "      - equation: $I_O\\ddot\\theta = -mgL\\sin\\theta - 1[N*m*s] \\dot\\theta$\n"
    "        when: ω > 0 and |θ| < 20°\n"
    "      - L = 2mL/m\n"
    "simulate: {until: 2 s, events: [block.x = 1]}\n";

static const char wrong_file[] =
    "fbd: 1\n"
    "bodies:\n"
    "  ball: {mass: 2 kg, motion: slide, hand: [ẍ = mg/m sin x, mẍ = \\pm z, 'mẍ = ab', 'ma = |x']}\n"
    "  block: {mas: 2 kg, motion: {slide: {along: fi}}, forces: [gravty]}\n"
    "  block: {mass: 2 N, motion: slide}\n"
    "cupplings: []\n";

static const char broken_file[] = "fbd: 1\nbodies:\n  block: {mass: 2 kg, motion: [slide}\n";

static bool tells_of_memory(fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error note = fbd_errors_get(errors, i);
        if (strcmp(note.id, "out-of-memory") == 0) return true;
    }
    return false;
}

/* With allocation `n` failing, and all later ones when `for_good`; false when the file needs fewer. */
static bool read_without(const char *text, size_t n, bool for_good)
{
    fbd_errors *errors = fbd_errors_new();
    assert_non_null(errors);
    if (for_good)
        fail_alloc_from(n);
    else
        fail_alloc_at(n);
    struct scene *scene = scene_read(text, strlen(text), "model.yaml", NULL, 0, NULL, errors);
    bool failed = fail_alloc_end();
    if (failed) {
        assert_null(scene);
        assert_true(tells_of_memory(errors));
        assert_true(fbd_errors_failed_count(errors) > 0);
    }
    scene_free(scene);
    fbd_errors_free(errors);
    return failed;
}

static void each_allocation_may_fail(void **state)
{
    (void)state;
    static const char *const files[] = {right_file, wrong_file, broken_file};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        for (int for_good = 0; for_good < 2; for_good++) {
            size_t n = 0;
            while (read_without(files[i], n, for_good)) n++;
            assert_true(n > 10); /* the memory of the reader does pass through the counter */
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

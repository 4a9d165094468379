/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Equations as people write them: what they are read as, and which are refused.
 */
#include "notation_scope.h"

#include <stdio.h>
#include <stdlib.h>

#include "fbd_grade.h"
#include "gallery.h"
#include "model/model.h"
#include "scenes.h"

struct reading {
    const char *written, *read;
};

static struct notation read_text(struct arena *arena, struct notation_names *names, const char *text,
                                 bool equation, fbd_errors *errors)
{
    const struct scope scope = notation_scope(names);
    struct notation notation = {NULL, false, NULL};
    bool fine = notation_read(arena, text, (struct pos){1, 1}, &scope, equation, errors, &notation);
    if (!fine) notation.text = NULL;
    return notation;
}

static int compare(const struct reading *rows, size_t count, bool equation)
{
    int failed = 0;
    for (size_t i = 0; i < count; i++) {
        struct arena arena = {0};
        fbd_errors *errors = fbd_errors_new();
        struct notation notation = read_text(&arena, derivation(), rows[i].written, equation, errors);
        const char *read = notation.text ? notation.text : "(refused)";
        if (strcmp(read, rows[i].read) != 0 || (notation.changed == (strcmp(read, rows[i].written) == 0))) {
            print_error("`%s` was read as `%s`, not `%s`\n", rows[i].written, read, rows[i].read);
            fbd_errors_print(errors, stdout);
            failed++;
        }
        arena_free(&arena);
        fbd_errors_free(errors);
    }
    return failed;
}

#define COMPARE(rows, equation)                                                                              \
    assert_int_equal(compare((rows), sizeof(rows) / sizeof *(rows), (equation)), 0)

/* ---- the ways to write equations of the gallery */

static void a_pendulum_in_many_ways(void **unused)
{
    (void)unused;
    static const struct reading rows[] = {
        {"I_O θ'' = -m g L sin θ", "I_O*theta_ddot = -m*g*L*sin(theta)"},
        {"I_O θ'' = -mgL sin(θ)", "I_O*theta_ddot = -m*g*L*sin(theta)"},
        {"I_O·θ̈ = −m·g·L·sin θ", "I_O*theta_ddot = -m*g*L*sin(theta)"},
        {"I_O*theta'' == -m*g*L*sin(theta)", "I_O*theta_ddot = -m*g*L*sin(theta)"},
        {"I_O d^2θ/dt^2 = -mgL sinθ", "I_O*theta_ddot = -m*g*L*sin(theta)"},
        {"I_O d²θ/dt² + mgL sin θ = 0", "I_O*theta_ddot + m*g*L*sin(theta) = 0"},
        {"I_O dω/dt = -m g L sin(theta)", "I_O*omega_dot = -m*g*L*sin(theta)"},
        {"I_O ω' = -mgL sin(theta)", "I_O*omega_dot = -m*g*L*sin(theta)"},
        {"I_O α = -mgL sin θ", "I_O*alpha = -m*g*L*sin(theta)"},
        {"$I_O\\ddot{\\theta} = -mgL\\sin\\theta$", "I_O*theta_ddot = -m*g*L*sin(theta)"},
        {"I_O\\,\\ddot\\theta + m\\,g\\,L\\,\\sin\\theta = 0", "I_O*theta_ddot + m*g*L*sin(theta) = 0"},
        {"I_{O}\\frac{d^2\\theta}{dt^2} = -mgL\\sin\\left(\\theta\\right)",
         "I_O*theta_ddot = -m*g*L*sin(theta)"},
        {"I_{\\mathrm{O}}\\dot{\\omega} = -m g L \\sin{\\theta}", "I_O*omega_dot = -m*g*L*sin(theta)"},
        {"I_O \\frac{\\mathrm{d}\\omega}{\\mathrm{d}t} &= -m g L\\,\\sin\\theta",
         "I_O*omega_dot = -m*g*L*sin(theta)"},
        {"\\ddot\\theta = -\\frac{m g L}{I_O}\\sin\\theta", "theta_ddot = -((m*g*L)/I_O)*sin(theta)"},
        {"\\alpha = -\\dfrac{g}{L}\\sin\\vartheta", "alpha = -(g/L)*sin(theta)"},
        {"\\[ I_O \\alpha = -m g L \\sin \\theta \\]", "I_O*alpha = -m*g*L*sin(theta)"},
        {"θ'' = -(g/L) sin θ", "theta_ddot = -(g/L)*sin(theta)"},
        {"m L² θ'' = -m g L sin θ", "m*L^2*theta_ddot = -m*g*L*sin(theta)"},
        {"mL^2 θ'' = -mgL sin θ", "m*L^2*theta_ddot = -m*g*L*sin(theta)"},
        {"mL²θ'' + cL²θ' + mgL sin θ = 0", "m*L^2*theta_ddot + c*L^2*theta_dot + m*g*L*sin(theta) = 0"},
        {"mL^{2}\\ddot\\theta = -mgL\\sin\\theta", "m*L^2*theta_ddot = -m*g*L*sin(theta)"},
        {"½ m L² θ'' = -½ m g L sin θ", "0.5*m*L^2*theta_ddot = -0.5*m*g*L*sin(theta)"},
        {"\\tfrac{1}{3} m L^2\\alpha = -\\frac12 m g L\\sin\\theta",
         "(1/3)*m*L^2*alpha = -(1/2)*m*g*L*sin(theta)"},
        {"1/3 m L^2 α = -1/2 m g L sin θ", "1/3*m*L^2*alpha = -1/2*m*g*L*sin(theta)"},
        {"I_O theta_ddot = -m g L sin theta", "I_O*theta_ddot = -m*g*L*sin(theta)"},
    };
    COMPARE(rows, true);
}

static void a_block_in_many_ways(void **unused)
{
    (void)unused;
    static const struct reading rows[] = {
        {"m a = F − mg sin φ − μN", "m*a = F - m*g*sin(phi) - mu*N"},
        {"ma = F - mg sin φ - μ_k N", "m*a = F - m*g*sin(phi) - mu_k*N"},
        {"ma = F - mg sin φ - μk N", "m*a = F - m*g*sin(phi) - mu_k*N"},
        {"ma = F - mg sin φ - μₖN", "m*a = F - m*g*sin(phi) - mu_k*N"},
        {"mẍ = F − m·g·sin φ − μ·F_N", "m*x_ddot = F - m*g*sin(phi) - mu*N"},
        {"m x'' = F - m g sin(phi) - mu_k N sign(x')", "m*x_ddot = F - m*g*sin(phi) - mu_k*N*sign(x_dot)"},
        {"m\\ddot{x} = F - mg\\sin\\varphi - \\mu_k F_N\\operatorname{sgn}(\\dot{x})",
         "m*x_ddot = F - m*g*sin(phi) - mu_k*N*sign(x_dot)"},
        {"m\\ddot x + c\\dot x + kx = F", "m*x_ddot + c*x_dot + k*x = F"},
        {"mẍ + cẋ + kx = F", "m*x_ddot + c*x_dot + k*x = F"},
        {"m d²x/dt² + c dx/dt + kx = F", "m*x_ddot + c*x_dot + k*x = F"},
        {"m d^2x/dt^2 + c dx/dt + k x == F", "m*x_ddot + c*x_dot + k*x = F"},
        {"mx'' + cx' + kx = F", "m*x_ddot + c*x_dot + k*x = F"},
        {"m dv/dt = -k(x - x0) - c v", "m*v_dot = -k*(x - x0) - c*v"},
        {"m\\frac{dv}{dt} = -k\\left(x - x_0\\right) - cv", "m*v_dot = -k*(x - x0) - c*v"},
        {"m*v_dot = m*g - lambda*v**2", "m*v_dot = m*g - lambda*v^2"},
        {"m v̇ = mg - λv²", "m*v_dot = m*g - lambda*v^2"},
        {"m\\dot v = mg - \\lambda v^2", "m*v_dot = m*g - lambda*v^2"},
        {"m\\dot v = mg - \\lambda |v| v", "m*v_dot = m*g - lambda*abs(v)*v"},
        {"m\\dot v = mg - \\lambda\\left|v\\right|v", "m*v_dot = m*g - lambda*abs(v)*v"},
        {"(m_1 + m_2) a = m_1 g - m_2 g", "(m_1 + m2)*a = m_1*g - m2*g"},
        {"(m₁ + m₂)a = m₁g − m₂g", "(m_1 + m2)*a = m_1*g - m2*g"},
        {"(m1+m2)a = (m1-m2)g", "(m_1+m2)*a = (m_1-m2)*g"},
        {"\\left(m_{1}+m_{2}\\right)a = m_1g - m_2g", "(m_1+m2)*a = m_1*g - m2*g"},
        {"F_N = mg cos φ", "N = m*g*cos(phi)"},
        {"F_{\\mathrm N} = m g\\cos\\phi", "N = m*g*cos(phi)"},
        {"N = 2m g cos 2φ", "N = 2*m*g*cos(2*phi)"},
        {"N = 2mg cos φ", "N = 2*m*g*cos(phi)"},
        {"N = 2 m g", "N = 2*m*g"},
        {"N = 2m*g", "N = 2*m*g"},
        {"N = m g cos 30°", "N = m*g*cos(30[deg])"},
        {"N = m g\\cos 30^{\\circ}", "N = m*g*cos(30[deg])"},
        {"N = m\\cdot 9.81\\,\\mathrm{m/s^2}", "N = m*9.81[m/s^2]"},
        {"m a_x = F", "m*ax = F"},
        {"m\\dot{v}_y = F", "m*vy_dot = F"},
        {"m\\ddot{x}_A = kx_A", "m*A.x_ddot = k*A.x"},
        {"m g sin θ_{rod2} = F", "m*g*sin(rod2.theta) = F"},
        {"v^2 = v_0^2 + 2gL", "v^2 = v_0^2 + 2*g*L"},
        {"v = \\sqrt{2gL}", "v = sqrt(2*g*L)"},
        {"F = |v|v + k|x||v|", "F = abs(v)*v + k*abs(x)*abs(v)"},
        {"F = \\left|v\\right|v\\lvert x\\rvert + k\\sin\\left|x\\right|",
         "F = abs(v)*v*abs(x) + k*sin(abs(x))"},
        {"v = √(2gL)", "v = sqrt(2*g*L)"},
        {"sin²θ + cos²θ = 1", "sin(theta)^2 + cos(theta)^2 = 1"},
        {"\\sin^2\\theta + \\cos^{2}\\theta = 1", "sin(theta)^2 + cos(theta)^2 = 1"},
        {"v = v_0 e^{-ct/m}", "v = v_0*exp(-c*t/m)"},
        {"x = x0 e^{-c t/m} cos θ", "x = x0*exp(-c*t/m)*cos(theta)"},
        {"a = \\frac{F - \\frac{c v}{2}}{m}", "a = ((F - ((c*v)/2))/m)"},
    };
    COMPARE(rows, true);
}

/* ---- what is an expression already */

static void headings_of_sums_are_left_out(void **unused)
{
    (void)unused;
    static const struct reading rows[] = {
        {"ΣF_x = F - mu*N = m*a", "F - mu*N = m*a"},
        {"ΣF_x = F - μN = m a", "F - mu*N = m*a"},
        {"\\sum F_{x} = F - \\mu N = m a", "F - mu*N = m*a"},
        {"→+ ∑F_x = F - mu*N = m*a", "F - mu*N = m*a"},
        {"(+↑) ΣF_y: N - m*g = 0", "N - m*g = 0"},
        {"$\\Sigma F_y = N - mg = 0$", "N - m*g = 0"},
        {"sum F_y = N - m*g = 0", "N - m*g = 0"},
        {"↺ ΣM_G: N*L = I_G*alpha", "N*L = I_G*alpha"},
    };
    COMPARE(rows, true);
}

/* A sum that is not written out says nothing that could be checked. */
static void sums_alone_are_refused(void **unused)
{
    (void)unused;
    static const char *const texts[] = {"ΣF_x = m*a", "\\sum F_x = m a", "ΣF_x + ΣF_y = 0",
                                        "ΣF_x = F - mu*N"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct arena arena = {0};
        fbd_errors *errors = fbd_errors_new();
        const struct notation notation = read_text(&arena, derivation(), texts[i], true, errors);
        const bool written = notation.text && !strstr(notation.text, "Σ");
        if (written) print_error("`%s` was read as `%s`\n", texts[i], notation.text);
        assert_false(written);
        arena_free(&arena);
        fbd_errors_free(errors);
    }
}

static void expressions_stay_as_they_are(void **unused)
{
    (void)unused;
    static const char *const texts[] = {
        "m*v_dot = F - m*g*sin(phi) - mu*N",
        "  m * v_dot=F-m *g* sin( phi )",
        "0 = F - m*v_dot - (m*g*sin(phi) + k*x) - mu*N*sign(v)",
        "m*a = 5 N",
        "N = 20 N",
        "x = 2 m",
        "v = -2.5 m/s",
        "m*a = 0.4[N*s/m]*(v - 2[m/s])",
        "m*a = 5 [N] + F",
        "x = x0*exp(-c*t/m)*cos(2*pi*t/3[s])",
        "alpha = -(m*g*L/I_O)*sin(theta)^2",
        "A.x_ddot = -2^-1*A.x/1[s^2]",
        "m*a = if(v > 0 and not (x < 0[m]), F, -F)",
        "a = max(g, a, 2*g)",
        "m*a = q*unknown_name + nothing(x)",
        "m*a = vx + ay",
        "m*a = F\n - c*v",
        "m*(a + g = 3",
        "m*a) = 3",
        "m*a = ",
        "",
        "m*a = F ☃",
        "m*a != F",
        "1.2.3",
        "x = table(x)",
    };
    struct reading rows[sizeof texts / sizeof *texts];
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) rows[i] = (struct reading){texts[i], texts[i]};
    COMPARE(rows, true);
    static const struct reading conditions[] = {
        {"v > 0", "v > 0"},
        {"v == 0", "v == 0"},
        {"x > 2[m] and not (v < 0 or theta >= 30[deg])", "x > 2[m] and not (v < 0 or theta >= 30[deg])"},
        {"ẋ > 0", "x_dot > 0"},
        {"\\dot x \\ge 0", "x_dot >= 0"},
        {"θ ≤ 30°", "theta <= 30[deg]"},
    };
    COMPARE(conditions, false);
}

/* All of the gallery, with the names of its scenes. */
static void check_model(struct checks *checks, const char *path)
{
    struct trial trial = trial_open(path, NULL);
    const struct scene *scene = trial.model->scene;
    for (size_t b = 0; b < scene->body_count; b++)
        for (size_t i = 0; i < scene->bodies[b].hand_count; i++) {
            const struct hand *hand = &scene->bodies[b].hands[i];
            check_that(checks, hand->written, strcmp(hand->written, hand->text) == 0);
        }
    trial_close(&trial);
}

static void derivations_of_the_gallery_stay_as_they_are(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    each_model(&checks, check_model);
    checks_end(&checks);
}

/* ---- what is refused */

struct refusal {
    const char *written;
    int column;
    const char *says; /* parts of hint or message, separated by | */
};

static bool says_all(const char *text, const char *phrases)
{
    for (const char *phrase = phrases; *phrase;) {
        char one[160];
        size_t length = strcspn(phrase, "|");
        snprintf(one, sizeof one, "%.*s", (int)length, phrase);
        if (!strstr(text, one)) return false;
        phrase += length + (phrase[length] == '|');
    }
    return true;
}

static void what_can_be_read_in_two_ways_is_refused(void **unused)
{
    (void)unused;
    static const struct refusal rows[] = {
        {"alpha = -g/L sin θ", 14, "`g/L*sin(theta)`|`g/(L*sin(theta))`"},
        {"a = F/m v", 9, "`F/m*v`|`F/(m*v)`"},
        {"a = 1/2m", 8, "`1/2*m`|`1/(2*m)`"},
        {"a = 1/2(x + x0)", 8, "`1/2*(x + x0)`|`1/(2*(x + x0))`"},
        {"x = x0 sin ω t", 14, "`sin(omega)*t`|`sin(omega*t)`"},
        {"x = x0 cos ωt", 13, "`cos(omega)*t`|`cos(omega*t)`"},
        {"x = x0 sin ω*t", 13, "`sin(omega)*t`|`sin(omega*t)`"},
        {"a = g sin θ/2", 12, "`sin(theta)/2`|`sin(theta/2)`"},
        {"a = g sin θ^2", 12, "`sin(theta)^2`|`sin(theta^2)`"},
        {"a = g sin θ²", 12, "`sin(theta)^2`|`sin(theta^2)`"},
        {"a = g sin θ (x + x0)", 13, "`sin(theta)*(x + x0)`|`sin(theta*(x + x0))`"},
        {"a = \\sin\\theta\\dot\\theta", 15, "`sin(theta)*theta_dot`|`sin(theta*theta_dot)`"},
        {"θ = sin⁻¹(x/L)", 5, "asin|1/sin"},
        {"θ = \\sin^{-1}(x/L)", 5, "asin|1/sin"},
        {"v = x(t)", 6, "`x`|`x*t`"},
        {"m*a = F - 5 N", 13, "`5*N`|`5[N]`"},
        {"F = N^2x", 8, "`N^2*x`|`N^(2*x)`"},
        {"\\vec{F} = m a", 1, "\\vec|component"},
        {"F = \\pm m a", 5, "each sign"},
        {"F = \\frac{m}", 13, "group in braces"},
        {"F = (m a}", 9, "`)` is missing before `}`"},
        {"F = {m a)", 9, "`}` is missing before `)`"},
        {"F = \\sqrt[5]{m}", 10, "no name"},
        {"F = x'''", 5, "derivative"},
        {"F = |v", 7, "second `|`"},
        {"F = m sin", 10, "argument"},
        {"F = k|x|v|v|", 10, "abs(...)"},
    };
    int failed = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct arena arena = {0};
        fbd_errors *errors = fbd_errors_new();
        struct notation notation = read_text(&arena, derivation(), rows[i].written, true, errors);
        const fbd_error note = fbd_errors_get(errors, 0);
        char all[400] = "";
        if (note.id) snprintf(all, sizeof all, "%s %s", note.message, note.hint ? note.hint : "");
        if (notation.text || !note.id || note.column != rows[i].column || !says_all(all, rows[i].says)) {
            print_error("`%s` should be refused at %d with %s, not as `%s`: %d: %s\n", rows[i].written,
                        rows[i].column, rows[i].says, notation.text ? notation.text : "", note.column, all);
            failed++;
        }
        arena_free(&arena);
        fbd_errors_free(errors);
    }
    assert_int_equal(failed, 0);
}

/* `ab` and `abc` with names that can be put together in two ways. */
static void letters_that_are_two_products_are_refused(void **unused)
{
    (void)unused;
    static const struct notation_name list[] = {{"y", DIM_INIT(0, 0, 0)},   {"a", DIM_INIT(0, 0, 0)},
                                                {"ab", DIM_INIT(0, 0, 0)},  {"bc", DIM_INIT(0, 0, 0)},
                                                {"c", DIM_INIT(0, 0, 0)},   {"N1", DIM_INIT(1, 1, -2)},
                                                {"N_1", DIM_INIT(1, 1, -2)}};
    struct notation_names names = NAMES(list);
    static const struct reading rows[] = {{"y = abc", "a*bc"},
                                          {"y = abc", "ab*c"},
                                          {"y = F_N1", "N1"},
                                          {"y = F_N1", "N_1"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct arena arena = {0};
        fbd_errors *errors = fbd_errors_new();
        struct notation notation = read_text(&arena, &names, rows[i].written, true, errors);
        assert_null(notation.text);
        assert_string_equal(fbd_errors_get(errors, 0).id, "ambiguous-notation");
        assert_non_null(strstr(fbd_errors_get(errors, 0).hint, rows[i].read));
        arena_free(&arena);
        fbd_errors_free(errors);
    }
}

/* ---- in scenes */

static const char block[] = "fbd: 1\n"
                            "parameters: {phi: 30 deg, k: 3 N/m}\n"
                            "bodies:\n"
                            "  block:\n"
                            "    mass: 2 kg\n"
                            "    motion: {slide: {along: phi}}\n"
                            "    initial: {v: 3 m/s}\n"
                            "    forces: [gravity, normal, {friction: 0.5}, {spring: {stiffness: k}}]\n"
                            "    hand:\n"
                            "      - equation: %s\n"
                            "        when: ẋ > 0\n"
                            "simulate: {until: 2 s}\n";

static void a_line_is_shown_as_written_and_as_read(void **unused)
{
    (void)unused;
    static const struct reading rows[] = {
        {"m\\ddot{x} = -mg\\sin\\varphi - kx - \\mu_k F_N", "m*x_ddot = -m*g*sin(phi) - k*x - mu_k*N"},
        {"mẍ = −mg sin φ − kx − μN", "m*x_ddot = -m*g*sin(phi) - k*x - mu*N"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[1600], shown[400];
        size_t differing = 1;
        snprintf(text, sizeof text, block, rows[i].written);
        fbd_model *model = model_from(text);
        char *verdict = fbd_check_hand(model, 1, &differing);
        assert_non_null(verdict);
        snprintf(shown, sizeof shown, "block: %s\n  read as: %s\n  agrees", rows[i].written, rows[i].read);
        if (!strstr(verdict, shown)) fail_msg("%s", verdict);
        assert_int_equal(differing, 0);
        free(verdict);
        fbd_model_free(model);
    }
}

/* What is wrong in a text that was translated is noted where that stands in the file. */
static void errors_stand_where_they_were_written(void **unused)
{
    (void)unused;
    static const struct {
        const char *line, *id;
        int row, column;
    } rows[] = {
        {"mẍ = −mg sin φ − kx − μz", "unknown-name", 10, 41},
        {"m\\ddot{x} = \\frac{m g}{k} + kx", "wrong-dimension", 10, 45},
        {"ma = F/m g", "ambiguous-notation", 10, 28},
        {">-\n          mẍ =\n          F/k q", "ambiguous-notation", 12, 15},
        {">-\n          mẍ =\n          kx + q", "unknown-name", 12, 16},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[1600];
        snprintf(text, sizeof text, block, rows[i].line);
        fbd_errors *errors = fbd_errors_new();
        assert_null(fbd_model_parse(text, strlen(text), NULL, NULL, 0, errors));
        const fbd_error note = fbd_errors_get(errors, 0);
        if (strcmp(note.id, rows[i].id) != 0 || note.line != rows[i].row || note.column != rows[i].column)
            fail_msg("%s: %s at %d:%d, not %s at %d:%d", rows[i].line, note.id, note.line, note.column,
                     rows[i].id, rows[i].row, rows[i].column);
        fbd_errors_free(errors);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pendulum_in_many_ways),
        cmocka_unit_test(a_block_in_many_ways),
        cmocka_unit_test(headings_of_sums_are_left_out),
        cmocka_unit_test(sums_alone_are_refused),
        cmocka_unit_test(expressions_stay_as_they_are),
        cmocka_unit_test(derivations_of_the_gallery_stay_as_they_are),
        cmocka_unit_test(what_can_be_read_in_two_ways_is_refused),
        cmocka_unit_test(letters_that_are_two_products_are_refused),
        cmocka_unit_test(a_line_is_shown_as_written_and_as_read),
        cmocka_unit_test(errors_stand_where_they_were_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

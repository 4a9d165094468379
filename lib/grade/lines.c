/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Evaluate the derivations of an answer, each line on the key's own mechanics.
 *
 * A line of the key is matched by true lines about the same unknown: an acceleration, or the normal force. A
 * line that is true for all values of the unknowns, as `m*a = m*a`, matches none.
 */
#include <string.h>

#include "base/text.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/lines.h"

/* ---- one line */

/* Set the relevant senses of slip: the sampled ones of the motion of the sheet, or all sampled ones if there
 * is none. */
static void count_slips(struct line *line, unsigned of_motion)
{
    unsigned seen = 0;
    for (unsigned slip = 0; slip < slips; slip++) seen |= line->is.states[slip] > 0 ? 1U << slip : 0;
    line->counts = (seen & of_motion) != 0 ? seen & of_motion : seen;
}

/* At random states, with parameters that differ by up to `spread`. */
static bool sample_line(struct lines *lines, const struct node *root, int body, double spread,
                        double tolerance, struct line *line)
{
    if (!line_compare(lines, root, body, spread, tolerance, line)) return false;
    count_slips(line, lines->slips[body]);
    return true;
}

static size_t states_of(const struct line *line)
{
    return line->is.states[0] + line->is.states[1] + line->is.states[2];
}

/* Set line->dynamic if the line fails under other forces, or if these leave no admissible state. Returns
 * false when memory is out. */
static bool look_at_pushed(struct lines *lines, int body, double tolerance, struct line *line)
{
    bool seen_any = false;
    line->dynamic = false;
    for (int k = 0; k < lines_pushes && !line->dynamic; k++) {
        struct line other = {.counts = 0};
        struct pushed *pushed = &lines->pushed[k];
        lines_push(lines, k);
        if (!pushed->model) {
            line->dynamic = true;
            return !lines->grade->arena.failed;
        }
        if (!sample_line(lines, pushed->root, body, 0, tolerance, &other)) return false;
        size_t seen = states_of(&other);
        seen_any = seen_any || seen > 0;
        line->dynamic = 2 * (other.is.agree[0] + other.is.agree[1] + other.is.agree[2]) < seen;
    }
    if (!seen_any) line->dynamic = line->is.names != 0;
    return true;
}

/* Judge for the values of the sheet: to rounding, or to three digits if it has numbers that may be rounded. */
static bool look_at_values(struct lines *lines, int body, const char *text, double *tolerance,
                           struct line *line)
{
    const struct line general = *line;
    bool rounded = line_has_numbers(text), own = line_has_own_names(lines, text, &rounded);
    if (!rounded && !own) return true;
    if (!sample_line(lines, lines->root, body, 0, *tolerance, line)) return false;
    if (!line_agrees(line) && rounded) {
        *tolerance = 0.3 * fbd_model_grading(lines->model).tolerance;
        if (!sample_line(lines, lines->root, body, 0, *tolerance, line)) return false;
    }
    line->in_numbers = line_agrees(line);
    if (!line->in_numbers) *line = general;
    return true;
}

/* Store an equation with forces as a linear form of its unknowns at the start. */
static bool take_form(struct lines *lines, int body, struct line *line)
{
    if (!(line->is.names & (unsigned)FBD_NAMES_FORCES)) return true;
    fbd_state *state = grade_start(lines->alone);
    const fbd_residual residual = fbd_state_residual(state, (size_t)body, 0);
    memcpy(line->form, residual.slopes, sizeof line->form);
    fbd_state_free(state);
    return state != NULL;
}

/* Judge a line of energy or momentum: it is matched by one that is equivalent in the velocities. */
static bool look_at_run(struct lines *lines, int body, struct line *line)
{
    line->dynamic = true;
    line->counts = 1U << 1;
    return line_compare(lines, lines->root, body, 0, 1, line);
}

/* Judge a line for all values of the parameters, or for those of the sheet. */
static bool look_at_line(struct lines *lines, int body, int index, struct line *line)
{
    const char *name = fbd_model_body_name(lines->model, (size_t)body);
    const fbd_derivation hand = fbd_model_derivation(lines->model, (size_t)body, (size_t)index);
    double tolerance = 1e-9;
    *line = (struct line){.counts = 0};
    lines->index = index;
    if (hand.of_run) return look_at_run(lines, body, line);
    if (!sample_line(lines, lines->root, body, 0.3, tolerance, line)) return false;
    if (!line->is.compared) return true;
    if (!take_form(lines, body, line)) return false;
    if (!line_agrees(line) && !look_at_values(lines, body, hand.text, &tolerance, line)) return false;
    const char *text = lines->answer ? line_as_read(lines, name, &hand) : hand.text;
    bool in_general = line_agrees(line) && !line->in_numbers;
    if (line->is.names == 0 && !in_general && !line_is_of_rest(lines, body, text, &line->rest)) return false;
    if (line_agrees(line)) return look_at_pushed(lines, body, tolerance, line);
    struct line again;
    return sample_line(lines, lines->root, body, 0.3, 1e-9, &again); /* for the text of the finding */
}

/* ---- findings about it */

/* Kinematics is required if the key has it. */
static bool is_asked(const struct line *line, const struct line *keys, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!keys[k].dynamic && (keys[k].is.unknowns & line->is.unknowns)) return true;
    return false;
}

static void note_student_line(struct lines *lines, int body, int index, const struct line *line, bool asked)
{
    struct fbd_grade *grade = lines->grade;
    const char *name = fbd_model_body_name(lines->model, (size_t)body);
    const fbd_derivation hand = fbd_model_derivation(lines->model, (size_t)body, (size_t)index);
    if (line->rest) return;
    bool good = line_agrees(line), empty = good && !asked && (line->is.names == 0 || !line->dynamic);
    const size_t *states = line->is.states, seen = states_of(line);
    if (good && !empty && !line->in_numbers) return;
    fbd_finding *finding =
        finding_add(grade, good && !empty ? FBD_FINDING_RIGHT : FBD_FINDING_DERIVATION, name,
                    line_as_written(lines, name, &hand), (struct pos){hand.line, hand.column});
    line_say(lines, finding, &hand,
             empty       ? "it is true for any forces and does not check them"
             : good      ? "it is right for these numbers"
             : seen == 0 ? "no admissible state was found for its condition"
                         : "it does not agree with the mechanics of the sheet");
    if (good || seen == 0) return;
    char *mistake = fbd_checker_mistake(lines->checker, states[1] > 0 ? 0 : states[2] > 0 ? 1 : -1);
    if (!mistake) grade->arena.failed = true;
    finding_tell(grade, finding, mistake ? mistake : "");
    fbd_free(mistake);
}

static const char *unknown_of(const struct lines *lines, int body, const struct line *key)
{
    const fbd_body source = fbd_model_body(lines->model, (size_t)body);
    const unsigned asked = key->is.names;
    for (size_t i = 0, k = 0; k < source.coordinate_count; i++) {
        const fbd_variable variable = fbd_model_variable(lines->model, i);
        if (variable.kind != FBD_VARIABLE_ACCELERATION || variable.index != source.coordinate + k) continue;
        if (asked & (1U << k++)) return variable.name;
    }
    return (asked & (unsigned)FBD_NAMES_NORMAL) && !(asked & (unsigned)FBD_NAMES_FORCES) ? "N" : NULL;
}

/* Of a line with a condition: the sense of slip for which it was evaluated. */
static const char *sense_of(const struct line *key)
{
    const size_t *states = key->is.states;
    if ((states[0] > 0) == (states[2] > 0)) return "";
    return states[0] > 0 ? " for slip backward" : " for slip forward";
}

static void say_of_key_line(struct lines *lines, int body, const struct line *key)
{
    struct fbd_grade *grade = lines->grade;
    const char *name = unknown_of(lines, body, key);
    struct text text = {0};
    fbd_finding *finding = key->finding;
    finding->kind = key->share > 0 ? FBD_FINDING_RIGHT : FBD_FINDING_MISSING;
    finding->points = key->share * finding->most;
    text_printf(&text, "%s%s%s", key->share > 0 ? "the equation" : "a right equation", name ? " for " : "",
                name ? name : "");
    if (key->share == 0) text_add(&text, sense_of(key));
    text_add(&text, key->share == 1  ? " is right"
                    : key->share > 0 ? " is right for one direction of slip only"
                                     : " is missing");
    finding_say(grade, finding, text.data ? text.data : "");
    if (text.failed) grade->arena.failed = true;
    text_free(&text);
}

static void note_key_line(struct lines *lines, int body, int index, struct line *key)
{
    struct fbd_grade *grade = lines->grade;
    struct text text = {0};
    key->finding = finding_add(grade, FBD_FINDING_MISSING, fbd_model_body_name(lines->model, (size_t)body),
                               "", (struct pos){0, 0});
    key->finding->most = grade->key->grading.points.derivation;
    text_printf(&text, "the key has `%s`",
                fbd_model_derivation(grade->sheet, (size_t)body, (size_t)index).text);
    finding_tell(grade, key->finding, text.data ? text.data : "");
    if (text.failed) grade->arena.failed = true;
    text_free(&text);
    say_of_key_line(lines, body, key);
}

static bool is_of_motion(const struct line *line)
{
    return line->dynamic && (line->is.names & (unsigned)FBD_NAMES_ACCELERATIONS) != 0;
}

/* The fraction of these senses of slip for which a line agrees. */
static double share_agreed(unsigned wanted, const struct line *line)
{
    int cases = 0, agreed = 0;
    for (int slip = 0; slip < slips; slip++) {
        if (!(wanted >> slip & 1U)) continue;
        cases++;
        agreed += line_agrees_at(line, slip);
    }
    return cases ? (double)agreed / cases : 0;
}

/* With one degree of freedom there is one equation of motion, in any of the accelerations. If none of the
 * key's is matched, the first is matched by the answer's first true line: a second one might be equivalent to
 * it. */
static void meet_by_another(struct lines *lines, struct body_lines *bodies, size_t count)
{
    struct line *wanted = NULL, *given = NULL;
    size_t body = 0, other = 0;
    for (size_t b = 0; b < count; b++) {
        for (size_t k = 0; k < bodies[b].key_count; k++) {
            struct line *key = &bodies[b].key[k];
            if (is_of_motion(key) && key->share > 0) return;
            if (!is_of_motion(key) || wanted) continue;
            wanted = key;
            body = b;
        }
        for (size_t i = 0; i < bodies[b].count; i++) {
            struct line *own = &bodies[b].own[i];
            if (!is_of_motion(own) || own->met != 0 || !line_agrees(own) || given) continue;
            given = own;
            other = b;
        }
    }
    if (!wanted || !given) return;
    for (int k = 0; k < lines_pushes; k++) lines_push(lines, k);
    if (!lines_one_freedom(lines)) return;
    wanted->share = share_agreed(body == other ? line_wanted_slips(wanted) : given->counts, given);
    say_of_key_line(lines, (int)body, wanted);
}

/* Judge the lines of a body, in the order of the file. */
static bool look_at_lines(struct lines *lines, int body, struct line *found, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!look_at_line(lines, body, (int)i, &found[i])) return false;
    return true;
}

/* Judge one line of the answer, in its own coordinates or in those of the sheet. */
static bool look_at_own(struct lines *lines, struct lines *plain, int body, int index, struct line *line)
{
    if (!look_at_line(lines, body, index, line)) return false;
    if (!plain->model || line_agrees(line)) return true;
    struct line other;
    if (!look_at_line(plain, body, index, &other)) return false;
    if (line_agrees(&other)) *line = other;
    return true;
}

static bool grade_body(struct lines *lines, struct lines *plain, struct lines *sheet, int body,
                       struct body_lines *found)
{
    found->count = fbd_model_derivation_count(lines->model, (size_t)body);
    found->key_count = fbd_model_derivation_count(lines->grade->sheet, (size_t)body);
    found->own = ARENA_ARRAY(&lines->grade->arena, found->count + found->key_count + 1, struct line);
    found->key = found->own ? found->own + found->count : NULL;
    bool done = found->own && look_at_lines(sheet, body, found->key, found->key_count);
    for (size_t i = 0; done && i < found->count; i++) {
        done = look_at_own(lines, plain, body, (int)i, &found->own[i]);
        if (done)
            note_student_line(lines, body, (int)i, &found->own[i],
                              is_asked(&found->own[i], found->key, found->key_count));
    }
    done = done && lines_meet(lines, found);
    for (size_t k = 0; done && k < found->key_count; k++) note_key_line(lines, body, (int)k, &found->key[k]);
    return done;
}

static bool grade_all(struct lines *lines, struct lines *plain, struct lines *sheet)
{
    size_t count = fbd_model_body_count(lines->model);
    struct body_lines *bodies = ARENA_ARRAY(&lines->grade->arena, count + 1, struct body_lines);
    bool done = bodies != NULL;
    for (size_t b = 0; done && b < count; b++) done = grade_body(lines, plain, sheet, (int)b, &bodies[b]);
    if (done) meet_by_another(lines, bodies, count);
    return done && !lines->grade->arena.failed;
}

static bool open_lines(struct lines *lines)
{
    lines->checker = fbd_checker_new();
    return lines->checker != NULL;
}

static void close_lines(struct lines *lines)
{
    for (int k = 0; k < lines_pushes; k++) fbd_model_free(lines->pushed[k].model);
    fbd_checker_free(lines->checker);
    fbd_model_free(lines->alone);
}

/* Read the same lines in the coordinates of the sheet, if the answer has others. */
static bool read_plain(struct lines *lines, struct lines *plain)
{
    if (!lines->grade->own || !lines->model) return true;
    fbd_errors *errors = fbd_errors_new();
    plain->paper = lines->paper;
    plain->answer = lines->answer;
    plain->root = lines_as_written(lines);
    if (errors && plain->root) plain->model = lines_try(plain, plain->root, true, false, errors);
    fbd_errors_free(errors);
    return errors && plain->root;
}

void grade_lines(struct fbd_grade *grade, const struct node *root)
{
    struct lines lines = {.grade = grade}, plain = lines, sheet = {.grade = grade, .model = grade->sheet};
    sheet.root = grade->key->root;
    unsigned *slips_of_motion = lines_slips(grade);
    lines.slips = plain.slips = sheet.slips = slips_of_motion;
    bool done = slips_of_motion && open_lines(&lines) && open_lines(&plain) && open_lines(&sheet);
    if (done) lines_read(&lines, root);
    done = done && lines.model != NULL && read_plain(&lines, &plain);
    done = done && grade_all(&lines, &plain, &sheet);
    if (!done) grade->arena.failed = true;
    fbd_model_free(lines.model);
    fbd_model_free(plain.model);
    close_lines(&lines);
    close_lines(&plain);
    close_lines(&sheet);
}

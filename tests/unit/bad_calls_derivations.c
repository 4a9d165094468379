/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls that cannot be meant of the functions of fbd_grade.h for graders of others, and of those for connections.
 */
#include "bad_calls.h"
#include "fbd_grade.h"
#include "fbd_view.h"

static void take(void *context, int line, int column, const char *text)
{
    (void)context;
    (void)line;
    (void)column;
    (void)text;
}

static void documents(void)
{
    const fbd_setting nameless = {.value = "1"};
    const char *const path[] = {"bodies", "block", "hand"}, *const none[] = {NULL};
    REFUSES(fbd_document_parse, !fbd_document_parse(NULL, 0, NULL, errors));
    ENDURES(fbd_document_free, fbd_document_free(NULL));
    fbd_document *document = fbd_document_parse(bad_calls_scene, strlen(bad_calls_scene), NULL, errors);
    assert_non_null(document);
    ANSWERS(fbd_document_take, !fbd_document_take(NULL, document, path, 3));
    ANSWERS(fbd_document_take, !fbd_document_take(document, NULL, path, 3));
    ANSWERS(fbd_document_take, !fbd_document_take(document, document, NULL, 3));
    ANSWERS(fbd_document_take, !fbd_document_take(document, document, path, 0));
    ANSWERS(fbd_document_take, !fbd_document_take(document, document, none, 1));
    REFUSES(fbd_model_parse_document, !fbd_model_parse_document(NULL, NULL, 0, true, errors));
    REFUSES(fbd_model_parse_document, !fbd_model_parse_document(document, &nameless, 1, true, errors));
    ANSWERS(fbd_document_derivations, !fbd_document_derivations(NULL, NULL, 0, model, NULL, 0, take, NULL));
    ANSWERS(fbd_document_derivations,
            !fbd_document_derivations(document, NULL, 0, NULL, NULL, 0, take, NULL));
    ANSWERS(fbd_document_derivations,
            !fbd_document_derivations(document, NULL, 0, model, none, 1, take, NULL));
    ANSWERS(fbd_document_derivations,
            !fbd_document_derivations(document, NULL, 0, model, NULL, 0, NULL, NULL));
    ANSWERS(fbd_is_name,
            !fbd_is_name(NULL) && !fbd_is_name("") && !fbd_is_name("2a") && !fbd_is_name("theta"));
    fbd_document_free(document);
}

void derivations(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model);
    fbd_comparison comparison;
    documents();
    ANSWERS(fbd_model_derivation_count, fbd_model_derivation_count(NULL, 0) == 0);
    ANSWERS(fbd_model_derivation_count, fbd_model_derivation_count(model, past) == 0);
    ANSWERS(fbd_model_derivation, !fbd_model_derivation(NULL, 0, 0).written);
    ANSWERS(fbd_model_derivation, !fbd_model_derivation(model, 0, past).text);
    ANSWERS(fbd_state_residual, is_nan(fbd_state_residual(NULL, 0, 0).value));
    ANSWERS(fbd_state_residual, is_nan(fbd_state_residual(state, 0, past).slopes[FBD_UNKNOWNS - 1]));
    ANSWERS(fbd_model_grading, fbd_model_grading(NULL).tolerance == 0);
    ANSWERS(fbd_model_connection_count, fbd_model_connection_count(NULL) == 0);
    ANSWERS(fbd_model_connection, !fbd_model_connection(NULL, 0).kind);
    ANSWERS(fbd_model_connection, is_nan(fbd_model_connection(model, past).length));
    ENDURES(fbd_checker_new, (void)0);
    fbd_checker *checker = fbd_checker_new();
    assert_non_null(checker);
    ANSWERS(fbd_checker_mistake, !fbd_checker_mistake(NULL, 0));
    ANSWERS(fbd_checker_mistake, !fbd_checker_mistake(checker, 0));
    ANSWERS(fbd_checker_compare, !fbd_checker_compare(NULL, model, 0, 0, 0, 1e-9, &comparison));
    ANSWERS(fbd_checker_compare, !fbd_checker_compare(checker, NULL, 0, 0, 0, 1e-9, &comparison));
    ANSWERS(fbd_checker_compare, !fbd_checker_compare(checker, model, 0, past, 0, 1e-9, &comparison));
    ANSWERS(fbd_checker_compare, !fbd_checker_compare(checker, model, 0, 0, 0, 1e-9, NULL));
    ENDURES(fbd_checker_free, fbd_checker_free(NULL));
    fbd_checker_free(checker);
    fbd_state_free(state);
}

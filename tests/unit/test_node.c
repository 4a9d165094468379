/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The tree of a file: places, limits, and files that are no models at all.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "document/node.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct tree {
    struct arena arena;
    fbd_errors *errors;
    const struct node *root;
};

static struct tree read_bytes(const char *text, size_t length)
{
    struct tree tree = {.errors = fbd_errors_new()};
    struct source source;
    assert_non_null(tree.errors);
    if (source_open(text, length, tree.errors, &source))
        tree.root = node_read(&tree.arena, &source, tree.errors);
    return tree;
}

static struct tree read_tree(const char *text)
{
    return read_bytes(text, strlen(text));
}

/* The root, which must be there. */
static const struct node *root_of(const struct tree *tree)
{
    assert_non_null(tree->root);
    if (!tree->root) abort(); /* assert_non_null does not come back, but analyzers cannot know */
    return tree->root;
}

static struct tree read_right_tree(const char *text)
{
    struct tree tree = read_tree(text);
    if (fbd_errors_count(tree.errors) > 0) fbd_errors_print(tree.errors, stderr);
    assert_non_null(tree.root);
    assert_int_equal(fbd_errors_count(tree.errors), 0);
    return tree;
}

static void end_tree(struct tree *tree)
{
    arena_free(&tree->arena);
    fbd_errors_free(tree->errors);
}

static const struct pair *pair_of(const struct node *map, const char *key)
{
    const struct pair *pair = node_find(map, key);
    assert_non_null(pair);
    return pair;
}

static void assert_place(struct pos at, int line, int column)
{
    assert_int_equal(at.line, line);
    assert_int_equal(at.column, column);
}

static void assert_refused(struct tree *tree, const char *id, int line, int column)
{
    const fbd_error note = fbd_errors_get(tree->errors, 0);
    assert_non_null(note.id);
    assert_string_equal(note.id, id);
    assert_place((struct pos){note.line, note.column}, line, column);
    end_tree(tree);
}

/* ---- places */

static void every_key_and_value_has_its_place(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("fbd: 1\n"
                                       "bodies:\n"
                                       "  block:  {mass: 2 kg, at: [0, P]}\n");
    const struct pair *bodies = pair_of(tree.root, "bodies");
    const struct pair *block = pair_of(bodies->value, "block");
    const struct pair *at = pair_of(block->value, "at");
    assert_place(root_of(&tree)->at, 1, 1);
    assert_place(bodies->at, 2, 1);
    assert_place(bodies->value->at, 3, 3);
    assert_place(block->at, 3, 3);
    assert_place(block->value->at, 3, 11);
    assert_place(pair_of(block->value, "mass")->value->at, 3, 18);
    assert_place(at->at, 3, 24);
    assert_place(at->value->items[1]->at, 3, 32);
    end_tree(&tree);
}

static void columns_count_characters_and_not_bytes(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("{größe: 1, k: 2}");
    assert_place(pair_of(tree.root, "k")->at, 1, 12);
    assert_place(pair_of(tree.root, "k")->value->at, 1, 15);
    end_tree(&tree);
}

static void a_byte_order_mark_is_no_column(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("\xEF\xBB\xBFk: 2");
    assert_place(pair_of(tree.root, "k")->value->at, 1, 4);
    end_tree(&tree);
}

static void line_ends_of_all_systems_count_once(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("a: 1\r\nb: 2\rc: 3\nd: 4\r\n");
    assert_place(pair_of(tree.root, "b")->at, 2, 1);
    assert_place(pair_of(tree.root, "c")->at, 3, 1);
    assert_place(pair_of(tree.root, "d")->at, 4, 1);
    end_tree(&tree);
}

static void text_in_quotes_starts_behind_the_quote(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("a: \"x + y\"");
    const struct node *node = pair_of(tree.root, "a")->value;
    assert_place(node->at, 1, 4);
    assert_place(node->text_at, 1, 5);
    assert_place(node_place(node, 4), 1, 9);
    assert_true(node->quoted);
    end_tree(&tree);
}

static void a_value_behind_an_anchor_has_its_own_place(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("a: &name   30 deg\nb: &other 'x'\nc: *name");
    assert_place(pair_of(tree.root, "a")->value->at, 1, 12);
    assert_place(pair_of(tree.root, "b")->value->text_at, 2, 12);
    assert_ptr_equal(pair_of(tree.root, "c")->value, pair_of(tree.root, "a")->value);
    end_tree(&tree);
}

static void a_text_of_several_lines_keeps_the_place_of_each_word(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("a: >\n"
                                       "\n"
                                       "   m*v_dot =\n"
                                       "     - k*x\n"
                                       "b: one\n"
                                       "    two\n"
                                       "c: |\n"
                                       "  p\n"
                                       "  q\n");
    const struct node *a = pair_of(tree.root, "a")->value, *b = pair_of(tree.root, "b")->value;
    const struct node *c = pair_of(tree.root, "c")->value;
    assert_place(a->text_at, 3, 4);
    assert_place(node_place(a, (size_t)(strchr(a->text, 'k') - a->text)), 4, 8);
    assert_string_equal(b->text, "one two");
    assert_place(node_place(b, 4), 6, 5);
    assert_place(node_place(c, (size_t)(strchr(c->text, 'q') - c->text)), 9, 3);
    end_tree(&tree);
}

/* ---- kinds */

static void only_plain_scalars_are_null(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("a:\nb: ~\nc: null\nd: \"\"\ne: 'null'\nf: nil\n");
    assert_int_equal(pair_of(tree.root, "a")->value->kind, node_null);
    assert_int_equal(pair_of(tree.root, "b")->value->kind, node_null);
    assert_int_equal(pair_of(tree.root, "c")->value->kind, node_null);
    assert_int_equal(pair_of(tree.root, "d")->value->kind, node_scalar);
    assert_int_equal(pair_of(tree.root, "e")->value->kind, node_scalar);
    assert_int_equal(pair_of(tree.root, "f")->value->kind, node_scalar);
    end_tree(&tree);
}

static void the_symbols_of_mechanics_are_words(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("{y: 1, n: 2, N: 3, on: 4, off: 5, yes: 6}");
    assert_int_equal(root_of(&tree)->count, 6);
    assert_string_equal(pair_of(tree.root, "y")->value->text, "1");
    assert_string_equal(pair_of(tree.root, "N")->value->text, "3");
    end_tree(&tree);
}

static void a_mapping_keeps_the_order_of_the_file(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("{b: 1, c: 2, a: 3}");
    assert_string_equal(root_of(&tree)->pairs[0].key, "b");
    assert_string_equal(root_of(&tree)->pairs[2].key, "a");
    assert_null(node_find(tree.root, "d"));
    assert_null(node_find(NULL, "d"));
    end_tree(&tree);
}

static void the_first_of_two_equal_keys_stays(void **state)
{
    (void)state;
    struct tree tree = read_tree("b: 1\na: 2\nb: 3\nc: 4\nb: 5\n");
    assert_int_equal(root_of(&tree)->count, 3);
    assert_string_equal(pair_of(tree.root, "b")->value->text, "1");
    assert_string_equal(root_of(&tree)->pairs[2].key, "c");
    assert_int_equal(fbd_errors_failed_count(tree.errors), 2);
    assert_non_null(strstr(fbd_errors_get(tree.errors, 1).message, "line 1"));
    assert_refused(&tree, "duplicate-key", 3, 1);
}

/* ---- limits */

static char *repeated(const char *piece, size_t count, size_t *length)
{
    size_t size = strlen(piece);
    char *text = malloc(count * size + 1);
    assert_non_null(text);
    for (size_t i = 0; i < count; i++) memcpy(text + i * size, piece, size);
    text[count * size] = '\0';
    *length = count * size;
    return text;
}

/* The files below take milliseconds. The bound leaves room for valgrind, and is far below the minutes of
 * anything quadratic: libyaml alone needs 5.8 s for 40 000 brackets. */
static const double most_seconds = 5;

static void assert_monster(const char *piece, size_t count, const char *id, int line, int column)
{
    size_t length;
    char *text = repeated(piece, count, &length);
    clock_t start = clock();
    struct tree tree = read_bytes(text, length);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    assert_null(tree.root);
    assert_int_equal(fbd_errors_failed_count(tree.errors), 1);
    assert_true(seconds < most_seconds);
    assert_refused(&tree, id, line, column);
    free(text);
}

static void nesting_is_limited(void **state)
{
    (void)state;
    assert_monster("[", 10000, "too-deep", 1, 65);
    assert_monster("{", 10000, "too-deep", 1, 65);
    assert_monster("[", 1000000, "too-deep", 1, 65);
    assert_monster("[\n", 10000, "too-deep", 65, 1);
    assert_monster("- ", 10000, "too-deep", 1, 129);
    assert_monster("? ", 10000, "too-deep", 1, 129);
}

static void nesting_at_the_limit_is_read(void **state)
{
    (void)state;
    const size_t depth = node_most_depth;
    char text[2 * node_most_depth + 1] = "";
    memset(text, '[', depth);
    memset(text + depth, ']', depth);
    struct tree tree = read_right_tree(text);
    assert_int_equal(root_of(&tree)->height, node_most_depth);
    end_tree(&tree);
}

static void a_million_characters_are_answered_at_once(void **state)
{
    (void)state;
    assert_monster(": ", 500000, "yaml-syntax", 1, 1);
    assert_monster("\"", 1000000, "yaml-syntax", 1, 3);
    assert_monster("&a ", 300000, "yaml-syntax", 1, 4);
    assert_monster("%", 1000000, "yaml-syntax", 1, 2);
    assert_monster("\t", 1000000, "tab-indent", 1, 1);
    assert_monster("\n", 1000000, "empty-file", 1, 1);
}

static void a_key_without_end_is_called_too_long(void **state)
{
    (void)state;
    char text[3003];
    memset(text, 'k', 3000);
    memcpy(text + 3000, ": ", 3);
    struct tree tree = read_tree(text);
    assert_refused(&tree, "bad-key", 1, 3001);
    text[node_longest_key + 1] = ':';
    text[node_longest_key + 2] = ' ';
    text[node_longest_key + 3] = '\0';
    tree = read_tree(text);
    assert_refused(&tree, "bad-key", 1, 1);
}

static void an_alias_bomb_does_not_go_off(void **state)
{
    (void)state;
    char text[4096] = "a: &a [x,x,x,x,x,x,x,x,x,x]\n";
    for (int c = 'b'; c < 'l'; c++) {
        size_t used = strlen(text);
        const int p = c - 1;
        snprintf(text + used, sizeof text - used, "%c: &%c [*%c,*%c,*%c,*%c,*%c,*%c,*%c,*%c,*%c]\n", c, c, p,
                 p, p, p, p, p, p, p, p);
    }
    struct tree tree = read_tree(text);
    assert_null(tree.root);
    assert_non_null(strstr(fbd_errors_get(tree.errors, 0).message, "100000"));
    assert_string_equal(fbd_errors_get(tree.errors, 0).id, "alias-budget");
    end_tree(&tree);
}

static void aliases_do_not_nest_beyond_the_limit(void **state)
{
    (void)state;
    char text[8192] = "a0: &a0 [x]\n";
    for (int i = 1; i < 100; i++) {
        size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "a%d: &a%d [*a%d]\n", i, i, i - 1);
    }
    struct tree tree = read_tree(text);
    /* The root is level 1, list a0 in list i is level i + 2: the 63rd list, in line 64, is one too many. */
    assert_refused(&tree, "too-deep", 64, 12);
}

static void the_latest_anchor_of_a_name_counts(void **state)
{
    (void)state;
    struct tree tree = read_right_tree("a: &n 1\nb: *n\nc: &n 2\nd: *n\n");
    assert_string_equal(pair_of(tree.root, "b")->value->text, "1");
    assert_string_equal(pair_of(tree.root, "d")->value->text, "2");
    end_tree(&tree);
}

/* ---- bytes */

static void bytes_that_are_no_text_are_located(void **state)
{
    (void)state;
    static const struct {
        const char *text, *id;
        size_t length;
        int line, column;
    } cases[] = {
        {"a: 1\nb: \xFF", "not-utf-8", 9, 2, 4},
        {"a: \xC0\xAF", "not-utf-8", 5, 1, 4},         /* overlong */
        {"a: \xED\xA0\x80", "not-utf-8", 6, 1, 4},     /* a surrogate */
        {"a: \xF4\x90\x80\x80", "not-utf-8", 7, 1, 4}, /* beyond U+10FFFF */
        {"a: \xE2\x82", "not-utf-8", 5, 1, 4},         /* cut short */
        {"\xFF\xFE"
         "f\0",
         "not-utf-8", 4, 1, 1}, /* UTF-16 */
        {"ä: \0", "control-character", 5, 1, 4},
        {"a: \x1B[0m", "control-character", 7, 1, 4},
        {"a: \xC2\x85", "control-character", 5, 1, 4},     /* NEL */
        {"a: \xE2\x80\xA8", "control-character", 6, 1, 4}, /* line separator */
        {"a: \"\\0\"", "control-character", 7, 1, 4},      /* as an escape */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct tree tree = read_bytes(cases[i].text, cases[i].length);
        assert_refused(&tree, cases[i].id, cases[i].line, cases[i].column);
    }
}

static void nothing_is_no_model(void **state)
{
    (void)state;
    struct tree tree = read_bytes("", 0);
    assert_refused(&tree, "empty-file", 1, 1);
    tree = read_tree("# nothing\n\n");
    assert_refused(&tree, "empty-file", 1, 1);
}

/* A generator of its own, so that a seed means the same everywhere (Knuth, TAOCP 2, 3.3.4: MMIX). */
static unsigned next_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(*seed >> 33);
}

static void assert_noise(const char *alphabet, size_t letters, uint64_t seed)
{
    enum { size = 100000 };
    char *noise = malloc(size);
    assert_non_null(noise);
    uint64_t state = seed;
    for (size_t i = 0; i < size; i++)
        noise[i] = letters ? alphabet[next_random(&state) % letters] : (char)(next_random(&state) & 0xFF);
    clock_t start = clock();
    struct tree tree = read_bytes(noise, size);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    if (tree.root || seconds >= most_seconds) print_error("seed %llu\n", (unsigned long long)seed);
    assert_null(tree.root);
    assert_true(fbd_errors_failed_count(tree.errors) > 0);
    assert_true(fbd_errors_get(tree.errors, 0).line > 0);
    assert_true(seconds < most_seconds);
    end_tree(&tree);
    free(noise);
}

static void noise_is_refused_with_a_place(void **state)
{
    (void)state;
    static const char letters[] = "ab:-[]{}&*!|>'\"%@`#, \n\t0123";
    for (uint64_t seed = 1; seed <= 20; seed++) {
        assert_noise(NULL, 0, seed);
        assert_noise(letters, sizeof letters - 1, seed);
    }
}

/* ---- cost */

static double seconds_for(size_t keys)
{
    char *text = malloc(keys * 40 + 1);
    assert_non_null(text);
    size_t used = 0;
    for (size_t i = 0; i < keys; i++)
        used += (size_t)snprintf(text + used, 40, "key_%zu: {mass: 2 kg}\n", i * 7919 % keys);
    clock_t start = clock();
    struct tree tree = read_bytes(text, used);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    assert_int_equal(root_of(&tree)->count, keys);
    end_tree(&tree);
    free(text);
    return seconds;
}

/* Ten times the keys take about ten times as long. A check of each key against all others would take a
 * hundred times as long; the bound lies between, on the safe side of a busy machine. */
static void a_large_mapping_takes_linear_time(void **state)
{
    (void)state;
    double few = seconds_for(10000), many = seconds_for(100000);
    assert_true(many < 50 * few + 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_and_value_has_its_place),
        cmocka_unit_test(columns_count_characters_and_not_bytes),
        cmocka_unit_test(a_byte_order_mark_is_no_column),
        cmocka_unit_test(line_ends_of_all_systems_count_once),
        cmocka_unit_test(text_in_quotes_starts_behind_the_quote),
        cmocka_unit_test(a_value_behind_an_anchor_has_its_own_place),
        cmocka_unit_test(a_text_of_several_lines_keeps_the_place_of_each_word),
        cmocka_unit_test(only_plain_scalars_are_null),
        cmocka_unit_test(the_symbols_of_mechanics_are_words),
        cmocka_unit_test(a_mapping_keeps_the_order_of_the_file),
        cmocka_unit_test(the_first_of_two_equal_keys_stays),
        cmocka_unit_test(nesting_is_limited),
        cmocka_unit_test(nesting_at_the_limit_is_read),
        cmocka_unit_test(a_million_characters_are_answered_at_once),
        cmocka_unit_test(a_key_without_end_is_called_too_long),
        cmocka_unit_test(an_alias_bomb_does_not_go_off),
        cmocka_unit_test(aliases_do_not_nest_beyond_the_limit),
        cmocka_unit_test(the_latest_anchor_of_a_name_counts),
        cmocka_unit_test(bytes_that_are_no_text_are_located),
        cmocka_unit_test(nothing_is_no_model),
        cmocka_unit_test(noise_is_refused_with_a_place),
        cmocka_unit_test(a_large_mapping_takes_linear_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

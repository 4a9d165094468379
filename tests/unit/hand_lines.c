/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "hand_lines.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_grade.h"
#include "scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *hand_verdict(const char *scene, const char *line, size_t *differing)
{
    char text[2400], quoted[600];
    const bool map = line[0] == '{';
    snprintf(quoted, sizeof quoted, map ? "%s" : "\"%s\"", line);
    snprintf(text, sizeof text, scene, quoted);
    fbd_model *model = model_from(text);
    char *verdict = fbd_check_hand(model, 1, differing);
    fbd_model_free(model);
    assert_non_null(verdict);
    return verdict;
}

int hand_lines_wrong(const struct hand_line *lines, size_t count)
{
    int failed = 0;
    for (size_t i = 0; i < count; i++) {
        const struct hand_line *line = &lines[i];
        size_t differing = 0;
        char *verdict = hand_verdict(line->scene, line->line, &differing);
        bool fine = (differing == 0) == line->right && (!line->says || strstr(verdict, line->says));
        if (!fine)
            print_error("%s should be %s:\n%s\n", line->line, line->right ? "right" : "wrong", verdict);
        failed += !fine;
        free(verdict);
    }
    return failed;
}

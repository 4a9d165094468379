/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The yardstick for the cost of fbd-run: a program that links the same two libraries and does nothing but
 * parse the file.
 */
#include <gsl/gsl_odeiv2.h>
#include <stdbool.h>
#include <stdio.h>
#include <yaml.h>

int main(int argc, char **argv)
{
    FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
    yaml_parser_t parser;
    if (!file || !gsl_odeiv2_step_rk8pd || !yaml_parser_initialize(&parser)) return 1;
    yaml_parser_set_input_file(&parser, file);
    int events = 0;
    for (bool more = true; more; events++) {
        yaml_event_t event;
        if (!yaml_parser_parse(&parser, &event)) return 1;
        more = event.type != YAML_STREAM_END_EVENT;
        yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    fclose(file);
    printf("%d events\n", events);
    return 0;
}

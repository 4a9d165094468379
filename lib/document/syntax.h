/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Syntax: errors of libyaml in terms of model files.
 */
#ifndef FBD_DOCUMENT_SYNTAX_H
#define FBD_DOCUMENT_SYNTAX_H

#include "base/diag.h"
#include "document/source.h"

#include <yaml.h>

/* A position of libyaml, which counts from 0, counted from 1. */
struct pos syntax_place(yaml_mark_t mark);

/* Note the error of `parser`: `yaml-syntax` or `tab-indent`, with its position and the start of the enclosing
 * construct; out of memory is noted as such. */
void syntax_explain(const yaml_parser_t *parser, const struct source *source, fbd_errors *errors);

#endif

/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Syntax: what libyaml could not parse, said in the words of someone who writes a model file.
 */
#ifndef FBD_SCENE_SYNTAX_H
#define FBD_SCENE_SYNTAX_H

#include "base/diag.h"
#include "scene/source.h"

#include <yaml.h>

/* A place of libyaml, which counts from 0, as we count. */
struct pos syntax_place(yaml_mark_t mark);

/* Note why `parser` gave up: `yaml-syntax` or `tab-indent`, with the place where it broke and the start of
 * what was being read; out of memory is noted as such. */
void syntax_explain(const yaml_parser_t *parser, const struct source *source, fbd_errors *errors);

#endif

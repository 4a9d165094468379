/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Document: a tree with the name of its file, as functions of fbd_grade.h take it. A caller that makes trees by node_edit.h
 * fills one itself.
 */
#ifndef FBD_DOCUMENT_DOCUMENT_H
#define FBD_DOCUMENT_DOCUMENT_H

#include "document/node.h"
#include "fbd_grade.h"

struct fbd_document {
    struct arena arena;
    const char *file; /* names the text in messages; may be NULL */
    const struct node *root;
};

#endif

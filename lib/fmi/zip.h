/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A zip archive (PKWARE's APPNOTE.TXT 6.3, sections 4.3.7 and 4.3.12 to 4.3.16). Nothing is compressed here, so that no
 * library is needed: files are stored, or taken as they come from gzip, whose method is that of zip. Equal contents give
 * equal bytes, since all files are dated 1980.
 */
#ifndef FBD_FMI_ZIP_H
#define FBD_FMI_ZIP_H

#include "base/text.h"

struct zip {
    struct text files, directory;
    unsigned count;
    bool failed; /* out of memory, or more than 4 GB or 65,535 files */
};

void zip_add(struct zip *zip, const char *name, const char *bytes, size_t length);

/* Add a file of which `bytes` are the gzip (RFC 1952, without optional fields), as gzip and Python's gzip.compress make it;
 * other bytes are stored. */
void zip_add_gzip(struct zip *zip, const char *name, const char *bytes, size_t length);

/* The archive, to be freed with free(); NULL after a failure. The zip is empty afterwards. */
char *zip_finish(struct zip *zip, size_t *length);

#endif

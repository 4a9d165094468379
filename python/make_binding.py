# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: make_binding.py GLUE.C OUTPUT HEADER...

Write the C source of fbd._binding: every function of the public headers, as cffi calls it, and those of glue.c. The
declarations are read from the headers themselves, and the C compiler checks each of them against it.
"""
import re
import sys
from pathlib import Path

from cffi import FFI

GLUE = """
typedef struct glue_watch { void *handle; bool stopped; ...; } glue_watch;
static int glue_watch_run(void *context, const fbd_progress *progress);
static fbd_outcome glue_seek(fbd_simulation *simulation, double t, glue_watch *watch);
typedef struct glue_sheet { char *data; size_t length; bool lost; size_t written, failed; ...; } glue_sheet;
static int glue_keep(void *context, const char *text, size_t length);
static int glue_count(void *context, const fbd_progress *progress);
static int glue_is_stopped(void *context);
static void glue_stop(glue_sheet *sheet);
static void glue_free(glue_sheet *sheet);
static void glue_quiet(void);
static int glue_input(void *context, double t, const double *y, double *value);
extern "Python" int fbd_input(void *context, double t, const double *y, double *value);
extern "Python" int fbd_ask(void *handle, const fbd_progress *progress);
"""


def declarations(header):
    """What cffi reads: the header without comments, preprocessor lines and marks of export."""
    text = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    text = re.sub(r"^[ \t]*#(?:.*\\\n)*.*$", "", text, flags=re.MULTILINE)
    text = re.sub(r'extern "C" \{', "", text).rstrip().removesuffix("}")
    return text.replace("FBD_API ", "")


def main():
    glue, output, *headers = (Path(name) for name in sys.argv[1:])
    declared = "".join(declarations(header.read_text(encoding="utf-8")) for header in headers)
    ffi = FFI()
    ffi.cdef(declared + GLUE)
    ffi.set_source("fbd._binding", glue.read_text(encoding="utf-8"))
    ffi.emit_c_code(str(output))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: live_sources.py MAP: the files of GSL that are compiled for live pages (lib/live/module/gsl_files) are those that a link
of the module takes from GSL's archives, by the MAP of the linker. Archives made of parts name members of the same name
lt10-copy.o, lt83-copy.o; so names without folders are counted."""
import os
import re
import sys
from collections import Counter
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
from claims import claim, finish  # noqa: E402

MEMBER = re.compile(r"^\S*libgsl(?:cblas)?\.a\((?:lt\d+-)?([\w-]+)\.o\)\s*$", re.MULTILINE)


def main():
    listed = Counter(Path(line).stem for line in (SOURCE / "lib/live/module/gsl_files").read_text(encoding="utf-8").split())
    members = Path(sys.argv[1]).read_text(encoding="utf-8").split("Discarded input sections")[0]
    linked = Counter(MEMBER.findall(members.split("Merging program properties")[0]))
    with claim("the link takes files from GSL"):
        assert sum(linked.values()) > 100, linked
    with claim("every file of GSL that the module needs is in gsl_files"):
        assert not linked - listed, linked - listed
    with claim("and no other one"):
        assert not listed - linked, listed - linked
    finish()


main()

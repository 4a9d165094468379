#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Messages lead to the guide: the example of each section of "Ten things that go wrong" has a message with that section, and
no message leads to a section that is not there."""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path[:0] = [str(SOURCE / "tests" / folder) for folder in ("page", "tools")]
import limits  # pylint: disable=wrong-import-position
from claims import claim, finish  # pylint: disable=wrong-import-position

PAGE = SOURCE / "docs/guide/ten-things.md"


def sections():
    """Heading and text of each section of the page."""
    parts = re.split(r"^## (.*)$", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
    return list(zip(parts[::2], parts[1::2]))


def examples(text):
    """The models of a section."""
    for block in re.findall(r"^```(?:sh|yaml)[^\n]*\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
        yield from re.findall(r"^fbd: 1\n.*?(?=^END$|\Z)", block, re.DOTALL | re.MULTILINE)


def notes(model, folder):
    path = Path(folder) / "m.yaml"
    path.write_text(model, encoding="utf-8")
    done = limits.run([os.environ["FBD_RUN"], "--check", "--json", "-", path], capture_output=True, stdin=subprocess.DEVNULL, check=False)
    return json.loads(done.stdout)["notes"], done.stderr.decode()


def main():
    headings = {f"guide/ten-things.md, {heading}": text for heading, text in sections()}
    table = dict(re.findall(r'\{"([a-z-]+)", TEN_THINGS "(.*)"\}', (SOURCE / "lib/base/diag_guide.c").read_text()))
    ids = re.findall(r"`([a-z-]+)`", (SOURCE / "docs/format.md").read_text(encoding="utf-8"))
    with claim("each message that leads to the guide has a section there, and each section a message"):
        assert sorted(f"guide/ten-things.md, {section}" for section in table.values()) == sorted(headings)
    for name in table:
        with claim(f"{name} is documented"):
            assert name in ids
    with tempfile.TemporaryDirectory() as folder:
        for section, text in headings.items():
            with claim(f"the example leads to {section}"):
                found = [notes(model, folder) for model in examples(text)]
                assert any(note["see"] == section for listed, _ in found for note in listed), found
                assert any(f"    see: {section}\n" in printed for _, printed in found)
        with claim("of several messages the first one leads there"):
            listed, printed = notes("fbd: 1\nbodies: {a: {mas: 1 kg, motion: slide, foces: []}}\n", folder)
            assert sum(bool(note["see"]) for note in listed) == 2 and printed.count("see: ") == 1
    finish()


main()

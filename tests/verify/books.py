#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every model of tests/books has the answer that its book prints, or, where the print is wrong, the one derived beside it."""
import os
import sys
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path.insert(0, str(SOURCE / "tests" / "page"))
from case import Case  # pylint: disable=wrong-import-position
from claims import claim, finish  # pylint: disable=wrong-import-position


def main():
    programs = Path(os.environ["FBD_RUN"]).parent
    every = 4 if os.environ.get("FBD_THOROUGH") == "no" else 1
    for path in sorted((SOURCE / "tests" / "books").glob("*.yaml"))[::every]:
        case = Case(path, programs)
        with claim(f"{path.stem}: the model names its source and licence, and has an answer"):
            assert case.say["source"] and case.say["licence"] and case.answers
        for answer in case.answers:
            with claim(f"{path.stem}: {answer['name']}"):
                want = answer["instead"] or answer
                got = case.get(answer)
                assert abs(got - want["value"]) <= want["within"], f"got {got!r}, want {want['value']!r} +- {want['within']:g}"
                if answer["instead"]:
                    assert abs(got - answer["value"]) > answer["within"], "the print is not wrong after all"
    finish()


main()

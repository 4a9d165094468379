#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every line that the program writes in symbols is true: each term of report, LaTeX, diagram and page, and the comments of
--emit-c, is evaluated and held against its number, over the gallery, tests/books and random scenes.

    symbolic_lines.py [SCENES [SEED]]     a failing scene is printed with the seed that makes it

Of the files every fourth; with FBD_DRAWS (`make generators`) each, and as many times as many random scenes.
"""
import os
import random
import re
import sys
from collections import Counter
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path.insert(0, str(SOURCE / "tests" / "page"))
from claims import claim, finish, skip  # noqa: E402
try:
    import yaml  # noqa: F401  pylint: disable=unused-import
except ImportError:
    skip("python3-yaml is not installed")
from library import LIBRARY, Model, Refused, taken  # noqa: E402
from scenes import random_scene  # noqa: E402
from truth import Scene, judge_page, judge_state  # noqa: E402

# What the files of the gallery and of the books have in symbols and a number is compared with, at least. Fewer formulas than
# that are formulas lost.
LEAST = {"lines": 2550, "symbols": 1110, "laws": 330, "arms and slopes": 365, "remarks": 350, "page symbols": 3400, "page laws": 1000,
         "page arms and slopes": 1130}
RUN = 0.02  # its run, in seconds
# Forces act in these that did not at the start: each term is judged along the whole run, so that none is missing.
LATER = {"contact/ball_off_a_table": 3, "contact/bouncing_ball": 2, "contact/cradle": 2, "contact/stairs": 2, "contact/ladder": 1,
         "contact/woodpecker": 0.4, "couplings/ballistic_pendulum": 1, "couplings/sticky_plate": 2, "forcing/brake_from_a_mark": 5,
         "forcing/pulse_train": 5}
SHARE = 1 if "FBD_DRAWS" in os.environ else 4


def judge(text, name, run=RUN, rows=3):
    """The counts of one scene at its start, and along a run."""
    model = Model(text, name)
    try:
        scene = Scene(text, model)
        page = model.page(run, rows)
        chosen = {(page.rows - 1) * k // (rows - 1) for k in range(rows)}
        return judge_state(scene, model) + judge_page(scene, page, sorted(chosen))
    finally:
        model.free()


def emitted(text, name):
    """The potential of a comment is differentiated by the coordinate of its line."""
    model = Model(text, name)
    try:
        program = taken(LIBRARY.fbd_emit_c(model.model, None, None))
    except Refused:
        return 0
    finally:
        model.free()
    found = re.findall(r"f\[\w+?_([a-z]+)\] -= \w+\(s, t, y\)\.d; /\* [\w.]+: (.*) \*/", program)
    for coordinate, comment in found:
        assert comment == f"-dV/d{coordinate}", f"{comment} along {coordinate}"
    return len(found)


def files():
    for path in sorted([*(SOURCE / "models").glob("*/*.yaml"), *(SOURCE / "tests" / "books").glob("*.yaml"),
                        *(SOURCE / "tests" / "faults" / "equations").glob("*.yaml")]):
        yield path, path.read_text(encoding="utf-8")


def check_files(total):
    for path, text in list(files())[::SHARE]:
        os.chdir(path.parent)  # where its data are
        with claim(f"{path.parent.name}/{path.name}"):
            total.update(judge(text, path.name))
    for name, least in LEAST.items():
        least //= SHARE if SHARE == 1 else 2 * SHARE
        with claim(f"{name} in symbols: at least {least}"):
            assert total[name] >= least, f"{total[name]}"
    check_judged(total)


def check_later():
    total = Counter()
    for name, run in LATER.items():
        path = SOURCE / "models" / f"{name}.yaml"
        os.chdir(path.parent)
        with claim(f"{name}, to {run} s"):
            total.update(judge(path.read_text(encoding="utf-8"), path.name, run, 40))
    with claim("forces that are zero at the start have terms"):
        assert total["zero now"] >= 15, total["zero now"]


def check_judged(total):
    with claim(f"nearly all terms are judged: {dict(total)}"):
        judged = sum(total[name] for name in ("symbols", "laws", "page symbols", "page laws", "remarks"))
        others = sum(n for key, n in total.items() if "not judged" in key or "by its name" in key)
        assert others <= 0.05 * judged, f"{others} beside {judged}"


def check_random(count, seed, total):
    refused = potentials = 0
    for number in range(seed, seed + count):
        text = random_scene(random.Random(number))
        with claim(f"random scene {number}"):
            try:
                total.update(judge(text, f"scene {number}"))
                if "potential:" in text and "couplings:" not in text:
                    potentials += emitted(text, f"scene {number}")
            except Refused:
                refused += 1
            except Exception:
                print("".join(f"# {line}\n" for line in text.splitlines()), end="")
                raise
    with claim("--emit-c says of what a potential is the slope"):
        assert potentials >= count / 60, f"{potentials} lines"
    with claim("few random scenes are refused"):
        assert refused <= 2 + 0.1 * count, f"{refused} of {count}"
    check_judged(total)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    if len(sys.argv) <= 2:
        check_files(Counter())
        check_later()
    check_random(count * int(os.environ.get("FBD_DRAWS", "1")), first, Counter())
    finish()


main()

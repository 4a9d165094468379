#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Our own script of the page, read by machine: node for its syntax, eslint for the rest; each where it is installed."""
import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from claims import claim, finish
from fbd import SOURCE

PAGE = SOURCE / "lib/draw/page"
LIVE = [SOURCE / "lib/live/page" / part for part in ("engine.js", "phrases.js", "knobs.js", "editor.js", "share.js", "values.js", "check.js", "again.js", "grips.js", "pull.js", "hints.js",
                                                    "bench.js")]
WATCH = SOURCE / "apps/watched_page.js"
DRAWING = SOURCE / "lib/live/drawing"


def parts_of(template):
    """The scripts of a page as it puts them together, of those that are ours."""
    names = [line.strip("@\n") for line in template.open(encoding="utf-8") if line.endswith(".js@\n")]
    return [next(folder / name for folder in (template.parent, PAGE) if (folder / name).exists())
            for name in names if (template.parent / name).exists() or (PAGE / name).exists()]


RULES = {
    "root": True,
    "env": {"browser": True, "es6": True},
    "parserOptions": {"ecmaVersion": 2020, "sourceType": "script"},
    "extends": "eslint:recommended",
    "globals": {"Dygraph": "readonly", "CompressionStream": "readonly", "DecompressionStream": "readonly", "WebAssembly": "readonly"},
    "rules": {"eqeqeq": "error", "no-var": "error", "prefer-const": "error", "no-eval": "error",
              "no-implied-eval": "error", "max-len": ["error", {"code": 160}], "max-lines-per-function": ["error", 60],
              "no-unused-vars": "error", "no-shadow": "error", "semi": "error"},
}


# Debian's eslint finds its modules where Debian's node looks; another node has to be told.
ENVIRONMENT = {**os.environ, "NODE_PATH": "/usr/share/nodejs:/usr/lib/nodejs"}


def checked(command, folder):
    done = subprocess.run(command, capture_output=True, check=False, env=ENVIRONMENT, cwd=folder)
    assert done.returncode == 0, (done.stdout + done.stderr).decode()


def joined(paths):
    return "\n".join(path.read_text(encoding="utf-8").replace('"use strict";\n', "") for path in paths)


def main():
    parts, drawing_parts = parts_of(PAGE / "page.html"), parts_of(DRAWING / "drawing.html")
    live, source, drawing = joined([*LIVE, WATCH]), joined(parts), joined([*drawing_parts, LIVE[0]])
    with claim("text of the model never becomes markup"):
        for word in ("innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval("):
            assert word not in source + live + drawing, word
    with claim("the page asks for nothing: no address of the network in it"):
        for part in [*parts, PAGE / "page.html", PAGE / "page.css", *DRAWING.iterdir()]:
            text = part.read_text(encoding="utf-8")
            assert "http://" not in text and "https://" not in text and "fetch(" not in text, part
    with claim("the script is small"):
        assert len(source.encode()) < 110000, len(source)
    with tempfile.TemporaryDirectory() as name:
        unused = "/* exported quantity, mathOf */\n"  # of notation.js
        scripts, rules = {"page.js": source + live, "drawing.js": unused + drawing}, Path(name) / "rules.json"
        for script, text in scripts.items():
            (Path(name) / script).write_text('"use strict";\n' + text, encoding="utf-8")
        rules.write_text(json.dumps(RULES), encoding="utf-8")
        if shutil.which("node"):
            with claim("node has nothing to say about it"):
                for script in scripts:
                    checked(["node", "--check", script], name)
        if shutil.which("eslint"):
            with claim("nor has eslint"):
                checked(["eslint", "--no-eslintrc", "--format", "unix", "--config", rules.name, *scripts], name)
    finish()


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""fbd in a notebook that runs in the browser (JupyterLite, Pyodide): docs/python.md, In the browser.

    import fbd_browser
    fbd = await fbd_browser.load()
    fbd.run(open("incline.yaml").read())["block.x"]

It is no module for Pyodide but a client of the library for browsers (`make live`), texts in and texts out: fbd-live.wasm, wasi.js
and worker.js, which lie beside this file.
"""
import csv
import io
import json
from pathlib import Path

import js
from pyodide.ffi import to_js

HERE = Path(__file__).resolve().parent


class Refused(Exception):
    """The model is wrong; `notes` are those of fbd-run --check --json."""

    def __init__(self, notes):
        super().__init__("\n".join(f"{note['line']}:{note['column']}: {note['message']}" for note in notes) or "there is no run")
        self.notes = notes


class Library:
    def __init__(self, parts):
        self._parts = parts

    def _call(self, name, texts, *numbers):
        return self._parts.call(name, to_js(texts), to_js(numbers))

    def _answer(self, key, name, texts, *numbers):
        answer = json.loads(self._call(name, texts, *numbers))
        if answer[key] is None:
            raise Refused(answer["errors"])
        return answer[key]

    def check(self, text, name="model.yaml"):
        """All notes of a model."""
        return json.loads(self._call("controls", [text, name]))["errors"]

    def run(self, text, name="model.yaml", without=()):
        """The columns of the CSV with ledger, lists of numbers by their names, without some effects ("block.friction")."""
        texts = [text, name, "\n".join(without)]
        table = self._call("csv", texts)
        if table is None:
            raise Refused(json.loads(self._call("run", texts, 2))["errors"])
        rows = list(csv.reader(io.StringIO(table)))
        return {title.split(" ")[0]: list(map(float, column)) for title, column in zip(rows[0], zip(*rows[1:]))}

    def check_hand(self, text, name="model.yaml"):
        """The report of --check-hand on the derivation under `hand`."""
        return self._answer("hand", "check_hand", [text, name])["text"]

    def find(self, text, question, name="model.yaml"):
        """The answer to a question of --find, "mu: block.x = 2 m"."""
        return self._answer("find", "find", [text, name, question], 0)

    def note(self, text, name="model.yaml"):
        """The calculation note, as HTML."""
        return self._answer("note", "note", [text, name, ""])


async def load(folder=HERE, files=()):
    """The library of a folder. `files` are the data files of models, pairs of path and text."""
    folder = Path(folder)
    script = "\n".join((folder / name).read_text() for name in ("wasi.js", "worker.js"))
    make = js.Function.new("self", "postMessage", script + "\nreturn { begin, call };")
    parts = make(js.Object.new(), js.Function.new(""))
    module = await js.WebAssembly.compile(to_js((folder / "fbd-live.wasm").read_bytes()))
    question = js.Object.new()
    question.module, question.files = module, to_js([list(pair) for pair in files])
    await parts.begin(question)
    return Library(parts)

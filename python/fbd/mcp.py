# SPDX-License-Identifier: GPL-3.0-or-later
"""fbd-mcp: a server of the Model Context Protocol over standard input and output (docs/machines.md).

A language model gives the text of a scene and is told exactly what is wrong with it, and what its numbers are. Each call is
made by a process of its own, which ends at a limit of time and opens no files unless a folder is allowed.
"""
from __future__ import annotations

import argparse
import json
import os
import sys
import sysconfig
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

import numpy as np

from . import __version__, schema
from ._binding import lib
from ._bounded import Crashed, TooLong, bounded, files_refused, note_json, without_files
from ._grade import Key
from ._json_rpc import INVALID_PARAMS, Json, RpcError, Server
from ._library import text_at
from ._model import Model, read_notes
from ._notes import RunFailed
from ._run import Run
from ._state import State, _equations_text

PROTOCOLS = ("2025-06-18", "2025-03-26", "2024-11-05")
RESOURCE_NOT_FOUND = -32002
MOST_ROWS = 1000

INSTRUCTIONS = """fbd simulates planar rigid bodies from a model text in YAML: free-body diagrams that run. Read the tool `language` \
before you write a model, and `example` for models to start from. Then `check` the model: each note has a line, a column and often a `fix`. \
Numbers come from `run`, `equations`, `statics`, `linearize`, `sweep` and `find`; a derivation by hand is compared with the equations by \
`check_derivation`. Units: write them with every number (`2 kg`, `30 deg`)."""

# ---- arguments

TEXT: Json = {"type": "string"}
NUMBER: Json = {"type": "number"}
FLAG: Json = {"type": "boolean"}
TEXTS: Json = {"type": "array", "items": TEXT}
VALUES: Json = {"type": "object", "additionalProperties": {"type": ["string", "number"]}}

MODEL = {
    "model": {**TEXT, "description": "the text of the model file, YAML"},
    "parameters": {**VALUES, "description": 'other values of its parameters: {"mu": 0.3, "theta0": "60 deg"}'},
}
STATE = {"values": {**VALUES, "description": 'coordinates and rates: {"block.x": "0.1 m"}; default those of the start'}}
RUN = {
    "until": {**NUMBER, "description": "end time [s]; default that of the file"},
    "tolerance": {**NUMBER, "description": "relative error of a step"},
    "method": {**TEXT, "description": "auto, rk8pd, dop853, rodas5p, ...; default auto"},
    "step": {**NUMBER, "description": "fixed step [s]"},
}


def has_type(value: Any, name: str) -> bool:
    if name == "number":
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    if name == "integer":
        return isinstance(value, int) and not isinstance(value, bool)
    return isinstance(value, {"string": str, "boolean": bool, "array": list, "object": dict}[name])


def validate(value: Any, rule: Json, what: str) -> None:
    """Refuse a value that the JSON Schema of an argument does not allow; the few words of it that are used here."""
    kinds = rule["type"] if isinstance(rule["type"], list) else [rule["type"]]
    if not any(has_type(value, kind) for kind in kinds):
        raise RpcError(INVALID_PARAMS, f"{what} must be {' or '.join(kinds)}")
    if "enum" in rule and value not in rule["enum"]:
        raise RpcError(INVALID_PARAMS, f"{what} must be one of {', '.join(rule['enum'])}")
    if isinstance(value, list):
        for i, each in enumerate(value):
            validate(each, rule.get("items", {"type": kinds_of(each)}), f"{what}[{i}]")
    if isinstance(value, dict):
        _validate_members(value, rule, what)


def kinds_of(value: Any) -> List[str]:
    """Every type, for members of which a rule says nothing."""
    return ["string", "number", "boolean", "array", "object"] if value is not None else []


def _validate_members(value: Json, rule: Json, what: str) -> None:
    known, others = rule.get("properties", {}), rule.get("additionalProperties", True)
    for name, each in value.items():
        if name in known:
            validate(each, known[name], f"`{name}`")
        elif others is False:
            raise RpcError(INVALID_PARAMS, f"{what} has no argument `{name}`; it has {', '.join(known)}")
        elif isinstance(others, dict):
            validate(each, others, f"`{name}`")
    for name in rule.get("required", []):
        if name not in value:
            raise RpcError(INVALID_PARAMS, f"{what} lacks `{name}`")


# ---- tools: each returns a text and an object

Answer = Tuple[str, Json]
Tool = Callable[["Tools", Json], Answer]


def pick(arguments: Json, *names: str) -> Json:
    return {name: arguments[name] for name in names if name in arguments}


def thinned(run: Run, names: Sequence[str], most: int) -> Json:
    """Columns of a run, at most so many rows of them, with the first and the last."""
    rows = np.unique(np.linspace(0, len(run.rows) - 1, min(most, len(run.rows))).round().astype(int))
    columns = {name: {"values": run[name][rows].tolist(), "unit": run.units[name]} for name in ("t", *names)}
    return {"rows": len(rows), "of": len(run.rows), "columns": columns}


class Tools:
    """What a call may do, in the process of the call."""

    def __init__(self, root: Optional[str]):
        self.root = root
        self.name = os.path.join(os.path.realpath(root), "model.yaml") if root else "model.yaml"

    def model(self, arguments: Json) -> Model:
        return Model.parse(arguments["model"], self.name, **arguments.get("parameters", {}))

    def state(self, arguments: Json) -> State:
        return self.model(arguments).state(arguments.get("values"))

    def check(self, arguments: Json) -> Answer:
        notes, _ = read_notes(arguments["model"].encode("utf-8"), os.fsencode(self.name), arguments.get("parameters", {}))
        valid = not any(note.severity == "error" for note in notes)
        text = "\n".join(str(note) for note in notes) or "the model is valid"
        return text, {"valid": valid, "notes": [note_json(note) for note in notes]}

    def run(self, arguments: Json) -> Answer:
        options = pick(arguments, "until", "tolerance", "method", "step", "accuracy", "error_bars", "every", "ledger")
        failure = None
        try:
            run = self.model(arguments).run(**options)
        except RunFailed as error:
            if error.run is None:
                raise
            run, failure = error.run, error
        names = [name for name in arguments.get("columns", []) if name != "t"]
        most = max(1, min(int(arguments.get("rows", 50)), MOST_ROWS))
        data: Json = {"outcome": run.outcome, "reason": run.reason, "result": json.loads(run.json())}
        if names:
            data["table"] = thinned(run, names, most)
        if failure:
            data["notes"] = [note_json(note) for note in failure.notes]
        return (f"{failure}\n" if failure else "") + run.report(), data

    def equations(self, arguments: Json) -> Answer:
        state = self.state(arguments).fit()
        form = arguments.get("form", "numbers")
        numbers = state.equations(bool(arguments.get("components", False)))
        text = str(numbers) if form == "numbers" else _equations_text(
            state, {"symbols": lib.FBD_SYMBOLS, "latex": lib.FBD_LATEX}[form], True)
        return text, {"equations": json.loads(numbers.json()), "text": text}

    def check_derivation(self, arguments: Json) -> Answer:
        hand = arguments.get("hand")
        done = self.model(arguments).check_hand(int(arguments.get("seed", 1)), hand)
        lines: List[Json] = []
        for line in done.text.splitlines():
            if line.startswith("  ") and lines:
                lines[-1]["answer"].append(line.strip())
            elif ": " in line:
                lines.append({"line": line, "answer": []})
        for each in lines:
            each["agrees"] = bool(each["answer"]) and any(answer.startswith(("agrees at ", "holds at ")) for answer in each["answer"])
        return done.text, {"differing": int(done), "lines": lines}

    def grade(self, arguments: Json) -> Answer:
        key = Key.parse(arguments["key"], self.name, **arguments.get("parameters", {}))
        grade = key.grade(text=arguments["answer"], student=arguments["student"])
        details = bool(arguments.get("details", False))
        return grade.text(details), json.loads(grade.json(details))

    def draw(self, arguments: Json) -> Answer:
        options = pick(arguments, "components", "supports", "symbols", "worksheet", "solution", "scale")
        svg = self.state(arguments).fit().svg(arguments.get("body"), **options)
        return svg, {"svg": svg}

    def statics(self, arguments: Json) -> Answer:
        state = self.state(arguments)
        statics = (state.settle() if arguments.get("settle") else state).statics()
        return str(statics), json.loads(statics.json())

    def linearize(self, arguments: Json) -> Answer:
        linear = self.state(arguments).linearize()
        return str(linear), json.loads(linear.json())

    def sweep(self, arguments: Json) -> Answer:
        options = pick(arguments, "outputs", "zip", "seed", "until", "tolerance", "step", "method")
        self._refuse_files(arguments["vary"])
        table = self.model(arguments).sweep(arguments["vary"], jobs=1, **options)
        names = list(table.dtype.names or ())
        rows = [[each.item() for each in row] for row in table[:MOST_ROWS]]
        units = table.units
        heads = [f"{name} [{units[name]}]" if name in units else name for name in names]
        text = "\n".join(",".join(str(value) for value in row) for row in [heads, *rows])
        return text, {"columns": names, "units": units, "rows": rows, "of": len(table)}

    def _refuse_files(self, vary: Sequence[str]) -> None:
        """Tables vary over files: not outside of the root."""
        for text in vary:
            for value in text.partition("=")[2].split(","):
                if value.strip().startswith("/") or ".." in value:
                    raise ValueError(f"`{value}` is no file below the folder of --root")

    def find(self, arguments: Json) -> Answer:
        options = pick(arguments, "statics", "runs", "until", "tolerance", "method", "step")
        found = self.model(arguments).find(arguments["question"], **options)
        return str(found), json.loads(found.json())


def tool(name: str, description: str, properties: Json, *required: str) -> Json:
    return {"name": name, "description": description, "annotations": {"readOnlyHint": True, "openWorldHint": False},
            "inputSchema": {"type": "object", "properties": properties, "required": list(required), "additionalProperties": False}}


def tools() -> List[Json]:
    """The tools as tools/list has them."""
    return [
        tool("language", "The model language in 4,000 words. Read it before writing a model.", {}),
        tool("example", "Models to start from: their names, or the text of one.", {"name": {**TEXT, "description": "as listed"}}),
        tool("check", "All errors and warnings of a model and its start, with line, column, hint and, where it is known, a fix as an edit.",
             MODEL, "model"),
        tool("run", "Simulate a model: report, final state, events, forces and works, energies, cost; columns over time if asked for.",
             {**MODEL, **RUN,
              "accuracy": {**NUMBER, "description": "global error to be reached, relative to the size of the motion"},
              "error_bars": {**FLAG, "description": "estimate the error of every number"},
              "ledger": {**FLAG, "description": "columns of forces, works and energies"},
              "columns": {**TEXTS, "description": 'columns over time: ["block.x", "block.v"]'},
              "rows": {"type": "integer", "description": f"at most so many rows of them, up to {MOST_ROWS}; default 50"},
              "every": {**NUMBER, "description": "interval of the rows [s]"}}, "model"),
        tool("equations", "The assembled equations of motion, term by term, as numbers, symbols or LaTeX.",
             {**MODEL, **STATE, "form": {**TEXT, "enum": ["numbers", "symbols", "latex"]},
              "components": {**FLAG, "description": "with the equations of every body cut free"}}, "model"),
        tool("check_derivation", "Compare equations derived by hand with the assembled ones at some 300 random states; says which line differs, and in which term.",
             {**MODEL, "hand": {"type": "object", "additionalProperties": TEXTS,
                                "description": 'lines for each body: {"block": ["m*a = T - f", "N - m*g = 0"]}; default those of the file'},
              "seed": {"type": "integer", "description": "of the random states"}}, "model"),
        tool("grade", "Compare a student's answer, a model text, with a key by mechanics.",
             {"key": {**TEXT, "description": "the teacher's model, with `grading`"}, "answer": {**TEXT, "description": "the student's model"},
              "student": {**TEXT, "description": "the name that individual values are drawn for"},
              "details": {**FLAG, "description": "with findings that name forces of the key"}, "parameters": MODEL["parameters"]},
             "key", "answer", "student"),
        tool("draw", "The free-body diagrams at a state as SVG.",
             {**MODEL, **STATE, "body": {**TEXT, "description": "of this body alone"}, "components": FLAG, "supports": FLAG,
              "symbols": {**FLAG, "description": "letters instead of values"}, "worksheet": FLAG, "solution": FLAG,
              "scale": {**NUMBER, "description": "10 mm stand for this force"}}, "model"),
        tool("statics", "The reactions that hold the scene at rest, the utilisation of friction, what is undetermined.",
             {**MODEL, **STATE, "settle": {**FLAG, "description": "first find the equilibrium where it comes to rest"}}, "model"),
        tool("linearize", "Equilibrium near a state, matrix A, eigenvalues, frequencies and damping ratios.", {**MODEL, **STATE}, "model"),
        tool("sweep", "Run a model for many values of its parameters; a row for each run.",
             {**MODEL, **pick(RUN, "until", "tolerance", "method", "step"),
              "vary": {**TEXTS, "description": '["mu=0.1:0.6:51"], ["v0=1,2,5"], ["m=normal(2,0.1) kg:100"]'},
              "outputs": {**TEXTS, "description": '["block.x", "max(block.v)", "time(stick)"]'},
              "zip": {**FLAG, "description": "values side by side instead of every combination"}, "seed": {"type": "integer"}},
             "model", "vary"),
        tool("find", "The values of a parameter at which something slips, tips, lifts, or has a given result; with an error of each.",
             {**MODEL, **pick(RUN, "until", "tolerance", "method", "step"),
              "question": {**TEXT, "description": '"P = 0..40 N: crate tips", "F: block.x = 0.5 m"; without a range, that of the file'},
              "statics": {**FLAG, "description": "of the scene at rest at its start"},
              "runs": {"type": "integer", "description": "of the first scan; default 33"}}, "model", "question"),
    ]


# ---- the server


def default_models() -> Optional[Path]:
    """The folder of the models that are installed with fbd, if there is one."""
    for prefix in (sysconfig.get_path("data"), "/usr/local", "/usr"):
        folder = Path(prefix) / "share/fbd/models"
        if folder.is_dir():
            return folder
    return None


class Mcp(Server):
    """The protocol: methods and resources."""

    def __init__(self, source: Any, sink: Any, *, root: Optional[str], models: Optional[Path], seconds: float):
        super().__init__(source, sink)
        self.tools, self.models, self.seconds = Tools(root), models, seconds
        self.listed = {each["name"]: each for each in tools()}
        self.methods = {
            "initialize": self.initialize, "ping": lambda params: {}, "tools/list": lambda params: {"tools": list(self.listed.values())},
            "tools/call": self.call_tool, "resources/list": self.list_resources, "resources/read": self.read_resource,
            "resources/templates/list": lambda params: {"resourceTemplates": []},
            "notifications/initialized": lambda params: None, "notifications/cancelled": lambda params: None,
        }

    def initialize(self, params: Json) -> Json:
        asked = params.get("protocolVersion")
        return {"protocolVersion": asked if asked in PROTOCOLS else PROTOCOLS[0],
                "capabilities": {"tools": {}, "resources": {}},
                "serverInfo": {"name": "fbd-mcp", "title": "fbd: free-body diagrams that run", "version": __version__},
                "instructions": INSTRUCTIONS}

    # ---- resources

    def language(self) -> Optional[Path]:
        path = Path(__file__).with_name("llms.txt")
        return path if path.is_file() else None

    def examples(self) -> Dict[str, Path]:
        """The models of the folder, by their paths in it."""
        if self.models is None:
            return {}
        return {path.relative_to(self.models).as_posix(): path for path in sorted(self.models.rglob("*.yaml"))}

    def list_resources(self, params: Json) -> Json:
        listed = [{"uri": "fbd://schema", "name": "JSON Schema of the model language", "mimeType": "application/json"}]
        if self.language():
            listed.insert(0, {"uri": "fbd://language", "name": "the model language in 4,000 words", "mimeType": "text/markdown"})
        listed += [{"uri": f"fbd://models/{name}", "name": name, "mimeType": "application/yaml"} for name in self.examples()]
        return {"resources": listed}

    def read_resource(self, params: Json) -> Json:
        uri = params.get("uri")
        if not isinstance(uri, str):
            raise RpcError(INVALID_PARAMS, "`uri` must be a text")
        kind, text = "application/yaml", None
        language, example = self.language(), self.examples().get(uri.removeprefix("fbd://models/"))
        if uri == "fbd://schema":
            kind, text = "application/json", schema()
        elif uri == "fbd://language" and language:
            kind, text = "text/markdown", language.read_text(encoding="utf-8")
        elif uri.startswith("fbd://models/") and example:
            text = example.read_text(encoding="utf-8")
        if text is None:
            raise RpcError(RESOURCE_NOT_FOUND, f"there is no resource {uri}", {"uri": uri})
        return {"contents": [{"uri": uri, "mimeType": kind, "text": text}]}

    # ---- tools

    def call_tool(self, params: Json) -> Json:
        name, arguments = str(params.get("name")), params.get("arguments") or {}
        if name not in self.listed:
            raise RpcError(INVALID_PARAMS, f"there is no tool `{name}`; there are {', '.join(self.listed)}")
        validate(arguments, self.listed[name]["inputSchema"], f"`{name}`")
        if name in ("language", "example"):
            return self.read_tool(name, arguments)
        try:
            answer = bounded(lambda: self.work(name, arguments), self.seconds)
        except TooLong:
            return failed(f"`{name}` took more than {self.seconds:g} s and was ended: a shorter `until`, fewer runs or a larger "
                          "tolerance take less time", "too-long")
        except Crashed as crash:
            return failed(f"`{name}`: {crash}", "crashed")
        return shown(answer)

    def work(self, name: str, arguments: Json) -> Json:
        """In the process of the call."""
        if self.tools.root is None:
            without_files()
        texts = [arguments[key] for key in ("model", "key", "answer") if key in arguments]
        files_refused(texts, self.tools.name, self.tools.root, arguments.get("parameters", {}))
        text, data = getattr(Tools, name)(self.tools, arguments)
        return {"text": text, "data": data}

    def read_tool(self, name: str, arguments: Json) -> Json:
        language, examples, wanted = self.language(), self.examples(), arguments.get("name")
        if name == "language":
            text = language.read_text(encoding="utf-8") if language else schema()
        elif wanted is None:
            text = "\n".join(examples) or "no models are installed"
        elif wanted in examples:
            text = examples[wanted].read_text(encoding="utf-8")
        else:
            return failed(f"there is no example `{wanted}`", "unknown-example")
        return {"content": [{"type": "text", "text": text}], "isError": False}


def failed(text: str, code: str) -> Json:
    note = {"severity": "error", "id": code, "message": text}
    return {"content": [{"type": "text", "text": text}], "structuredContent": {"notes": [note]}, "isError": True}


def shown(answer: Json) -> Json:
    """The result of a tool."""
    warned = answer["warnings"]
    text = "".join(f"warning: {note['message']} [{note['id']}]\n" for note in warned)
    if "value" not in answer:
        return {"content": [{"type": "text", "text": text + answer["text"]}],
                "structuredContent": {"notes": answer["notes"] or [{"severity": "error", "id": "bad-argument", "message": answer["text"]}],
                                      "warnings": warned}, "isError": True}
    data = {**answer["value"]["data"], **({"warnings": warned} if warned else {})}
    return {"content": [{"type": "text", "text": text + answer["value"]["text"]}], "structuredContent": data,
            "isError": data.get("outcome") == "failed"}


def options(arguments: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="fbd-mcp", description="A server of the Model Context Protocol for fbd, over standard input and output.")
    parser.add_argument("--root", metavar="FOLDER", help="models may read data files below this folder; without it none")
    parser.add_argument("--models", metavar="FOLDER", type=Path, help="examples to offer; default those that are installed")
    parser.add_argument("--seconds", metavar="NUMBER", type=float, default=60, help="limit of a call (default: 60)")
    parser.add_argument("--version", action="version", version=f"fbd-mcp {text_at(lib.fbd_version())}")
    return parser.parse_args(arguments)


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Serve until standard input ends."""
    chosen = options(arguments)
    if chosen.root and not os.path.isdir(chosen.root):
        print(f"fbd-mcp: there is no folder `{chosen.root}`", file=sys.stderr)
        return 2
    sink = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever else is printed is not the protocol's
    models = chosen.models or default_models()
    server = Mcp(sys.stdin.buffer, sink, root=chosen.root, models=models, seconds=chosen.seconds)
    try:
        server.serve()
    except (BrokenPipeError, KeyboardInterrupt):
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())

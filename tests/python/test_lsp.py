# SPDX-License-Identifier: GPL-3.0-or-later
"""fbd-lsp, by a client that speaks the protocol."""
import io
import json
import subprocess
import sys

import pytest
from conftest import INCLINE, SOURCE
from fbd import lsp
from fbd._json_rpc import read_framed

URI = "file:///nowhere/model.yaml"


def framed(message):
    body = json.dumps({"jsonrpc": "2.0", **message}).encode()
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


def session(text, *requests):
    """Diagnostics of the text, and the results of the requests on it."""
    messages = [{"id": "first", "method": "initialize", "params": {"capabilities": {}}}, {"method": "initialized", "params": {}},
                {"method": "textDocument/didOpen", "params": {"textDocument": {"uri": URI, "languageId": "yaml", "version": 1, "text": text}}}]
    for i, (method, params) in enumerate(requests):
        messages.append({"id": i, "method": method, "params": {"textDocument": {"uri": URI}, **params}})
    messages += [{"id": "last", "method": "shutdown"}, {"method": "exit"}]
    done = subprocess.run([sys.executable, "-m", "fbd.lsp", "--stdio"], input=b"".join(map(framed, messages)),
                          stdout=subprocess.PIPE, check=True, timeout=600)
    stream, answers, diagnostics = io.BytesIO(done.stdout), {}, None
    for body in iter(lambda: read_framed(stream), None):
        message = json.loads(body)
        if message.get("method") == "textDocument/publishDiagnostics":
            diagnostics = message["params"]["diagnostics"]
        elif "id" in message:
            answers[message["id"]] = message.get("result", message.get("error"))
    assert stream.read() == b"" and answers["first"]["capabilities"]["hoverProvider"] and answers["last"] is None
    return diagnostics, [answers[i] for i in range(len(requests))]


def within(text, place):
    """The text of a range, whose characters are UTF-16 units."""
    start, end = place["start"], place["end"]
    assert start["line"] == end["line"]
    line = text.split("\n")[start["line"]].encode("utf-16-le")
    return line[2 * start["character"]:2 * end["character"]].decode("utf-16-le")


def after(text, marker):
    """The position behind a marker."""
    before = text[:text.index(marker) + len(marker)].split("\n")
    return {"position": {"line": len(before) - 1, "character": len(before[-1].encode("utf-16-le")) // 2}}


def labels(answer):
    return {item["label"] for item in answer}


def test_diagnostics_and_quick_fixes():
    text = 'fbd: 1\nbodies: {b: {description: "\U0001d70b", mas: 1 kg, motion: slidee, forces: []}}\nsimulate: {until: 1 s}\n'
    everywhere = {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}}
    diagnostics, (actions,) = session(text, ("textDocument/codeAction", {"range": everywhere, "context": {"diagnostics": []}}))
    assert {within(text, each["range"]) for each in diagnostics} >= {"mas", "slidee"}
    assert all(each["source"] == "fbd" and each["code"] for each in diagnostics)
    edits = [action["edit"]["changes"][URI][0] for action in actions]
    assert {(within(text, edit["range"]), edit["newText"]) for edit in edits} == {("mas", "mass"), ("slidee", "slide")}


def test_a_right_model_has_no_diagnostics():
    assert session(INCLINE.read_text())[0] == []


UNFINISHED = """fbd: 1
parameters: {mu: 0.3, m0: 2 kg}
bodies:
  block:
    mass: 2 kg
    mo
    forces:
      - gravity
      - {friction: {sta
  ball: {mass: m0, motion: {pivot: {at: [0, 0]}}, shape: disc, radius: 10 c
couplings:
  - pin: {between: [bl
simulate: {until: 1 s, method: rk
"""


@pytest.mark.parametrize("text, notes", [("services:\n  web: {image: x}\n", 0), ("", 0), ("fbd: 1\n", 1), ('{"bodies": {}}', 2)])
def test_a_file_that_is_no_model_has_no_diagnostics(text, notes):
    assert len(session(text)[0]) == notes


def test_completion_in_an_unfinished_text():
    at = ["    mo", "{sta", "10 c", "[bl", "method: rk", "mass: m0", "fbd: 1\n"]
    _, answers = session(UNFINISHED, *(("textDocument/completion", after(UNFINISHED, marker)) for marker in at))
    key, friction, unit, body, method, value, top = map(labels, answers)
    assert "motion" in key and "mass" not in key
    assert "static" in friction and "kinetic" in friction
    assert "cm" in unit and {"block", "ball"} <= body and "rk8pd" in method
    assert {"mu", "m0"} <= value and "ground" in top and "bodies" not in value


def test_hover_describes_keys():
    at = ["    mass", "{friction", "simulate: {until", "  - pin"]
    _, answers = session(UNFINISHED, *(("textDocument/hover", after(UNFINISHED, marker)) for marker in at))
    for answer in answers:
        assert len(answer["contents"]["value"]) > 5


def test_symbols_are_bodies_and_parameters():
    text = INCLINE.read_text()
    _, (symbols,) = session(text, ("textDocument/documentSymbol", {}))
    names = [symbol["name"] for symbol in symbols]
    assert "block" in names and "phi" in names
    assert all(within(text, symbol["range"]) == symbol["name"] for symbol in symbols)


def test_requests_without_a_document_are_errors():
    _, (answer,) = session("", ("textDocument/hover", {"textDocument": {"uri": "file:///other"}, "position": {"line": 0, "character": 0}}))
    assert answer["code"] == -32602


@pytest.mark.parametrize("folder", ["bad", "schema"])
def test_the_path_is_found_at_every_place_of_every_text(folder):
    """Whatever is in a file: no exception, and names that are in it."""
    server = lsp.Lsp(io.BytesIO(), io.BytesIO())
    for path in sorted((SOURCE / "tests" / folder).glob("*.yaml"))[::40]:
        text = path.read_bytes().decode("utf-8", "replace").replace("\r", "")
        server.take(URI, text)
        lines = text.split("\n")
        for line, row in enumerate(lines):
            for character in range(0, len(row) + 1, 7):
                place = lsp.place_at(text, line, character)
                assert all(key in text for key in place.path)
                server.complete({"textDocument": {"uri": URI}, "position": {"line": line, "character": character}})


def test_the_path_in_a_model_is_that_of_its_schema():
    """Each key of a right model is one that is offered at its place."""
    language = lsp.Language()
    for name in ("kinetics/incline.yaml", "couplings/four_bar.yaml", "statics/ladder.yaml"):
        text = (SOURCE / "models" / name).read_text()
        for line, row in enumerate(text.split("\n")):
            found = lsp.KEY.match(lsp.without_comment(row).strip().removeprefix("- "))
            if not found:
                continue
            at = len(row) - len(row.lstrip(" -"))
            place = lsp.place_at(text, line, at + found.end())
            assert place.in_value and lsp.name_of(found) == place.path[-1]
            if place.path[:-1] not in (("bodies",), ("parameters",), ("ground", "points"), ("ground", "lines")):
                assert language.at(place.path), place

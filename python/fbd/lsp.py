# SPDX-License-Identifier: GPL-3.0-or-later
"""fbd-lsp: a language server for model files over standard input and output (docs/machines.md).

Diagnostics are the notes of the library, quick fixes their edits. Completion and hover follow the JSON Schema of the language by
the path of keys at the cursor, which is found from indentation and brackets, so that a text need not be complete.
"""
from __future__ import annotations

import argparse
import json
import os
import re
import sys
from typing import Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple
from urllib.parse import unquote, urlparse

from . import __version__, schema
from ._json_rpc import INVALID_PARAMS, Json, RpcError, Server, read_framed, write_framed
from ._model import check
from ._notes import Note

# A file in YAML that is meant as a model.
MODEL = re.compile(r"""(?:^|[{,])\s*["']?(?:fbd|bodies)["']?\s*:""", re.MULTILINE)
UNITS = ("m", "cm", "mm", "km", "ft", "in", "kg", "g", "t", "lbm", "slug", "s", "ms", "min", "h", "N", "kN", "lbf", "kip", "J", "kJ", "W",
         "kW", "hp", "Pa", "kPa", "MPa", "psi", "rad", "deg", "rev", "rpm", "Hz", "m/s", "m/s^2", "rad/s", "N/m", "N*m", "N*s/m", "kg*m^2")
KEYWORD, VALUE, BODY, PARAMETER, UNIT = 10, 12, 7, 6, 11  # kinds of completion items of the protocol

# ---- places: the protocol counts UTF-16 units from 0, the library characters from 1


def to_units(line: str, at: int) -> int:
    return len(line[:at].encode("utf-16-le", "surrogatepass")) // 2


def from_units(line: str, units: int) -> int:
    seen = 0
    for i, c in enumerate(line):
        if seen >= units:
            return i
        seen += 2 if ord(c) > 0xFFFF else 1
    return len(line)


def span(lines: Sequence[str], line: int, start: int, end: int) -> Json:
    """A range in one line, from characters."""
    text = lines[line] if line < len(lines) else ""
    return {"start": {"line": line, "character": to_units(text, start)}, "end": {"line": line, "character": to_units(text, end)}}


def word_at(line: str, at: int) -> Tuple[int, int]:
    """The word that begins at a character, at least one character."""
    found = re.compile(r"[\w.]+|[^\s,{}\[\]]+").match(line, at)
    return at, found.end() if found else min(at + 1, max(len(line), at))


# ---- the path of keys at a place

KEY = re.compile(r"""(?:"([^"]*)"|'([^']*)'|([^\s"'{}\[\],:#][^{}\[\],:#]*?))\s*:(?=\s|$)""")


class Place(NamedTuple):
    """Where the cursor is: the keys above it, those beside it, and whether a value or a key is being written."""

    path: Tuple[str, ...]
    siblings: Tuple[str, ...]
    in_value: bool  #: behind the last key of the path
    word: str  #: what is written so far


def without_comment(line: str) -> str:
    return re.sub(r"(^|\s)#.*$", r"\1", line)


def key_of(text: str) -> Optional["re.Match[str]"]:
    return KEY.match(text)


def name_of(match: "re.Match[str]") -> str:
    return next(group for group in match.groups() if group is not None)


class Level(NamedTuple):
    """A mapping or list that is open at the cursor: the indentation of its keys, its key in the mapping above, its own keys."""

    indent: int
    key: Optional[str]
    keys: List[str]


def block_levels(lines: Sequence[str]) -> Tuple[List[Level], str, int]:
    """The open levels of block style before the last line's content; that content, and its indentation."""
    levels: List[Level] = [Level(-1, None, [])]
    pending: Optional[str] = None
    content, indent = "", 0
    for number, raw in enumerate(lines):
        line = without_comment(raw)
        last = number == len(lines) - 1
        if not line.strip() and not last:
            continue
        indent = len(line) - len(line.lstrip(" "))
        content = line[indent:]
        if last and not content:
            # an empty line: the cursor's column says where one is
            levels = [levels[0]] + [level for level in levels[1:] if level.indent <= indent]
            deepest = levels[-1]
            if pending is not None and indent > deepest.indent:
                levels.append(Level(indent, pending, []))
            return levels, "", indent
        while len(levels) > 1 and (levels[-1].indent > indent or (levels[-1].indent == indent and content.startswith("- ") is False
                                                                  and levels[-1].key == "-" and levels[-1].keys == [])):
            levels.pop()
        if levels[-1].indent < indent and not (content.startswith("-") and levels[-1].indent == indent):
            levels.append(Level(indent, pending, []))
        pending = None
        while content.startswith("- ") or content == "-":
            shift = len(content) - len(content[1:].lstrip(" "))
            if levels[-1].indent == indent and pending is None and levels[-1].keys and levels[-1].key != "-":
                levels.append(Level(indent, levels[-1].keys[-1], []))  # a list in the column of its key
            indent, content = indent + shift, content[shift:]
            levels.append(Level(indent, "-", []))
        match = key_of(content)
        if match:
            levels[-1].keys.append(name_of(match))
            rest = content[match.end():].strip()
            if last:
                return levels, content, indent
            if not rest:
                pending = levels[-1].keys[-1]
        elif last:
            return levels, content, indent
    return levels, content, indent


def flow_steps(text: str) -> Tuple[List[Level], str]:
    """The levels of braces and brackets that are open at the end of a text, and what stands behind the last separator."""
    levels: List[Level] = []
    piece, quote = "", ""
    for c in text:
        if quote:
            quote = "" if c == quote else quote
            piece += c
        elif c in "\"'":
            quote = c
            piece += c
        elif c in "{[":
            match = key_of(piece.strip())
            key = name_of(match) if match else "-"
            if levels and match:
                levels[-1].keys.append(key)
            levels.append(Level(0, key if match or c == "{" else "-", []))
            if c == "[":
                levels.append(Level(0, "-", []))
            piece = ""
        elif c in "}]":
            if c == "]" and levels:
                levels.pop()
            if levels:
                levels.pop()
            piece = ""
        elif c == ",":
            match = key_of(piece.strip())
            if levels and match:
                levels[-1].keys.append(name_of(match))
            piece = ""
        else:
            piece += c
    return levels, piece


def open_start(lines: Sequence[str]) -> int:
    """The line in which the flow style begins that is open at the end; the last one without."""
    depth, first = 0, len(lines) - 1
    for number, raw in enumerate(lines):
        if KEY.match(raw):  # at the margin: what was open above has been left unfinished
            depth, first = 0, number
        for c in re.sub(r"\"[^\"]*\"|'[^']*'", "", without_comment(raw)):
            if c in "{[":
                if depth == 0:
                    first = number
                depth += 1
            elif c in "}]":
                depth = max(0, depth - 1)
        if depth == 0:
            first = len(lines) - 1
    return first


def place_at(text: str, line: int, character: int) -> Place:
    """The path of keys at line and character, from 0."""
    lines = text.split("\n")[:line + 1]
    lines[-1] = lines[-1][:character]
    first = open_start(lines)
    head = lines[:first] + [lines[first]]
    levels, content, _ = block_levels(head)
    tail = "\n".join([content, *(without_comment(each).strip() for each in lines[first + 1:])])
    path = [level.key for level in levels[1:] if level.key and level.key != "-"]
    siblings = list(levels[-1].keys)
    flow, piece = flow_steps(tail)
    match = key_of(content)
    for level in flow:
        if level.key and level.key != "-":
            path.append(level.key)
        siblings = level.keys
    if flow and match and not (flow[0].key and flow[0].key == name_of(match)):
        path.insert(len(path) - sum(1 for level in flow if level.key and level.key != "-"), name_of(match))
    piece = piece.lstrip() if flow else content
    match = key_of(piece)
    if match:
        return Place((*path, name_of(match)), tuple(siblings), True, piece[match.end():].strip())
    return Place(tuple(path), tuple(siblings), False, piece.strip().removeprefix("- ").strip())


# ---- the schema


class Language:
    """The JSON Schema of the language, followed by paths."""

    def __init__(self) -> None:
        self.root: Json = json.loads(schema())

    def _resolved(self, node: Json) -> Iterator[Json]:
        """The node and all that it refers to or chooses from."""
        yield node
        if "$ref" in node:
            yield from self._resolved(self.root["definitions"][node["$ref"].rpartition("/")[2]])
        for word in ("anyOf", "allOf", "oneOf"):
            for each in node.get(word, []):
                yield from self._resolved(each)
        if isinstance(node.get("items"), dict):  # a list is written through: its entries stand in the path of its key
            yield from self._resolved(node["items"])

    def at(self, path: Sequence[str]) -> List[Json]:
        """The nodes of the schema for the value at a path."""
        nodes = [self.root]
        for key in path:
            nodes = [found for node in nodes for each in self._resolved(node) for found in self._member(each, key)]
        return nodes

    def _member(self, node: Json, key: str) -> Iterator[Json]:
        properties, others = node.get("properties", {}), node.get("additionalProperties")
        if key in properties:
            yield properties[key]
        elif isinstance(others, dict):
            yield others

    def keys(self, path: Sequence[str]) -> Dict[str, Json]:
        """The keys that may stand at a path."""
        found: Dict[str, Json] = {}
        for node in self.at(path):
            for each in self._resolved(node):
                for key, value in each.get("properties", {}).items():
                    found.setdefault(key, value)
        return found

    def words(self, path: Sequence[str]) -> List[str]:
        """The words that a value at a path may be."""
        found: List[str] = []
        for node in self.at(path):
            for each in self._resolved(node):
                found += [word for word in each.get("enum", []) if isinstance(word, str)]
                found += ["true", "false"] if each.get("type") == "boolean" else []
                found += [word for word in each.get("examples", []) if isinstance(word, str)]
        return list(dict.fromkeys(found))

    def describe(self, node: Json) -> str:
        for each in self._resolved(node):
            if "description" in each:
                return str(each["description"])
        return ""

    def details(self, node: Json) -> str:
        """Description, default and examples."""
        parts = [self.describe(node)]
        for each in self._resolved(node):
            if "default" in each and "default" not in parts[0]:
                parts.append(f"default: {each['default']}")
                break
        examples = [str(word) for each in self._resolved(node) for word in each.get("examples", [])]
        if examples:
            parts.append("for example " + ", ".join(f"`{word}`" for word in dict.fromkeys(examples)))
        words = [f"`{word}`" for each in self._resolved(node) for word in each.get("enum", [])]
        if words:
            parts.append("one of " + ", ".join(dict.fromkeys(words)))
        return "\n\n".join(part for part in parts if part)


# ---- names of the document


def names_under(text: str, section: str) -> List[Tuple[str, int, int]]:
    """The keys of a section at the top of the text, in either style, with line and character from 0."""
    found: List[Tuple[str, int, int]] = []
    inside, indent, depth = False, 0, 0
    for number, raw in enumerate(text.split("\n")):
        line = without_comment(raw)
        if not line.strip():
            continue
        at = len(line) - len(line.lstrip(" "))
        if key_of(line[at:]) and (at == 0 or at == indent):
            depth = 0  # what was open above has been left unfinished
        if at == 0 and depth == 0:
            match = key_of(line)
            inside = bool(match and name_of(match) == section)
            indent = 0
            if not inside or not match:
                continue
            at = match.end()
        elif not inside:
            continue
        elif depth == 0:
            indent = indent or at
            match = key_of(line[at:])
            if match and at == indent:
                found.append((name_of(match), number, at))
                at += match.end()
            depth = _flow_names(line, at, 1, number, found, -1)
            depth = max(0, depth - 1)
            continue
        depth = _flow_names(line, at, depth, number, found, 1)
    return found


def _flow_names(line: str, at: int, depth: int, number: int, found: List[Tuple[str, int, int]], wanted: int) -> int:
    """Add keys at a depth of braces; the depth at the end of the line."""
    begins = depth == wanted
    while at < len(line):
        match = key_of(line[at:]) if begins and depth == wanted else None
        if match and not line[at].isspace():
            found.append((name_of(match), number, at))
            at += match.end()
            begins = False
            continue
        c = line[at]
        depth += (c in "{[") - (c in "}]")
        begins = c in "{," or (begins and c.isspace())
        at += 1
    return depth


# ---- the server


def path_of(uri: str) -> str:
    """The path of a document; the name of one that is not saved."""
    parts = urlparse(uri)
    return unquote(parts.path) if parts.scheme == "file" else "model.yaml"


class Lsp(Server):
    """Documents and what is asked about them."""

    read = staticmethod(read_framed)
    write = staticmethod(write_framed)

    def __init__(self, source: Any, sink: Any):
        super().__init__(source, sink)
        self.texts: Dict[str, str] = {}
        self.notes: Dict[str, Tuple[Note, ...]] = {}
        self.language = Language()
        self.shut = False
        self.methods = {
            "initialize": self.initialize, "initialized": lambda params: None, "shutdown": self.shutdown, "exit": self.exit,
            "textDocument/didOpen": self.opened, "textDocument/didChange": self.changed, "textDocument/didSave": lambda params: None,
            "textDocument/didClose": self.closed, "textDocument/codeAction": self.actions, "textDocument/completion": self.complete,
            "textDocument/hover": self.hover, "textDocument/documentSymbol": self.symbols,
            "$/cancelRequest": lambda params: None, "$/setTrace": lambda params: None,
            "workspace/didChangeConfiguration": lambda params: None,
        }

    def initialize(self, params: Json) -> Json:
        return {"capabilities": {
            "textDocumentSync": {"openClose": True, "change": 1},
            "codeActionProvider": {"codeActionKinds": ["quickfix"]},
            "completionProvider": {"triggerCharacters": [" ", "{", ".", "["]},
            "hoverProvider": True, "documentSymbolProvider": True},
            "serverInfo": {"name": "fbd-lsp", "version": __version__}}

    def shutdown(self, params: Json) -> None:
        self.shut = True

    def exit(self, params: Json) -> None:
        self.going = False

    def text(self, params: Json) -> Tuple[str, str]:
        """The document of a request: its address and text."""
        document = params.get("textDocument")
        uri = document.get("uri") if isinstance(document, dict) else None
        if not isinstance(uri, str) or uri not in self.texts:
            raise RpcError(INVALID_PARAMS, f"the document {uri} is not open" if isinstance(uri, str) else "there is no `textDocument` with a `uri`")
        return uri, self.texts[uri]

    def position(self, params: Json) -> Tuple[str, int, int]:
        """Text, line, and character of the cursor."""
        _, text = self.text(params)
        place, lines = params.get("position", {}), text.split("\n")
        line = min(int(place.get("line", 0)), len(lines) - 1)
        return text, line, from_units(lines[line], int(place.get("character", 0)))

    # ---- documents

    def opened(self, params: Json) -> None:
        document = params["textDocument"]
        self.take(document["uri"], document["text"])

    def changed(self, params: Json) -> None:
        uri, _ = self.text(params)
        self.take(uri, params["contentChanges"][-1]["text"])

    def closed(self, params: Json) -> None:
        uri, _ = self.text(params)
        del self.texts[uri], self.notes[uri]
        self.notify("textDocument/publishDiagnostics", {"uri": uri, "diagnostics": []})

    def take(self, uri: str, text: str) -> None:
        self.texts[uri] = text
        path = path_of(uri)
        notes = check(text.replace("\0", "\ufffd"), path) if MODEL.search(text) else ()
        self.notes[uri] = tuple(note for note in notes if note.file in (path, None))
        self.notify("textDocument/publishDiagnostics", {"uri": uri, "diagnostics": [self.diagnostic(uri, note) for note in self.notes[uri]]})

    def diagnostic(self, uri: str, note: Note) -> Json:
        lines = self.texts[uri].split("\n")
        line, at = max(note.line - 1, 0), max(note.column - 1, 0)
        start, end = word_at(lines[line] if line < len(lines) else "", at)
        if note.fix:
            line, start = note.fix.line - 1, note.fix.column - 1
            end = start + len(note.fix.replace)
        message = note.message + (f"\nhint: {note.hint}" if note.hint else "") + (f"\nsee: {note.see}" if note.see else "")
        return {"range": span(lines, line, start, end), "severity": 1 if note.severity == "error" else 2, "code": note.id,
                "source": "fbd", "message": message}

    # ---- what is asked

    def actions(self, params: Json) -> List[Json]:
        uri, text = self.text(params)
        lines, wanted, actions = text.split("\n"), params.get("range", {}), []
        first, last = wanted.get("start", {}).get("line", 0), wanted.get("end", {}).get("line", len(lines))
        for note in self.notes[uri]:
            if not note.fix or not first <= note.fix.line - 1 <= last:
                continue
            start = note.fix.column - 1
            edit = {"range": span(lines, note.fix.line - 1, start, start + len(note.fix.replace)), "newText": note.fix.to}
            actions.append({"title": f"write `{note.fix.to}`", "kind": "quickfix", "diagnostics": [self.diagnostic(uri, note)],
                            "isPreferred": True, "edit": {"changes": {uri: [edit]}}})
        return actions

    def complete(self, params: Json) -> List[Json]:
        text, line, at = self.position(params)
        place = place_at(text, line, at)
        items: List[Json] = []
        if not place.in_value:
            for key, node in self.language.keys(place.path).items():
                if key not in place.siblings:
                    items.append({"label": key, "kind": KEYWORD, "insertText": f"{key}: ", "detail": self.language.describe(node)})
        items += [{"label": word, "kind": VALUE} for word in self.language.words(place.path)]
        items += self.names(text, place)
        return items

    def names(self, text: str, place: Place) -> List[Json]:
        """Bodies and parameters of the document, and units behind a number."""
        if not place.in_value and self.language.keys(place.path) and place.path and place.path[-1] != "forces":
            return []
        if re.search(r"(?:^|[\s(*/+-])\d[\d.]*(?:\s+\S*)?$", place.word):
            return [{"label": unit, "kind": UNIT} for unit in UNITS]
        items = [{"label": name, "kind": BODY, "detail": "body"} for name, _, _ in names_under(text, "bodies")] if place.path else []
        return items + ([{"label": name, "kind": PARAMETER, "detail": "parameter"} for name, _, _ in names_under(text, "parameters")]
                        if place.in_value else [])

    def hover(self, params: Json) -> Optional[Json]:
        text, line, at = self.position(params)
        row = text.split("\n")[line]
        word = next((m for m in re.finditer(r"\w+", row) if m.start() <= at <= m.end()), None)
        if word is None:
            return None
        place = place_at(text, line, word.end())
        keys = self.language.keys(place.path if not place.in_value else place.path[:-1])
        node = keys.get(word.group())
        if node is None and place.in_value:
            node = self.language.keys(place.path).get(word.group()) or keys.get(place.path[-1])
        if node is None:
            return None
        lines = text.split("\n")
        return {"contents": {"kind": "markdown", "value": self.language.details(node) or f"`{word.group()}`"},
                "range": span(lines, line, word.start(), word.end())}

    def symbols(self, params: Json) -> List[Json]:
        _, text = self.text(params)
        lines, found = text.split("\n"), []
        for section, kind in (("parameters", 13), ("bodies", 5)):
            for name, line, at in names_under(text, section):
                place = span(lines, line, at, at + len(name))
                found.append({"name": name, "kind": kind, "detail": section, "range": place, "selectionRange": place})
        return found


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Serve until the client ends it."""
    parser = argparse.ArgumentParser(prog="fbd-lsp", description="A language server for model files of fbd, over standard input and output.")
    parser.add_argument("--stdio", action="store_true", help="as always: for clients that say so")
    parser.add_argument("--version", action="version", version=f"fbd-lsp {__version__}")
    parser.parse_args(arguments)
    sink = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever else is printed is not the protocol's
    server = Lsp(sys.stdin.buffer, sink)
    try:
        server.serve()
    except (BrokenPipeError, KeyboardInterrupt):
        pass
    return 0 if server.shut else 1


if __name__ == "__main__":
    sys.exit(main())

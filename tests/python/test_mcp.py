# SPDX-License-Identifier: GPL-3.0-or-later
"""fbd-mcp, by a client that speaks the protocol: one process for each test, all requests in its input."""
import json
import math
import os
import subprocess
import sys

import pytest
from conftest import INCLINE, MODELS, SOURCE

TEXT = INCLINE.read_text()
KEY = SOURCE / "tests/grade"


def session(messages, *options, raw=""):
    """Responses by id; everything on standard output is a message of the protocol."""
    lines = "".join(json.dumps({"jsonrpc": "2.0", **message}) + "\n" for message in messages)
    done = subprocess.run([sys.executable, "-m", "fbd.mcp", "--models", str(MODELS), *options], input=(raw + lines).encode(),
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True, timeout=600)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert all(answer["jsonrpc"] == "2.0" for answer in answers)
    return {answer["id"]: answer for answer in answers}


def calls(*wanted, options=()):
    """The results of tools, in their order."""
    messages = [{"id": i, "method": "tools/call", "params": {"name": name, "arguments": arguments}}
                for i, (name, arguments) in enumerate(wanted)]
    answers = session(messages, *options)
    return [answers[i].get("result", answers[i].get("error")) for i in range(len(wanted))]


def test_the_protocol_is_negotiated():
    answers = session([
        {"id": 1, "method": "initialize", "params": {"protocolVersion": "2024-11-05", "capabilities": {}}},
        {"method": "notifications/initialized"},
        {"id": 2, "method": "initialize", "params": {"protocolVersion": "1900-01-01"}},
        {"id": "three", "method": "ping"},
        {"id": 4, "method": "nothing/such"},
        {"id": 5, "method": "tools/call", "params": {"name": "nothing"}},
        {"id": 6, "method": "tools/call", "params": {"name": "check", "arguments": {}}},
        {"id": 7, "method": "tools/call", "params": {"name": "check", "arguments": {"model": 1}}},
        {"id": 8, "method": "resources/read", "params": {"uri": "fbd://models/none.yaml"}},
        {"id": 9, "method": "ping", "params": []},
    ], raw="{ no json\n\n[1]\n")
    assert answers[1]["result"]["protocolVersion"] == "2024-11-05"
    assert answers[2]["result"]["protocolVersion"] == "2025-06-18"
    assert answers["three"]["result"] == {}
    codes = {i: answers[i]["error"]["code"] for i in (4, 5, 6, 7, 8, 9)}
    assert codes == {4: -32601, 5: -32602, 6: -32602, 7: -32602, 8: -32002, 9: -32602}
    assert answers[None]["error"]["code"] in (-32700, -32600)


def test_tools_and_resources_are_listed():
    answers = session([{"id": 1, "method": "tools/list"}, {"id": 2, "method": "resources/list"},
                       {"id": 3, "method": "resources/read", "params": {"uri": "fbd://language"}},
                       {"id": 4, "method": "resources/read", "params": {"uri": "fbd://models/kinetics/incline.yaml"}}])
    tools = {tool["name"]: tool for tool in answers[1]["result"]["tools"]}
    assert {"check", "run", "equations", "check_derivation", "grade", "draw", "statics", "linearize", "sweep", "find"} <= set(tools)
    for tool in tools.values():
        assert tool["inputSchema"]["type"] == "object" and set(tool["inputSchema"]["required"]) <= set(tool["inputSchema"]["properties"])
    uris = {resource["uri"] for resource in answers[2]["result"]["resources"]}
    assert {"fbd://language", "fbd://schema", "fbd://models/kinetics/incline.yaml"} <= uris
    assert answers[3]["result"]["contents"][0]["text"] == (SOURCE / "docs/llms.txt").read_text()
    assert answers[4]["result"]["contents"][0]["text"] == TEXT


def test_a_wrong_model_is_mended_by_its_fixes():
    (wrong,) = calls(("check", {"model": TEXT.replace("forces:", "focres:")}))
    note = wrong["structuredContent"]["notes"][0]
    assert not wrong["structuredContent"]["valid"] and note["fix"]["with"] == "forces"
    lines = TEXT.replace("forces:", "focres:").split("\n")
    at, fix = note["fix"]["column"] - 1, note["fix"]
    row = lines[fix["line"] - 1]
    lines[fix["line"] - 1] = row[:at] + fix["with"] + row[at + len(fix["replace"]):]
    (right,) = calls(("check", {"model": "\n".join(lines)}))
    assert right["structuredContent"] == {"valid": True, "notes": []}


def test_numbers():
    run, equations, symbols, statics, sweep, svg, linear = calls(
        ("run", {"model": TEXT, "columns": ["block.x"], "rows": 3, "error_bars": True}),
        ("equations", {"model": TEXT, "values": {"block.v": 1}}),
        ("equations", {"model": TEXT, "form": "symbols"}),
        ("statics", {"model": TEXT}),
        ("sweep", {"model": TEXT, "vary": ["mu_k=0.1,0.2"], "outputs": ["block.x"]}),
        ("draw", {"model": TEXT, "symbols": True}),
        ("linearize", {"model": (MODELS / "rotation/simple_pendulum.yaml").read_text()}),
    )
    data = run["structuredContent"]
    assert data["outcome"] == "done" and data["table"]["columns"]["t"]["values"][-1] == 3
    assert len(data["table"]["columns"]["block.x"]["values"]) == 3 and "Final state" in run["content"][0]["text"]
    assert equations["structuredContent"]["equations"]["equations"][0]["body"] == "block"
    assert "m v_dot = " in symbols["content"][0]["text"]
    assert statics["structuredContent"]["equilibrium"] is True
    assert [row[1] for row in sweep["structuredContent"]["rows"]] == [0.1, 0.2]
    assert svg["structuredContent"]["svg"].startswith("<?xml")
    assert "A" in linear["structuredContent"] or "eigenvalues" in linear["content"][0]["text"].lower()


def test_a_value_is_found():
    question = {"model": TEXT, "parameters": {"f1": 0, "v0": 0}, "question": "mu_s = 0..1: block slips", "until": 1}
    found, unknown = calls(("find", question), ("find", {**question, "question": "nu = 0..1: block slips"}))
    (solution,) = found["structuredContent"]["solutions"]
    assert abs(solution["value"] - math.tan(math.pi / 6)) <= solution["error"] and "mu_s" in found["content"][0]["text"]
    assert unknown["isError"]


def test_a_derivation_is_judged_line_by_line():
    (answer,) = calls(("check_derivation", {"model": TEXT, "hand": {"block": ["N = m*g*cos(phi)", "N = m*g"]}}))
    assert answer["structuredContent"]["differing"] == 1
    assert [line["agrees"] for line in answer["structuredContent"]["lines"]] == [True, False]
    energy = "m*v^2/2 - m*v0^2/2 = work(friction) {} work(gravity) + work(push)"
    (run,) = calls(("check_derivation", {"model": TEXT, "hand": {"block": [energy.format("+"), energy.format("-")]}}))
    assert [line["agrees"] for line in run["structuredContent"]["lines"]] == [True, False]
    (unknown,) = calls(("check_derivation", {"model": TEXT, "hand": {"block": ["N = m*foo"]}}))
    assert unknown["isError"] and unknown["structuredContent"]["notes"][0]["id"] == "unknown-name"


def test_an_answer_is_graded():
    key = "\n".join(line for line in TEXT.split("\n")) + "\ngrading: {}\n"
    (grade,) = calls(("grade", {"key": key, "answer": TEXT, "student": "anna"}))
    assert not grade["isError"], grade["content"][0]["text"]
    assert grade["structuredContent"]["points"] > 0


def test_files_are_refused_by_name(tmp_path):
    (tmp_path / "data.csv").write_text("t [s],x [N]\n0,0\n1,1\n2,3\n")
    text = ("fbd: 1\ntables: {f: {file: data.csv, x: \"t [s]\", y: \"x [N]\"}}\nbodies: {a: {mass: 1 kg, motion: slide, "
            "forces: [{applied: {name: P, value: f(t)}}]}}\nsimulate: {until: 1 s}\n")
    (refused,) = calls(("check", {"model": text}))
    assert refused["isError"] and "data.csv" in refused["content"][0]["text"]
    assert refused["structuredContent"]["notes"][0]["id"] == "file-not-allowed"
    (allowed,) = calls(("check", {"model": text}), options=("--root", str(tmp_path)))
    assert "file-not-allowed" not in allowed["content"][0]["text"]
    for path in ("/etc/passwd", "../data.csv"):
        (outside,) = calls(("check", {"model": text.replace("data.csv", path)}), options=("--root", str(tmp_path)))
        assert outside["isError"] and path.rpartition("/")[2] in outside["content"][0]["text"]
        assert "root:" not in json.dumps(outside)


def test_a_long_run_is_ended_by_name():
    endless, after = calls(("run", {"model": TEXT, "until": 1e9, "step": 1e-7}), ("check", {"model": TEXT}), options=("--seconds", "1"))
    assert endless["isError"] and "`run` took more than 1 s" in endless["content"][0]["text"]
    assert after["structuredContent"]["valid"]


def test_a_run_that_fails_says_why():
    text = (SOURCE / "tests/cli/messages/weight_reaches_pulley.yaml").read_text()
    (run,) = calls(("run", {"model": text}))
    assert "rope" in json.dumps(run["structuredContent"])


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_arguments_that_no_tool_has_are_refused():
    (answer,) = calls(("run", {"model": TEXT, "untl": 1}))
    assert answer["code"] == -32602 and "untl" in answer["message"]
    (answer,) = calls(("run", {"model": TEXT, "columns": ["block.y"]}))
    assert answer["isError"] and "block.x" in answer["content"][0]["text"]

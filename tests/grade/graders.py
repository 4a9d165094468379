#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: graders.py FBD_RUN

The graders of examples/grading, put together as their documents say and run on right, wrong and hostile answers: what
they write has the fields that PrairieLearn, Gradescope and CodeRunner document. Prints TAP.
"""
import json
import os
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FBD_RUN = os.path.abspath(sys.argv[1])
EXAMPLES = Path(os.environ["FBD_SOURCE_ROOT"]) / "examples" / "grading"
ENVIRONMENT = {**os.environ, "PATH": f"{Path(FBD_RUN).parent}:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}
sys.dont_write_bytecode = True
RIGHT = ("[gravity, applied: {name: pull, value: P, angle: beta, at: right}, "
         "applied: {name: R, value: unknown, angle: unknown, at: left}]")
HAND = '["I_O*theta_ddot = -m*g*L/2*cos(theta) + P*L*sin(beta - theta)"]'
count = failed = 0


def check(claim, fact, shown=""):
    global count, failed
    count += 1
    failed += not fact
    print(f"{'ok' if fact else 'not ok'} {count} - {claim}", flush=True)
    if not fact:
        print("".join(f"# {line}\n" for line in str(shown).splitlines()), end="", flush=True)


def run(*command, code=0, **options):
    done = subprocess.run([str(word) for word in command], env={**ENVIRONMENT, **options.pop("env", {})}, text=True,
                          capture_output=True, check=False, **options)
    check(f"{Path(str(command[0])).name} ends with {code}", done.returncode == code, done.stdout + done.stderr)
    return done.stdout


def handout(student, *options):
    return subprocess.run([FBD_RUN, "--handout", f"--student={student}", *options, EXAMPLES / "key.yaml"], text=True,
                          capture_output=True, check=True).stdout


def right(sheet):
    filled = re.sub(r"(?m)^( +forces:)( \[\])?$", lambda found: f"{found[1]} {RIGHT}", sheet)
    return re.sub(r"(?m)^( +hand:)( \[\])?$", lambda found: f"{found[1]} {HAND}", filled)


def answers_of(sheet):
    """Answers by name: what is written, and a share of the points that they get, None where they are not graded."""
    good = right(sheet)
    return {"right": (good, 1), "half": (good.replace("value: P", "value: -P").replace(HAND, "[]"), 0.5), "sheet": (sheet, None),
            "empty": ("", None), "no model": ("- 1\n- 2\n", None), "no text": ("\x00\x01\ufffd", None),
            "quotes": (good.replace("title: A rod on a pin", "title: '\"\"\" {{ STUDENT }} \\ <script>'"), 1),
            "file": (good.replace("bodies:", "tables: {push: /etc/passwd}\nbodies:", 1), 1),
            "long": (good + "# long\n" * 200000, None)}


def is_worth(score, share):
    return abs(score - (share or 0)) < 1e-9


def prairielearn(folder):
    question = folder / "question"
    shutil.copytree(EXAMPLES / "prairielearn", question)
    for name in ("key.yaml", "grade_one.py"):
        shutil.copy(EXAMPLES / name, question / "tests")
    info = json.loads((question / "info.json").read_text())
    external = info["externalGradingOptions"]
    check("its info.json has what a question needs",
          {"uuid", "title", "topic", "type"} <= set(info) and info["type"] == "v3" and info["gradingMethod"] == "External"
          and external["enabled"] and not external["enableNetworking"] and external["timeout"] <= 600, info)
    data = {"variant_seed": 17, "options": {"question_path": str(question)}, "params": {}}
    runpy.run_path(str(question / "server.py"))["generate"](data)
    values, sheet = data["params"]["values"], data["params"]["sheet"]
    want = handout("x", *(f"--set={name}={value}" for name, value in values.items()))
    check("its sheet is that of the key", sheet.splitlines()[1:] == want.splitlines()[1:], sheet + want)
    page = (question / "question.html").read_text()
    check("its page has what is drawn", all(f"{{{{params.values.{name}}}}}" in page for name in values), page)
    grade = folder / "grade"
    shutil.copytree(question / "tests", grade / "tests")
    (grade / "data").mkdir()
    (grade / "data/data.json").write_text(json.dumps(data))
    (grade / "student").mkdir()
    for name, (text, share) in [*answers_of(sheet).items(), ("absent", (None, None))]:
        (grade / "student/answer.yaml").unlink(missing_ok=True)
        if text is not None:
            (grade / "student/answer.yaml").write_text(text)
        run(grade / "tests/run", env={"GRADE": str(grade)})
        result = json.loads((grade / "results/results.json").read_text())
        fields = ({"gradable", "score", "message", "tests"} <= set(result) and 0 <= result["score"] <= 1
                  and all({"name", "points", "max_points", "message"} <= set(test) for test in result["tests"])
                  and (result["gradable"] or result["format_errors"]))
        check(f"PrairieLearn, {name}", fields and result["gradable"] == (share is not None)
              and is_worth(result["score"], share), result)
    (grade / "student/answer.yaml").symlink_to(grade / "tests/key.yaml")
    run(grade / "tests/run", env={"GRADE": str(grade)})
    check("a link to the key is no answer", not json.loads((grade / "results/results.json").read_text())["gradable"])


def gradescope(folder):
    source = folder / "autograder" / "source"
    source.mkdir(parents=True)
    for path in (EXAMPLES / "gradescope/setup.sh", EXAMPLES / "gradescope/run_autograder", EXAMPLES / "key.yaml",
                 EXAMPLES / "grade_one.py"):
        shutil.copy(path, source)
    root = source.parent
    mail = "anna@example.org"
    (root / "submission_metadata.json").write_text(json.dumps({"id": 1, "users": [{"email": mail, "id": 2, "name": "A"}]}))
    answers = answers_of(handout(mail))
    for name in ("right", "half", "empty", "long"):
        text, share = answers[name]
        shutil.rmtree(root / "submission", ignore_errors=True)
        (root / "submission").mkdir()
        (root / "submission" / "my answer.yaml").write_text(text)
        run(source / "run_autograder", env={"AUTOGRADER": str(root)})
        result = json.loads((root / "results/results.json").read_text())
        fields = (result["score"] >= 0 and isinstance(result["output"], str) and result["visibility"] == "visible"
                  and result["stdout_visibility"] == "hidden" and result["output_format"] == "text"
                  and all({"name", "score", "max_score", "output", "status"} == set(test) for test in result["tests"])
                  and all(test["status"] in ("passed", "failed") for test in result["tests"]))
        check(f"Gradescope, {name}", fields and is_worth(result["score"] / 5, share), result)
    (root / "submission/second.yaml").write_text("fbd: 1\n")
    run(source / "run_autograder", env={"AUTOGRADER": str(root)})
    check("two files are none", "there are 2" in json.loads((root / "results/results.json").read_text())["output"])


def twig(template, values):
    """The two names that the template asks Twig for, escaped for a text of Python."""
    def value(match):
        return values[match[1]].replace("\\", "\\\\").replace('"', '\\"')
    text = re.sub(r"\{\{ ([A-Z_.a-z]+) \| e\('py'\) \}\}", value, template)
    return text


def coderunner(folder):
    template = (EXAMPLES / "coderunner/template.py").read_text()
    job = folder / "job"
    job.mkdir()
    for name in ("key.yaml", "grade_one.py"):
        shutil.copy(EXAMPLES / name, job)
    answers = answers_of(handout("anna"))
    for name in ("half", "quotes", "empty", "file"):
        text, share = answers[name]
        (job / "prog.py").write_text(twig(template, {"STUDENT_ANSWER": text, "STUDENT.username": "anna"}))
        result = json.loads(run("python3", "prog.py", cwd=job))
        table = result["testresults"]
        fields = (0 <= result["fraction"] <= 1 and isinstance(result["prologuehtml"], str) and table[0][0] == "iscorrect"
                  and all(len(row) == len(table[0]) and row[0] in (0, 1) for row in table[1:])
                  and all("<script" not in result[key] for key in ("prologuehtml",)))
        check(f"CodeRunner, {name}", fields and is_worth(result["fraction"], share), result)


def loop(folder):
    shutil.copy(EXAMPLES / "key.yaml", folder)
    (folder / "class").mkdir()
    for name, sheet in (("anna", right(handout("anna"))), ("boris", answers_of(handout("boris"))["half"][0]), ("clara", ""),
                        ("dora", right(handout("anna")))):
        (folder / f"class/{name}.yaml").write_text(sheet)
    shown = run(EXAMPLES / "folder/grade-folder", "key.yaml", "class", cwd=folder, code=4)
    rows = [row.split(",") for row in (folder / "class/points.csv").read_text().splitlines()]
    check("the loop has a row for each", [row[0] for row in rows] == ["student", "anna", "boris", "clara", "dora"], rows)
    totals = dict(zip(rows[0][6:], (sum(map(int, column[1:])) for column in list(zip(*rows))[6:])))
    said = {kind: int(number) for number, kind in re.findall(r"(\d+) of (\w+) in \d+ answers", shown)}
    check("the class's findings are those of its rows", said == {kind: n for kind, n in totals.items() if n}, shown)
    check("and how many passed", shown.startswith("4 answers, 2 passed, mean score "), shown)
    check("each has a text", all((folder / f"class/{name}.txt").read_text().startswith(name) for name in ("anna", "clara")))
    (folder / "class/emil.yaml").symlink_to(folder / "key.yaml")
    run(EXAMPLES / "folder/grade-folder", "key.yaml", "class", cwd=folder, code=1)
    check("a link to the key is not graded", "emil" not in (folder / "class/points.csv").read_text())
    (folder / "key.yaml").write_text("fbd: 1\nbodies: 3\n")
    run(EXAMPLES / "folder/grade-folder", "key.yaml", "class", cwd=folder, code=3)


def limits(folder):
    """A program in the place of fbd-run that goes beyond each limit."""
    sys.path.insert(0, str(EXAMPLES))
    import grade_one
    grade_one.SECONDS = 1
    answer = folder / "answer.yaml"
    answer.write_text("fbd: 1\n")
    for claim, script in (("time", "while :; do :; done"), ("memory", "exec python3 -c 'bytearray(2 * 10**9)'"),
                          ("size of files", "head -c 2000000 /dev/zero >big"), ("number of files", "exec python3 -c '\nfiles = [open(\"/dev/null\") for i in range(40)]'")):
        program = folder / "program"
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        os.environ["FBD_RUN"] = str(program)
        result = grade_one.grade(EXAMPLES / "key.yaml", answer, "anna")
        check(f"beyond the limit of {claim} an answer is not graded", not result["gradable"] and result["score"] == 0, result)


for test in (prairielearn, gradescope, coderunner, loop, limits):
    with tempfile.TemporaryDirectory() as name:
        test(Path(name))
print(f"1..{count}")
sys.exit(failed > 0)

# SPDX-License-Identifier: GPL-3.0-or-later
"""A model whose first lines say what somebody else has found for it:

    # source: where it is published
    # licence: of the source
    # method: how the published numbers were found (default: by hand)
    # answer: NAME = VALUE UNIT +- UNCERTAINTY: EXPRESSION
    # instead: VALUE +- UNCERTAINTY: why the print of the answer above is wrong
    # methods: none           (the answers take no integration; or some of them)
    # model: another file      (a model of the gallery; then there is nothing else in this one)
    # options: of every run
    # needs: of the language  (in tests/books/waiting)

The expression is Python over what the programs print, and nothing else: `run()`, `static()` are the objects of --json,
`equations()`, `linear()` the reports, `rows()` the columns of the CSV. Each takes options as in a shell and parameters
as keywords: `run("--until 10", mu=0.3).final.block.x`. `root(f, a, b)` is where f(a number) is zero.
A percent sign behind the uncertainty makes it relative.
"""
import csv
import io
import json
import math
import re
import shlex
import signal
import subprocess

NUMBER = r"[-+0-9.e]+"
ANSWER = re.compile(rf"^(\w+) = ({NUMBER}) ?([^:]*?) \+- ({NUMBER})( %)?: (.*)$")
INSTEAD = re.compile(rf"^({NUMBER}) \+- ({NUMBER})( %)?: (.*)$")


class Refused(Exception):
    """The program gave no answer: its exit code and message."""


class Node(dict):
    """An object of JSON whose keys are attributes as well; a run knows its events by kind or name."""
    __getattr__ = dict.__getitem__

    def times(self, what):
        return [event["t"] for event in self["events"] if what in (event["kind"], event["name"])]

    def time(self, what):
        return self.times(what)[0]

    def tension(self, coupling):
        return next(member["tension"] for member in self["members"] if member["name"] == coupling)


class Equations:
    """Accelerations in the report of --equations: `block.x` -> v_dot, as shown (nine digits)."""

    def __init__(self, text):
        self.rates, of = {}, None
        for line in text.splitlines():
            head = re.match(r"^  ([\w.]+): ", line)
            term = re.match(rf"^    (\w+(?: \w+)?) +({NUMBER}) +\S", line)
            if head:
                of = head[1]
            elif of and term and re.fullmatch(r"v[xy]?_dot|omega_dot|a_\w+|alpha", term[1]):
                self.rates[of] = float(term[2])

    def rate(self, coordinate):
        return self.rates[coordinate]


class Linear:
    """Equilibrium, natural frequencies (rad/s) and damping ratios, as listed in the report of --linearize."""

    def __init__(self, text):
        self.at = {name: float(value) for name, value in re.findall(rf"^  (\w+\.\w+) = ({NUMBER})", text, re.MULTILINE)}
        self.w0 = [float(w) for w in re.findall(rf"w0 = ({NUMBER})", text)]
        self.zeta = [float(ratio) for ratio in re.findall(rf"zeta = ({NUMBER})", text)]


class Case:
    """One model with its published answers."""

    def __init__(self, path, programs):
        self.path, self.programs = path, programs
        self.say = {"method": "by hand", "licence": "", "source": "", "options": "", "methods": "all", "model": "", "needs": ""}
        self.answers, self.question = [], []
        self.seconds, self.calls = 0.0, 0
        self.method, self.limit = None, 60  # of every run from now on; None: the default; processor seconds that one may take
        self.cache = {}
        for line in self._header():
            key, _, rest = line.partition(": ")
            if key == "answer":
                self.answers.append(self._answer(rest))
            elif key == "instead":
                self.answers[-1]["instead"] = self._instead(rest)
            elif key in self.say:
                self.say[key] = rest
            else:
                self.question.append(line)

        self.model = path.parent / self.say["model"] if self.say["model"] else path

    def _header(self):
        """The comment on top; an indented line goes on with the one before."""
        lines = []
        for line in self.path.read_text(encoding="utf-8").splitlines():
            if not line.startswith("#"):
                break
            text = line[1:].removeprefix(" ")
            if text.startswith("  ") and lines:
                lines[-1] += " " + text.strip()
            elif text.strip():
                lines.append(text)
        return lines

    def _answer(self, text):
        found = ANSWER.match(text)
        assert found, f"{self.path}: not an answer: {text}"
        name, value, unit, within, percent, expression = found.groups()
        value, within = float(value), float(within) * (abs(float(value)) / 100 if percent else 1)
        return {"name": name, "value": value, "unit": unit, "within": within, "expression": expression, "instead": None}

    def _instead(self, text):
        found = INSTEAD.match(text)
        assert found, f"{self.path}: not a correction: {text}"
        value, within, percent, why = found.groups()
        return {"value": float(value), "within": float(within) * (abs(float(value)) / 100 if percent else 1), "why": why}

    def title(self):
        return re.search(r"^title: (.*)$", self.model.read_text(encoding="utf-8"), re.MULTILINE)[1]

    def is_read(self):
        """Whether the language has all that the model says."""
        check = [self.programs / "fbd-run", "--check", self.model]
        return subprocess.run(check, stdin=subprocess.DEVNULL, capture_output=True, check=False).returncode != 3

    def source(self):
        return self.say["source"] + (f" ({self.say['licence']})" if self.say["licence"] else "")

    # What an expression may ask.

    def _program(self, what, options, values, may_end=(0,)):
        command = [self.programs / "fbd-run", *what, *shlex.split(self.say["options"])]
        for option in options:
            command += shlex.split(option)
        for name, value in values.items():
            command += ["--set", f"{name}={value!r}" if isinstance(value, float) else f"{name}={value}"]
        command.append(self.model)
        key = tuple(map(str, command))
        if key not in self.cache:
            limited = ["sh", "-c", 'ulimit -t "$0"; exec "$@"', str(self.limit), *command]
            done = subprocess.run(limited, stdin=subprocess.DEVNULL, capture_output=True, check=False)
            if -done.returncode in (signal.SIGXCPU, signal.SIGKILL):
                raise Refused(f"not done after {self.limit} s of processor time")
            if done.returncode not in may_end:
                raise Refused(done.stderr.decode(errors="replace").strip() or f"exit code {done.returncode}")
            self.cache[key] = done.stdout.decode()
        self.calls += 1
        return self.cache[key]

    def _run(self, *options, **values):
        method = ["--method", self.method] if self.method else []
        result = json.loads(self._program(["--json", "-", *method], options, values, (0, 1)), object_pairs_hook=Node)
        if result["outcome"] not in ("done", "stopped"):
            raise Refused(result["reason"])
        self.seconds += result["stats"]["seconds"]
        return result

    def _rows(self, *options, **values):
        method = ["--method", self.method] if self.method else []
        lines = list(csv.reader(io.StringIO(self._program(["--csv", "-", *method], options, values))))
        names = [name.split(" [")[0] for name in lines[0]]
        return {name: [float(row[i]) for row in lines[1:]] for i, name in enumerate(names)}

    def _static(self, *options, **values):
        return json.loads(self._program(["--static", "--json", "-"], options, values, (0, 1)), object_pairs_hook=Node)

    def _equations(self, *options, **values):
        return Equations(self._program(["--equations"], options, values))

    def _linear(self, *options, **values):
        return Linear(self._program(["--linearize"], options, values))

    def get(self, answer):
        """What the program says for an answer."""
        names = {name: getattr(math, name) for name in ("sqrt", "hypot", "atan2", "degrees", "radians", "sin", "cos", "tan", "pi")}
        names |= {"run": self._run, "rows": self._rows, "static": self._static, "equations": self._equations,
                  "linear": self._linear, "root": root, "threshold": threshold, "FOLDER": self.path.parent}
        return float(eval(answer["expression"], names))  # pylint: disable=eval-used


def root(function, low, high):
    """Where a function is zero: secants (a linear function takes three calls), kept within the bracket."""
    a, b, fa, fb = float(low), float(high), function(float(low)), function(float(high))
    assert fa * fb <= 0, f"no zero between {low} and {high}: {fa}, {fb}"
    for _ in range(60):
        if fb == 0 or abs(b - a) <= 1e-13 * abs(b) or fa == fb:
            break
        c = b - fb * (b - a) / (fb - fa)
        fc = function(c)
        if abs(fc) >= 0.5 * min(abs(fa), abs(fb)) and fc != 0:  # slow: halve once
            if fa * fc < 0:
                b, fb = c, fc
            else:
                a, fa = c, fc
            c = (a + b) / 2
            fc = function(c)
        if fa * fc < 0:
            b, fb = c, fc
        else:
            a, fa = c, fc
        if abs(fa) < abs(fb):
            a, b, fa, fb = b, a, fb, fa
    return b


def threshold(holds, low, high):
    """The value between low, where something holds, and high, where it does not, at which it ends."""
    assert holds(low) and not holds(high)
    while abs(high - low) > 1e-6 * abs(high):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return (low + high) / 2

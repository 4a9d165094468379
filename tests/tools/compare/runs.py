# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one program on one scene for each output, within a limit of processor time."""
import os
import signal
import subprocess
import tempfile
from pathlib import Path

from differences import parsed

# Name, options and program of each output. The run writes report, CSV and JSON at once.
RUN = ("run", ["--ledger", "--csv", "{folder}/motion.csv", "--json", "{folder}/result.json"], "fbd-run")
OUTPUTS = [
    RUN,
    ("quiet", ["--quiet", "--csv", "-"], "fbd-run"),
    ("bars", ["--quiet", "--error-bars", "--json", "-"], "fbd-run"),
    ("check", ["--check"], "fbd-run"),
    ("equations", ["--equations"], "fbd-run"),
    ("symbols", ["--equations", "--symbols"], "fbd-run"),
    ("components", ["--equations", "--components"], "fbd-run"),
    ("latex", ["--equations", "--latex"], "fbd-run"),
    ("svg", ["--svg", "-", "--components", "--supports"], "fbd-run"),
    ("svg-symbols", ["--svg", "-", "--symbols"], "fbd-run"),
    ("static", ["--static", "--json", "-"], "fbd-run"),
    ("static-report", ["--static"], "fbd-run"),
    ("linearize", ["--linearize", "--json", "-"], "fbd-run"),
    ("explain", ["--explain"], "fbd-run"),
    ("hand", ["--check-hand"], "fbd-run"),
    ("emit-c", ["--emit-c", "-"], "fbd-run"),
    ("html", ["--html", "-"], "fbd-run"),
    ("sweep", ["--quiet", "--jobs", "1", "--output", "final,times,energy", "{vary}"], "fbd-sweep"),
]
CHECK = OUTPUTS[3]
BY_NAME = {output[0]: output for output in OUTPUTS}


class Run:
    """A finished program: exit code or a word, texts, and its results where it wrote some."""

    def __init__(self, code, out="", err="", table=None, result=None, seconds=0.0):
        self.code, self.out, self.err, self.csv, self.json, self.seconds = code, out, err, table, result, seconds


def code_of(status):
    """The exit code, or a word where a signal ended the program."""
    if not os.WIFSIGNALED(status):
        return os.WEXITSTATUS(status)
    number = os.WTERMSIG(status)
    if number in (signal.SIGXCPU, signal.SIGKILL):
        return "no end in its processor time"
    return f"signal {signal.Signals(number).name}"


def command(programs, output, scene, folder, vary=""):
    """The command line of one output of a scene."""
    _, options, program = output
    words = [programs / program]
    for option in options:
        words += ["--vary", vary] if option == "{vary}" else [option.format(folder=folder)]
    return [str(word) for word in [*words, scene]]


def read(path):
    return path.read_text(encoding="utf-8", errors="replace") if path.exists() else None


def run(words, folder, limit):
    """Run a command; what it writes into folder besides is read as well."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "out", "wb") as out, open(folder / "err", "wb") as err:
        # The shell sets the limit, and becomes the program.
        process = subprocess.Popen(["sh", "-c", f'ulimit -c 0; ulimit -t {limit}; exec "$@"', "sh", *words],
                                   stdin=subprocess.DEVNULL, stdout=out, stderr=err)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = status
    result = read(folder / "result.json")
    out = read(folder / "out")
    return Run(code_of(status), out, read(folder / "err"), read(folder / "motion.csv"),
               parsed(result if result is not None else out if "--json" in words else ""),
               used.ru_utime + used.ru_stime)


def temporary():
    return tempfile.TemporaryDirectory(prefix="fbd-compare-")


def first_parameter(scene):
    """NAME=VALUES for fbd-sweep, of the first parameter that is a plain number with a unit; empty without one."""
    inside = False
    for line in Path(scene).read_text(encoding="utf-8", errors="replace").splitlines():
        if not line.startswith(" "):
            inside = line.startswith("parameters:") and line.strip() == "parameters:"
        elif inside:
            name, _, value = line.strip().partition(": ")
            words = value.strip("{}").removeprefix("value: ").partition(",")[0].split(" ", 1)
            try:
                number = float(words[0])
            except ValueError:
                continue
            unit = f" {words[1]}" if len(words) > 1 else ""
            return f"{name}={number!r},{1.01 * number!r}{unit}"
    return ""

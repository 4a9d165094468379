# SPDX-License-Identifier: GPL-3.0-or-later
"""One answer of somebody unknown against a key, by fbd-run --grade, with limits on time, memory and files, and without
a network where the system can do that. For the graders in the folders beside this file, which are to be given it.
"""
import functools
import json
import os
import resource
import subprocess
import sys
import tempfile

SECONDS = 20  # of processor time
MEMORY = 10**9  # bytes
LARGEST = 10**6  # bytes, of the answer and of what is written


def limit():
    """In the process of fbd-run, before it starts."""
    for what, most in ((resource.RLIMIT_CPU, SECONDS), (resource.RLIMIT_AS, MEMORY), (resource.RLIMIT_FSIZE, LARGEST),
                       (resource.RLIMIT_NOFILE, 32), (resource.RLIMIT_CORE, 0)):
        resource.setrlimit(what, (most, most))


@functools.lru_cache
def without_network():
    """The command that a program without a network begins with; none where that is not allowed."""
    command = ["unshare", "--map-root-user", "--net"]
    try:
        subprocess.run([*command, "true"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return []
    return command


def answer_at(path):
    """The bytes of a plain file, of no link to another one, which could be the key; None where there is none."""
    try:
        with open(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as file:
            return file.read(LARGEST)
    except OSError:
        return None


def not_graded(message):
    return {"gradable": False, "score": 0, "points": 0, "max_points": 0, "passed": False, "message": message, "tests": []}


def grade(key, path, student, values=None):
    """What `fbd-run --grade --json` says of an answer, as a dict. `values` of parameters have the place of those that
    the key draws for the name of the student. An answer that cannot be graded is not `gradable`."""
    text = answer_at(path)
    if text is None:
        return not_graded("there is no answer to read")
    command = [*without_network(), os.environ.get("FBD_RUN", "fbd-run"), "--grade", os.path.abspath(key),
               f"--student={student}", *(f"--set={name}={value}" for name, value in (values or {}).items()),
               "--quiet", "--json=-", "answer.yaml"]
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "answer.yaml"), "wb") as file:
            file.write(text)
        try:
            done = subprocess.run(command, cwd=folder, preexec_fn=limit, stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, timeout=3 * SECONDS, check=False)
        except subprocess.TimeoutExpired:
            return not_graded("grading took too long; ask your teacher")
    if done.returncode not in (0, 4):  # 4: it does not pass; 3: the key is wrong; below 0: beyond a limit
        print(f"exit code {done.returncode}\n{done.stderr}", file=sys.stderr)
        return not_graded("the answer could not be graded; ask your teacher")
    return json.loads(done.stdout)["answers"][0]

# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs of another revision: built from `git archive` into a folder of its own, and kept there."""
import shutil
import subprocess
import sys
from pathlib import Path

PROGRAMS = ["fbd-run", "fbd-sweep"]


def unusable(words):
    print(f"compare: {words}", file=sys.stderr)
    sys.exit(2)


def revision(name):
    done = subprocess.run(["git", "rev-parse", "--verify", "--quiet", f"{name}^{{commit}}"], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        unusable(f"there is no revision and no build `{name}`")
    return done.stdout.strip()


def is_build(folder):
    return all((folder / "apps" / program).exists() for program in PROGRAMS[:1])


def make(commit, folder, options):
    """Build the programs of a commit below folder, unless that has been done."""
    build, log = folder / "build", folder / "log"
    if (folder / "done").exists():
        return build
    print(f"building {commit[:12]} into {build} (log: {log})", flush=True)
    shutil.rmtree(folder, ignore_errors=True)
    source = folder / "source"
    source.mkdir(parents=True)
    archive = subprocess.Popen(["git", "archive", commit], stdout=subprocess.PIPE)
    subprocess.run(["tar", "-x", "-C", source], stdin=archive.stdout, check=True)
    if archive.wait() != 0:
        unusable(f"`git archive {commit}` has failed")
    with open(log, "wb") as file:
        for words in (["meson", "setup", build, source, "-Dtests=disabled", "-Dmpi=disabled", *options],
                      ["ninja", "-C", build, *(f"apps/{program}" for program in PROGRAMS)]):
            if subprocess.run(words, stdout=file, stderr=subprocess.STDOUT, check=False).returncode != 0:
                unusable(f"{commit[:12]} cannot be built: {log}")
    (folder / "done").touch()
    return build


def programs(name, folder, options):
    """The folder of the programs of a revision, or of a build that is there already."""
    if is_build(Path(name)):
        return Path(name).resolve() / "apps"
    commit = revision(name)
    return (make(commit, folder / commit[:12], options) / "apps").resolve()

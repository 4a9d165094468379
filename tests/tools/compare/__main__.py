# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: tests/tools/compare BASE [options]

Run the programs of two revisions on the same scenes and tell what differs. BASE is a revision of git, which is built
into a folder of its own and kept there, or a folder that was built before (BASE/apps/fbd-run).

  --build BUILD       the programs that are looked at (default: build)
  --scenes NUMBER     random scenes beside the files of the repository (default 300; 0: none)
  --seed NUMBER       of the first of them (default 1)
  --only TEXT         scenes whose path has this text, and no counts of instructions
  --outputs A,B,...   of the gallery: run, equations, svg, ... (default: all)
  --instructions few|all|none
                      which scenes of the gallery are run under callgrind (default few)
  --tolerance NUMBER  for states, times of events and works, beside their scale (default 1e-6)
  --limit SECONDS     of processor time, for each run (default 30)
  --jobs NUMBER       runs at a time (default: the processors)
  --folder FOLDER     for builds, random scenes and what differs (default: build-compare)
  --cross PROGRAM     cross_check, which draws smooth scenes (default: BUILD/tests/cross/cross_check, where it is)
  --meson "OPTIONS"   for the build of the base revision
  --all               every difference, instead of a few of each kind

Exit code: 0 nothing differs, 1 something does, 2 usage.
"""
import argparse
import os
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import base
import instructions
import report
import runs
import scenes
from differences import differences, run_differences

# Differences of these kinds are compared with what another tolerance does to the base.
NUMERIC = ("events", "states", "motion", "works", "forces")
# Every tenth smooth scene shows its equations as well.
SOME = ("run", "equations", "latex", "svg", "static", "linearize")


class Arguments(argparse.ArgumentParser):
    def print_help(self, file=None):
        print(__doc__, end="", file=file or sys.stdout)

    def error(self, message):
        base.unusable(f"{message}; see --help")


def arguments():
    parser = Arguments()
    parser.add_argument("base")
    parser.add_argument("--build", default="build")
    parser.add_argument("--scenes", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--outputs", default=",".join(runs.BY_NAME))
    parser.add_argument("--instructions", choices=["few", "all", "none"], default="few")
    parser.add_argument("--tolerance", type=float, default=1e-6)
    parser.add_argument("--limit", type=int, default=30)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--folder", type=Path, default=Path("build-compare"))
    parser.add_argument("--cross")
    parser.add_argument("--meson", default="")
    parser.add_argument("--all", action="store_true")
    return parser.parse_args()


# ---- which scenes

def random_scenes(plan, cross):
    """Half of the scenes are rich in events, half are the smooth ones of tests/cross."""
    folder = plan.folder / f"scenes-{plan.seed}-{plan.scenes}"
    shutil.rmtree(folder, ignore_errors=True)
    smooth = plan.scenes // 2 if cross else 0
    paths = [(path, ["run"]) for path in scenes.write(folder / "events", plan.seed, plan.scenes - smooth)]
    if smooth:
        (folder / "smooth").mkdir()
        subprocess.run([cross, "--scenes", str(smooth), "--seed", str(plan.seed), "--write", folder / "smooth"], check=True)
        for path in sorted((folder / "smooth").iterdir(), key=lambda each: int(each.stem)):
            paths.append((path, SOME if int(path.stem) % 10 == 0 else ["run"]))
    return paths


def all_scenes(plan, cross):
    """(path, names of outputs) of each scene."""
    wanted = plan.outputs.split(",")
    unknown = [name for name in wanted if name not in runs.BY_NAME]
    if unknown:
        base.unusable(f"there is no output `{unknown[0]}`: {', '.join(runs.BY_NAME)}")
    found = [(path, wanted) for path in sorted(Path("models").glob("*/*.yaml"))]
    found += [(path, ["run", "equations", "hand"]) for path in sorted(Path("tests/books").glob("*.yaml"))]
    found += [(path, ["run", "quiet", "check"]) for path in sorted(Path("tests/faults").glob("*/*.yaml"))]
    found += [(path, ["check"]) for path in sorted(Path("tests/bad").glob("*.yaml"))]
    if plan.scenes > 0:
        found += random_scenes(plan, cross)
    return [(path, outputs) for path, outputs in found if plan.only in str(path)]


# ---- one scene by both

def sensitive(programs, scene, first, tolerance, folder, limit):
    """Whether another tolerance moves the base by as much: then the scene itself does not decide."""
    used = (first.json or {}).get("stats", {}).get("tolerance")
    if not isinstance(used, (int, float)):
        return []
    words = runs.command(programs, runs.RUN, scene, folder / "sensitive")
    words[1:1] = ["--tolerance", f"{0.1 * used if used > 1e-12 else 10 * used:g}"]
    other = runs.run(words, folder / "sensitive", limit)
    found = run_differences(first, other, tolerance)
    shutil.rmtree(folder / "sensitive", ignore_errors=True)
    return found


def mark_sensitive(found, own):
    """Mark the differences of which the base has such as large at another tolerance; events by their kind alone."""
    sizes = {}
    for each in own:
        sizes[each.kind] = max(sizes.get(each.kind, 0), each.size)
    for each in found:
        each.sensitive = each.kind in sizes and (each.kind == "events" or sizes[each.kind] >= 0.1 * each.size)


def compare_output(plan, both, scene, name, keep):
    """(differences, seconds of both) of one output of a scene."""
    vary = runs.first_parameter(scene) if name == "sweep" else ""
    if name == "sweep" and not vary:
        return [], (0, 0)
    output, done, words = runs.BY_NAME[name], [], []
    for side, programs in zip(("base", "new"), both):
        words.append(runs.command(programs, output, scene, keep / side, vary))
        done.append(runs.run(words[-1], keep / side, plan.limit))
    found = differences(name, *done, plan.tolerance)
    if any(each.kind in NUMERIC for each in found):
        mark_sensitive(found, sensitive(both[0], scene, done[0], plan.tolerance, keep, plan.limit))
    for each in found:
        each.scene, each.folder, each.command = str(scene), keep, [shlex.join(each) for each in words]
    if not found:
        shutil.rmtree(keep, ignore_errors=True)
    return found, (done[0].seconds, done[1].seconds)


def compare_scene(plan, both, scene, outputs):
    """(differences, seconds by output) of a scene."""
    found, seconds = [], {}
    for name in outputs:
        keep = plan.folder / "differ" / str(scene).replace("/", "_").removesuffix(".yaml") / name
        more, seconds[name] = compare_output(plan, both, scene, name, keep)
        if name != "run" and any(each.kind in ("crash", "outcome") for each in found):
            more = [each for each in more if each.kind in ("crash", "outcome")]
        found += more
    return found, seconds


def compare_all(plan, both, chosen):
    found, seconds = [], {}
    with ThreadPoolExecutor(plan.jobs) as pool:
        jobs = [(scene, pool.submit(compare_scene, plan, both, scene, outputs)) for scene, outputs in chosen]
        for number, (scene, job) in enumerate(jobs):
            more, used = job.result()
            found += more
            seconds[scene] = used
            if sys.stderr.isatty():
                print(f"\r{number + 1} of {len(jobs)} scenes, {len(found)} differences", end="", file=sys.stderr)
    if sys.stderr.isatty():
        print(file=sys.stderr)
    return found, seconds


def count_all(plan, both):
    """(scene, instructions of base, of new) of the chosen scenes of the gallery."""
    if plan.instructions == "none" or plan.only or not shutil.which("valgrind"):
        return []
    chosen = instructions.FEW if plan.instructions == "few" else sorted(Path("models").glob("*/*.yaml"))
    with ThreadPoolExecutor(plan.jobs) as pool:
        jobs = [[pool.submit(instructions.count, programs / "fbd-run", scene) for programs in both] for scene in chosen]
        return [(str(scene), *(job.result() for job in pair)) for scene, pair in zip(chosen, jobs)]


def main():
    plan = arguments()
    os.environ["LC_ALL"] = "C"
    plan.folder.mkdir(exist_ok=True)
    new = Path(plan.build).resolve() / "apps"
    if not (new / "fbd-run").exists():
        base.unusable(f"there is no program {plan.build}/apps/fbd-run")
    both = (base.programs(plan.base, plan.folder, shlex.split(plan.meson)), new)
    cross = Path(plan.cross or f"{plan.build}/tests/cross/cross_check")
    shutil.rmtree(plan.folder / "differ", ignore_errors=True)
    chosen = all_scenes(plan, cross if cross.exists() else None)
    print(f"base {both[0]}, new {both[1]}\n{len(chosen)} scenes, {plan.scenes} of them drawn from SEED={plan.seed}", flush=True)
    found, seconds = compare_all(plan, both, chosen)
    counts = count_all(plan, both)
    return report.write(plan, found, seconds, counts)


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-3.0-or-later
"""What other programs say, where they are installed; a word where they are not."""
import subprocess

from library import Model

AGREE = 1e-12  # of the largest acceleration


def by_sympy(source, build):
    try:
        import by_sympy as them  # pylint: disable=import-outside-toplevel
    except ImportError as absent:
        return [f"SymPy: skipped, {absent} (Debian: python3-sympy)."]
    rows = []
    for make in them.SYSTEMS:
        system = make()
        model = Model(build / "lib" / "libfbd.so", source / "models" / system.path)
        worst = them.compare(system, model)
        print(f"SymPy: {system.path}: {worst:.2g}")
        rows.append(f"| [{system.path}](../models/{system.path}) | {len(system.names)} | {worst:.2g} | {'met' if worst <= AGREE else '**missed**'} |")
    met = sum("missed" not in row for row in rows)
    return [f"SymPy {them.sp.__version__}'s mechanics module derives Lagrange's equations of {len(rows)} models from energies written down anew",
            f"(tests/verify/by_sympy.py), evaluated with 40 digits at {them.STATES} random states each (seed {them.SEED}). The largest difference of an acceleration,",
            f"relative to the largest one of its state, is to be at most {AGREE:g}: {met} met, {len(rows) - met} missed.", "",
            "| model | coordinates | largest difference | |", "| --- | --- | --- | --- |", *rows]


def trees(build):
    """Accelerations of a chain of ten rods by the simulators that bench_chain was built with."""
    done = subprocess.run([build / "tests" / "bench" / "bench_chain", "--agreement"], capture_output=True, text=True, check=False)
    found = dict(line.rsplit(" ", 1) for line in done.stdout.splitlines())
    said = []
    for name, package in (("MuJoCo", "libmujoco-dev"), ("Simbody", "libsimbody-dev")):
        if name in found:
            said.append(f"{name}: accelerations of a chain of ten rods differ from those by hand by {found[name]} of the largest (fbd: {found['fbd']}).")
        else:
            said.append(f"{name}: skipped, not here when fbd was built (Debian: {package}).")
    return [*said, "SUNDIALS: [accuracy.md](accuracy.md) measures fbd beside CVODE and ARKODE."]


def lines(source, build):
    return [*by_sympy(source, build), "", *(f"- {line}" for line in trees(build))]

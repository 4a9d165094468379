# SPDX-License-Identifier: GPL-3.0-or-later
"""Instructions of whole runs by valgrind's callgrind, so that they repeat to the last one.

The environment is a fixed one, and what glibc chooses by the processor at hand (functions with AVX or FMA) is
switched off. A run writes nothing, since the digits of a time of the clock take more or fewer instructions.
"""
import re
import subprocess
import tempfile
from pathlib import Path

FEATURES = ["AVX", "AVX2", "AVX512F", "AVX512VL", "AVX512BW", "FMA", "FMA4", "ERMS", "FSRM", "BMI1", "BMI2", "LZCNT",
            "MOVBE", "RTM", "SSE4_1", "SSE4_2", "SSSE3"]
ENVIRONMENT = {
    "PATH": "/usr/bin:/bin",
    "LC_ALL": "C",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + ",".join(f"-{feature}" for feature in FEATURES),
}
# Of different kinds, and most of them short.
FEW = [
    "models/contact/bouncing_ball.yaml", "models/contact/stairs.yaml", "models/contact/woodpecker.yaml",
    "models/couplings/atwood.yaml", "models/couplings/slider_crank.yaml", "models/energy/cubic_spring_force.yaml",
    "models/hard/stick_slip_belt.yaml", "models/hard/square_wave.yaml", "models/kinetics/incline.yaml",
    "models/plane/thrown_rod.yaml", "models/rotation/simple_pendulum.yaml", "models/statics/truss.yaml",
    "models/trees/chain_of_ten_rods.yaml", "models/trees/block_on_wedge.yaml",
]


def count(program, scene, *options):
    """Instructions of a run; None where it fails."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", str(program), "--quiet",
                               *options, str(scene)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, env=ENVIRONMENT, check=False)
        if not out.exists() or done.returncode != 0:
            return None
        found = re.search(r"^(?:summary|totals): (\d+)", out.read_text(encoding="utf-8"), re.MULTILINE)
        return int(found[1]) if found else None

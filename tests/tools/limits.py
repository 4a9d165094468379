# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits that hold on a loaded machine: computing is bounded by processor time, and waiting by a long
time of the clock. The environment variable FBD_TEST_TIMEOUT multiplies both."""
import math
import os
import resource
import signal
import subprocess

FACTOR = float(os.environ.get("FBD_TEST_TIMEOUT") or 1)
WAIT = 600 * FACTOR  # seconds of the clock, for what comes at once where nothing else runs
TOO_LONG = -signal.SIGXCPU  # the return code of a program whose processor time was up


def run(command, seconds=60, **how):
    """subprocess.run of a program that may take so many seconds of processor time."""
    most = math.ceil(seconds * FACTOR)

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (most, resource.getrlimit(resource.RLIMIT_CPU)[1]))

    return subprocess.run(command, timeout=WAIT, preexec_fn=limit, **how)

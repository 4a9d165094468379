# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads share models and runs, Python goes on while the library works, Ctrl-C ends it, and nothing is lost."""
import os
import signal
import subprocess
import sys
import threading
import time

import limits
import numpy as np
import pytest
from conftest import PENDULUM


def together(work, count=6):
    """Threads that do the same; what they give."""
    results, failures = [None] * count, []

    def run(i):
        try:
            results[i] = work(i)
        except BaseException as failure:
            failures.append(failure)

    threads = [threading.Thread(target=run, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures, failures
    return results


def test_threads_share_a_model(pendulum):
    runs = together(lambda i: [pendulum.run().rows for _ in range(20)][-1])
    for rows in runs[1:]:
        np.testing.assert_array_equal(rows, runs[0])


def test_threads_share_a_run_and_a_state(pendulum):
    run, state = pendulum.run(), pendulum.state()
    times = np.linspace(0, 10, 41)
    expected = [run.at(t)["theta"] for t in times]

    def look(i):
        order = np.random.default_rng(i).permutation(len(times))
        for k in order:
            assert run.at(times[k])["theta"] == expected[k]
            state["theta"] = 0.1 * i
            assert state.equations()["pendulum.theta"].terms["gravity"] <= 0
            assert run.report() and run.energy and state.svg()
        return True

    assert all(together(look))


def test_sweeps_of_several_threads(pendulum):
    tables = together(lambda i: pendulum.sweep("theta0=0.1:1:40", "pendulum.theta", jobs=2), 3)
    for table in tables[1:]:
        np.testing.assert_array_equal(table, tables[0])


@pytest.mark.parametrize("work", [
    lambda model: model.run(until=2e4, every=1e3),
    lambda model: model.sweep("theta0=uniform(0.1,1):4000", "pendulum.theta", jobs=1),
    lambda model: model.cost(budget=1, methods=["rk8pd", "auto"]),
    lambda model: model.run(until=2e4, every=1e3).at(1.9e4),
])
def test_python_goes_on_meanwhile(pendulum, work):
    """The switch interval is beyond the work: only where the library works without the interpreter does another thread
    come to its turn again and again, in any time."""
    thread, turns, interval = threading.Thread(target=work, args=(pendulum,)), 0, sys.getswitchinterval()
    sys.setswitchinterval(1e6)
    try:
        thread.start()
        while thread.is_alive():
            turns += 1
            time.sleep(0)
    finally:
        sys.setswitchinterval(interval)
    assert turns > 50  # with the interpreter held it is none, or the few at the ends


SLOW = {
    "run": "model.run(until=1e9, every=1e6)",
    "accuracy": "model.run(until=1e8, every=1e6, accuracy=1e-9)",
    "progress": "model.run(until=1e9, every=1e6, progress=lambda p: None)",
    "sweep": "model.sweep('theta0=uniform(0.1,1):10000000', 'pendulum.theta')",
    "cost": "model.cost(budget=60, until=1e4)",
}
SCRIPT = """
import sys, time, fbd
model = fbd.Model(sys.argv[1])
begin = time.time()
try:
    print("ready", flush=True)
    {slow}
    print("done")
except KeyboardInterrupt:
    print("interrupted", model.run().outcome, flush=True)
"""


@pytest.mark.parametrize("slow", SLOW)
def test_ctrl_c_ends_what_takes_long(slow):
    script = SCRIPT.format(slow=SLOW[slow])
    with subprocess.Popen([sys.executable, "-c", script, str(PENDULUM)], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.4)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=limits.WAIT)[0]  # to the end each takes for ever
    assert said == "interrupted done\n"
    assert process.returncode == 0


# Here the other thread alone can end what goes on.
HELD = """
import os, signal, sys, threading, time, fbd
model = fbd.Model(sys.argv[1])
sys.setswitchinterval(1e6)
begun, turns = threading.Event(), 0

def other():
    global turns
    begun.set()
    for turns in range(1, 1001):
        time.sleep(0)
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=other, daemon=True).start()
begun.wait()
try:
    model.run(until=1e9, every=1e6)
except KeyboardInterrupt:
    print("ended after", turns)
"""


def test_another_thread_ends_a_run():
    done = subprocess.run([sys.executable, "-c", HELD, str(PENDULUM)], stdout=subprocess.PIPE, text=True, timeout=limits.WAIT, check=True)
    assert done.stdout == "ended after 1000\n"


MANY = """
import gc, os, sys, fbd

def size():
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

def round():
    model = fbd.Model(sys.argv[1], theta0="50 deg")
    run = model.run(ledger=True, error_bars=True)
    run.to_pandas(), run.at(5), run.end, run.events, run.json(), run.report(), run._repr_html_()
    model.run(progress=lambda progress: True)
    model.equations(theta=1)._repr_html_(), model.linearize(), model.statics(), model.check_hand()
    model.sweep("theta0=0.1,0.2", jobs=1), model.explain()
    try:
        fbd.Model(sys.argv[1], wrong=1)
    except fbd.Error:
        pass
    try:
        model.state()["nothing"] = 1
    except fbd.Error:
        pass

def growth(rounds):
    before = size()
    for i in range(rounds):
        round()
    return (size() - before) / rounds

growth(60) # what allocators keep comes to its size
print(min(growth(50) for k in range(4))) # pages that the system has taken come back at any time: what is lost grows at all times
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="there is no /proc")
def test_memory_does_not_grow():
    """A round that forgot one run, page or table alone would lose some 20 000 bytes."""
    grown = subprocess.run([sys.executable, "-c", MANY, str(PENDULUM)], stdout=subprocess.PIPE, text=True, check=True)
    assert float(grown.stdout) < 4000

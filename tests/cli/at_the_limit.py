#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads that exceed the limit of static friction, or miss it, by 1e-14 to 1e-6 of it: every run succeeds, and beyond the
accuracy of the decision (3e-9) a body that should stay does, and one that slips has the acceleration of kinetic friction.
Prints TAP."""
import json
import os
import subprocess
import sys

RUN = os.environ["FBD_RUN"]
G, M, MU, UNTIL = 9.81, 5, 0.8, 0.2
DECIDED = 3e-9


# ---- scenes: the body, its file with a load F [N] along the surface, and the mass that F - mu_k N moves

def friction(kinetic):
    return f"friction: {{static: {MU}, kinetic: {kinetic}}}"


def hanging_weight(load, kinetic):
    return "block", f"""
couplings:
  - rope: {{name: cord, through: [block.G, pulley, weight.G]}}
bodies:
  block: {{mass: {M} kg, motion: {{slide: {{through: [-5 m, 0.1 m]}}}}, forces: [gravity, normal, {friction(kinetic)}]}}
  weight: {{mass: {load / G!r} kg, motion: {{slide: {{along: -90 deg, through: [0.1 m, -1 m]}}}}, forces: [gravity]}}
  pulley: {{mass: 0.2 kg, shape: disc, radius: 0.1 m, motion: pivot, forces: [gravity]}}
""", M + load / G + 0.1


def crate_on_a_floor(load, kinetic):
    return "crate", f"""
ground: {{lines: {{floor: {{along: 0 deg}}}}}}
contacts: [{{between: [crate, ground.floor], static: {MU}, kinetic: {kinetic}}}]
bodies:
  crate: {{mass: {M} kg, shape: prism, a: 2 m, b: 0.2 m, motion: planar, initial: {{y: 0.1 m}},
    forces: [gravity, applied: {{value: {load!r} N, angle: 0 deg, at: [0, -0.1 m]}}]}}
""", M


def two_blocks_and_a_rod(load, kinetic):
    return "front", f"""
bodies:
  front: {{mass: 2 kg, motion: {{slide: {{}}}}, forces: [gravity, normal, {friction(kinetic)}, applied: {{value: {load!r} N}}]}}
  back: {{mass: 3 kg, motion: {{slide: {{}}}}, initial: {{x: -1 m}}, forces: [gravity, normal, {friction(kinetic)}]}}
couplings:
  - rod: {{between: [front.G, back.G], length: 1 m}}
""", M


# ---- runs

def speed(scene, load, kinetic):
    """At the end; and that of the closed form where the load is more than the limit."""
    body, text, mass = scene(load, kinetic)
    done = subprocess.run([RUN, "--json", "-", "--quiet", "-"], input=f"fbd: 1\n{text}simulate: {{until: {UNTIL} s}}\n", capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        return None, done.stderr
    final = json.loads(done.stdout)["final"][body]
    return final.get("v", final.get("vx")), (load - kinetic * M * G) / mass * UNTIL


def fault(scene, kinetic, part):
    v, slipped = speed(scene, MU * M * G * (1 + part), kinetic)
    if v is None:
        return f"{part:g}, mu_k {kinetic}: {slipped.splitlines()[0]}"
    if abs(part) < DECIDED:
        return None if min(abs(v), abs(v - slipped)) <= 1e-9 else f"{part:g}, mu_k {kinetic}: {v:g} m/s"
    want = slipped if part > 0 else 0
    return None if abs(v - want) <= 1e-9 else f"{part:g}, mu_k {kinetic}: {v:g} m/s, not {want:g}"


def main():
    scenes = (hanging_weight, crate_on_a_floor, two_blocks_and_a_rod)
    parts = [sign * digit * 10.0 ** -power for power in range(7, 15) for digit in (1, 2.3, 5.1) for sign in (1, -1)]
    all_faults = 0
    for number, scene in enumerate(scenes, 1):
        faults = [wrong for kinetic in (MU, 0.5) for part in parts if (wrong := fault(scene, kinetic, part))]
        all_faults += len(faults)
        print(f"{'not ok' if faults else 'ok'} {number} - {scene.__name__}")
        for wrong in faults[:4]:
            print(f"# {wrong}")
    print(f"1..{len(scenes)}")
    return 1 if all_faults else 0


if __name__ == "__main__":
    sys.exit(main())

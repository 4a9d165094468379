# SPDX-License-Identifier: GPL-3.0-or-later
"""More answers, right and wrong, to ten sheets and some of the models: (sheet, what was done, {text of the right
answer: text of this one}, the kinds of all findings that are not `right`). No kinds: it has to get all points."""
import os
from pathlib import Path

MODELS = Path(os.environ["FBD_SOURCE_ROOT"]) / "models"
NONE = ""

TOW = """fbd: 1
title: A crate is towed, in pounds and feet
units: US
parameters: {W: 120 lbf, P: 40 lbf, beta: 25 deg, mu_s: 0.4, mu_k: 0.3}
bodies:
  crate:
    mass: W/g
    motion: {slide: {along: 0 deg}}
    initial: {v: 2 ft/s}
    forces:
      - gravity
      - normal
      - friction: {static: mu_s, kinetic: mu_k}
      - applied: {name: tow, value: P, angle: beta}
    hand:
      - "N = W - P*sin(beta)"
      - "W/g*v_dot = P*cos(beta) - mu_k*N*sign(v)"
simulate: {until: 2 s}
"""
LADDER = """fbd: 1
parameters: {phi: 60 deg, s: 3 m, P: 800 N, mu: 0.5}
ground:
  lines: {wall: {through: [2.5, 0], along: 90 deg}}
bodies:
  foot:
    mass: 1 kg
    motion: slide
    forces: [gravity, normal, friction: mu]
  ladder:
    shape: rod
    mass: 20 kg
    length: 5 m
    points: {rung: ["s - 2.5[m]", 0]}
    motion: {pivot: {on: foot, at: G, point: left}}
    initial: {theta: phi}
    forces:
      - gravity
      - applied: {name: person, value: [0, -P], at: rung}
  top:
    mass: 1 kg
    motion: {slide: {line: wall}}
    initial: {assemble: true}
    forces: [gravity, normal: {side: left}]
couplings:
  - pin: {name: hinge, between: [ladder.right, top.G]}
simulate: {until: 1 s}
"""
DRUM = """fbd: 1
title: A drum with a brake and a cord on its rim
parameters: {R: 0.3 m, m: 12 kg, T: 50 N, Q: 20 N, M_b: 4 N*m}
bodies:
  drum:
    shape: disc
    radius: R
    mass: m
    points: {rim: [R, 0]}
    motion: {pivot: {at: [1 m, 2 m], point: G}}
    initial: {omega: 3 rad/s}
    forces:
      - gravity
      - applied: {name: cord, fx: 0 N, fy: -T, at: {offset: [R, 0 m]}}
      - applied: {name: shoe, value: Q, angle: 90 deg, frame: body, at: rim}
    moments:
      - applied: {name: brake, value: -M_b}
    hand:
      - "I_O*omega_dot = -T*R + Q*R - M_b"
simulate: {until: 1 s}
"""
OSC = """fbd: 1
title: Two masses in a row, with springs and a force that swings
parameters: {k1: 200 N/m, k2: 100 N/m, c: 3 N*s/m, F0: 10 N, w: 6 rad/s, m_a: 2 kg, m_b: 1 kg}
bodies:
  a:
    mass: m_a
    motion: {slide: {along: 0 deg}}
    initial: {x: 0.1 m}
    forces:
      - spring: {name: left, stiffness: k1}
      - applied: {name: shared, value: -k2*(x - b.x)}
      - damper: {name: dashpot, coefficient: c}
    hand: "m_a*v_dot = -k1*x - k2*(x - b.x) - c*v"
  b:
    mass: m_b
    motion: {slide: {along: 0 deg}}
    forces:
      - applied: {name: shared, value: -k2*(x - a.x)}
      - applied: {name: drive, value: F0*sin(w*t)}
    hand: "m_b*v_dot = -k2*(x - a.x) + F0*sin(w*t)"
simulate: {until: 3 s}
"""
BEAM = """fbd: 1
parameters: {l: 4 m, w0: 300 N/m, w1: 600 N/m, C: 50 N*m}
ground: {points: {A: [0, 0], B: [4 m, 1 m]}}
bodies:
  beam:
    shape: rod
    mass: 20 kg
    length: l
    points: {M: [0, 0]}
    motion: {pivot: {at: A, point: left}}
    forces:
      - gravity
      - distributed: {name: uniform, from: left, to: M, value: w0, angle: -90 deg}
      - distributed: {name: ramp, from: M, to: right, value: w1*s/(l/2), angle: -90 deg}
    moments:
      - applied: {name: couple, value: C}
couplings:
  - rod: {name: link, between: [beam.right, ground.B]}
simulate: {until: 1 s}
"""
DOUBLE = """fbd: 1
title: Two rods in a row, a motor at each joint
parameters: {L1: 0.6 m, L2: 0.4 m, m1: 3 kg, m2: 2 kg, M1: 5 N*m, M2: 2 N*m, F: 8 N}
bodies:
  upper:
    shape: rod
    from: [0, 0]
    to: [L1, 0]
    mass: m1
    motion: {pivot: {at: [0, 0], point: left}}
    initial: {theta: -60 deg}
    forces: [gravity]
    moments:
      - applied: {name: shoulder, value: M1}
      - applied: {name: reaction, value: -M2}
  lower:
    shape: rod
    from: [0, 0]
    to: [L2, 0]
    mass: m2
    motion: {pivot: {on: upper, at: right, point: left}}
    initial: {theta: 30 deg}
    forces:
      - gravity
      - applied: {name: load, value: F, angle: 0 deg, at: right}
    moments:
      - applied: {name: elbow, value: M2}
simulate: {until: 1 s}
"""
ROLL = """fbd: 1
title: A wheel that is pulled at its hub and rolls
parameters: {m_w: 5 kg, R: 0.25 m, P: 12 N, beta: 20 deg, M: 1.5 N*m}
ground:
  lines: {road: {along: 0 deg}}
bodies:
  wheel:
    mass: m_w
    shape: disc
    radius: R
    motion: planar
    initial: {y: R}
    forces:
      - gravity
      - applied: {name: pull, value: P, angle: beta}
    moments:
      - applied: {name: drag, value: M}
    hand:
      - "3/2*m*vx_dot = P*cos(beta) - M/R"
couplings:
  - roll: {name: tread, body: wheel, on: road}
simulate: {until: 1 s}
"""
BEAD = """fbd: 1
parameters: {a: 0.5 1/m, x0: 1 m, c: 0.3 N*s/m}
bodies:
  bead:
    mass: 0.1 kg
    motion: {track: {y: a*x^2, from: -2 m, to: 2 m}}
    initial: {x: x0}
    forces:
      - gravity
      - normal: {two_sided: true}
      - damper: {name: grease, coefficient: c}
      - applied: {name: blow, value: [0.4 N, 0.1 N]}
    hand:
      - "m*v_dot = (0.4[N] + (0.1[N] - m*g)*2*a*bead.x)/sqrt(1 + (2*a*bead.x)^2) - c*v"
simulate: {until: 1 s}
"""
KITE = """fbd: 1
title: A glider in wind
parameters: {m: 0.4 kg, k: 0.02 N*s^2/m^2, u: 6 m/s, T: 3 N}
bodies:
  glider:
    shape: prism
    a: 0.6 m
    b: 0.1 m
    c: 0.1 m
    mass: m
    points: {nose: [0.3 m, 0], tail: [-0.3 m, 0], wing: [0.05 m, 0.02 m]}
    motion: planar
    initial: {vx: 10 m/s, vy: 1 m/s, theta: 10 deg}
    forces:
      - gravity
      - drag: {name: air, quadratic: k, wind: [-u, 0]}
      - applied: {name: thrust, value: T, angle: 0 deg, frame: body, at: tail}
      - applied: {name: lift, value: 2*T, angle: 90 deg, frame: body, at: wing}
    moments:
      - damper: {name: fins, coefficient: 0.05 N*m*s}
simulate: {until: 1 s}
"""
CART = """fbd: 1
parameters: {m_c: 2 kg, m_p: 0.5 kg, L: 1 m, F_0: 6 N}
bodies:
  cart:
    mass: m_c
    motion: slide
    forces:
      - gravity
      - normal
      - applied: {name: push, value: "F_0*cos(3[rad/s]*t)"}
      - damper: {name: grease, coefficient: 0.8 N*s/m}
    hand:
      - "(m_c + m_p)*v_dot = m_p*L/2*(pole.omega_dot*cos(pole.theta) - pole.omega^2*sin(pole.theta)) + F_0*cos(3[rad/s]*t) - 0.8[N*s/m]*v"
  pole:
    mass: m_p
    shape: rod
    from: [0, 0]
    to: [0, L]
    motion: {pivot: {on: cart, point: left}}
    initial: {theta: -0.2 rad}
    forces: [gravity]
    hand:
      - m_p*L^2/3*omega_dot = m_p*L/2*cart.v_dot*cos(theta) + m_p*g*L/2*sin(theta)
simulate: {until: 3 s}
"""
KEYS = {"tow": TOW, "ladder": LADDER, "drum": DRUM, "osc": OSC, "beam": BEAM, "double": DOUBLE, "roll": ROLL, "bead": BEAD, "kite": KITE,
        "cart": CART}
KEYS.update({name: (MODELS / f"{path}.yaml").read_text(encoding="utf-8") for name, path in {
    "atwood": "couplings/atwood", "gears": "couplings/gear_pair", "gate": "rotation/flood_gate",
    "hole": "plane/plate_with_hole", "motor": "control/dc_motor"}.items()})

TOW_LOAD = "      - applied: {name: tow, value: P, angle: beta}\n"
RUB = "      - friction: {static: mu_s, kinetic: mu_k}\n"
UNIFORM = "      - distributed: {name: uniform, from: left, to: M, value: w0, angle: -90 deg}\n"
RAMP = "      - distributed: {name: ramp, from: M, to: right, value: w1*s/(l/2), angle: -90 deg}\n"
CORD = "      - applied: {name: cord, fx: 0 N, fy: -T, at: {offset: [R, 0 m]}}\n"
SHOE = "      - applied: {name: shoe, value: Q, angle: 90 deg, frame: body, at: rim}\n"
AIR = "      - drag: {name: air, quadratic: k, wind: [-u, 0]}\n"
THRUST = "      - applied: {name: thrust, value: T, angle: 0 deg, frame: body, at: tail}\n"
LIFT = "      - applied: {name: lift, value: 2*T, angle: 90 deg, frame: body, at: wing}\n"
GREASE = "      - damper: {name: grease, coefficient: c}\n"
ATWOOD_LINE = "hand: m*(v_dot - g) + m_2*(v_dot + g) + M/2*v_dot = -M_f/R*sign(pulley.omega)"
GEAR_LINE = "    hand: (0.18[kg*m^2] + 0.02[kg*m^2]*9)*omega_dot = -1.2[N*m]*3 - c*omega\n"

CASES = [
    # ---- a crate that is towed: wrong
    ("tow", "slugs for pounds: weight as a mass times g again", {"- gravity": "- applied: {name: weight, value: W*32.2, angle: -90 deg}"}, ["unit"]),
    ("tow", "W as mass", {"- gravity": "- applied: {name: weight, value: \"W/g*1[lbf/slug]\", angle: -90 deg}"}, ["unit"]),
    ("tow", "tow in newtons", {"tow, value: P": "tow, value: 40 N"}, ["unit"]),
    ("tow", "tow in kip", {"tow, value: P": "tow, value: 40 kip"}, ["unit"]),
    ("tow", "tow below the horizontal", {"angle: beta}": "angle: -beta}"}, ["direction"]),
    ("tow", "angle from the vertical", {"angle: beta}": "angle: \"90[deg] - beta\"}"}, ["direction"]),
    ("tow", "angle in radians", {"angle: beta}": "angle: 25 rad}"}, ["direction"]),
    ("tow", "only the horizontal part", {TOW_LOAD:"      - applied: {name: tow, value: P*cos(beta), angle: 0 deg}\n"}, ["direction"]),
    ("tow", "N by hand is the weight", {"- normal": "- applied: {name: n, value: W, angle: 90 deg}", RUB:"      - applied: {name: rub, value: mu_k*(W - P*sin(beta)), angle: 180 deg}\n"}, ["magnitude"]),
    ("tow", "normal twice", {"- normal": "- normal\n      - applied: {name: n, value: W - P*sin(beta), angle: 90 deg}"}, ["superfluous"]),
    ("tow", "static for kinetic in the force by hand", {RUB:"      - applied: {name: rub, value: mu_s*(W - P*sin(beta)), angle: 180 deg}\n"}, ["magnitude"]),
    ("tow", "friction forward", {RUB:"      - applied: {name: rub, value: mu_k*(W - P*sin(beta)), angle: 0 deg}\n"}, ["sense"]),
    ("tow", "coefficients exchanged", {"static: mu_s, kinetic: mu_k": "static: mu_k, kinetic: mu_s"}, ["coefficient"]),
    ("tow", "two pulls", {TOW_LOAD:TOW_LOAD+"      - applied: {name: tow2, value: P, angle: beta}\n"}, ["superfluous"]),
    ("tow", "ma as a force", {TOW_LOAD:TOW_LOAD+"      - applied: {name: ma, value: \"W/g*5[ft/s^2]\"}\n"}, ["superfluous"]),
    ("tow", "N with plus", {"N = W - P": "N = W + P"}, ["derivation","missing"]),
    ("tow", "dimension in line", {"N = W - P": "N = W/g - P"}, ["missing","unreadable"]),
    ("tow", "v_dot without N sign", {"W/g*v_dot = P*cos(beta) - mu_k*N*sign(v)": "W/g*v_dot = P*cos(beta) - mu_k*W*sign(v)"}, ["derivation","missing"]),
    # ---- and right
    ("tow", "in SI units", {"units: US\n": "units: SI\n", "v: 2 ft/s": "v: 2 ft/s"}, []),
    ("tow", "components", {TOW_LOAD:"      - applied: {name: tx, value: P*cos(beta)}\n      - applied: {name: ty, value: P*sin(beta), angle: 90 deg}\n"}, []),
    ("tow", "from the tail, negative", {TOW_LOAD:"      - applied: {name: tow, value: -P, angle: \"beta + 180[deg]\"}\n"}, []),
    ("tow", "N and F by hand", {"- normal": "- applied: {name: n, value: W - P*sin(beta), angle: 90 deg}", RUB:"      - applied: {name: rub, value: mu_k*(W - P*sin(beta)), angle: 180 deg}\n"}, []),
    ("tow", "total reaction of the floor", {"      - normal\n"+RUB:"      - applied: {name: floor, fx: -mu_k*(W - P*sin(beta)), fy: W - P*sin(beta)}\n"}, []),
    ("tow", "acceleration solved for", {"W/g*v_dot = P*cos(beta) - mu_k*N*sign(v)": "v_dot = g*(P*cos(beta) - mu_k*(W - P*sin(beta))*sign(v))/W"}, []),
    ("tow", "numbers in newtons", {"tow, value: P": "tow, value: 177.9 N"}, []),
    # ---- ladder: wrong
    ("ladder", "person at the middle", {"at: rung": "at: G"}, ["place"]),
    ("ladder", "person at the foot", {"at: rung": "at: left"}, ["place"]),
    ("ladder", "person lifts", {"value: [0, -P]": "value: [0, P]"}, ["sense"]),
    ("ladder", "person along the ladder", {"value: [0, -P], at": "value: P, angle: 180 deg, frame: body, at"}, ["direction"]),
    ("ladder", "person as a mass", {"value: [0, -P]": "value: [0, -80 N]"}, ["magnitude"]),
    ("ladder", "person counted twice", {"at: rung}\n": "at: rung}\n      - applied: {name: p2, value: [0, -P], at: rung}\n"}, ["superfluous"]),
    ("ladder", "forgets the foot's friction", {"forces: [gravity, normal, friction: mu]": "forces: [gravity, normal]"}, ["missing"]),
    ("ladder", "friction at the wall", {"forces: [gravity, normal: {side: left}]": "forces: [gravity, normal: {side: left}, friction: mu]"}, ["superfluous"]),
    ("ladder", "wall pushes down too", {"forces: [gravity, normal: {side: left}]": "forces: [gravity, normal: {side: left}, applied: {name: wall, value: 100 N, angle: -90 deg}]"}, ["superfluous"]),
    ("ladder", "forgets person", {"      - applied: {name: person, value: [0, -P], at: rung}\n": NONE}, ["missing"]),
    ("ladder", "weight at the top", {"    forces:\n      - gravity\n      - applied": "    forces:\n      - applied: {name: w, value: [0, -m*g], at: right}\n      - applied"}, ["place"]),
    ("ladder", "ladder heavier", {"mass: 20 kg": "mass: 25 kg"}, ["inertia"]),
    # ---- ladder: right
    ("ladder", "force below by angle", {"value: [0, -P], at": "value: P, angle: 270 deg, at"}, []),
    ("ladder", "person and moment", {"value: [0, -P], at: rung}\n": "value: [0, -P]}\n    moments: [applied: {name: m, value: \"-P*(s - 2.5[m])*cos(theta)\"}]\n"}, []),
    ("ladder", "weight by hand at G", {"    forces:\n      - gravity\n      - applied": "    forces:\n      - applied: {name: w, value: [0, \"-20[kg]*g\"]}\n      - applied"}, []),
    ("ladder", "point in place of rung", {"at: rung": "at: [0.5 m, 0 m]"}, []),
    # ---- drum: wrong
    ("drum", "cord on the other side", {"offset: [R, 0 m]": "offset: [-R, 0 m]"}, ["place"]),
    ("drum", "cord at the axle", {", at: {offset: [R, 0 m]}": NONE}, ["place"]),
    ("drum", "cord fixed to the rim point", {"at: {offset: [R, 0 m]}": "at: rim"}, ["place"]),
    ("drum", "cord pulls up", {"fy: -T": "fy: T"}, ["sense"]),
    ("drum", "shoe radial", {"angle: 90 deg, frame: body, at: rim": "angle: 0 deg, frame: body, at: rim"}, ["direction"]),
    ("drum", "shoe vertical in the world", {"angle: 90 deg, frame: body, at: rim": "angle: 90 deg, at: rim"}, ["direction"]),
    ("drum", "brake helps", {"value: -M_b": "value: M_b"}, ["sense"]),
    ("drum", "brake as a force value", {"value: -M_b": "value: \"-M_b/R*1[m]\""}, ["magnitude"]),
    ("drum", "lbf*ft for brake", {"value: -M_b": "value: -4 lbf*ft"}, ["unit"]),
    ("drum", "ring for a disc", {"shape: disc": "shape: ring"}, ["inertia"]),
    ("drum", "arm is the diameter", {"-T*R + Q*R": "-T*2*R + Q*R"}, ["derivation","missing"]),
    ("drum", "m R^2 for I_O", {"I_O*omega_dot": "m*R^2*omega_dot"}, ["derivation","missing"]),
    # ---- drum: right
    ("drum", "cord as force and moment", {CORD:"      - applied: {name: cord, fx: 0 N, fy: -T}\n","- applied: {name: brake": "- applied: {name: cm, value: -T*R}\n      - applied: {name: brake"}, []),
    ("drum", "one moment for shoe and brake", {SHOE:"      - applied: {name: shoe, value: Q, angle: 90 deg, frame: body}\n","value: -M_b": "value: Q*R - M_b"}, []),
    ("drum", "shoe in the world", {SHOE:"      - applied: {name: shoe, value: Q, angle: \"theta + 90[deg]\", at: rim}\n"}, []),
    ("drum", "half m R^2", {"I_O*omega_dot": "m*R^2/2*omega_dot"}, []),
    ("drum", "numbers", {"-T*R + Q*R - M_b": "-13[N*m]"}, []),
    # ---- osc: wrong
    ("osc", "action without reaction", {"      - applied: {name: shared, value: -k2*(x - a.x)}\n": NONE}, ["missing"]),
    ("osc", "shared with the same sense on both", {"value: -k2*(x - a.x)": "value: k2*(x - a.x)"}, ["sense"]),
    ("osc", "shared by the own place only", {"value: -k2*(x - b.x)": "value: -k2*x"}, ["magnitude"]),
    ("osc", "stiffness halved", {"stiffness: k1": "stiffness: k1/2"}, ["magnitude"]),
    ("osc", "damper pushes on", {"coefficient: c}": "coefficient: -c}"}, ["missing","unreadable"]),
    ("osc", "cos for sin", {"value: F0*sin(w*t)}": "value: F0*cos(w*t)}"}, ["magnitude"]),
    ("osc", "drive on the wrong body", {"      - applied: {name: drive, value: F0*sin(w*t)}\n": NONE, "      - damper": "      - applied: {name: drive, value: F0*sin(w*t)}\n      - damper"}, ["missing","superfluous"]),
    ("osc", "amplitude only", {"value: F0*sin(w*t)}": "value: F0}"}, ["magnitude"]),
    ("osc", "gravity along", {"      - damper": "      - applied: {name: mg, value: m*g}\n      - damper"}, ["superfluous"]),
    ("osc", "damper between the masses", {"      - damper: {name: dashpot, coefficient: c}": "      - applied: {name: dashpot, value: -c*(v - b.v)}"}, ["magnitude"]),
    ("osc", "line with a sign", {"- k2*(x - b.x) - c*v": "+ k2*(x - b.x) - c*v"}, ["derivation","missing"]),
    # ---- osc: right
    ("osc", "one spring for two", {"      - spring: {name: left, stiffness: k1}\n      - applied: {name: shared, value: -k2*(x - b.x)}\n": "      - applied: {name: springs, value: -(k1 + k2)*x + k2*b.x}\n"}, []),
    ("osc", "spring with a free end that moves", {"      - applied: {name: shared, value: -k2*(x - b.x)}\n": "      - applied: {name: shared, value: k2*b.x}\n      - spring: {name: s2, stiffness: k2}\n"}, []),
    ("osc", "potential", {"- spring: {name: left, stiffness: k1}": "- potential: {name: left, V: k1*x^2/2}"}, []),
    ("osc", "x to the left", {"  b:\n    mass: m_b\n    motion: {slide: {along: 0 deg}}\n    forces:\n": "  b:\n    mass: m_b\n    motion: {slide: {along: 180 deg}}\n    forces:\n", "value: -k2*(x - a.x)": "value: -k2*(x + a.x)", "value: F0*sin(w*t)}": "value: -F0*sin(w*t)}", "value: -k2*(x - b.x)": "value: -k2*(x + b.x)",
    "- k2*(x - b.x) - c*v": "- k2*(x + b.x) - c*v", "-k2*(x - a.x) + F0*sin(w*t)\"": "-k2*(x + a.x) - F0*sin(w*t)\""}, []),
    ("osc", "phase", {"value: F0*sin(w*t)}": "value: \"F0*cos(w*t - 90[deg])\"}"}, []),
    # ---- beam: wrong
    ("beam", "resultant of the ramp at the middle", {RAMP:"      - applied: {name: ramp, value: [0, -w1*l/4], at: [l/4, 0 m]}\n"}, ["place"]),
    ("beam", "resultant of ramp at one third from the small end", {RAMP:"      - applied: {name: ramp, value: [0, -w1*l/4], at: [l/6, 0 m]}\n"}, ["place"]),
    ("beam", "ramp resultant without half", {RAMP:"      - applied: {name: ramp, value: [0, -w1*l/2], at: [l/3, 0 m]}\n"}, ["magnitude"]),
    ("beam", "ramp reversed", {"value: w1*s/(l/2)": "value: w1*(1 - s/(l/2))"}, ["place"]),
    ("beam", "uniform on the whole length", {"from: left, to: M, value: w0": "from: left, to: right, value: w0"}, ["magnitude"]),
    ("beam", "uniform upward", {"value: w0, angle: -90 deg": "value: w0, angle: 90 deg"}, ["sense"]),
    ("beam", "couple turned", {"value: C": "value: -C"}, ["sense"]),
    ("beam", "couple as a force", {"    moments:\n      - applied: {name: couple, value: C}\n": "      - applied: {name: couple, value: [0, 50 N], at: right}\n"}, ["missing","superfluous"]),
    ("beam", "link left out", {"couplings:\n  - rod: {name: link, between: [beam.right, ground.B]}\n": NONE}, ["motion"]),
    ("beam", "forgets own weight", {"      - gravity\n": NONE}, ["missing"]),
    # ---- beam: right
    ("beam", "resultants", {UNIFORM:"      - applied: {name: u, value: [0, -w0*l/2], at: [-l/4, 0 m]}\n",RAMP:"      - applied: {name: r, value: [0, -w1*l/4], at: [l/3, 0 m]}\n"}, []),
    ("beam", "ramp from the other end", {RAMP:"      - distributed: {name: ramp, from: right, to: M, value: w1*(1 - s/(l/2)), angle: -90 deg}\n"}, []),
    ("beam", "couple as two forces", {"    moments:\n      - applied: {name: couple, value: C}\n": "      - applied: {name: c1, value: [0, C/l], at: right}\n      - applied: {name: c2, value: [0, -C/l], at: left}\n"}, []),
    ("beam", "weight spread", {"      - gravity\n": "      - distributed: {name: own, from: left, to: right, value: \"20[kg]*g/l\", angle: -90 deg}\n"}, []),
    ("beam", "one load for two", {UNIFORM:"      - distributed: {name: u2, from: M, to: left, value: w0, angle: -90 deg}\n"}, []),
    # ---- double: wrong
    ("double", "no reaction of the elbow", {"      - applied: {name: reaction, value: -M2}\n": NONE}, ["missing"]),
    ("double", "reaction in the same sense", {"value: -M2": "value: M2"}, ["sense"]),
    ("double", "elbow on both, shoulder on the lower", {"      - applied: {name: elbow, value: M2}": "      - applied: {name: elbow, value: M1}"}, ["magnitude"]),
    ("double", "load turns with the rod", {"angle: 0 deg, at: right": "angle: 0 deg, frame: body, at: right"}, ["direction"]),
    ("double", "load at the joint", {"angle: 0 deg, at: right": "angle: 0 deg, at: left"}, ["place"]),
    ("double", "weight of lower on the upper as well", {"    forces: [gravity]\n": "    forces: [gravity, applied: {name: w2, value: [0, -m2*g], at: right}]\n"}, ["superfluous"]),
    ("double", "masses exchanged", {"mass: m1": "mass: m2", "    mass: m2\n    motion: {pivot: {on": "    mass: m1\n    motion: {pivot: {on"}, ["inertia","inertia"]),
    ("double", "weight at the end", {"    forces: [gravity]\n": "    forces: [applied: {name: w, value: [0, -m1*g], at: right}]\n"}, ["place"]),
    # ---- double: right
    ("double", "one moment at the upper", {"      - applied: {name: shoulder, value: M1}\n      - applied: {name: reaction, value: -M2}\n": "      - applied: {name: sum, value: M1 - M2}\n"}, []),
    ("double", "weight by hand", {"    forces: [gravity]\n": "    forces: [applied: {name: w, value: m1*g, angle: -90 deg, at: G}]\n"}, []),
    ("double", "load by a point along its line", {"angle: 0 deg, at: right": "angle: 0 deg, at: {point: right, offset: [0.3 m, 0 m]}"}, []),
    # ---- roll: wrong
    ("roll", "pull at the rim", {"angle: beta}": "angle: beta, at: {offset: [0 m, R]}}"}, ["place"]),
    ("roll", "moment other way", {"drag, value: M": "drag, value: -M"}, ["sense"]),
    ("roll", "friction drawn too", {"angle: beta}": "angle: beta}\n      - applied: {name: f, value: 5 N, angle: 180 deg, at: {offset: [0 m, -R]}}"}, ["superfluous"]),
    ("roll", "normal drawn too", {"angle: beta}": "angle: beta}\n      - applied: {name: n, value: m*g - P*sin(beta), angle: 90 deg}"}, []),
    ("roll", "inertia forgotten", {"3/2*m*vx_dot": "m*vx_dot"}, ["derivation","missing"]),
    ("roll", "sphere", {"shape: disc": "shape: sphere"}, ["inertia"]),
    ("roll", "moment sign in line", {"- M/R": "+ M/R"}, ["derivation","missing"]),
    # ---- roll: right
    ("roll", "pull with components", {"value: P, angle: beta": "fx: P*cos(beta), fy: P*sin(beta)"}, []),
    ("roll", "about the contact", {"\"3/2*m*vx_dot = P*cos(beta) - M/R\"": "\"3/2*m*R^2*omega_dot = -P*R*cos(beta) + M\""}, []),
    ("roll", "couple of forces", {"      - applied: {name: drag, value: M}\n": "      - applied: {name: d1, value: M}\n"}, []),
    # ---- bead: wrong
    ("bead", "drag quadratic", {GREASE:"      - drag: {name: grease, quadratic: 0.3 N*s^2/m^2}\n"}, ["magnitude"]),
    ("bead", "blow downward", {"value: [0.4 N, 0.1 N]": "value: [0.4 N, -0.1 N]"}, ["direction"]),
    ("bead", "blow along the wire", {"value: [0.4 N, 0.1 N]": "value: 0.412 N, angle: 0 deg, frame: body"}, ["direction"]),
    ("bead", "no weight", {"      - gravity\n": NONE}, ["missing"]),
    ("bead", "lines forget slope", {"/sqrt(1 + (2*a*bead.x)^2) - c*v": " - c*v"}, ["derivation","missing"]),
    # ---- bead: right
    ("bead", "grease by hand", {GREASE:"      - applied: {name: grease, value: -c*v, angle: 0 deg, frame: body}\n"}, []),
    ("bead", "drag linear", {GREASE:"      - drag: {name: grease, linear: c}\n"}, []),
    ("bead", "blow and weight", {"      - gravity\n": NONE, "value: [0.4 N, 0.1 N]": "value: [0.4 N, \"0.1[N] - m*g\"]"}, []),
    # ---- kite: wrong
    ("kite", "wind from behind", {"wind: [-u, 0]": "wind: [u, 0]"}, ["direction"]),
    ("kite", "no wind", {", wind: [-u, 0]": NONE}, ["direction"]),
    ("kite", "drag linear", {AIR:"      - drag: {name: air, linear: 0.2 N*s/m, wind: [-u, 0]}\n"}, ["magnitude"]),
    ("kite", "thrust horizontal", {"angle: 0 deg, frame: body, at: tail": "angle: 0 deg, at: tail"}, ["direction"]),
    ("kite", "lift at the nose", {"frame: body, at: wing": "frame: body, at: nose"}, ["place"]),
    ("kite", "thrust backward", {"value: T, angle: 0": "value: T, angle: 180"}, ["sense"]),
    ("kite", "lift vertical", {"angle: 90 deg, frame: body, at: wing": "angle: 90 deg, at: wing"}, ["direction"]),
    ("kite", "lift half", {"value: 2*T": "value: T"}, ["magnitude"]),
    ("kite", "fins forgotten", {"    moments:\n      - damper: {name: fins, coefficient: 0.05 N*m*s}\n": NONE}, ["missing"]),
    ("kite", "fins excite", {"coefficient: 0.05": "coefficient: -0.05"}, ["missing","unreadable"]),
    ("kite", "air drag at nose", {"wind: [-u, 0]": "wind: [-u, 0], at: nose"}, ["direction"]),
    # ---- kite: right
    ("kite", "drag by hand", {AIR:"      - applied: {name: air, fx: \"-k*hypot(vx + u, vy)*(vx + u)\", fy: \"-k*hypot(vx + u, vy)*vy\"}\n"}, []),
    ("kite", "thrust slides along its line", {"frame: body, at: tail": "frame: body, at: nose"}, []),
    ("kite", "lift and thrust as one", {THRUST:NONE, LIFT:"      - applied: {name: both, fx: T, fy: 2*T, frame: body, at: [0.05 m, 0 m]}\n"}, []),
    ("kite", "fins by hand", {"- damper: {name: fins, coefficient: 0.05 N*m*s}": "- applied: {name: fins, value: \"-0.05[N*m*s]*omega\"}"}, []),
    ("kite", "weight by its components along the body", {"      - gravity\n": "      - applied: {name: w, fx: -m*g*sin(theta), fy: -m*g*cos(theta), frame: body}\n"}, []),
    # ---- cart: wrong
    ("cart", "push on the pole", {"      - applied: {name: push, value: \"F_0*cos(3[rad/s]*t)\"}\n": NONE, "    initial: {theta: -0.2 rad}\n    forces: [gravity]": "    initial: {theta: -0.2 rad}\n    forces: [gravity, applied: {name: push, value: [\"F_0*cos(3[rad/s]*t)\", 0]}]"}, ["missing","superfluous"]),
    ("cart", "weight of the pole on the cart", {"      - normal\n": "      - normal\n      - applied: {name: wp, value: m_p*g, angle: -90 deg}\n"}, ["superfluous"]),
    ("cart", "grease as coulomb", {"- damper: {name: grease, coefficient: 0.8 N*s/m}": "- friction: {name: grease, coefficient: 0.1}"}, ["magnitude"]),
    ("cart", "pole about G only", {"m_p*L^2/3*omega_dot": "m_p*L^2/12*omega_dot"}, ["derivation","missing"]),
    ("cart", "pole gravity sign", {"+ m_p*g*L/2*sin(theta)": "- m_p*g*L/2*sin(theta)"}, ["derivation","missing"]),
    ("cart", "centrifugal forgotten", {" - pole.omega^2*sin(pole.theta)": NONE}, ["derivation","missing"]),
    ("cart", "push frequency", {"value: \"F_0*cos(3[rad/s]*t)\"": "value: \"F_0*cos(3[rev/s]*t)\""}, ["magnitude"]),
    # ---- cart: right
    ("cart", "pole line divided", {"m_p*L^2/3*omega_dot = m_p*L/2*cart.v_dot*cos(theta) + m_p*g*L/2*sin(theta)": "2*L*omega_dot = 3*cart.v_dot*cos(theta) + 3*g*sin(theta)"}, []),
    ("cart", "grease by hand", {"- damper: {name: grease, coefficient: 0.8 N*s/m}": "- applied: {name: grease, value: \"-0.8[N*s/m]*v\"}"}, []),
    ("cart", "cart's own normal with number", {"      - normal\n": "      - normal: {two_sided: true}\n"}, []),
    ("tow", "vacuous when", {'- "N = W - P*sin(beta)"':'- {equation: "N = W", when: t > 1e9}'}, ["derivation","missing"]),
    ("tow", "when nothing moves", {'- "N = W - P*sin(beta)"':'- {equation: "N = W", when: "v == 0"}'}, ["derivation","missing"]),
    ("tow", "zero times", {'- "N = W - P*sin(beta)"':'- "0*N = 0"'}, ["derivation","missing"]),
    ("tow", "other gravity", {"units: US\n": "units: US\ngravity: 16 ft/s^2\n"}, ["motion"]),
    ("tow", "P redefined", {"P: 40 lbf": "P: 50 lbf"}, ["magnitude"]),
    ("tow", "mu redefined", {"mu_k: 0.3": "mu_k: 0.35"}, ["coefficient"]),
    ("tow", "beta redefined", {"beta: 25 deg": "beta: 35 deg"}, ["direction"]),
    ("tow", "units SI with US numbers: bare", {"tow, value: P": "tow, value: 178"}, ["unit"]),
    ("tow", "surface moves", {"kinetic: mu_k}": "kinetic: mu_k, surface_speed: 1 ft/s}"}, ["coefficient"]),
    ("tow", "normal pulls", {"- normal": "- normal: {side: right}"}, ["sense"]),
    ("tow", "two that cancel nearly", {TOW_LOAD:TOW_LOAD+"      - applied: {name: a, value: 5 lbf}\n      - applied: {name: b, value: -5 lbf}\n"}, ["superfluous","superfluous"]),
    ("tow", "right at the start only", {"tow, value: P": "tow, value: \"P*(1 + t/1[s])\""}, ["magnitude"]),
    ("tow", "right at start velocity only", {"tow, value: P": "tow, value: P*v/2"}, ["magnitude"]),
    ("tow", "line with a number for v", {"- mu_k*N*sign(v)": "- mu_k*N*v/2"}, ["derivation","missing"]),
    ("ladder", "the rung elsewhere", {"rung: [\"s - 2.5[m]\", 0]": "rung: [\"s - 2[m]\", 0]"}, ["place"]),
    ("ladder", "ladder longer", {"length: 5 m": "length: 5.5 m"}, ["inertia","motion","place","place"]),
    ("ladder", "other point on the same vertical is right?", {"at: rung": "at: {point: rung, offset: [0, 1 m]}"}, []),
    ("ladder", "wall normal to the other side", {"normal: {side: left}": "normal: {side: right}"}, ["sense"]),
    ("ladder", "mu of the foot", {"friction: mu]": "friction: 0.6]"}, ["coefficient"]),
    ("ladder", "person toward the foot", {"value: [0, -P], at: rung": "value: P, toward: foot, at: rung"}, ["direction","superfluous"]),
    ("drum", "pivot elsewhere", {"at: [1 m, 2 m]": "at: [0 m, 0 m]"}, ["motion"]),
    ("drum", "radius changed", {"R: 0.3 m": "R: 0.25 m"}, ["inertia","place","place"]),
    ("drum", "I_O as a number wrong", {"I_O*omega_dot": "0.27[kg*m^2]*omega_dot"}, ["derivation","missing"]),
    ("drum", "sign of whole equation", {"= -T*R + Q*R - M_b": "= T*R - Q*R + M_b"}, ["derivation","missing"]),
    ("drum", "true but of energy", {'"I_O*omega_dot = -T*R + Q*R - M_b"':'"I_O*omega*omega_dot = (-T*R + Q*R - M_b)*omega"'}, []),
    ("osc", "swapped parameters", {"value: -k2*(x - b.x)": "value: -k1*(x - b.x)"}, ["magnitude"]),
    ("osc", "spring relaxed elsewhere", {"stiffness: k1}": "stiffness: k1, neutral: 0.05 m}"}, ["magnitude"]),
    ("beam", "pressure for load", {"value: w0, angle": "value: w0/l, angle"}, ["missing","unit"]),
    ("beam", "from the middle of the wrong half", {"from: left, to: M, value: w0": "from: M, to: right, value: w0"}, ["place"]),
    ("beam", "ramp quadratic", {"value: w1*s/(l/2)": "value: w1*(s/(l/2))^2"}, ["magnitude"]),
    ("double", "elbow moment as an internal force only on upper", {"    moments:\n      - applied: {name: elbow, value: M2}\n": NONE}, ["missing"]),
    ("kite", "thrust as acceleration", {"value: T, angle: 0": "value: T/m, angle: 0"}, ["missing","unit"]),
    ("kite", "mass on the nose", {"mass: m\n    points": "mass: m\n    center: [0.05 m, 0]\n    points"}, ["inertia","magnitude","place"]),
    # one degree of freedom
    ("atwood", "for the other mass", {ATWOOD_LINE:NONE, "[R, -4]}}\n    forces: [gravity]\n": "[R, -4]}}\n    forces: [gravity]\n    hand: (m_1 + m_2 + M/2)*v_dot = (m_2 - m_1)*g + M_f/R*sign(pulley.omega)\n"}, []),
    ("atwood", "for the pulley, wrong sign", {ATWOOD_LINE:NONE, "moments: [friction": "hand: (m_1 + m_2 + M/2)*R*omega_dot = -(m_1 - m_2)*g - M_f/R*sign(omega)\n    moments: [friction"}, ["derivation","missing"]),
    ("atwood", "for the pulley", {ATWOOD_LINE:NONE, "moments: [friction": "hand: (m_1 + m_2 + M/2)*R*omega_dot = (m_1 - m_2)*g - M_f/R*sign(omega)\n    moments: [friction"}, []),
    ("atwood", "kinematics for the pulley", {ATWOOD_LINE:NONE, "moments: [friction": "hand: R*omega_dot = m1.v_dot\n    moments: [friction"}, ["derivation","missing"]),
    ("atwood", "free fall", {ATWOOD_LINE:"hand: v_dot = g"}, ["derivation","missing"]),
    ("atwood", "no pulley inertia", {ATWOOD_LINE:"hand: m*(v_dot - g) + m_2*(v_dot + g) = -M_f/R*sign(pulley.omega)"}, ["derivation","missing"]),
    ("gears", "for the pinion", {GEAR_LINE:NONE, "moments: [applied: {name: drive, value: 1.2 N*m}]": "moments: [applied: {name: drive, value: 1.2 N*m}]\n    hand: (0.02[kg*m^2] + 0.18[kg*m^2]/9)*omega_dot = 1.2[N*m] - c/9*omega"}, []),
    ("gears", "ratio not squared", {"0.02[kg*m^2]*9": "0.02[kg*m^2]*3"}, ["derivation","missing"]),
    ("gears", "moment not geared", {"-1.2[N*m]*3": "-1.2[N*m]"}, ["derivation","missing"]),
    ("gears", "drive on the wheel", {"moments: [applied: {name: drive, value: 1.2 N*m}]": "moments: []", "moments: [damper: {name: load, coefficient: c}]": "moments: [damper: {name: load, coefficient: c}, applied: {name: drive, value: 1.2 N*m}]"}, ["missing","superfluous"]),
    ("gate", "h^2/2 for the moment", {"p*h^3/3": "p*h^2/2*1[m]"}, ["derivation","missing"]),
    ("gate", "uniform", {"value: p*s, angle": "value: p*h/2, angle"}, ["place"]),
    ("gate", "water as a resultant at 2/3", {"- distributed: {name: water, from: left, to: right, value: p*s, angle: 90 deg, frame: body, factor: exp(-t/tau)}": "- applied: {name: w, value: p*h^2/2*exp(-t/tau), angle: 90 deg, frame: body, at: [h/6, 0 m]}"}, []),
    ("gate", "water horizontal", {"angle: 90 deg, frame: body, factor": "angle: 0 deg, factor"}, ["direction"]),
    ("gate", "factor forgotten", {", factor: exp(-t/tau)}": "}"}, ["magnitude"]),
    ("gate", "cos/sin", {"- m*g*h/2*cos(theta)": "- m*g*h/2*sin(theta)"}, ["derivation","missing"]),
    ("hole", "hole with positive mass", {"mass: -M_h": "mass: M_h"}, ["inertia"]),
    ("motor", "k squared", {"value: k*states.current": "value: 2*k*states.current"}, ["magnitude"]),
    ("motor", "stationary current", {"value: k*states.current": "value: k*U/R"}, ["magnitude"]),
    ("motor", "line with U/R", {"J*omega_dot = k*states.current": "J*omega_dot = k*U/R"}, ["derivation","missing"]),
]

# What YAML cannot read: the entry alone is lost.
FLOW = "    forces: [gravity, normal, friction: {static: mu_s, kinetic: mu_k}, applied: {name: tow, value: "
LIST = "    forces:\n      - gravity\n      - normal\n" + RUB + TOW_LOAD
ONE_LOST = ["missing", "unreadable"]
ALL_LOST = ["missing"] * 4 + ["unreadable"]
CASES += [
    ("tow", "a unit in braces without quotes", {"tow, value: P,": "tow, value: 40[lbf],"}, ONE_LOST),
    ("tow", "a brace that is not closed", {"angle: beta}\n    hand": "angle: beta\n    hand"}, ONE_LOST),
    ("tow", "one that is not closed, before others", {"mu_k}\n": "mu_k\n"}, ONE_LOST),
    ("tow", "two faults", {"mu_k}\n": "mu_k\n", "tow, value: P,": "tow, value: 40[lbf],"}, sorted(2 * ONE_LOST)),
    ("tow", "a key twice", {"tow, value: P,": "tow, value: P, value: P,"}, ONE_LOST),
    ("tow", "a quote that is not closed", {'- "N = W - P*sin(beta)"': '- "N = W - P*sin(beta)'}, ONE_LOST),
    ("tow", "a line indented by a tab", {TOW_LOAD: TOW_LOAD.replace("      ", "\t")}, ONE_LOST),
    ("tow", "a line that fits nothing", {"      - normal\n": "      - normal\n   so it is\n"}, ["unreadable"]),
    ("tow", "a list on one line with a unit without quotes", {LIST: FLOW + "40[lbf], angle: beta}]\n"}, ALL_LOST),
    ("tow", "a list on one line that is not closed", {LIST: FLOW + "P, angle: beta}\n"}, ALL_LOST),
]

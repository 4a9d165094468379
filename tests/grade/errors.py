# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors that students make, each a change of a right answer, and what each has to be called.

A case is (what it is, {text of the right answer: text of the wrong one}, kind of the finding, name in the finding).
"""

BLOCK = """fbd: 1
parameters: {phi: 30 deg, beta: 10 deg, f1: 5 N, mu_s: 0.5, mu_k: 0.4, m: 2 kg}
bodies:
  block:
    mass: m
    motion: {slide: {along: phi}}
    initial: {v: 3 m/s}
    forces:
      - gravity
      - normal
      - friction: {static: mu_s, kinetic: mu_k}
      - applied: {name: push, value: f1, angle: phi + beta}
    hand:
      - "N = m*g*cos(phi) - f1*sin(beta)"
      - "m*v_dot = f1*cos(beta) - m*g*sin(phi) - sign(v)*mu_k*N"
"""

PENDULUM = """fbd: 1
parameters: {L: 0.8 m, alpha: 20 deg, m: 3 kg, c: 0.2 N*m*s, P: 7 N, M1: 2 N*m}
bodies:
  rod:
    shape: rod
    length: L
    mass: m
    motion: {pivot: {at: [0, 0], point: left}}
    initial: {theta: 30 deg}
    forces:
      - gravity
      - applied: {name: pull, value: P, angle: alpha, at: right}
    moments:
      - damper: {coefficient: c}
      - applied: {name: motor, value: M1}
    hand: "I_O*theta_ddot = -m*g*L/2*cos(theta) + P*L*sin(alpha - theta) - c*omega + M1"
"""

PLATE = """fbd: 1
parameters: {F: 10 N, r: 2 N/s, k: 200 N/m}
bodies:
  plate:
    shape: prism
    a: 0.4 m
    b: 0.2 m
    c: 0.01 m
    mass: 2 kg
    points: {P: [0.2 m, 0.1 m], Q: [-0.2 m, 0.1 m]}
    motion: {planar: {}}
    forces:
      - gravity
      - applied: {name: F1, value: F, angle: 30 deg, at: P}
      - applied: {name: F2, fx: r*t, fy: 5 N, at: Q}
      - spring: {name: spring, stiffness: k, free_length: 0.3 m, at: Q, to: [-1 m, 1 m]}
    moments:
      - applied: {name: couple, value: 3 N*m}
"""

BALL = """fbd: 1
parameters: {m: 0.2 kg}
bodies:
  ball:
    mass: m
    motion: {particle: {}}
    initial: {vx: 10 m/s, vy: 5 m/s}
    forces:
      - gravity
      - drag: {quadratic: 0.01 N*s^2/m^2}
"""

PAIR = """fbd: 1
bodies:
  cart:
    mass: 3 kg
    motion: {slide: {along: 0 deg}}
    forces:
      - gravity
      - normal
      - applied: {name: pull, value: 6 N}
  hanger:
    mass: 1 kg
    motion: {slide: {along: -90 deg}}
    forces:
      - gravity
"""

# Bodies in contact at every random place; a rope, along which accelerations are the same whatever the forces are; and
# a block that sticks.
BOUNCE = """fbd: 1
bodies:
  ball:
    shape: disc
    radius: 0.1 m
    mass: 1 kg
    motion: {planar: {}}
    initial: {y: 1 m}
    forces:
      - gravity
ground: {lines: {floor: {along: 0 deg}}}
contacts:
  - {between: [ball, ground.floor], restitution: 0.5}
simulate: {until: 2 s}
"""

ROPE = """fbd: 1
parameters: {m_1: 3 kg, m_2: 2 kg}
bodies:
  one:
    mass: m_1
    motion: {slide: {along: -90 deg, through: [-0.1 m, -4 m]}}
    forces: [gravity]
    hand: m*(v_dot - g) + m_2*(v_dot + g) = 0*v_dot*m
  two:
    mass: m_2
    motion: {slide: {along: -90 deg, through: [0.1 m, -4 m]}}
    forces: [gravity]
ground: {points: {left: [-0.1 m, 0], right: [0.1 m, 0]}}
couplings:
  - rope: {name: cable, through: [one.G, ground.left, ground.right, two.G]}
simulate: {until: 1 s}
"""

REST = """fbd: 1
bodies:
  box:
    mass: 2 kg
    motion: slide
    forces:
      - gravity
      - normal
      - friction: {static: 0.9, kinetic: 0.8}
      - applied: {name: shake, fx: "3[N]*cos(9[rad/s]*t)", fy: "2[N]*sin(3[rad/s]*t)"}
simulate: {until: 2 s}
"""

KEYS = {"bounce": BOUNCE, "rope": ROPE, "rest": REST, "block": BLOCK, "pendulum": PENDULUM, "plate": PLATE, "ball": BALL, "pair": PAIR}

NONE = ""

CASES = [
    # ---- a block on an incline
    ("block", "forgets the weight", {"      - gravity\n": NONE}, "missing", ""),
    ("block", "forgets friction", {"      - friction: {static: mu_s, kinetic: mu_k}\n": NONE}, "missing", ""),
    ("block", "forgets the push", {"      - applied: {name: push, value: f1, angle: phi + beta}\n": NONE}, "missing", ""),
    ("block", "pushes downhill", {"value: f1, angle": "value: -f1, angle"}, "sense", "push"),
    ("block", "pushes along x", {"angle: phi + beta": "angle: 10 deg"}, "direction", "push"),
    ("block", "exchanges sine and cosine", {"angle: phi + beta": "fx: f1*sin(phi + beta), fy: f1*cos(phi + beta)",
                                            "push, value: f1,": "push,"}, "direction", "push"),
    ("block", "pushes twice as much", {"value: f1, angle": "value: 2*f1, angle"}, "magnitude", "push"),
    ("block", "takes pounds for newtons", {"value: f1, angle": "value: 5 lbf, angle"}, "unit", "push"),
    ("block", "kilonewtons", {"value: f1, angle": "value: 5 kN, angle"}, "unit", "push"),
    ("block", "a mass for a force", {"value: f1, angle": "value: m, angle"}, "unit", "push"),
    ("block", "g once too often", {"value: f1, angle": "value: f1*9.81, angle"}, "unit", "push"),
    ("block", "the mass as a weight", {"- gravity": '- applied: {name: weight, value: "2[N]", angle: -90 deg}'},
     "unit", "weight"),
    ("block", "weight upward", {"- gravity": "- applied: {name: weight, value: m*g, angle: 90 deg}"}, "sense", "weight"),
    ("block", "weight across the slope", {"- gravity": "- applied: {name: weight, value: m*g, angle: phi - pi/2}"},
     "direction", "weight"),
    ("block", "a force of inertia", {"      - normal\n": '      - normal\n      - applied: {name: inertia, value: "2[N]"}\n'},
     "superfluous", "inertia"),
    ("block", "the force of motion", {"      - normal\n": "      - normal\n      - applied: {name: thrust, value: 20 N}\n"},
     "superfluous", "thrust"),
    ("block", "the weight twice", {"      - normal\n": "      - normal\n      - applied: {name: mg, value: m*g, angle: -90 deg}\n"},
     "superfluous", "mg"),
    ("block", "another coefficient", {"kinetic: mu_k": "kinetic: mu_s"}, "coefficient", "friction"),
    ("block", "friction that pushes on", {"- friction: {static: mu_s, kinetic: mu_k}":
     "- applied: {name: rub, value: mu_k*(m*g*cos(phi) - f1*sin(beta)), angle: phi}"}, "sense", "rub"),
    ("block", "friction with the whole weight", {"- friction: {static: mu_s, kinetic: mu_k}":
     "- applied: {name: rub, value: mu_k*m*g, angle: phi + pi}"}, "magnitude", "rub"),
    ("block", "a force without a unit's sense", {"value: f1, angle": "value: 5 s, angle"}, "unit", "push"),
    ("block", "a word for a force", {"- normal": "- reaction"}, "unreadable", "reaction"),
    ("block", "sine for cosine in N", {"N = m*g*cos(phi)": "N = m*g*sin(phi)"}, "derivation", "N = m*g*sin(phi) - f1*sin(beta)"),
    ("block", "a sign in the equation", {"- m*g*sin(phi)": "+ m*g*sin(phi)"}, "derivation", None),
    ("block", "an identity", {"m*v_dot = f1*cos(beta) - m*g*sin(phi) - sign(v)*mu_k*N": "m*v_dot = m*v_dot"},
     "derivation", "m*v_dot = m*v_dot"),
    ("block", "a wrong dimension in a line", {"sign(v)*mu_k*N": "m*g*v"}, "unreadable", None),
    ("block", "a line that is no equation", {"m*v_dot = f1": "m*v_dot + f1"}, "unreadable", None),
    ("block", "one line only", {'      - "N = m*g*cos(phi) - f1*sin(beta)"\n': NONE}, "missing", ""),
    # ---- a rod on a pivot
    ("pendulum", "pulls at the middle", {"angle: alpha, at: right": "angle: alpha"}, "place", "pull"),
    ("pendulum", "pulls in the rod's frame", {"angle: alpha, at": "angle: alpha, frame: body, at"}, "direction", "pull"),
    ("pendulum", "the motor turns back", {"value: M1": "value: -M1"}, "sense", "motor"),
    ("pendulum", "a motor of half the moment", {"value: M1": "value: M1/2"}, "magnitude", "motor"),
    ("pendulum", "forgets the damper", {"      - damper: {coefficient: c}\n": NONE}, "missing", ""),
    ("pendulum", "another mass", {"mass: m": "mass: 2*m"}, "inertia", ""),
    ("pendulum", "I about G in the equation", {"I_O*theta_ddot": "I_G*theta_ddot"}, "derivation", None),
    ("pendulum", "the whole length as arm", {"m*g*L/2": "m*g*L"}, "derivation", None),
    ("pendulum", "I about O given about G", {"    shape: rod\n    length: L\n":
     "    points: {left: [-L/2, 0], right: [L/2, 0]}\n    inertia: {value: m*L^2/3, about: G}\n"}, "reference_point", ""),
    # ---- a plate in the plane
    ("plate", "acts at G", {"angle: 30 deg, at: P": "angle: 30 deg"}, "place", "F1"),
    ("plate", "at the mirrored corner", {"angle: 30 deg, at: P": "angle: 30 deg, at: Q"}, "place", "F1"),
    ("plate", "turned by 60 deg", {"angle: 30 deg, at: P": "angle: 90 deg, at: P"}, "direction", "F1"),
    ("plate", "a spring that pushes", {"stiffness: k, free_length: 0.3 m": "stiffness: -k, free_length: 0.3 m"}, None, None),
    ("plate", "a spring half as stiff", {"stiffness: k,": "stiffness: k/2,"}, "magnitude", "spring"),
    ("plate", "a spring to another point", {"to: [-1 m, 1 m]": "to: [-1 m, 0 m]"}, "direction", "spring"),
    ("plate", "the couple turned", {"value: 3 N*m": "value: -3 N*m"}, "sense", "couple"),
    ("plate", "constant instead of growing", {"fx: r*t": "fx: 2 N"}, "direction", "F2"),
    ("plate", "forgets the couple", {"    moments:\n      - applied: {name: couple, value: 3 N*m}\n": NONE}, "missing", ""),
    # ---- a ball in air
    ("ball", "drag of the first power", {"quadratic: 0.01 N*s^2/m^2": "linear: 0.1 N*s/m"}, "magnitude", "drag"),
    ("ball", "drag that helps", {"      - drag: {quadratic: 0.01 N*s^2/m^2}\n":
     '      - applied: {name: air, fx: "0.01[N*s^2/m^2]*vx*sqrt(vx^2+vy^2)", fy: "0.01[N*s^2/m^2]*vy*sqrt(vx^2+vy^2)"}\n'},
     "sense", "air"),
    ("ball", "a force of the throw", {"      - gravity\n": "      - gravity\n      - applied: {name: throw, fx: 3 N, fy: 1 N}\n"},
     "superfluous", "throw"),
    # ---- two bodies
    ("pair", "the pull on the other body", {"      - applied: {name: pull, value: 6 N}\n": NONE,
     "along: -90 deg}}\n    forces:\n": "along: -90 deg}}\n    forces:\n      - applied: {name: pull, value: 6 N}\n"}, "superfluous", "pull"),
    ("pair", "one body only", {PAIR[PAIR.index("  hanger"):]: NONE}, "body", ""),
    ("pair", "slides the other way round", {"motion: {slide: {along: 0 deg}}": "motion: {pivot: {at: [0, 0]}}\n    initial: {theta: 1 rad}\n    shape: point\n    center: [1 m, 0]"}, "motion", ""),
]

V_LINE = "m*v_dot = f1*cos(beta) - m*g*sin(phi) - sign(v)*mu_k*N"
PUSH = "      - applied: {name: push, value: f1, angle: phi + beta}\n"

# Points without mechanics.
CASES += [
    ("block", "a multiple of itself", {V_LINE: "m*v_dot = 1.001*m*v_dot"}, "derivation", None),
    ("block", "drowned in numbers", {V_LINE: "m*v_dot + 1e15[N] = 1e15[N]"}, "derivation", None),
    ("block", "a wave of the acceleration", {V_LINE: "sin(1e20*v_dot*1[s^2/m]) = 0"}, "derivation", None),
    ("block", "next to nothing", {V_LINE: "m*v_dot*1e-320 = 0[N]"}, "derivation", None),
    ("block", "nothing of N", {"N = m*g*cos(phi) - f1*sin(beta)": "exp(-(N/1[N])^2) = 0"}, "derivation", None),
    ("block", "two that cancel", {PUSH: '      - applied: {name: up, value: "1e20[N]"}\n      - applied: {name: down, value: "-1e20[N]"}\n'},
     "superfluous", "up"),
    ("plate", "a wrong place beside a far one", {"angle: 30 deg, at: P": "angle: 30 deg, at: Q", "name: F2, fx": "name: far, fx",
     "fy: 5 N, at: Q": "fy: 5 N, at: [1e12 m, 0]"}, "place", "F1"),
    ("block", "a coefficient that is no number", {"kinetic: mu_k}": 'kinetic: "sqrt(-1 - (x/1[m])^2)"}'}, None, None),
    ("block", "another m", {"m: 2 kg}": "m: 2 kg, g: 0.001 m/s^2}"}, None, None),
    ("bounce", "right at the start only", {"- gravity": '- applied: {name: weight, fx: "1e6[N/s]*t", fy: "-9.81[N]*(1 + 1e6[1/s]*t)"}'},
     "superfluous", "weight"),
    ("rest", "friction of nothing", {"- friction: {static: 0.9, kinetic: 0.8}": "- applied: {name: rub, value: 0 N}"}, "missing", ""),
    ("rest", "friction as at the start", {"- friction: {static: 0.9, kinetic: 0.8}": "- applied: {name: rub, value: -3 N}"}, "superfluous", "rub"),
    ("rope", "kinematics", {"m*(v_dot - g) + m_2*(v_dot + g) = 0*v_dot*m": "v_dot = -two.v_dot"}, "derivation", None),
]

# The same mechanics, written in another way: all points.
RIGHT = [
    ("block", "components", {"push, value: f1, angle: phi + beta": "p, fx: f1*cos(phi + beta), fy: f1*sin(phi + beta)"}),
    ("block", "in two parts", {"- applied: {name: push, value: f1, angle: phi + beta}":
     "- applied: {name: along, value: f1*cos(beta), angle: phi}\n      - applied: {name: across, value: f1*sin(beta), angle: phi + pi/2}"}),
    ("block", "the weight in three parts", {"- gravity": "- applied: {name: a, value: m*g/3, angle: -90 deg}\n      - applied: "
     "{name: b, value: m*g/3, angle: -90 deg}\n      - applied: {name: c, value: m*g/3, angle: -90 deg}"}),
    ("rest", "friction by hand while it sticks", {"- friction: {static: 0.9, kinetic: 0.8}":
     '- applied: {name: rub, value: "-3[N]*cos(9[rad/s]*t)"}'}),
    ("block", "the weight by hand", {"- gravity": "- applied: {name: weight, value: m*g, angle: -90 deg}"}),
    ("block", "friction by hand", {"- friction: {static: mu_s, kinetic: mu_k}":
     "- applied: {name: rub, value: mu_k*(m*g*cos(phi) - f1*sin(beta)), angle: phi + pi}"}),
    ("block", "numbers", {"value: f1, angle: phi + beta": "value: 5.02 N, angle: 40 deg"}),
    ("block", "rounded numbers in the lines", {"N = m*g*cos(phi) - f1*sin(beta)": '"N = 16.12[N]"'.strip('"')}),
    ("block", "the other side of the equation", {"m*v_dot = f1*cos(beta) - m*g*sin(phi) - sign(v)*mu_k*N":
     "0 = m*v_dot + m*g*sin(phi) - f1*cos(beta) + sign(v)*mu_k*N"}),
    ("block", "a parameter of one's own", {"m: 2 kg}": "m: 2 kg, W: m*g}", "N = m*g*cos(phi)": "N = W*cos(phi)"}),
    ("block", "x down the slope", {"slide: {along: phi}": "slide: {along: phi + pi}", "v: 3": "v: -3"}),
    ("pendulum", "the pull slides along its line", {"angle: alpha, at: right": "angle: alpha, at: right"}),
    ("pendulum", "divided by I", {"I_O*theta_ddot = -m*g*L/2*cos(theta) + P*L*sin(alpha - theta) - c*omega + M1":
     "theta_ddot = (-m*g*L/2*cos(theta) + P*L*sin(alpha - theta) - c*omega + M1)/(m*L^2/3)"}),
    ("plate", "the spring by hand", {"- spring: {name: spring, stiffness: k, free_length: 0.3 m, at: Q, to: [-1 m, 1 m]}":
     "- spring: {name: s, stiffness: 200 N/m, free_length: 300 mm, at: [-200 mm, 0.1 m], to: [-1 m, 1 m]}"}),
    ("plate", "moments and forces in another order", {"      - gravity\n": NONE, "    moments:": "      - gravity\n    moments:"}),
    ("ball", "drag by hand", {"      - drag: {quadratic: 0.01 N*s^2/m^2}\n":
     '      - applied: {name: air, fx: "-0.01[N*s^2/m^2]*vx*sqrt(vx^2+vy^2)", fy: "-0.01[N*s^2/m^2]*vy*sqrt(vx^2+vy^2)"}\n'}),
]

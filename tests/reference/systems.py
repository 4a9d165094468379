# SPDX-License-Identifier: GPL-3.0-or-later
"""The thirty reference systems: models of the gallery, and closed forms of their states and times of events.

A closed form of states is a function of the parameters p (an attribute each, and p.g) and the time; it returns
{column of the CSV: value}, for the times at which it is valid, else {}. One of events returns {number of the event: time},
counted from 0. Every formula is derived in the header of its model, or here.
"""
from dataclasses import dataclass, field
from math import asin, atan2, cos, exp, pi, sin, sqrt
from typing import Callable


def none(*_):
    return {}


@dataclass
class System:
    """A model with the values that differ from its file, and its closed forms."""
    name: str
    kind: str  # dry friction, impact, rope or loop
    model: str  # below models/
    until: float  # seconds
    set: dict = field(default_factory=dict)  # parameters that differ from those of the file
    states: Callable = none
    events: Callable = none


def moved(x, v, a, t, jerk=0.0):
    """Place and velocity after the time t at an acceleration a + jerk t."""
    return x + v * t + a * t**2 / 2 + jerk * t**3 / 6, v + a * t + jerk * t**2 / 2


def after(pieces, t):
    """Place and velocity from pieces (duration, acceleration, jerk), which begin at rest at 0 or where `start` says."""
    x, v = pieces[0]
    for duration, a, jerk in pieces[1:]:
        step = min(t, duration)
        x, v = moved(x, v, a, step, jerk)
        t -= step
    return x, v


FOREVER = 1e300


def integral(function, end):
    """From 0 to end, by Gauss's formula of four points on a hundred parts; of functions that are smooth."""
    nodes = [(sign * sqrt(3 / 7 + other * 2 / 7 * sqrt(6 / 5)), (18 - other * sqrt(30)) / 36) for sign in (-1, 1) for other in (-1, 1)]
    h = end / 100
    return sum(weight * function(h * (n + (1 + x) / 2)) for n in range(100) for x, weight in nodes) * h / 2


# Dry friction

def incline_stop(p):
    return p.v0 / (p.g * (sin(p.phi) + p.mu_k * cos(p.phi)) - p.f1 / 2)


def incline(p, t):
    stop = incline_stop(p)
    x, v = after([(0, p.v0), (stop, -p.v0 / stop, 0)], t)
    return {"block.x": x, "block.v": v if t < stop else 0}


def slides_back_times(p):
    up, down = p.g * (sin(p.phi) + 0.2 * cos(p.phi)), p.g * (sin(p.phi) - 0.2 * cos(p.phi))
    return {0: 3 / up, 1: 3 / up + sqrt(9 / (up * down))}


def slides_back(p, t):
    up, down = p.g * (sin(p.phi) + 0.2 * cos(p.phi)), p.g * (sin(p.phi) - 0.2 * cos(p.phi))
    x, v = after([(0, 3), (3 / up, -up, 0), (FOREVER, -down, 0)], t)
    return {"block.x": x, "block.v": v}


def flat_stop(p):
    return -p.v0 / (p.f1 / 5 + p.mu_k * p.g)


def flat(p, t):
    x, v = after([(0, p.v0), (flat_stop(p), p.f1 / 5 + p.mu_k * p.g, 0), (FOREVER, p.f1 / 5 - p.mu_k * p.g, 0)], t)
    return {"block.x": x, "block.v": v}


def pulled_times(p):
    """The force 4 N/s t, from 5 s on 20 N - 8 N/s (t - 5 s), on 2 kg: breaks away, and stops where the parabola of v is zero."""
    breakaway = 0.6 * 2 * p.g / 4
    _, v = moved(0, 0, 2 * breakaway - 0.4 * p.g, 5 - breakaway, 2)
    a = 10 - 0.4 * p.g
    return {0: breakaway, 1: 5, 2: 5 + (a + sqrt(a**2 + 8 * v)) / 4}


def pulled(p, t):
    breakaway, top, stop = pulled_times(p).values()
    x, v = after([(0, 0), (breakaway, 0, 0), (top - breakaway, 2 * breakaway - 0.4 * p.g, 2), (stop - top, 10 - 0.4 * p.g, -4),
                  (FOREVER, 10 - 4 * (stop - top) + 0.4 * p.g, -4)], t)
    return {"block.x": x, "block.v": v}


def stacked_times(p):
    lower, upper, friction = (p.F_0 - 0.4 * p.m2 * p.g) / p.m1, 0.4 * p.g, 0.4 * p.g * (1 + p.m2 / p.m1)
    return {0: p.t_end, 1: p.t_end + (lower - upper) * p.t_end / friction}


def stacked(p, t):
    end, stick = stacked_times(p).values()
    brake = -0.4 * p.m2 * p.g / p.m1
    x, v = after([(0, 0), (end, p.F_0 / p.m1 + brake, 0), (stick - end, brake, 0)], t)
    s, w = after([(0, 0), (stick, 0.4 * p.g, 0)], t)
    if t > stick:
        x, s = x + v * (t - stick), s + v * (t - stick)
        w = v
    return {"lower.x": x, "lower.v": v, "upper.x": s - x, "upper.v": w - v}


def wedge(p, t):
    """N from m X'' sin(phi) = N - m g cos(phi) and M X'' = -N (sin(phi) - mu cos(phi)); then the block along the slope."""
    lean = sin(p.phi) - p.mu_k * cos(p.phi)
    normal = p.m_b * p.g * cos(p.phi) / (1 + p.m_b * sin(p.phi) * lean / p.M)
    a = -normal * lean / p.M
    s = p.g * sin(p.phi) - p.mu_k * normal / p.m_b - a * cos(p.phi)
    return {"wedge.x": a * t**2 / 2, "wedge.v": a * t, "block.x": s * t**2 / 2, "block.v": s * t}


def belt_times(p):
    return {1: p.s / (3 * p.mu * p.g), 2: p.s / (p.mu * p.g)}


def belt(p, t):
    rolls, sticks = belt_times(p).values()
    x, v = after([(0, 0), (sticks, p.mu * p.g, 0), (FOREVER, 0, 0)], t)
    c, u = after([(1, 0), (rolls, p.mu * p.g, 0), (FOREVER, 0, 0)], t)
    angle, omega = after([(0, 0), (rolls, 2 * p.mu * p.g / p.R, 0), (FOREVER, 0, 0)], t)
    return {"parcel.x": x, "parcel.vx": v, "parcel.y": 0, "disc.x": c, "disc.vx": u, "disc.theta": angle, "disc.omega": omega}


def bowling_time(p):
    return 2 * p.v_0 / (7 * p.mu * p.g)


def bowling(p, t):
    x, v = after([(0, p.v_0), (bowling_time(p), -p.mu * p.g, 0), (FOREVER, 0, 0)], t)
    angle, omega = after([(0, 0), (bowling_time(p), -5 * p.mu * p.g / (2 * p.R), 0), (FOREVER, 0, 0)], t)
    return {"ball.x": x, "ball.vx": v, "ball.theta": angle, "ball.omega": omega}


def stick_slip_times(p):
    """It sticks to k x = mu_s m g, slips on a sine about mu_d m g/k until it has the velocity of the belt again, as far below
    as it was above, and sticks for the way between; twice as many events as cycles."""
    w, above = sqrt(p.k), (0.4 - 0.25) * p.g / p.k
    slip, stick, times = (2 * pi - 2 * atan2(above * w, p.v_b)) / w, 2 * above / p.v_b, [0.4 * p.g / p.k / p.v_b]
    while times[-1] < 5:
        times += [times[-1] + slip, times[-1] + slip + stick]
    return {n: time for n, time in enumerate(times) if time < 5}


# Impact

def bounce_times(p):
    """The n-th impact, of which 40 are compared: later ones are nearer to each other than they are accurate."""
    fall, times = sqrt(2 * p.h / p.g), [sqrt(2 * p.h / p.g)]
    for n in range(1, 40):
        times.append(times[-1] + 2 * fall * p.e**n)
    return dict(enumerate(times))


def bounce(p, t):
    fall, times = sqrt(2 * p.h / p.g), list(bounce_times(p).values())
    if t >= fall * (1 + p.e) / (1 - p.e):
        return {"ball.y": p.r, "ball.vy": 0}
    n = sum(time < t for time in times)
    x, v = moved(p.h + p.r, 0, -p.g, t) if n == 0 else moved(p.r, p.e**n * sqrt(2 * p.g * p.h), -p.g, t - times[n - 1])
    return {"ball.y": x, "ball.vy": v}


def quarter(p):
    """A quarter of the period of a pendulum let go at phi: K(sin(phi/2))/w, by the arithmetic-geometric mean."""
    a, b = 1.0, cos(p.phi / 2)
    for _ in range(8):
        a, b = (a + b) / 2, sqrt(a * b)
    return pi / (2 * a) / sqrt(p.g * p.L / (p.L**2 + 0.4 * p.r**2))


def cradle_times(p):
    """Impacts at one, three and five quarters of the period; each stands as four events, after three contacts at the start."""
    return {n: (1, 3, 5)[(n - 3) // 4] * quarter(p) for n in range(3, 15)}


def ballistic_times(p):
    return {0: p.L / p.u}


def zeno_times(p):
    """Towards the origin F - mu m g acts, away from it F + mu m g: passages (even numbers, of which 10 are compared) and
    turns between them; each round takes r times as long as the one before."""
    inward, outward = p.F - 0.2 * p.g, p.F + 0.2 * p.g
    passage, v, times = sqrt(2 / inward), sqrt(2 * inward), {}
    for n in range(10):
        times |= {2 * n: passage, 2 * n + 1: passage + v / outward}
        passage += v / outward + v / sqrt(inward * outward)
        v *= sqrt(inward / outward)
    return times


def shaken_times(p):
    """It leaves where the table falls with g, once in a period."""
    return {1 + 3 * n: (asin(p.g / (p.A * p.w**2)) + 2 * pi * n) / p.w for n in range(5)}


def ladder_times(p):
    """phi'^2 = 3 g/L (sin(phi_0) - sin(phi)) until sin(phi) = 2/3 sin(phi_0); with phi = phi_0 - u^2 nothing is singular."""
    end = sqrt(p.phi - asin(sin(p.phi) * 2 / 3))
    fall = lambda u: 2 * u / sqrt(6 * p.g / p.L * cos(p.phi - u**2 / 2) * sin(u**2 / 2))
    return {2: integral(fall, end)}


# Ropes

def atwood(p, t):
    a = (p.m_1 - p.m_2) * p.g / (p.m_1 + p.m_2 + p.M / 2)
    x, v = a * t**2 / 2, a * t
    return {"m1.x": x, "m1.v": v, "m2.x": -x, "m2.v": -v, "pulley.theta": x / p.R, "pulley.omega": v / p.R}


def over_pulley(p, t):
    a = (p.m_2 - p.m_1 * (sin(p.phi) + p.mu * cos(p.phi))) * p.g / (p.m_1 + p.m_2 + p.M / 2)
    return {"block.x": a * t**2 / 2, "block.v": a * t, "weight.x": a * t**2 / 2, "weight.v": a * t}


def bollard(p, t):
    grip = exp(p.mu_k * 2.5 * pi)
    a, jerk = (grip * p.F_0 - 60 * p.g) / (60 + p.m_h * grip), -grip * p.F_0 / p.T / (60 + p.m_h * grip)
    x, v = moved(0, 0, a, t, jerk)
    return {"hand.x": x, "hand.v": v, "barrel.x": x, "barrel.v": v}


def string_times(p):
    """phi from the horizontal: phi'^2 = 2 g/L sin(phi), the tension is 3 m g sin(phi); phi = u^2."""
    swing = lambda u: 2 * u / sqrt(2 * p.g / p.L * sin(u**2))
    return {n: integral(swing, sqrt(asin(tension / (3 * p.m_bob * p.g)))) for n, tension in enumerate((7.5, p.T_max))}


def rope_times(p):
    """psi above the horizontal: L psi' = sqrt(v_0^2 - 2 g L sin(psi)) until sin(psi) = v_0^2/(3 g L). There v^2 = g L sin(psi),
    and the parabola meets the circle again after 4 v cos(psi)/g."""
    rise = lambda psi: p.L / sqrt(p.v_0**2 - 2 * p.g * p.L * sin(psi))
    sine = p.v_0**2 / (3 * p.g * p.L)
    slack = integral(rise, asin(sine))
    return {0: slack, 1: slack + 4 * sqrt(p.L * sine * (1 - sine**2) / p.g)}


# Loops

def driven(p, t):
    angle = 0.3 + p.rate * t
    c = sqrt(p.l**2 - (p.r * sin(angle))**2)
    v = -p.r * p.rate * sin(angle) * (1 + p.r * cos(angle) / c)
    return {"crank.theta": angle, "piston.x": p.r * cos(angle) + c, "piston.v": v}


def yoke_times(p):
    """theta' sqrt(I_O + m R^2 sin^2(theta)) is constant: equal times from quarter to quarter of a turn."""
    turn = lambda theta: sqrt(1 + 100 * p.R**2 * sin(theta)**2) / 10
    return {n: (n + 1) * integral(turn, pi / 2) for n in range(10)}


SYSTEMS = [
    System("incline", "dry friction", "kinetics/incline.yaml", 3, states=incline, events=lambda p: {0: incline_stop(p)}),
    System("incline_slides_back", "dry friction", "kinetics/incline_slides_back.yaml", 1.5, states=slides_back, events=slides_back_times),
    System("flat_coulomb", "dry friction", "kinetics/flat_coulomb.yaml", 3, {"v0": -3}, states=flat, events=lambda p: {0: flat_stop(p)}),
    System("ramp_up_and_down", "dry friction", "kinetics/ramp_up_and_down.yaml", 11, states=pulled, events=pulled_times),
    System("stacked_blocks", "dry friction", "trees/stacked_blocks.yaml", 2, states=stacked, events=stacked_times),
    System("block_on_wedge", "dry friction", "trees/block_on_wedge.yaml", 0.5, states=wedge),
    System("conveyor_belt", "dry friction", "contact/conveyor_belt.yaml", 2, states=belt, events=belt_times),
    System("bowling_ball", "dry friction", "couplings/bowling_ball.yaml", 6, states=bowling, events=lambda p: {0: bowling_time(p)}),
    System("stick_slip_belt", "dry friction", "hard/stick_slip_belt.yaml", 5, events=stick_slip_times),
    System("zeno_stop", "dry friction", "hard/zeno_stop.yaml", 4, events=zeno_times),
    System("coupled_friction", "dry friction", "hard/coupled_friction.yaml", 5),
    System("bouncing_ball", "impact", "contact/bouncing_ball.yaml", 5, states=bounce, events=bounce_times),
    System("ball_off_a_table", "impact", "contact/ball_off_a_table.yaml", 10),
    System("cradle", "impact", "contact/cradle.yaml", 1.5, events=cradle_times),
    System("ballistic_pendulum", "impact", "couplings/ballistic_pendulum.yaml", 1, events=ballistic_times),
    System("stairs", "impact", "contact/stairs.yaml", 4),
    System("shaken_table", "impact", "contact/shaken_table.yaml", 2, events=shaken_times),
    System("ladder", "impact", "contact/ladder.yaml", 1.5, events=ladder_times),
    System("atwood", "rope", "couplings/atwood.yaml", 2, states=atwood),
    System("block_over_pulley", "rope", "couplings/block_over_pulley.yaml", 1, states=over_pulley),
    System("breaking_string", "rope", "couplings/breaking_string.yaml", 0.8, events=string_times),
    System("rope_pendulum", "rope", "couplings/rope_pendulum.yaml", 2, events=rope_times),
    System("winch", "rope", "couplings/winch.yaml", 8),
    System("winding_pendulum", "rope", "couplings/winding_pendulum.yaml", 1.5),
    System("capstan", "rope", "couplings/capstan.yaml", 0.8, states=bollard),
    System("four_bar", "loop", "couplings/four_bar.yaml", 2),
    System("slider_crank", "loop", "couplings/slider_crank.yaml", 1),
    System("driven_slider_crank", "loop", "couplings/driven_slider_crank.yaml", 1, states=driven),
    System("scotch_yoke", "loop", "couplings/scotch_yoke.yaml", 2, events=yoke_times),
    System("andrews_squeezer", "loop", "couplings/andrews_squeezer.yaml", 0.03),
]

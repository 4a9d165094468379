# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten models of the gallery written down a second time for SymPy's mechanics module, which derives Lagrange's equations from
their energies: the accelerations at random states, against those of fbd. Lengths, masses and stiffnesses are those of the files."""
import random

import mpmath
import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

t = dynamicsymbols._t  # pylint: disable=protected-access
g = sp.Rational(981, 100)
R = sp.Rational


def speed2(x, y):
    return sp.diff(x, t)**2 + sp.diff(y, t)**2


class System:
    """Kinetic less potential energy, other generalized forces, and conditions between the coordinates."""

    def __init__(self, path, coordinates, equations=None, shown=None):
        """What an equation of a body on another one shows is its acceleration in the world: `shown` of those of the coordinates."""
        self.path, self.names = path, coordinates
        self.equation_names, self.shown = equations or coordinates, shown or (lambda *a: a)
        self.q = dynamicsymbols(f"q0:{len(coordinates)}")
        self.L, self.forces, self.conditions = 0, [], []

    def rod(self, m, l, x, y, angle, inertia=None):
        """A body whose centre of mass is at (x, y)."""
        inertia = m * l**2 / 12 if inertia is None else inertia
        self.L += m * speed2(x, y) / 2 + inertia * sp.diff(angle, t)**2 / 2 - m * g * y

    def point(self, m, x, y, weight=True):
        self.L += m * speed2(x, y) / 2 - (m * g * y if weight else 0)

    def spring(self, k, l0, length):
        self.L -= k * (length - l0)**2 / 2

    def equations(self):
        """Functions of (q, q') for the matrix and the right-hand side of the accelerations (and multipliers)."""
        method = LagrangesMethod(self.L, self.q, **({"hol_coneqs": self.conditions} if self.conditions else {}))
        method.form_lagranges_equations()
        n = len(self.q)
        extra = sp.Matrix((self.forces or [0] * n) + [0] * len(self.conditions))
        if not self.conditions:
            return method.mass_matrix, method.forcing + extra
        return method.mass_matrix_full[n:, n:], method.forcing_full[n:, :] + extra

    def function(self):
        matrix, right = self.equations()
        rates = [sp.diff(q, t) for q in self.q]
        q, v = sp.symbols(f"a0:{len(self.q)}"), sp.symbols(f"b0:{len(self.q)}")
        put = {**dict(zip(rates, v)), **dict(zip(self.q, q))}
        matrix, right = (part.subs(dict(zip(rates, v))).subs(put) for part in (matrix, right))
        return sp.lambdify([*q, *v], (matrix, right), "mpmath")


def compound_pendulum():
    s = System("rotation/compound_pendulum.yaml", ["pendulum.theta"])
    th, r = s.q[0], R(6, 100)
    s.rod(R(8, 10), 1, sp.sin(th) / 2, -sp.cos(th) / 2, th)
    s.rod(3, 0, (1 + r) * sp.sin(th), -(1 + r) * sp.cos(th), th, R(2, 5) * 3 * r**2)
    return s


def damped_pendulum():
    s = System("rotation/damped_pendulum.yaml", ["pendulum.theta"])
    th = s.q[0]
    s.rod(R(1, 2), 1, sp.sin(th) / 2, -sp.cos(th) / 2, th)
    s.point(2, sp.sin(th), -sp.cos(th))
    s.forces = [-sp.diff(th, t) / 2]
    return s


def projectile():
    s = System("plane/projectile_with_drag.yaml", ["ball.x", "ball.y"])
    vx, vy = (sp.diff(q, t) for q in s.q)
    s.point(R(45, 100), *s.q)
    s.forces = [-R(5, 1000) * sp.sqrt(vx**2 + vy**2) * v for v in (vx, vy)]
    return s


def two_springs():
    s = System("plane/two_springs_off_axis.yaml", ["bar.x", "bar.y", "bar.theta"])
    x, y, th = s.q
    a, h, l0 = R(6, 10), R(4, 10), R(1, 2)
    s.rod(4, 2 * a, x, y, th)
    for side, k in ((-1, 300), (1, 500)):
        s.spring(k, l0, sp.sqrt((x + side * a * sp.cos(th) - side * a)**2 + (y + side * a * sp.sin(th) + h)**2))
    return s


def double_pendulum():
    s = System("trees/double_pendulum.yaml", ["rod1.theta", "rod2.theta"], shown=lambda a, b: (a, a + b))
    a, b = s.q[0], s.q[0] + s.q[1]
    s.rod(1, 1, sp.sin(a) / 2, -sp.cos(a) / 2, a)
    s.rod(1, 1, sp.sin(a) + sp.sin(b) / 2, -sp.cos(a) - sp.cos(b) / 2, b)
    return s


def cart_and_pendulum():
    s = System("trees/cart_and_pendulum.yaml", ["cart.x", "pole.theta"])
    x, th = s.q
    s.point(2, x, 0)
    s.rod(R(1, 2), 1, x - sp.sin(th) / 2, sp.cos(th) / 2, th)
    return s


def elastic_pendulum():
    s = System("trees/elastic_pendulum.yaml", ["cart.x", "bob.x", "bob.y"], ["cart.x", "bob.G.x", "bob.G.y"], lambda c, x, y: (c, c + x, y))
    c, x, y = s.q
    s.point(2, c, 0)
    s.point(R(1, 2), c + x, y)
    s.spring(40, R(9, 10), sp.sqrt(x**2 + y**2))
    return s


def smooth_wedge():
    s = System("trees/smooth_wedge.yaml", ["wedge.x", "block.x"], ["wedge.x", "block.G.x", "block.G.y"],
               lambda w, b: (w, w + b * mpmath.sqrt(3) / 2, -b / 2))
    w, b = s.q
    s.point(5, w, 0)
    s.point(2, w + b * sp.sqrt(3) / 2, -b / 2)
    return s


def slider_crank():
    s = System("couplings/slider_crank.yaml", ["crank.theta", "connecting_rod.theta", "piston.x"], shown=lambda a, b, x: (a, a + b, x))
    a, b, x = s.q[0], s.q[0] + s.q[1], s.q[2]
    r, l = R(2, 10), R(5, 10)
    s.rod(1, r, r / 2 * sp.cos(a), r / 2 * sp.sin(a), a)
    s.rod(R(3, 2), l, r * sp.cos(a) + l / 2 * sp.cos(b), r * sp.sin(a) + l / 2 * sp.sin(b), b)
    s.point(2, x, 0)
    s.conditions = [r * sp.cos(a) + l * sp.cos(b) - x, r * sp.sin(a) + l * sp.sin(b)]
    s.forces = [5, 0, 0]
    return s


def four_bar():
    s = System("couplings/four_bar.yaml", ["crank.theta", "coupler.theta", "rocker.theta"], shown=lambda a, b, c: (a, a + b, c))
    a, b, c = s.q[0], s.q[0] + s.q[1], s.q[2]
    la, lb, lc = R(3, 10), R(9, 10), R(7, 10)
    s.rod(1, la, la / 2 * sp.cos(a), la / 2 * sp.sin(a), a)
    s.rod(2, lb, la * sp.cos(a) + lb / 2 * sp.cos(b), la * sp.sin(a) + lb / 2 * sp.sin(b), b)
    s.rod(R(3, 2), lc, 1 + lc / 2 * sp.cos(c), lc / 2 * sp.sin(c), c)
    s.conditions = [la * sp.cos(a) + lb * sp.cos(b) - 1 - lc * sp.cos(c), la * sp.sin(a) + lb * sp.sin(b) - lc * sp.sin(c)]
    s.forces = [4, 0, 0]
    return s


SYSTEMS = (compound_pendulum, damped_pendulum, projectile, two_springs, double_pendulum, cart_and_pendulum, elastic_pendulum,
           smooth_wedge, slider_crank, four_bar)
STATES, SEED = 20, 17


def rate_of(model, name):
    body, coordinate = name.split(".")
    return next(rate for rate in (f"{body}.{one}" for one in {"theta": ["omega"], "x": ["vx", "v"], "y": ["vy"]}[coordinate]) if model.knows(rate))


def state_of(model, system, start, draw):
    """A random state about the start of the file; with conditions the first coordinate is drawn and the others close the loop."""
    rates = [rate_of(model, name) for name in system.names]
    free = 1 if system.conditions else len(system.names)
    model.set({name: start[name] + draw.uniform(-0.4, 0.4) for name in system.names[:free]} | {rate: draw.uniform(-2, 2) for rate in rates[:free]})
    return [model.get(name) for name in [*system.names, *rates]]


def compare(system, model):
    """The largest difference of an acceleration, relative to the largest one of its state."""
    mpmath.mp.dps = 40
    function, draw, worst = system.function(), random.Random(SEED), 0.0
    start = {name: model.get(name) for name in system.names}
    for _ in range(STATES):
        values = [mpmath.mpf(value) for value in state_of(model, system, start, draw)]
        matrix, right = function(*values)
        theirs = system.shown(*list(mpmath.lu_solve(matrix, right))[:len(system.names)])
        ours = model.accelerations(system.equation_names)
        size = max(abs(one) for one in theirs)
        worst = max(worst, float(max(abs(a - b) for a, b in zip(theirs, ours)) / size))
    return worst

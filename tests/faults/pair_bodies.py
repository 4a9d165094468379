# SPDX-License-Identifier: GPL-3.0-or-later
"""Two bodies that meet, as pairs.py draws them: their shapes, how they fly, and a reference of their impacts.

The reference flies them by closed forms (no force but gravity acts between impacts, and none on what turns off its
centre), finds the first time at which a corner is on a side or a circle at one by its own search, and takes the impulse of
one smooth point, J = (1 + e) v_n / (sum of 1/m + (r x n)^2/I)."""
import math

G = 9.81
KINDS = ["disc", "prism", "rod", "particle", "body point", "ground point", "line", "polygon"]
GROUND = ("ground point", "line", "polygon")
POINTS = ("particle", "body point", "ground point")


def turn(angle, p):
    c, s = math.cos(angle), math.sin(angle)
    return (c * p[0] - s * p[1], s * p[0] + c * p[1])


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


class Body:
    """One side of the contact: its shape in its own frame, and how it moves."""

    def __init__(self, rng, name, kind, scale):
        self.name, self.kind, self.scale = name, kind, scale
        self.mass = rng.choice([1, 1, rng.uniform(0.2, 5)])
        self.size = scale * rng.choice([1, 1, rng.uniform(0.3, 2)])
        self.corners, self.radius, self.inertia, self.own = [], 0.0, 0.0, ""
        self.mount, self.gravity = "free", 0.0
        self.pose0, self.rate0, self.slide = (0, 0, 0), (0, 0, 0), 0.0
        a, b = self.size, self.size * rng.choice([1, 0.3, 0.05])
        if kind == "disc":
            self.radius, self.inertia = a / 2, self.mass * a * a / 8
            self.own = f"shape: disc, radius: {a / 2!r}"
        elif kind == "prism":
            self.corners = [(-a / 2, -b / 2), (a / 2, -b / 2), (a / 2, b / 2), (-a / 2, b / 2)]
            self.inertia = self.mass * (a * a + b * b) / 12
            self.own = f"shape: prism, a: {a!r}, b: {b!r}, c: {a!r}"
        elif kind == "rod":
            self.corners, self.inertia = [(-a / 2, 0), (a / 2, 0)], self.mass * a * a / 12
            self.own = f"shape: rod, length: {a!r}"
        elif kind == "body point":
            self.corners, self.inertia = [(0.3 * a, 0.1 * a)], self.mass * a * a / 8
            self.own = f"shape: disc, radius: {a / 2!r}, points: {{P: [{0.3 * a!r}, {0.1 * a!r}]}}"
        elif kind == "polygon":
            count = rng.randint(3, 6)
            first = rng.uniform(0, 6)
            self.corners = [turn(first + 2 * math.pi * i / count, (a / 2, 0)) for i in range(count)]
        elif kind == "line":
            self.corners = [(-1e3 * a, 0), (1e3 * a, 0)]
        else:
            self.corners = [(0, 0)]

    def reach(self):
        return self.radius + max([math.hypot(*p) for p in self.corners], default=0)

    def pose(self, t):
        """(x, y, theta) and their rates at t after the last impact."""
        (x, y, th), (u, v, w) = self.pose0, self.rate0
        gx, gy = (0, -self.gravity) if self.mount == "free" else (0, 0)
        if self.mount == "slide":
            along = -self.gravity * math.sin(self.slide)
            gx, gy = along * math.cos(self.slide), along * math.sin(self.slide)
        if self.mount == "pivot":
            c, r = self.pivot, turn(th + w * t, self.arm)
            return (c[0] + r[0], c[1] + r[1], th + w * t), (-w * r[1], w * r[0], w)
        return ((x + u * t + gx * t * t / 2, y + v * t + gy * t * t / 2, th + w * t), (u + gx * t, v + gy * t, w))

    def where(self, p, t):
        (x, y, th), _ = self.pose(t)
        q = turn(th, p)
        return (x + q[0], y + q[1])

    def velocity(self, at, t):
        (x, y, _), (u, v, w) = self.pose(t)
        return (u - w * (at[1] - y), v + w * (at[0] - x))

    def give(self, at, n, t):
        """1/m of an impulse along n at the place."""
        (x, y, _), _ = self.pose(t)
        r = (at[0] - x, at[1] - y)
        if self.mount == "fixed":
            return 0.0
        if self.mount == "slide":
            return dot(n, turn(self.slide, (1, 0)))**2 / self.mass
        if self.mount == "pivot":
            r = (at[0] - self.pivot[0], at[1] - self.pivot[1])
            return cross(r, n)**2 / (self.inertia + self.mass * dot(self.arm, self.arm))
        about = cross(r, n)**2 / self.inertia if self.inertia > 0 else 0
        return 1 / self.mass + about

    def take(self, at, impulse, t):
        """Start anew at t, with the impulse."""
        pose, (u, v, w) = self.pose(t)
        r = (at[0] - pose[0], at[1] - pose[1])
        if self.mount == "free":
            u, v = u + impulse[0] / self.mass, v + impulse[1] / self.mass
            w += cross(r, impulse) / self.inertia if self.inertia > 0 else 0
        elif self.mount == "slide":
            e = turn(self.slide, (1, 0))
            p = dot(e, impulse) / self.mass
            u, v = u + p * e[0], v + p * e[1]
        elif self.mount == "pivot":
            r = (at[0] - self.pivot[0], at[1] - self.pivot[1])
            w += cross(r, impulse) / (self.inertia + self.mass * dot(self.arm, self.arm))
        self.pose0, self.rate0 = pose, (u, v, w)

    def sides(self):
        if len(self.corners) < 2:
            return []
        if len(self.corners) == 2:
            return [(self.corners[0], self.corners[1])]
        return list(zip(self.corners, self.corners[1:] + self.corners[:1]))

    def text(self):
        """Its lines of the model; a ground's are elsewhere."""
        (x, y, th), (u, v, w) = self.pose0, self.rate0
        forces = ", forces: [gravity]" if self.gravity else ""
        head = f"  {self.name}: {{mass: {self.mass!r}, {self.own + ', ' if self.own else ''}"
        if self.kind == "particle":
            motion, initial = "particle", f"x: {x!r}, y: {y!r}, vx: {u!r}, vy: {v!r}"
        else:
            motion = "planar"
            initial = f"x: {x!r}, y: {y!r}, theta: {th!r}, vx: {u!r}, vy: {v!r}, omega: {w!r}"
        if self.mount == "slide":
            e = turn(self.slide, (1, 0))
            motion = f"{{slide: {{along: {self.slide!r}, through: [{x!r}, {y!r}]}}}}"
            initial = f"v: {u * e[0] + v * e[1]!r}"
        if self.mount == "pivot":
            p = (-self.arm[0], -self.arm[1])
            motion = f"{{pivot: {{at: [{self.pivot[0]!r}, {self.pivot[1]!r}], point: [{p[0]!r}, {p[1]!r}]}}}}"
            initial = f"theta: {th!r}, omega: {w!r}"
        if self.mount == "fixed":
            motion, initial = f"{{pivot: {{at: [{x!r}, {y!r}], theta: {th!r}}}}}", ""
            return f"{head}motion: {motion}{forces}}}\n"
        return f"{head}motion: {motion}, initial: {{{initial}}}{forces}}}\n"

    def ground(self):
        (x, y, th), _ = self.pose0, self.rate0
        if self.kind == "line":
            return f"lines: {{S: {{along: {th!r}, through: [{x!r}, {y!r}]}}}}"
        if self.kind == "ground point":
            return f"points: {{S: [{x!r}, {y!r}]}}"
        corners = ", ".join(f"[{p[0]!r}, {p[1]!r}]" for p in (self.where(q, 0) for q in self.corners))
        return f"polygons: {{S: [{corners}]}}"

    def end(self):
        return {"body point": self.name + ".P"}.get(self.kind, "ground.S" if self.kind in GROUND else self.name)


# ---- the reference

def features(a, b):
    """Functions of t that are zero where a feature of one is on the line or circle of one of the other, and whether that
    is on it: (value, place, normal from b to a)."""
    out = []
    for p, q, sign in ((a, b, 1), (b, a, -1)):
        points = [(c, 0.0) for c in p.corners] + ([((0, 0), p.radius)] if p.radius else [])
        for c, radius in points:
            for s in q.sides():
                out.append(("side", p, c, radius, q, s, sign))
            if radius and q.kind != "line":
                for d in q.corners:
                    out.append(("corner", p, c, radius, q, d, sign))
    if a.radius and b.radius:
        out.append(("corner", a, (0, 0), a.radius + b.radius, b, (0, 0), 1))
    return out


def height(feature, t):
    """Signed distance from the line of a side; of a circle at it the distance less its radius."""
    kind, p, c, radius, q, s, _ = feature
    at = p.where(c, t)
    if kind == "corner":
        other = q.where(s, t)
        return math.hypot(at[0] - other[0], at[1] - other[1]) - radius
    u, v = q.where(s[0], t), q.where(s[1], t)
    length = math.hypot(v[0] - u[0], v[1] - u[1])
    h = cross((v[0] - u[0], v[1] - u[1]), (at[0] - u[0], at[1] - u[1])) / length
    return abs(h) - radius if radius else h


def contact(feature, t, before):
    """(how far within the side, place, normal on a) there."""
    kind, p, c, radius, q, s, sign = feature
    at = p.where(c, t)
    if kind == "corner":
        other = q.where(s, t)
        d = (at[0] - other[0], at[1] - other[1])
        n = (d[0] / math.hypot(*d), d[1] / math.hypot(*d))
        own = p.radius
        return math.inf, (at[0] - own * n[0], at[1] - own * n[1]), (sign * n[0], sign * n[1])
    u, v = q.where(s[0], t), q.where(s[1], t)
    length = math.hypot(v[0] - u[0], v[1] - u[1])
    e = ((v[0] - u[0]) / length, (v[1] - u[1]) / length)
    n = (-e[1], e[0])
    d = (at[0] - u[0], at[1] - u[1])
    if (dot(n, d) if radius else before) < 0:
        n = (-n[0], -n[1])
    foot = dot(e, d)
    return min(foot, length - foot), (at[0] - radius * n[0], at[1] - radius * n[1]), (sign * n[0], sign * n[1])


def first_contact(a, b, start, end, count=1200):
    """(t, margin, place, normal) of the first contact, or None. The margin is how far it is from the ends of a side, or from
    another contact at that time."""
    best, others = None, []
    for feature in features(a, b):
        step = (end - start) / count
        before, at = height(feature, start), start
        for i in range(1, count + 1):
            t = start + i * step
            if best and at > best[0] + step:
                break
            now = height(feature, t)
            if (before < 0) != (now < 0):
                low, high = at, t
                for _ in range(60):
                    middle = (low + high) / 2
                    if (height(feature, middle) < 0) == (before < 0):
                        low = middle
                    else:
                        high = middle
                margin, place, n = contact(feature, high, before)
                if margin > -1e-7 * a.scale:
                    others.append((high, place))
                    if not best or high < best[0]:
                        best = (high, margin, place, n)
            before, at = now, t
    if best and any(abs(t - best[0]) < 1e-6 * end and math.dist(place, best[2]) > 1e-6 * a.scale
                    for t, place in others):
        return best[0], -1.0, best[2], best[3]
    return best


def reference(a, b, e, until, most):
    """Fly until the end or until what it cannot tell: (until, impacts), the bodies as they are after the last impact and
    `last`, its time."""
    t, impacts, skip = 0.0, [], 0.0
    while True:
        hit = first_contact(a, b, skip, until - t)
        if hit is None:
            return until, impacts, t
        when, margin, place, n = hit
        va, vb = a.velocity(place, when), b.velocity(place, when)
        vn = dot(n, (va[0] - vb[0], va[1] - vb[1]))
        speed = math.hypot(*va) + math.hypot(*vb)
        gives = a.give(place, n, when) + b.give(place, n, when)
        plain = margin > 1e-5 * a.scale and vn < -1e-2 * speed and gives > 1e-2 / max(a.mass, b.mass)
        if impacts and when < 1e-3 * until:
            plain = False
        if not plain or len(impacts) == most:
            return t + when * (0.5 if not plain else 0.9), impacts, t
        J = -(1 + e) * vn / gives
        a.take(place, (J * n[0], J * n[1]), when)
        b.take(place, (-J * n[0], -J * n[1]), when)
        t += when
        impacts.append(t)
        skip = 1e-9 * until

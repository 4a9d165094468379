# SPDX-License-Identifier: GPL-3.0-or-later
"""Other ways of writing a model that mean the same. Each takes a sheet and says whether it could be made."""
from trees import (QUANTITY, Sheet, all_texts, components, expression, in_world, map_texts, place, put, replaced, words, Load)

# ---- the same in other words


def weight_by_hand(sheet):
    load = sheet.a_load("gravity")
    if not load or not sheet.down():
        return False
    name, rng = sheet.new_name(), sheet.rng
    way = rng.randrange(3)
    if way == 0:
        return put(load, ("forces", {"name": name, "value": "m*g", "angle": "-90 deg"}))
    if way == 1:
        return put(load, ("forces", {"name": name, "fx": f"0 {sheet.force}", "fy": "-m*g"}))
    # along inclined axes, of the slope where there is one
    angle = load.body.along() or f"({rng.uniform(-80, 80):.3g}[deg])"
    return put(load, ("forces", {"name": name + "a", "value": f"-m*g*sin{angle}", "angle": angle}),
               ("forces", {"name": name + "b", "value": f"m*g*cos{angle}", "angle": f"{angle} - pi/2"}))


def force_by_components(sheet):
    load = sheet.a_load("applied")
    parts = load and components(load)
    if not parts or load.wrong:
        return False
    keys = {"name": sheet.new_name(), "fx": parts[0], "fy": parts[1], **place(load)}
    if parts[2] == "body":
        keys["frame"] = "body"
    return put(load, ("forces", keys))


def force_in_the_world(sheet):
    load = sheet.a_load("applied")
    parts = load and in_world(load)
    if not parts or (load.body.kind == "slide" and load.body.along() is None):
        return False
    return put(load, ("forces", {"name": sheet.new_name(), "fx": parts[0], "fy": parts[1], **place(load)}))


def force_along_inclined_axes(sheet):
    load = sheet.a_load("applied")
    parts = load and in_world(load)
    if not parts:
        return False
    angle = f"({sheet.rng.choice((-1, 1)) * sheet.rng.uniform(10, 80):.3g}[deg])"
    name = sheet.new_name()
    x, y = f"({parts[0]})", f"({parts[1]})"
    return put(load, ("forces", {"name": name + "a", "value": f"{x}*cos{angle} + {y}*sin{angle}", "angle": angle, **place(load)}),
               ("forces", {"name": name + "b", "value": f"{y}*cos{angle} - {x}*sin{angle}", "angle": f"{angle} + pi/2", **place(load)}))


def force_in_parts(sheet):
    load = sheet.a_load("applied")
    parts = load and components(load)
    if not parts:
        return False
    name, share = sheet.new_name(), sheet.rng.choice((sheet.rng.uniform(-0.5, -0.1), sheet.rng.uniform(0.2, 0.8), sheet.rng.uniform(1.1, 1.5)))
    frame = {"frame": "body"} if parts[2] == "body" else {}
    return put(load, *[("forces", {"name": name + letter, "fx": f"{f:.4f}*{parts[0]}", "fy": f"{f:.4f}*{parts[1]}", **frame, **place(load)})
                       for letter, f in (("a", round(share, 4)), ("b", 1 - round(share, 4)))])


def couple_for_an_offset(sheet):
    """At G, with the moment that it had about G."""
    found = [load for load in sheet.loads("applied") if load.body.turns and isinstance(load.keys.get("at"), (str, list))]
    load = sheet.rng.choice(found) if found else None
    parts = load and in_world(load)
    if not parts or load.wrong:
        return False
    body, at = load.body, load.keys["at"]
    if isinstance(at, list):
        at = sheet.new_name()
        body.node.setdefault("points", {})[at] = load.keys["at"]
    name, where = sheet.new_name(), body.name
    moment = f"({where}.{at}.x - {where}.G.x)*({parts[1]}) - ({where}.{at}.y - {where}.G.y)*({parts[0]})"
    return put(load, ("forces", {"name": name, "fx": parts[0], "fy": parts[1]}), ("moments", {"name": name + "m", "value": moment}))


def all_forces_at_the_centre(sheet):
    """Every given force of a body at G, and one moment for all of them."""
    for body in sheet.bodies:
        loads = [load for load in body.loads if load.kind == "applied" and load.group == "forces" and isinstance(load.keys.get("at"), str)]
        worlds = [in_world(load) for load in loads]
        if not body.turns or len(loads) < 2 or None in worlds or any(load.wrong for load in loads):
            continue
        moment, where = [], body.name
        for load, (x, y) in zip(loads, worlds):
            at = load.keys["at"]
            moment.append(f"({where}.{at}.x - {where}.G.x)*({y}) - ({where}.{at}.y - {where}.G.y)*({x})")
            put(load, ("forces", {"name": sheet.new_name(), "fx": x, "fy": y}))
        body.loads.append(Load(body, "moments", {"applied": {"name": sheet.new_name(), "value": " + ".join(moment)}}))
        return True
    return False


def moment_for_a_force_at_the_rim(sheet):
    """A couple: two opposite forces, apart from each other."""
    load = sheet.a_load("applied", group="moments")
    if not load or load.wrong:
        return False
    arm = f"{sheet.rng.uniform(0.1, 2):.4g}"
    value, name = expression(load.keys["value"], f"{sheet.force}*{sheet.length}"), sheet.new_name()
    size = f"{value}/(2*{arm}[{sheet.length}])"
    return put(load, ("forces", {"name": name + "a", "fx": "0 N", "fy": size, "frame": "body", "at": [f"{arm} {sheet.length}", "0"]}),
               ("forces", {"name": name + "b", "fx": "0 N", "fy": f"-{size}", "frame": "body", "at": [f"-{arm} {sheet.length}", "0"]}))


def resultant_of_two(sheet):
    for body in sheet.bodies:
        loads = [load for load in body.loads if load.kind == "applied" and load.group == "forces"]
        if len(loads) < 2 or any(load.wrong for load in loads[:2]):
            continue
        a, b = loads[:2]
        one, two = in_world(a), in_world(b)
        if one and two and a.keys.get("at") == b.keys.get("at"):
            body.loads.remove(b)
            return put(a, ("forces", {"name": sheet.new_name(), "fx": f"{one[0]} + {two[0]}", "fy": f"{one[1]} + {two[1]}", **place(a)}))
    return False


def spring_by_hand(sheet):
    for group, unit, angle in (("forces", f"{sheet.force}/{sheet.length}", False), ("moments", f"{sheet.force}*{sheet.length}", True)):
        load = sheet.a_load("spring", group=group)
        if not load or load.wrong or "to" in load.keys or not load.body.on_ground:
            continue
        if not (load.body.kind == "pivot" if angle else load.body.along()):
            continue
        if not angle and "free_length" in load.keys:
            continue
        stiffness = expression(load.keys["stiffness"], unit)
        neutral = expression(load.keys.get("neutral", "0"), "rad" if angle else sheet.length)
        coordinate = "theta" if angle else "x"
        return put(load, (group, {"name": sheet.new_name(), "value": f"-{stiffness}*({coordinate} - {neutral})"}))
    return False


def damper_by_hand(sheet):
    for group, rate in (("forces", "v"), ("moments", "omega")):
        load = sheet.a_load("damper", group=group)
        if not load or load.wrong or "to" in load.keys or not load.body.on_ground:
            continue
        if not (load.body.kind == "pivot" if group == "moments" else load.body.along()):
            continue
        unit = f"{sheet.force}*{sheet.length}*s" if group == "moments" else f"{sheet.force}*s/{sheet.length}"
        return put(load, (group, {"name": sheet.new_name(), "value": f"-{expression(load.keys['coefficient'], unit)}*{rate}"}))
    return False


def drag_by_hand(sheet):
    load = sheet.a_load("drag")
    if not load or load.wrong or "wind" in load.keys or "at" in load.keys or load.body.kind not in ("particle", "planar"):
        return False
    where, parts = load.body.name, []
    speed = f"hypot({where}.G.vx, {where}.G.vy)"
    unit = f"{sheet.force}*s/{sheet.length}"
    if "linear" in load.keys:
        parts.append(expression(load.keys["linear"], unit))
    if "quadratic" in load.keys:
        parts.append(f"{expression(load.keys['quadratic'], unit + '*s/' + sheet.length)}*{speed}")
    c = " + ".join(parts)
    return put(load, ("forces", {"name": sheet.new_name(), "fx": f"-({c})*{where}.G.vx", "fy": f"-({c})*{where}.G.vy"}))


def other_order(sheet):
    for body in sheet.bodies:
        sheet.rng.shuffle(body.loads)
    return True


def other_names_of_parameters(sheet):
    root = sheet.root
    if not isinstance(root.get("parameters"), dict) or root.get("tables") or root.get("grading"):
        return False
    names = {name: f"{name}_{sheet.rng.randrange(100)}" for name in root["parameters"]}
    own = {load.name for load in sheet.loads("applied")} | {body.name for body in sheet.bodies}
    for points in [root.get("ground", {}).get("points")] + [body.node.get("points") for body in sheet.bodies]:
        own |= set(points or ())
    root["parameters"] = {names[name]: value for name, value in root["parameters"].items()}
    keep = {key: root.pop(key) for key in ("title", "description") if key in root}

    def change(node, key=""):
        if isinstance(node, dict):
            return {name: change(value, name) for name, value in node.items()}
        if isinstance(node, list):
            return [change(value, key) for value in node]
        if not isinstance(node, str) or node in own or (QUANTITY.match(node) and not node.strip()[0].isalpha()):
            return node
        return node if key in ("name", "between", "on", "motion", "line") else replaced(node, names)

    for key, value in list(root.items()):
        root[key] = change(value, key)
    root.update(keep)
    again = Sheet(root, sheet.rng)
    wrong = [[load.wrong for load in body.loads] for body in sheet.bodies]
    for body, flags in zip(again.bodies, wrong):
        for load, flag in zip(body.loads, flags):
            load.wrong = flag
    sheet.bodies, sheet._root = again.bodies, again._root
    for body in sheet.bodies:
        body.sheet = sheet
    return True


# What counts and where from: expressions of a body in the coordinate that it had.


def mentioned(sheet, body):
    """Does something outside the body name its coordinates?"""
    own = sheet.root["bodies"][body.name]
    rest = {**sheet.root, "bodies": {name: node for name, node in sheet.root["bodies"].items() if name != body.name}, "simulate": None}
    names = [f"{body.name}.{name}" for name in ("x", "v", "v_dot", "a", "theta", "omega", "omega_dot", "x_dot", "theta_ddot", "alpha")]
    return any(word in names for text in all_texts(rest) for word in words(text)) or any(
        word in names for text in all_texts(own) for word in words(text))


SLIDE = ("x", "v", "v_dot", "a", "x_dot", "x_ddot", "a_x")


def of_other_coordinate(body, place_, sign):
    """Expressions of a slide in another coordinate: x is place_, rates have the sign."""
    names = {"x": place_, **({name: f"({sign}{name})" for name in SLIDE[1:]} if sign else {})}

    def change(node, key=""):
        if isinstance(node, dict):
            return {name: change(value, name) for name, value in node.items()}
        if isinstance(node, list):
            return [change(value, key) for value in node]
        return replaced(node, names) if isinstance(node, str) and key not in ("name", "at") else node

    for load in body.loads:
        load.keys = change(load.keys)
    if "hand" in body.node:
        body.node["hand"] = change(body.node["hand"])


def can_count_otherwise(sheet, body):
    return (body.along() and not body.has_children() and not mentioned(sheet, body) and "prescribed" not in body.motion and
            "exact" not in body.node and not {"low", "high", "x", "p"} & set(body.motion) and "parts" not in body.node and
            not any(load.kind in ("potential", "distributed") or isinstance(load.keys.get("value"), list) or "surface_speed" in load.keys
                    or "frame" in load.keys or "side" in load.keys for load in body.loads) and
            not sheet.root.get("couplings") and not sheet.root.get("contacts") and isinstance(body.node.get("initial", {}), dict) and
            all(isinstance(value, str) for value in body.node.get("initial", {}).values()))


def x_counts_the_other_way(sheet):
    bodies = [body for body in sheet.bodies if can_count_otherwise(sheet, body)]
    if not bodies:
        return False
    body = sheet.rng.choice(bodies)
    of_other_coordinate(body, "(-x)", "-")
    for load in body.loads:
        if load.kind == "applied" and "angle" not in load.keys and "fx" not in load.keys and "fy" not in load.keys and "toward" not in load.keys:
            load.keys["value"] = f"-{expression(load.keys['value'], sheet.force)}"
        if load.kind == "spring" and "neutral" in load.keys:
            load.keys["neutral"] = f"-{expression(load.keys['neutral'], sheet.length)}"
    body.motion["along"] = f"{body.along()} + pi"
    body.node["initial"] = {name: f"-{expression(value, sheet.length + ('/s' if name == 'v' else ''))}"
                            for name, value in body.node.get("initial", {}).items()}
    return True


def x_counts_from_elsewhere(sheet):
    bodies = [body for body in sheet.bodies if can_count_otherwise(sheet, body) and "through" not in body.motion]
    if not bodies:
        return False
    body = sheet.rng.choice(bodies)
    shift, along = f"{sheet.rng.uniform(0.5, 2):.3g}[{sheet.length}]", body.along()
    of_other_coordinate(body, f"(x + {shift})", "")
    for load in body.loads:
        if load.kind == "spring" and "to" not in load.keys:
            load.keys["neutral"] = f"{expression(load.keys.get('neutral', '0'), sheet.length)} - {shift}"
    body.motion["along"] = along
    body.motion["through"] = [f"{shift}*cos{along}", f"{shift}*sin{along}"]
    initial = dict(body.node.get("initial", {}))
    initial["x"] = f"{expression(initial.get('x', '0'), sheet.length)} - {shift}"
    body.node["initial"] = initial
    return True


def theta_counts_from_elsewhere(sheet):
    """The frame of a rod on a pivot turned: its ends are elsewhere in it, and theta is less by that."""
    for body in sheet.bodies:
        node = body.node
        if (body.kind != "pivot" or not body.on_ground or body.has_children() or mentioned(sheet, body) or "parts" in node or
                not {"from", "to"} <= set(node) or "points" in node or "exact" in node or sheet.root.get("couplings") or
                sheet.root.get("contacts") or "prescribed" in body.motion or not {"point"}.isdisjoint(body.motion) or
                any(load.kind in ("potential", "distributed", "spring") or "frame" in load.keys or not isinstance(load.keys.get("at", ""), str)
                    for load in body.loads)):
            continue
        turn = sheet.rng.choice((90, -90, 180, 37.5))
        c, s = f"cos({-turn}[deg])", f"sin({-turn}[deg])"
        for end in ("from", "to"):
            x, y = (expression(value, sheet.length) for value in node[end])
            node[end] = [f"{x}*{c} - {y}*{s}", f"{x}*{s} + {y}*{c}"]
        names = {"theta": f"(theta + {turn}[deg])", "angle": f"(angle + {turn}[deg])"}
        for load in body.loads:
            load.keys = {key: map_texts(value, lambda text: replaced(text, names)) if key not in ("name", "at", "angle") else
                         replaced(value, {"theta": names["theta"]}) if key == "angle" else value for key, value in load.keys.items()}
        if "hand" in node:
            node["hand"] = map_texts(node["hand"], lambda text: replaced(text, names))
        initial = dict(node.get("initial", {}))
        initial["theta"] = f"{expression(initial.get('theta', '0'), 'rad')} + {turn}[deg]"
        node["initial"] = initial
        # the frame turned by -turn in the body: a direction at phi of the old frame is at phi - turn in the new one
        return True
    return False


SAME = [weight_by_hand, force_by_components, force_in_the_world, force_along_inclined_axes, force_in_parts, couple_for_an_offset,
        all_forces_at_the_centre, moment_for_a_force_at_the_rim, resultant_of_two, spring_by_hand, damper_by_hand, drag_by_hand,
        other_order, other_names_of_parameters, x_counts_the_other_way, x_counts_from_elsewhere, theta_counts_from_elsewhere]

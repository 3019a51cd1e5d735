"""Office furniture and what lies on it. Things stand on y = 0 and look towards +z."""

import math
import random

from . import vectors as vec
from .curved import cushion, disc, lathe, rounded_box, tube
from .mesh import Model
from .seating import smooth
from .shapes import box, rectangle, slab, taper

DESK_TOP = 0.73


def desk(top, frame, width=1.6, depth=0.8, drawers=None, drawer_side=1):
    """The user sits on the +z side; the other side has a modesty panel."""
    w, d = width / 2, depth / 2
    model = Model("desk")
    model.add(top, rounded_box((width, 0.03, depth), 0.006, 1, (0, DESK_TOP - 0.03, 0)))
    for x in (-w + 0.05, w - 0.05):
        for z in (-d + 0.06, d - 0.06):
            model.add(frame, taper(0.045, 0.045, DESK_TOP - 0.025, (x, -0.002, z)))
    model.add(top, slab((width - 0.16, 0.36, 0.016), (0, 0.335, -d + 0.06)))
    if drawers:
        x = drawer_side * (w - 0.3)
        model.add(drawers, box((x - 0.2, 0.06, -d + 0.09), (x + 0.2, DESK_TOP - 0.035, d - 0.07)))
        for k in range(3):
            y = 0.08 + 0.205 * k
            front = box((x - 0.193, y, d - 0.08), (x + 0.193, y + 0.19, d - 0.052))
            model.add(top, front)
            model.add(frame, slab((0.12, 0.012, 0.03), (x, y + 0.13, d - 0.045)))
    return model


def shelf(board, back, width, height, boards, depth=0.3):
    """Open in front, its back at z = 0. Returns the model and the heights of its boards."""
    w, t = width / 2, 0.022
    model = Model("shelf")
    for x in (-w, w - t):
        model.add(board, box((x, -0.002, 0.002), (x + t, height, depth)))
    model.add(back, box((-w + t, 0.04, 0.002), (w - t, height, 0.01)))
    levels = [0.06 + (height - t - 0.06) * k / boards for k in range(boards + 1)]
    for y in levels:
        model.add(board, box((-w + t, y, 0.01), (w - t, y + t, depth - 0.003)))
    model.add(board, box((-w + t, -0.002, depth - 0.04), (w - t, 0.06, depth - 0.02)))
    return model, [y + t for y in levels[:-1]]


def monitor(frame, screen, width=0.56, height=0.34):
    w = width / 2
    model = Model("monitor").add(frame, rounded_box((width, height, 0.03), 0.008, 1, (0, 0.13, 0)))
    inner = (-w + 0.014, 0.144, 0.0155)
    model.add(screen, rectangle(inner, (width - 0.028, 0, 0), (0, height - 0.028, 0), fit=True))
    model.add(frame, slab((0.05, 0.25, 0.02), (0, 0.01, -0.035)))
    model.add(frame, slab((0.05, 0.05, 0.03), (0, 0.23, -0.03)))
    model.add(frame, rounded_box((0.24, 0.012, 0.18), 0.005, 1, (0, 0.0005, -0.02)))
    return model


def keyboard(body, keys):
    model = Model("keyboard").add(body, rounded_box((0.44, 0.018, 0.15), 0.005, 1, (0, 0.0005, 0)))
    for j in range(5):
        x = -0.205
        while x < 0.2:
            wide = 0.115 if j == 4 and -0.09 < x < -0.07 else 0.018
            key = slab((wide, 0.006, 0.018), (x + wide / 2, 0.0175, -0.052 + 0.026 * j), ("-y",))
            model.add(keys, key)
            x += wide + 0.0047
    return model


def mouse(body):
    return Model("mouse").add(body, cushion((0.062, 0.036, 0.105), 16, 8, 0.8, (0, 0.0005, 0)))


def mug(clay, inside, segments=28):
    """A cup with a wall of 4 mm, a handle and coffee in it."""
    outer = [(0, 0.0005), (0.03, 0.0005), (0.036, 0.006), (0.0395, 0.03), (0.041, 0.095)]
    rim = [(0.0405, 0.097), (0.0375, 0.097), (0.037, 0.095)]
    inner = [(0.0355, 0.03), (0.033, 0.01), (0, 0.008)]
    model = Model("mug").add(clay, lathe(outer + rim + inner, segments))
    model.add(inside, disc(0.0358, 0.078, segments))
    handle = [
        (0.039, 0.078, 0),
        (0.06, 0.08, 0),
        (0.07, 0.055, 0),
        (0.058, 0.028, 0),
        (0.038, 0.026, 0),
    ]
    return model.add(clay, tube(smooth(handle, 4), 0.005, 8))


def pens(cup, colours, seed=4):
    model, rnd = Model("pen holder"), random.Random(seed)
    outer = [(0, 0.0005), (0.036, 0.0005), (0.038, 0.1), (0.035, 0.1), (0.033, 0.006), (0, 0.005)]
    model.add(cup, lathe(outer, 20))
    for k in range(6):
        a = 2 * math.pi * (k + rnd.random() * 0.5) / 6
        foot = (-0.016 * math.sin(a), 0.012, -0.016 * math.cos(a))
        tip = (0.033 * math.sin(a), rnd.uniform(0.14, 0.17), 0.033 * math.cos(a))
        model.add(colours[k % len(colours)], tube([foot, tip], 0.0038, 8))
    return model


def desk_lamp(metal, light, bulb_radius=0.062):
    """A jointed arm that carries a shade over the point (0, 0, 0.3); its light looks down."""
    model = Model("desk lamp")
    foot = [(0, 0.0005), (0.095, 0.0005), (0.098, 0.006), (0.09, 0.018), (0.02, 0.026), (0, 0.026)]
    model.add(metal, lathe(foot, 32))
    joints = [(0, 0.02, 0), (0, 0.31, -0.1), (0, 0.54, 0.2)]
    for a, b in zip(joints, joints[1:]):
        for x in (-0.012, 0.012):
            model.add(metal, tube([vec.add(a, (x, 0, 0)), vec.add(b, (x, 0, 0))], 0.006, 10))
    for joint in joints[1:]:
        pin = [vec.add(joint, (-0.024, 0, 0)), vec.add(joint, (0.024, 0, 0))]
        model.add(metal, tube(pin, 0.015, 14))
    outside = [
        (bulb_radius + 0.03, 0),
        (bulb_radius + 0.022, 0.04),
        (0.045, 0.1),
        (0.03, 0.15),
        (0, 0.155),
    ]
    inside = [
        (0, 0.145),
        (0.028, 0.14),
        (0.042, 0.098),
        (bulb_radius + 0.018, 0.04),
        (bulb_radius + 0.028, 0),
    ]
    head = vec.chain(vec.move(0, 0.44, 0.27), vec.turn("x", -22))
    model.add(metal, lathe(inside + outside, 32).moved(head))
    model.add(light, disc(bulb_radius, 0.03, 24, up=False).moved(head))
    return model


def bin_(material, inside=None):
    outer = [(0, 0.0005), (0.11, 0.0005), (0.14, 0.3), (0.143, 0.3), (0.143, 0.306), (0.136, 0.306)]
    return Model("waste bin").add(material, lathe(outer + [(0.107, 0.006), (0, 0.005)], 32))


def pinboard(board, frame, notes, width=1.5, height=0.95, seed=6):
    """Hangs on a wall at z = 0; the origin is its middle. Notes hang on it, each a little askew."""
    w, h, f = width / 2, height / 2, 0.025
    model = Model("pin board").add(board, box((-w, -h, -0.005), (w, h, 0.012)))
    for y0, y1 in ((-h - f, -h), (h, h + f)):
        model.add(frame, box((-w - f, y0, -0.005), (w + f, y1, 0.022)))
    for x0, x1 in ((-w - f, -w), (w, w + f)):
        model.add(frame, box((x0, -h, -0.005), (x1, h, 0.022), skip=("-y", "+y")))
    rnd = random.Random(seed)
    columns = max(2, round(width / 0.3))
    for i in range(columns):
        for j in range(3):
            if rnd.random() < 0.78:
                a, b = rnd.choice(((0.15, 0.21), (0.1, 0.1), (0.21, 0.15)))
                note = rectangle((-a / 2, -b / 2, 0), (a, 0, 0), (0, b, 0), fit=True)
                place = (
                    width * (i - (columns - 1) / 2) / (columns + 0.2),
                    height * (j - 1) / 3.2,
                    0.0135 + 0.0002 * i,
                )
                turn = vec.turn("z", rnd.uniform(-6, 6))
                model.add(notes[rnd.randrange(len(notes))], note.moved(vec.move(*place), turn))
    return model


def cabinet(body, fronts, handle, width=0.8, height=1.1, depth=0.42, drawers=4):
    """Its back at z = 0."""
    w = width / 2
    model = Model("cabinet").add(body, box((-w, -0.002, 0.004), (w, height, depth)))
    step = (height - 0.04) / drawers
    for k in range(drawers):
        y = 0.03 + step * k
        model.add(
            fronts, box((-w + 0.012, y, depth - 0.01), (w - 0.012, y + step - 0.014, depth + 0.016))
        )
        model.add(handle, slab((0.14, 0.014, 0.03), (0, y + step * 0.6, depth + 0.02)))
    return model

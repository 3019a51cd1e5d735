"""Plants, pictures, vases, lamps, tableware. Things stand on y = 0."""

import math
import random

from . import vectors as vec
from .curved import disc, lathe, tube
from .mesh import Mesh, Model
from .seating import smooth
from .shapes import box, rectangle

_GOLDEN_ANGLE = 137.50776


def framed_picture(picture, frame, width, height):
    """Hangs on a wall at z = 0, looks towards +z; the origin is its middle."""
    w, h, f = width / 2, height / 2, 0.03
    model = Model("picture")
    model.add(picture, rectangle((-w, -h, 0.012), (width, 0, 0), (0, height, 0), fit=True))
    model.add(frame, box((-w - f, -h - f, -0.005), (w + f, -h, 0.028)))
    model.add(frame, box((-w - f, h, -0.005), (w + f, h + f, 0.028)))
    for x0, x1 in ((-w - f, -w), (w, w + f)):
        model.add(frame, box((x0, -h, -0.005), (x1, h, 0.028), skip=("-y", "+y")))
    return model


def _leaf(size, width, bend, steps=5):
    """One sheet, three lines wide with a fold along the middle, from the origin along +z; it starts
    level and sinks by `bend` degrees."""
    mesh, rows, y, z = Mesh(), [], 0.0, 0.0
    for k in range(steps + 1):
        t = k / steps
        half = width / 2 * math.sin(math.pi * min(0.97, 0.06 + 0.94 * t)) ** 0.75
        slope = math.radians(bend * t)
        rows.append([(-half, y + 0.18 * half, z), (0, y, z), (half, y + 0.18 * half, z)])
        y -= size / steps * math.sin(slope)
        z += size / steps * math.cos(slope)
    normals = []
    for k in range(steps + 1):
        along = vec.sub(rows[min(steps, k + 1)][1], rows[max(0, k - 1)][1])
        normals.append(vec.unit(vec.cross(along, (1, 0, 0))))
    grid = [[(p, n, (0, 0)) for p in row] for row, n in zip(rows, normals)]
    return mesh.grid(grid[::-1])


def plant(pot, soil, leaf_colours, stem, leaves=34, height=1.1, seed=2):
    """A potted plant: leaves on arching stalks, turned by the golden angle."""
    rnd = random.Random(seed)
    model = Model("plant")
    outline = [
        (0, 0.0005),
        (0.12, 0.0005),
        (0.165, 0.27),
        (0.175, 0.272),
        (0.175, 0.305),
        (0.155, 0.305),
        (0.15, 0.25),
    ]
    model.add(pot, lathe(outline, 32)).add(soil, disc(0.152, 0.262, 32))
    for k in range(leaves):
        t = (k + 0.5) / leaves
        reach = (0.12 + 0.4 * (1 - t) ** 0.8) * rnd.uniform(0.85, 1.1) * height
        top = 0.26 + height * (0.2 + 0.72 * t) * rnd.uniform(0.9, 1.05)
        stalk = [
            (0, 0.25, 0.02),
            (0, 0.26 + (top - 0.26) * 0.62, 0.05 + reach * 0.22),
            (0, top, reach * 0.75),
        ]
        around = vec.turn("y", _GOLDEN_ANGLE * k)
        model.add(stem, tube(smooth(stalk, 3), 0.004, 5, ends=False).moved(around))
        blade = _leaf(
            0.3 * rnd.uniform(0.8, 1.15), 0.1 * rnd.uniform(0.8, 1.2), rnd.uniform(40, 80)
        )
        rise = vec.turn("x", -rnd.uniform(10, 30) - 25 * t)
        tip = vec.move(0, top, reach * 0.75)
        model.add(leaf_colours[k % len(leaf_colours)], blade.moved(around, tip, rise))
    return model


def vase(clay, segments=32):
    outer = [
        (0, 0.0005),
        (0.06, 0.0005),
        (0.075, 0.02),
        (0.105, 0.1),
        (0.108, 0.15),
        (0.085, 0.23),
        (0.045, 0.3),
        (0.038, 0.34),
        (0.055, 0.38),
    ]
    inner = [(0.052, 0.38), (0.034, 0.34), (0.04, 0.3), (0.08, 0.22), (0.1, 0.14), (0, 0.02)]
    return Model("vase").add(clay, lathe(outer + inner, segments, 50))


def bowl(clay, segments=32):
    outer = [(0, 0.0005), (0.05, 0.0005), (0.055, 0.012), (0.11, 0.04), (0.14, 0.085)]
    inner = [(0.136, 0.086), (0.106, 0.045), (0.05, 0.018), (0, 0.014)]
    return Model("bowl").add(clay, lathe(outer + inner, segments, 50))


def plate(clay, segments=32):
    outer = [(0, 0.0005), (0.08, 0.0005), (0.1, 0.008), (0.135, 0.017)]
    inner = [(0.134, 0.02), (0.098, 0.012), (0.08, 0.006), (0, 0.005)]
    return Model("plate").add(clay, lathe(outer + inner, segments, 50))


def wine_glass(glass, segments=32):
    """A goblet with a real wall; all of it is one closed solid."""
    foot = [
        (0, 0.0008),
        (0.032, 0.0008),
        (0.034, 0.002),
        (0.02, 0.005),
        (0.006, 0.012),
        (0.004, 0.05),
        (0.005, 0.085),
    ]
    cup = [(0.012, 0.094), (0.028, 0.108), (0.037, 0.13), (0.038, 0.155), (0.033, 0.195)]
    inner = [
        (0.0318, 0.195),
        (0.0366, 0.155),
        (0.0356, 0.131),
        (0.027, 0.11),
        (0.011, 0.097),
        (0, 0.0945),
    ]
    return Model("wine glass").add(glass, lathe(foot + cup + inner, segments, 60))


def torchiere(metal, light, height=1.78, segments=32):
    """A floor lamp: a bowl that is open above. The light lies below its rim, so that only the
    ceiling and the upper walls see it."""
    model = Model("floor lamp")
    foot = [
        (0, -0.002),
        (0.15, -0.002),
        (0.152, 0.012),
        (0.13, 0.025),
        (0.02, 0.035),
        (0.013, 0.06),
    ]
    pole = [(0.013, height - 0.16), (0.03, height - 0.13)]
    outer = [(0.1, height - 0.1), (0.17, height - 0.04), (0.2, height)]
    inner = [(0.195, height), (0.165, height - 0.035), (0.14, height - 0.055), (0, height - 0.056)]
    model.add(metal, lathe(foot + pole + outer + inner, segments, 50))
    return model.add(light, disc(0.13, height - 0.05, 24))


def pendant(shade, inside, light, cord, drop, radius=0.2, segments=32):
    """Hangs from y = 0; the mouth of its shade is at -drop. Its light looks down."""
    model = Model("pendant lamp")
    model.add(cord, tube([(0, -drop + 0.15, 0), (0, 0.002, 0)], 0.005, 8, ends=False))
    model.add(cord, lathe([(0, -0.03), (0.05, -0.03), (0.06, -0.005), (0.06, 0.002)], 20))
    outer = [
        (radius, 0),
        (radius * 0.93, 0.06),
        (radius * 0.7, 0.12),
        (radius * 0.3, 0.165),
        (0.02, 0.18),
        (0, 0.18),
    ]
    inner = [
        (0, 0.172),
        (radius * 0.28, 0.158),
        (radius * 0.67, 0.114),
        (radius * 0.91, 0.055),
        (radius * 0.985, 0),
    ]
    hung = vec.move(0, -drop, 0)
    model.add(shade, lathe(outer, segments).moved(hung))
    model.add(inside, lathe(inner, segments).moved(hung))
    model.add(shade, lathe([(radius * 0.985, 0), (radius, 0)], segments).moved(hung))
    return model.add(light, disc(radius * 0.75, 0.04, 24, up=False).moved(hung))

"""Chairs and sofas. They look towards +z and stand on y = 0."""

from . import vectors as vec
from .curved import ball, cushion, lathe, rounded_box, tube
from .mesh import Model
from .shapes import slab, taper


def wooden_chair(seat, frame):
    """Plain, flat, few triangles."""
    model = Model("wooden chair").add(seat, slab((0.42, 0.035, 0.42), (0, 0.43, 0)))
    for x in (-0.185, 0.185):
        model.add(frame, taper(0.03, 0.038, 0.434, (x, -0.002, 0.185)))
        model.add(frame, taper(0.03, 0.042, 0.434, (x, -0.002, -0.185)))
        model.add(frame, taper(0.042, 0.028, 0.47, (x, 0.463, -0.185), (0, -0.07)))
    for y, z in ((0.6, -0.207), (0.72, -0.225), (0.84, -0.243)):
        model.add(seat, slab((0.35, 0.075, 0.016), (0, y, z)))
    return model


def _star_base(model, material, wheel, detail):
    """Five arms with castors under a gas spring."""
    arm = rounded_box((0.035, 0.03, 0.3), 0.012, 1, (0, 0.075, 0.16))
    castor = ball(0.028, 1 + detail, (0, 0.026, 0.3))
    for k in range(5):
        around = vec.turn("y", 72 * k)
        model.add(material, arm.moved(around))
        model.add(wheel, castor.moved(around))
    column = [(0, 0.06), (0.035, 0.06), (0.035, 0.13), (0.025, 0.14), (0.025, 0.41)]
    model.add(material, lathe(column, 12 * detail))


def office_chair(fabric, base, plastic, detail=1, name="office chair"):
    """On castors, with a padded seat and back and two arm rests. `detail` 1, 2, ... multiplies
    the pieces of every curve."""
    model = Model(name)
    _star_base(model, base, plastic, detail)
    segments, rings = 24 * detail, 10 * detail
    model.add(fabric, cushion((0.5, 0.1, 0.48), segments, rings, 0.5, (0, 0.43, 0.02)))
    model.add(plastic, rounded_box((0.3, 0.03, 0.3), 0.012, detail, (0, 0.405, 0)))
    back = cushion((0.46, 0.085, 0.58), segments, rings, 0.5, (0, -0.042, 0))
    upright = vec.chain(vec.move(0, 0.86, -0.24), vec.turn("x", 82))
    model.add(fabric, back.moved(upright))
    spine = [(0, 0.415, -0.04), (0, 0.425, -0.2), (0, 0.53, -0.29), (0, 0.82, -0.3)]
    model.add(plastic, tube(smooth(spine, 4 * detail), 0.022, 8 * detail))
    for x in (-0.27, 0.27):
        path = [
            (x * 0.7, 0.425, 0.02),
            (x * 0.95, 0.427, 0.02),
            (x * 1.03, 0.5, 0.02),
            (x, 0.64, 0.02),
        ]
        model.add(plastic, tube(smooth(path, 4 * detail), 0.016, 8 * detail))
        model.add(plastic, rounded_box((0.07, 0.03, 0.28), 0.013, 1 + detail, (x, 0.64, 0.03)))
    return model


def smooth(points, steps):
    """A Catmull-Rom line through the points."""
    padded = [points[0], *points, points[-1]]
    line = []
    for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:]):
        for k in range(steps):
            t = k / steps
            line.append(
                tuple(
                    0.5
                    * (
                        2 * q
                        + (r - p) * t
                        + (2 * p - 5 * q + 4 * r - s) * t * t
                        + (3 * q - p - 3 * r + s) * t * t * t
                    )
                    for p, q, r, s in zip(a, b, c, d)
                )
            )
    return [*line, points[-1]]


def upholstered_chair(fabric, wood, detail=1):
    """For a dining table: a thick seat, a curved padded back, four legs."""
    model = Model("upholstered chair")
    segments, rings = 12 + 8 * detail, 6 + 2 * detail
    model.add(fabric, cushion((0.47, 0.11, 0.46), segments, rings, 0.42, (0, 0.38, 0)))
    back = cushion((0.43, 0.07, 0.5), segments, rings, 0.42, (0, -0.035, 0))
    model.add(fabric, back.moved(vec.move(0, 0.74, -0.225), vec.turn("x", 80)))
    for x in (-0.18, 0.18):
        model.add(wood, taper(0.024, 0.045, 0.43, (x, -0.002, 0.18)))
        model.add(wood, taper(0.024, 0.045, 0.43, (x * 1.05, -0.002, -0.2)))
    return model


def sofa(fabric, pillow, feet, width=1.9):
    model = Model("sofa")
    inner = width - 0.36
    model.add(fabric, rounded_box((width - 0.06, 0.2, 0.84), 0.03, 1, (0, 0.09, 0)))
    model.add(fabric, rounded_box((inner + 0.1, 0.5, 0.2), 0.06, 1, (0, 0.3, -0.32)))
    for x in (-1, 1):
        arm = (x * (width / 2 - 0.1), 0.1, 0)
        model.add(fabric, rounded_box((0.2, 0.5, 0.88), 0.07, 2, arm))
        seat = (x * inner / 4, 0.285, 0.07)
        model.add(fabric, rounded_box((inner / 2 - 0.006, 0.16, 0.68), 0.05, 2, seat))
        soft = cushion((0.42, 0.14, 0.42), 20, 8, 0.55, (0, -0.07, 0))
        place = vec.chain(
            vec.move(x * inner / 3.2, 0.63, -0.13), vec.turn("z", -7 * x), vec.turn("x", 68)
        )
        model.add(pillow, soft.moved(place))
        for z in (-0.34, 0.34):
            model.add(feet, slab((0.05, 0.1, 0.05), (x * (width / 2 - 0.12), -0.002, z)))
    return model

"""Rooms: the shell with its openings, windows with blinds, doors, skirting boards.

Compass: north is -z, east is +x. Walls look inwards. Anything that touches a wall or a floor
reaches a little into it, so that no two faces lie in one plane and no light gets through the joint.
"""

import math

from . import vectors as vec
from .mesh import Mesh, Model
from .shapes import box, rectangle, slab, wall

SIDES = ("north", "south", "west", "east")


def wall_frame(side, x0, x1, z0, z1):
    """Lower left corner of a wall and its direction to the right, seen from inside."""
    return {
        "north": ((x0, 0, z0), (x1 - x0, 0, 0)),
        "south": ((x1, 0, z1), (x0 - x1, 0, 0)),
        "west": ((x0, 0, z1), (0, 0, z0 - z1)),
        "east": ((x1, 0, z0), (0, 0, z1 - z0)),
    }[side]


def shell(x0, x1, z0, z1, height, floor, ceiling, walls, holes=None, name="room"):
    """`walls`: material by side; `holes`: by side, rectangles as shapes.wall takes them."""
    model = Model(name)
    model.add(floor, rectangle((x0, 0, z1), (x1 - x0, 0, 0), (0, 0, z0 - z1)))
    model.add(ceiling, rectangle((x0, height, z0), (x1 - x0, 0, 0), (0, 0, z1 - z0)))
    for side in SIDES:
        corner, right = wall_frame(side, x0, x1, z0, z1)
        model.add(walls[side], wall(corner, right, (0, height, 0), (holes or {}).get(side, ())))
    return model


def skirting(x0, x1, z0, z1, material, gaps=None, height=0.08, thickness=0.016):
    """`gaps`: by side, pieces (from, to) in metres from the wall's left end that stay free."""
    model = Model("skirting board")
    for side in SIDES:
        corner, right = wall_frame(side, x0, x1, z0, z1)
        extent = abs(right[0] + right[2])
        ends = [0.0]
        for a, b in sorted((gaps or {}).get(side, ())):
            ends += [a, b]
        ends.append(extent)
        top = height if right[0] else height - 0.002
        for a, b in zip(ends[::2], ends[1::2]):
            low = [corner[i] + right[i] / extent * a for i in range(3)]
            high = [corner[i] + right[i] / extent * b for i in range(3)]
            inner = thickness if side in ("north", "west") else -thickness
            across = 2 if right[0] else 0
            low[across] -= inner / 2
            high[across] += inner
            ordered = [sorted(pair) for pair in zip(low, high)]
            first = (ordered[0][0], -0.002, ordered[2][0])
            model.add(material, box(first, (ordered[0][1], top, ordered[2][1]), skip=("-y",)))
    return model


def casing(width, height, depth, trim, bottom=True):
    """A frame around an opening in a wall at z = 0 that looks towards +z; the opening begins at
    y = 0 and goes back to z = -depth."""
    w, h, t = width / 2, height, 0.06
    front, back = 0.018, -depth
    low = -t if bottom else -0.002
    mesh = Mesh()
    mesh.join(box((-w - t, low, back), (-w + 0.012, h + t, front)))
    mesh.join(box((w - 0.012, low, back), (w + t, h + t, front)))
    mesh.join(box((-w + 0.012, h - 0.012, back), (w - 0.012, h + t, front - 0.002)))
    if bottom:
        mesh.join(box((-w + 0.012, -t, back), (w - 0.012, 0.012, front + 0.05)))
    return Model("casing").add(trim, mesh)


def doorway(width, height, depth, floor, trim):
    """Lines an opening through a wall `depth` thick whose near side is at z = 0; open both ways."""
    w, t, over = width / 2, 0.06, 0.018
    model = Model("doorway")
    for low, high in ((-w - t, -w + 0.012), (w - 0.012, w + t)):
        model.add(trim, box((low, -0.002, -depth - over), (high, height + t, over)))
    model.add(
        trim,
        box(
            (-w + 0.012, height - 0.012, -depth - over + 0.002),
            (w - 0.012, height + t, over - 0.002),
        ),
    )
    sill = box((-w + 0.012, -0.03, -depth - 0.02), (w - 0.012, 0.004, 0.02))
    return model.add(floor, sill)


def window(width, height, trim, view):
    """Fits a hole of that size; the middle of the hole's lower edge is the origin. The view behind
    the bars is a picture on a closed back."""
    depth = 0.14
    model = casing(width, height, depth, trim)
    w = width / 2
    back = rectangle(
        (-w - 0.03, -0.03, -depth + 0.01), (width + 0.06, 0, 0), (0, height + 0.06, 0), True
    )
    model.add(view, back)
    z0, z1 = -depth + 0.02, -depth + 0.06
    model.add(trim, box((-0.025, 0, z0), (0.025, height, z1)))
    model.add(trim, box((-w, height * 0.62, z0 + 0.002), (w, height * 0.62 + 0.04, z1 - 0.002)))
    model.name = "window"
    return model


def blind(width, height, material, rail, angle=42, pitch=0.036):
    """Slats that hang from a rail at `height` down to y = 0; they look towards +z."""
    model = Model("blind").add(rail, slab((width, 0.04, 0.05), (0, height, 0)))
    count = int(height / pitch)
    slat = slab((width - 0.01, 0.0012, 0.038), (0, 0, 0))
    for i in range(count):
        wobble = 1.5 * math.sin(i * 12.9898)
        at = vec.move(0, height - pitch * (i + 0.6), 0)
        model.add(material, slat.moved(at, vec.turn("x", angle + wobble)))
    model.add(rail, slab((width, 0.018, 0.026), (0, height - pitch * (count + 0.4), 0)))
    for x in (-0.35 * width, 0.35 * width):
        model.add(rail, slab((0.004, height - 0.01, 0.003), (x, 0.005, 0.021)))
    return model


def door(width, height, leaf, trim, handle):
    """A closed door with two panels in front of a wall at z = 0, looking towards +z."""
    w, t = width / 2, 0.07
    model = Model("door").add(leaf, box((-w, -0.002, -0.01), (w, height, 0.02)))
    for y0, y1 in ((0.15, 0.9), (1.05, height - 0.15)):
        for x0, x1, a, b in (
            (-w + 0.12, w - 0.12, y0, y0 + 0.02),
            (-w + 0.12, w - 0.12, y1 - 0.02, y1),
            (-w + 0.12, -w + 0.14, y0 + 0.02, y1 - 0.02),
            (w - 0.14, w - 0.12, y0 + 0.02, y1 - 0.02),
        ):
            model.add(leaf, box((x0, a, 0.015), (x1, b, 0.03)))
    model.add(trim, box((-w - t, -0.002, -0.01), (-w - 0.003, height + t, 0.03)))
    model.add(trim, box((w + 0.003, -0.002, -0.01), (w + t, height + t, 0.03)))
    model.add(trim, box((-w - 0.003, height + 0.003, -0.01), (w + 0.003, height + t, 0.028)))
    model.add(handle, box((w - 0.09, 1.0, 0.015), (w - 0.06, 1.06, 0.045)))
    model.add(handle, box((w - 0.2, 1.022, 0.045), (w - 0.06, 1.038, 0.06)))
    return model


def ceiling_panel(width, depth, frame, light):
    """A flat lamp: hangs at y = 0 under a ceiling, gives light from its lower side only."""
    w, d, t = width / 2, depth / 2, 0.03
    model = Model("ceiling lamp")
    model.add(light, rectangle((-w, -0.06, -d), (width, 0, 0), (0, 0, depth)))
    for z0, z1 in ((-d - t, -d), (d, d + t)):
        model.add(frame, box((-w - t, -0.07, z0), (w + t, -0.02, z1)))
    for x0, x1 in ((-w - t, -w), (w, w + t)):
        model.add(frame, box((x0, -0.07, -d), (x1, -0.02, d), skip=("-z", "+z")))
    model.add(frame, rectangle((-w, -0.021, d), (width, 0, 0), (0, 0, -depth)))
    model.add(frame, slab((0.1, 0.03, 0.1), (0, -0.025, 0), skip=("-y",)))
    return model

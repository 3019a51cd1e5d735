"""A table under a lamp, a glass sphere on the table. The smallest scene: soft shadows, colour
bleeding from two coloured walls, and the caustic of the sphere on the table, on which it goes once round
when the animation plays."""

from . import palette as p
from .curved import ball
from .decor import framed_picture
from .materials import light, picture
from .mesh import Model
from .scene import Scene
from .seating import wooden_chair
from .shapes import box, rectangle, slab, taper
from .textures import rug

RUG = picture("rug", rug((116, 44, 36), (232, 208, 170)))
LAMP = light("lamp", 26, 24.5, 22)

TABLE_TOP = 0.74


def room(width, depth, height):
    x, z = width / 2, depth / 2
    model = Model("room")
    model.add(p.BOARDS, rectangle((-x, 0, z), (width, 0, 0), (0, 0, -depth)))
    model.add(p.PLASTER, rectangle((-x, 0, -z), (width, 0, 0), (0, height, 0)))
    model.add(p.PLASTER, rectangle((x, 0, z), (-width, 0, 0), (0, height, 0)))
    model.add(p.PLASTER, rectangle((-x, height, -z), (width, 0, 0), (0, 0, depth)))
    model.add(p.TERRACOTTA, rectangle((-x, 0, z), (0, 0, -depth), (0, height, 0)))
    model.add(p.TEAL, rectangle((x, 0, -z), (0, 0, depth), (0, height, 0)))
    return model


def table():
    model = Model("table").add(p.OAK, slab((1.5, 0.04, 0.9), (0, TABLE_TOP - 0.04, 0)))
    for x in (-0.66, 0.66):
        for z in (-0.36, 0.36):
            model.add(p.OAK, taper(0.045, 0.07, 0.705, (x, -0.002, z)))
    for z in (-0.36, 0.36):
        model.add(p.OAK, slab((1.25, 0.092, 0.022), (0, 0.61, z)))
    for x in (-0.66, 0.66):
        model.add(p.OAK, slab((0.022, 0.092, 0.65), (x, 0.61, 0)))
    return model


def lamp():
    """A flat box on four rods under the ceiling; only its lower side gives light."""
    model = Model("lamp").add(LAMP, rectangle((-0.5, 0, -0.35), (1, 0, 0), (0, 0, 0.7)))
    model.add(p.DARK_WOOD, box((-0.52, -0.01, -0.37), (0.52, 0.05, -0.35)))
    model.add(p.DARK_WOOD, box((-0.52, -0.01, 0.35), (0.52, 0.05, 0.37)))
    model.add(p.DARK_WOOD, box((-0.52, -0.01, -0.35), (-0.5, 0.05, 0.35), skip=("-z", "+z")))
    model.add(p.DARK_WOOD, box((0.5, -0.01, -0.35), (0.52, 0.05, 0.35), skip=("-z", "+z")))
    model.add(p.PLASTER, rectangle((-0.5, 0.05, 0.35), (1, 0, 0), (0, 0, -0.7)))
    for x in (-0.4, 0.4):
        model.add(p.DARK_WOOD, slab((0.012, 0.212, 0.012), (x, 0.051, 0), skip=("-y",)))
    return model


def carpet(width, depth):
    top = rectangle((-width / 2, 0.008, depth / 2), (width, 0, 0), (0, 0, -depth), fit=True)
    edge = slab((width, 0.009, depth), (0, -0.001, 0), skip=("+y", "-y"))
    return Model("rug").add(RUG, top).add(p.TERRACOTTA, edge)


def books():
    model = Model("books")
    y = 0.001
    for size, turn in (((0.24, 0.03, 0.17), p.TERRACOTTA), ((0.21, 0.025, 0.15), p.TEAL)):
        model.add(turn, slab(size, (0, y, 0), skip=("-y",)))
        y += size[1] + 0.0005
    return model


def build():
    scene = Scene("table_room")
    scene.place(room(4.2, 4.8, 2.6))
    scene.place(carpet(2.5, 1.7), (0, 0, -0.5))
    scene.place(table(), (0, 0, -0.5), 0)
    seat = wooden_chair(p.OAK, p.DARK_WOOD)
    scene.place(seat, (-0.3, 0, -1.1), 8, "chair behind the table")
    scene.place(seat, (1.02, 0, -0.4), -82, "chair on the right")
    scene.place(Model("glass sphere").add(p.GLASS, ball(0.13, 5)), (0.24, TABLE_TOP + 0.131, -0.35))
    scene.place(books(), (-0.4, TABLE_TOP, -0.5), 24)
    scene.place(lamp(), (0, 2.34, -0.5))
    scene.place(framed_picture(p.LANDSCAPE, p.DARK_WOOD, 1.2, 0.8), (-0.1, 1.55, -2.4))
    # Over the table's edge to the left and back, once round in four seconds.
    scene.move(
        "glass sphere",
        (0, 1, 2, 3, 4),
        ((0, 0, 0), (0.2, 0, 0.3), (-0.1, 0, 0.35), (-0.25, 0, 0.05), (0, 0, 0)),
    )
    scene.camera("front", (0.15, 1.5, 2.25), (0.02, 0.88, -0.6), 52)
    scene.camera("sphere", (0.75, 1.25, 0.75), (0.15, 0.78, -0.4), 40)
    return scene

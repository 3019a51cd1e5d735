"""A table under a lamp, a glass sphere on the table. The smallest scene: soft shadows, colour
bleeding from two coloured walls, and the caustic of the sphere on the table."""

from .curved import ball, rounded_box
from .materials import glass, light, matte, picture, textured
from .mesh import Mesh, Model
from .pictures import landscape
from .scene import Scene
from .shapes import box, rectangle, slab, taper
from .textures import planks, rug, wood

OAK = textured("oak", wood((120, 74, 38), (202, 150, 96)), 0.9, 0.45)
DARK_WOOD = matte("dark wood", 0.12, 0.06, 0.035)
FLOOR = textured("floor boards", planks((96, 66, 42), (196, 152, 108)), 2.4, 1.2)
RUG = picture("rug", rug((104, 40, 34), (226, 200, 160)))
PLASTER = matte("plaster", 0.76, 0.74, 0.69)
TERRACOTTA = matte("terracotta", 0.62, 0.17, 0.08)
TEAL = matte("teal", 0.1, 0.36, 0.4)
PAINTING = picture("painting", landscape())
LAMP = light("lamp", 17, 15, 11.5)

TABLE_TOP = 0.74


def room(width, depth, height):
    x, z = width / 2, depth / 2
    model = Model("room")
    model.add(FLOOR, rectangle((-x, 0, z), (width, 0, 0), (0, 0, -depth)))
    model.add(PLASTER, rectangle((-x, 0, -z), (width, 0, 0), (0, height, 0)))
    model.add(PLASTER, rectangle((x, 0, z), (-width, 0, 0), (0, height, 0)))
    model.add(PLASTER, rectangle((-x, height, -z), (width, 0, 0), (0, 0, depth)))
    model.add(TERRACOTTA, rectangle((-x, 0, z), (0, 0, -depth), (0, height, 0)))
    model.add(TEAL, rectangle((x, 0, -z), (0, 0, depth), (0, height, 0)))
    return model


def table():
    model = Model("table").add(OAK, rounded_box((1.5, 0.04, 0.9), 0.008, 1, (0, TABLE_TOP - 0.04, 0)))
    for x in (-0.66, 0.66):
        for z in (-0.36, 0.36):
            model.add(OAK, taper(0.045, 0.07, 0.702, (x, -0.002, z)))
    for z in (-0.36, 0.36):
        model.add(OAK, slab((1.25, 0.09, 0.022), (0, 0.61, z)))
    for x in (-0.66, 0.66):
        model.add(OAK, slab((0.022, 0.09, 0.65), (x, 0.61, 0)))
    return model


def chair():
    """Looks towards +z."""
    model = Model("chair").add(OAK, slab((0.42, 0.035, 0.42), (0, 0.43, 0)))
    for x in (-0.185, 0.185):
        model.add(DARK_WOOD, taper(0.03, 0.038, 0.434, (x, -0.002, 0.185)))
        model.add(DARK_WOOD, taper(0.03, 0.042, 0.434, (x, -0.002, -0.185)))
        model.add(DARK_WOOD, taper(0.042, 0.028, 0.47, (x, 0.463, -0.185), (0, -0.07)))
    for y, z in ((0.6, -0.207), (0.72, -0.225), (0.84, -0.243)):
        model.add(OAK, slab((0.35, 0.075, 0.016), (0, y, z)))
    return model


def lamp():
    """A flat box on four rods under the ceiling; only its lower side gives light."""
    model = Model("lamp").add(LAMP, rectangle((-0.5, 0, -0.35), (1, 0, 0), (0, 0, 0.7)))
    model.add(DARK_WOOD, box((-0.52, -0.01, -0.37), (0.52, 0.05, -0.35)))
    model.add(DARK_WOOD, box((-0.52, -0.01, 0.35), (0.52, 0.05, 0.37)))
    model.add(DARK_WOOD, box((-0.52, -0.01, -0.35), (-0.5, 0.05, 0.35), skip=("-z", "+z")))
    model.add(DARK_WOOD, box((0.5, -0.01, -0.35), (0.52, 0.05, 0.35), skip=("-z", "+z")))
    model.add(PLASTER, rectangle((-0.5, 0.05, 0.35), (1, 0, 0), (0, 0, -0.7)))
    for x in (-0.4, 0.4):
        model.add(DARK_WOOD, slab((0.012, 0.2, 0.012), (x, 0.051, 0), skip=("-y",)))
    return model


def painting(width, height):
    """Hangs on a wall behind it, looks towards +z."""
    w, h, f = width / 2, height / 2, 0.035
    model = Model("painting").add(
        PAINTING, rectangle((-w, -h, 0.012), (width, 0, 0), (0, height, 0), fit=True)
    )
    model.add(DARK_WOOD, box((-w - f, -h - f, 0.001), (w + f, -h, 0.03)))
    model.add(DARK_WOOD, box((-w - f, h, 0.001), (w + f, h + f, 0.03)))
    for x0, x1 in ((-w - f, -w), (w, w + f)):
        model.add(DARK_WOOD, box((x0, -h, 0.001), (x1, h, 0.03), skip=("-y", "+y")))
    return model


def books():
    model = Model("books")
    y = 0.001
    for size, turn in (((0.24, 0.03, 0.17), TERRACOTTA), ((0.21, 0.025, 0.15), TEAL)):
        model.add(turn, slab(size, (0, y, 0), skip=("-y",)))
        y += size[1] + 0.0005
    return model


def build():
    scene = Scene("table_room")
    scene.place(room(4.2, 4.8, 2.6))
    rug_mesh = rectangle((-1.25, 0, 0.85), (2.5, 0, 0), (0, 0, -1.7), fit=True)
    scene.place(Model("rug").add(RUG, rug_mesh), (0, 0.006, -0.5))
    scene.place(table(), (0, 0, -0.5), 0)
    seat = chair()
    scene.place(seat, (-0.3, 0, -1.1), 8, "chair behind the table")
    scene.place(seat, (1.02, 0, -0.4), -82, "chair on the right")
    scene.place(Model("glass sphere").add(glass(), ball(0.13, 5)), (0.24, TABLE_TOP + 0.131, -0.35))
    scene.place(books(), (-0.4, TABLE_TOP, -0.5), 24)
    scene.place(lamp(), (0, 2.34, -0.5))
    scene.place(painting(1.2, 0.8), (-0.1, 1.55, -2.4))
    scene.camera("front", (0.15, 1.5, 2.25), (0.02, 0.88, -0.6), 52)
    scene.camera("sphere", (0.75, 1.25, 0.75), (0.15, 0.78, -0.4), 40)
    return scene

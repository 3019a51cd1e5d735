"""A table laid for two in the light of two floor lamps that shine on the ceiling only: whatever
stands below is lit indirectly. A polished floor, and a glass sphere that hangs in the light."""

from . import decor, palette as p, seating, textures
from . import room as rooms
from .curved import ball, lathe, table_top, tube
from .materials import Material, Texture, light, matte, textured
from .mesh import Model
from .scene import Scene

X, Z, HEIGHT = 2.7, 2.5, 2.75
FLOOR = Material(
    "polished tiles",
    texture=Texture("tiles", textures.checker((30, 26, 26), (186, 174, 156)), (0.9, 0.9)),
    roughness=0,
)
ROSE = matte("rose wall", 0.68, 0.3, 0.25)
GREEN = matte("green wall", 0.3, 0.5, 0.3)
SOFA = matte("sofa cloth", 0.16, 0.25, 0.42)
PILLOW = matte("pillow cloth", 0.78, 0.52, 0.14)
CHAIR = textured("chair cloth", textures.weave((112, 28, 36), (186, 70, 66)), 0.05, 0.05)
LINEN = matte("linen", 0.8, 0.78, 0.72)
CHINA = matte("china", 0.82, 0.82, 0.8)
WAX = matte("wax", 0.82, 0.74, 0.58)
LAMP = light("lamp", 190, 170, 136)

TABLE_TOP = 0.75


def dinner_table():
    model = Model("dinner table").add(LINEN, table_top(1.0, 1.0, 0.03, 40, 2, 2, TABLE_TOP - 0.03))
    leg = [
        (0.2, 0.03),
        (0.06, 0.09),
        (0.045, 0.4),
        (0.06, TABLE_TOP - 0.06),
        (0.16, TABLE_TOP - 0.03),
    ]
    foot = [(0.26, -0.002), (0.26, 0.02)]
    return model.add(p.DARK_WOOD, lathe(foot + leg, 24))


def candlestick():
    foot = [
        (0, 0.0005),
        (0.055, 0.0005),
        (0.05, 0.012),
        (0.012, 0.03),
        (0.01, 0.12),
        (0.028, 0.14),
        (0.012, 0.145),
    ]
    model = Model("candlestick").add(p.BRASS, lathe([*foot, (0, 0.146)], 20))
    return model.add(WAX, lathe([(0.011, 0.14), (0.011, 0.34), (0, 0.343)], 12))


def laid_table(scene, x, z):
    scene.place(dinner_table(), (x, 0, z))
    scene.place(candlestick(), (x, TABLE_TOP, z - 0.05))
    chair = seating.upholstered_chair(CHAIR, p.DARK_WOOD)
    plate, glass = decor.plate(CHINA, 24), decor.wine_glass(p.GLASS, 20)
    for side, name in ((-1, "her"), (1, "his")):
        scene.place(chair, (x + side * 0.72, 0, z), -90 * side + 12, f"{name} chair")
        scene.place(plate, (x + side * 0.32, TABLE_TOP, z + 0.02), 0, f"{name} plate")
        scene.place(glass, (x + side * 0.17, TABLE_TOP, z - 0.24 * side), 0, f"{name} glass")


def build():
    scene = Scene("invisible_date")
    scene.exposure = -1  # else the ceiling, which the lamps shine on, is white
    sides = {"north": p.PLASTER, "south": p.PLASTER, "west": ROSE, "east": GREEN}
    scene.place(rooms.shell(-X, X, -Z, Z, HEIGHT, FLOOR, p.PLASTER, sides))
    scene.place(rooms.skirting(-X, X, -Z, Z, p.WHITE))
    lamp = decor.torchiere(p.BRASS, LAMP, 1.8, 24)
    scene.place(lamp, (-2.2, 0, -1.55), 0, "left lamp")
    scene.place(lamp, (2.2, 0, -1.9), 0, "right lamp")
    scene.place(seating.sofa(SOFA, PILLOW, p.DARK_WOOD), (0.25, 0, -1.98))
    scene.place(decor.framed_picture(p.LANDSCAPE, p.DARK_WOOD, 1.3, 0.86), (0.25, 1.58, -Z))
    laid_table(scene, 0.1, 0.1)
    sphere = Model("glass sphere").add(p.GLASS, ball(0.13, 8))
    sphere.add(p.BLACK, tube([(0, 0.131, 0), (0, 0.302, 0)], 0.003, 6, ends=False))
    scene.place(sphere, (-1.75, HEIGHT - 0.3, -1.3))
    scene.place(decor.vase(p.TEAL, 24), (2.3, 0, -0.9), 0, "vase", 0, 1.5)
    scene.camera("from the window", (0.45, 1.5, 2.3), (-0.02, 1.17, -0.6), 58)
    scene.camera("table", (1.3, 1.4, 1.45), (0.05, 0.85, 0.05), 42)
    return scene

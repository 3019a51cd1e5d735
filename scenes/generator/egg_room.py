"""A gallery with two lamps, a warm and a cool one, and a glass egg on a column between them."""

from . import decor, palette as p, textures
from . import room as rooms
from .curved import cushion, egg, lathe, rounded_box
from .materials import light, matte, picture, textured
from .mesh import Model
from .pictures import abstract
from .scene import Scene
from .shapes import slab

X, Z, HEIGHT = 2.4, 2.3, 2.8
FLOOR = textured(
    "marble tiles", textures.marble_tiles((88, 84, 82), (236, 230, 220), 0.1), 1.2, 1.2
)
STONE = matte("limestone", 0.72, 0.68, 0.6)
PLUM = matte("plum wall", 0.52, 0.16, 0.26)
BLUE = matte("blue wall", 0.14, 0.32, 0.6)
CLOTH = matte("mustard cloth", 0.72, 0.46, 0.08)
POSTER = picture("rings", abstract(34))
WARM = light("warm lamp", 95, 72, 44)
COOL = light("cool lamp", 56, 66, 79)


def column(height=0.92):
    """Stands on a square plinth and carries a square slab."""
    model = Model("column").add(STONE, rounded_box((0.46, 0.1, 0.46), 0.01, 1, (0, -0.002, 0)))
    base = [(0.205, 0.098), (0.21, 0.115), (0.205, 0.135), (0.17, 0.15)]
    neck = [(0.15, 0.2), (0.135, height - 0.16), (0.15, height - 0.12), (0.19, height - 0.058)]
    model.add(STONE, lathe(base + neck, 36))
    return model.add(STONE, rounded_box((0.44, 0.06, 0.44), 0.01, 1, (0, height - 0.06, 0)))


def bench():
    model = Model("bench").add(p.OAK, slab((1.3, 0.045, 0.4), (0, 0.38, 0)))
    for x in (-0.5, 0.5):
        model.add(p.OAK, slab((0.05, 0.382, 0.34), (x, -0.002, 0)))
    model.add(CLOTH, rounded_box((1.2, 0.07, 0.36), 0.025, 1, (0, 0.4255, 0)))
    return model.add(CLOTH, cushion((0.3, 0.12, 0.3), 16, 8, 0.6, (0.38, 0.496, 0)))


def build():
    scene = Scene("egg_room")
    sides = {"north": p.PLASTER, "south": p.PLASTER, "west": PLUM, "east": BLUE}
    scene.place(rooms.shell(-X, X, -Z, Z, HEIGHT, FLOOR, p.PLASTER, sides))
    scene.place(rooms.skirting(-X, X, -Z, Z, p.WHITE))
    scene.place(column(), (0, 0, -0.3), 0)
    scene.place(Model("glass egg").add(p.GLASS, egg(0.16, 0.44, 40, 24)), (0, 0.921, -0.3))
    scene.place(
        decor.pendant(p.BRASS, p.WHITE, WARM, p.BLACK, 0.62, 0.2, 20),
        (-1.15, HEIGHT, -0.7),
        0,
        "warm lamp",
    )
    scene.place(
        decor.pendant(p.STEEL, p.WHITE, COOL, p.BLACK, 0.62, 0.2, 20),
        (1.2, HEIGHT, -0.9),
        0,
        "cool lamp",
    )
    scene.place(bench(), (1.72, 0, -1.75), -20)
    scene.place(decor.framed_picture(POSTER, p.DARK_WOOD, 0.8, 0.8), (-0.95, 1.5, -Z))
    scene.place(
        decor.framed_picture(p.LANDSCAPE, p.DARK_WOOD, 1.0, 0.72),
        (0.95, 1.5, -Z),
        0,
        "second picture",
    )
    scene.place(decor.vase(p.TERRACOTTA, 24), (-1.75, 0, -1.6), 0, "vase", 0, 1.6)
    scene.camera("front", (0.22, 1.5, 1.75), (-0.02, 1.14, -0.6), 56)
    scene.camera("egg", (0.5, 1.25, 0.75), (0, 1.08, -0.3), 36)
    return scene

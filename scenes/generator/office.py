"""An office in the evening: two lamps under the ceiling and a desk lamp over an open book. Shelves
full of books, blinds, chairs and plants: light finds its way only in small pieces."""

from . import books, decor, palette as p, pictures, seating, textures, workplace
from . import room as rooms
from .curved import ball
from .materials import light, matte, picture, textured
from .mesh import Model
from .scene import Scene
from .workplace import DESK_TOP

X, Z, HEIGHT = 3.2, 2.6, 2.75
CARPET = textured("carpet", textures.carpet((60, 78, 96), (112, 130, 142)), 0.7, 0.7)
FABRIC = textured("chair fabric", textures.weave((120, 36, 28), (196, 84, 60)), 0.05, 0.05)
VISITOR_FABRIC = textured(
    "visitor fabric", textures.weave((40, 76, 84), (92, 142, 148)), 0.05, 0.05
)
WARM_WALL = matte("ochre wall", 0.74, 0.5, 0.22)
GREEN_WALL = matte("sage wall", 0.36, 0.48, 0.34)
CORK = textured("cork", textures.carpet((150, 108, 68), (206, 164, 112), 12), 0.5, 0.5)
SLAT = matte("slat", 0.72, 0.68, 0.6)
EDITOR = picture("editor", pictures.screen(5))
NOTES = (
    p.LETTER,
    p.PAGES,
    matte("yellow note", 0.85, 0.7, 0.16),
    matte("rose note", 0.8, 0.36, 0.36),
)
CEILING_LIGHT = light("ceiling light", 21, 20, 17.5)
DESK_LIGHT = light("desk light", 190, 150, 96)

WINDOWS = (0.75, 3.1)  # left edges, from the left end of the west wall
WINDOW_WIDTH, WINDOW_HEIGHT, SILL = 1.35, 1.4, 0.95


def walls(scene):
    holes = [(a, SILL, a + WINDOW_WIDTH, SILL + WINDOW_HEIGHT) for a in WINDOWS]
    sides = {"north": p.PLASTER, "south": p.PLASTER, "west": WARM_WALL, "east": GREEN_WALL}
    scene.place(rooms.shell(-X, X, -Z, Z, HEIGHT, CARPET, p.CEILING, sides, {"west": holes}))
    scene.place(rooms.skirting(-X, X, -Z, Z, p.WHITE, {"north": [(5.08, 6.12)]}))
    window = rooms.window(WINDOW_WIDTH, WINDOW_HEIGHT, p.WHITE, p.EVENING)
    blind = rooms.blind(WINDOW_WIDTH - 0.06, WINDOW_HEIGHT - 0.09, SLAT, p.WHITE)
    for k, a in enumerate(WINDOWS):
        z = Z - a - WINDOW_WIDTH / 2
        scene.place(window, (-X, SILL, z), 90, f"window {k + 1}")
        scene.place(blind, (-X + 0.028, SILL + 0.03, z), 90, f"blind {k + 1}")
    scene.place(rooms.door(0.9, 2.05, p.OAK, p.WHITE, p.STEEL), (2.4, 0, -Z))
    lamp = rooms.ceiling_panel(1.5, 0.6, p.WHITE, CEILING_LIGHT)
    for k, z in enumerate((-0.95, 1.0)):
        scene.place(lamp, (0.15, HEIGHT, z), 0, f"ceiling lamp {k + 1}")


def shelves(scene):
    case, levels = workplace.shelf(p.OAK, p.WHITE, 0.95, 2.1, 6)
    rows = [books.row(0.9, 40 + k, 0.29, f"books {k + 1}") for k in range(5)]
    for k, x in enumerate((-2.05, -1.09, -0.13)):
        scene.place(case, (x, 0, -Z), 0, f"shelf {k + 1}")
        for j, y in enumerate(levels):
            if (k, j) not in ((1, 3), (2, 1), (0, 5)):
                row = rows[(2 * k + 3 * j) % 5]
                scene.place(row, (x - 0.45, y, -Z + 0.27), 0, f"shelf {k + 1} board {j + 1}")
    scene.place(decor.vase(p.TERRACOTTA), (-1.25, levels[3], -Z + 0.16), 0, "vase", 0, 0.72)
    pile = books.stack(((0.03, 0.26, 0.19), (0.04, 0.24, 0.17), (0.025, 0.23, 0.16)), 3)
    scene.place(pile, (-0.92, levels[3], -Z + 0.16), 80)
    scene.place(pile, (-0.3, levels[1], -Z + 0.16), 60, "second stack")
    scene.place(decor.bowl(p.TEAL), (0.1, levels[1], -Z + 0.16), 0, "bowl", 0, 0.9)
    scene.place(decor.bowl(p.CREAM), (-2.05, levels[5], -Z + 0.16))
    painting = decor.framed_picture(p.LANDSCAPE, p.DARK_WOOD, 0.9, 0.66)
    scene.place(painting, (1.13, 1.62, -Z))
    drawers = workplace.cabinet(p.WHITE, p.OAK, p.STEEL, 0.85, 0.82, drawers=3)
    scene.place(drawers, (1.13, 0, -Z))


def main_desk(scene):
    """In the middle: lamp, open book, glass ball. Its user looks south, towards the camera."""
    x, z = -0.15, -0.5
    desk = workplace.desk(p.WALNUT, p.BLACK, 1.7, 0.82, p.WALNUT)
    scene.place(desk, (x, 0, z), 180, "main desk")
    top = DESK_TOP + 0.0005
    lamp = workplace.desk_lamp(p.TEAL, DESK_LIGHT)
    scene.place(lamp, (x - 0.66, top, z + 0.05), 80, "desk lamp")
    scene.place(books.open_book(p.PAGES, p.TERRACOTTA), (x - 0.34, top, z + 0.08), -8)
    scene.place(
        Model("glass ball").add(p.GLASS, ball(0.062, 12)), (x - 0.04, top + 0.0625, z + 0.2)
    )
    scene.place(workplace.mug(p.WHITE, p.SOIL), (x + 0.14, top, z + 0.02), 120)
    scene.place(workplace.pens(p.TERRACOTTA, (p.TEAL, p.BLACK, p.CREAM)), (x - 0.02, top, z - 0.22))
    scene.place(workplace.monitor(p.BLACK, EDITOR), (x + 0.5, top, z + 0.06), 205, "monitor")
    keys = workplace.keyboard(p.GREY, p.BLACK)
    scene.place(keys, (x + 0.42, top, z - 0.24), 192, "keyboard")
    tall = books.stack(
        ((0.045, 0.25, 0.18), (0.03, 0.26, 0.19), (0.05, 0.23, 0.17), (0.02, 0.2, 0.14)), 9
    )
    scene.place(tall, (x - 0.02 + 0.72, top, z + 0.24), 20, "books on the desk")
    chair = seating.office_chair(FABRIC, p.STEEL, p.BLACK)
    scene.place(chair, (x - 0.1, 0, z - 0.82), 14, "main chair")
    return chair


def second_desk(scene, chair):
    """Under the windows; its user looks west."""
    desk = workplace.desk(p.OAK, p.BLACK, 1.5, 0.75, p.WHITE)
    x, z = -X + 0.42, 0.35
    scene.place(desk, (x, 0, z), 90, "second desk")
    top = DESK_TOP + 0.0005
    scene.place(workplace.monitor(p.BLACK, EDITOR), (x - 0.14, top, z - 0.1), 84, "second monitor")
    scene.place(
        workplace.keyboard(p.WHITE, p.GREY), (x + 0.18, top, z - 0.06), 90, "second keyboard"
    )
    scene.place(workplace.mouse(p.GREY), (x + 0.18, top, z - 0.4), 90)
    scene.place(workplace.mug(p.TEAL, p.SOIL), (x + 0.02, top, z + 0.42), 30, "second mug")
    scene.place(chair, (x + 0.72, 0, z + 0.1), -118, "second chair")
    board = workplace.pinboard(CORK, p.OAK, NOTES, 0.72, 0.95)
    scene.place(board, (-X, 1.62, 0), 90)


def loose_things(scene):
    green = decor.plant(p.TERRACOTTA, p.SOIL, p.LEAVES, p.STEM, 32, 1.15)
    scene.place(green, (-2.75, 0, -1.6), 30, "plant")
    small = decor.plant(p.WHITE, p.SOIL, p.LEAVES, p.STEM, 18, 0.7, 5)
    scene.place(small, (1.32, 0.821, -Z + 0.22), 0, "plant on the cabinet", 0, 0.5)
    scene.place(workplace.bin_(p.BLACK), (1.02, 0, -0.95))
    visitor = seating.upholstered_chair(VISITOR_FABRIC, p.DARK_WOOD, 2)
    scene.place(visitor, (-0.5, 0, 0.72), 168, "visitor's chair")
    scene.place(visitor, (0.55, 0, 0.66), 204, "second visitor's chair")


def build():
    scene = Scene("office")
    walls(scene)
    shelves(scene)
    chair = main_desk(scene)
    second_desk(scene, chair)
    loose_things(scene)
    scene.camera("from the corner", (2.05, 1.66, 2.3), (-0.62, 0.86, -0.75), 54)
    scene.camera("desk", (0.2, 1.25, 0.75), (-0.4, 0.8, -0.55), 42)
    return scene

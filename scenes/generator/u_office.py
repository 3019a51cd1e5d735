"""Two offices and the narrow corridor that joins them, in the shape of a U, after Segovia and
others (2006). The only lamp is in the far room, the camera in the dark one: nearly all light that
it sees came through two doors. Standard instant radiosity hardly finds it."""

from . import books, decor, palette as p, seating, textures, workplace
from . import room as rooms
from .curved import ball
from .materials import light, matte, textured
from .mesh import Model
from .scene import Scene
from .workplace import DESK_TOP

INNER, OUTER, Z, HEIGHT = 0.12, 4.3, 2.2, 2.6  # each room: |x| from INNER to OUTER, z from -Z to Z
CORRIDOR = (-3.4, -2.38)  # z
DOOR = (0.95, 2.05)  # width, height
DOOR_X = 1.25  # |x| of the middle of both doors
CARPET = textured("carpet", textures.carpet((96, 84, 72), (150, 136, 118), 18), 0.7, 0.7)
FABRIC = textured("chair fabric", textures.weave((30, 60, 110), (76, 120, 172)), 0.05, 0.05)
CORAL = matte("coral wall", 0.7, 0.3, 0.2)
MINT = matte("mint wall", 0.42, 0.66, 0.5)
LAMP = light("ceiling light", 2400, 2280, 2050)


def shells(scene):
    low, high = DOOR_X - DOOR[0] / 2, DOOR_X + DOOR[0] / 2
    plain = {"north": p.PLASTER, "south": p.PLASTER, "west": p.PLASTER, "east": p.PLASTER}

    def hole(left_end, centre):
        a = abs(centre - left_end) - DOOR[0] / 2
        return (a, 0, a + DOOR[0], DOOR[1])

    dark = {"north": [hole(-OUTER, -DOOR_X)]}
    bright = {"north": [hole(INNER, DOOR_X)]}
    passage = {"south": [hole(OUTER, DOOR_X), hole(OUTER, -DOOR_X)]}
    scene.place(
        rooms.shell(
            -OUTER,
            -INNER,
            -Z,
            Z,
            HEIGHT,
            CARPET,
            p.CEILING,
            {**plain, "west": CORAL},
            dark,
            "dark room",
        )
    )
    scene.place(
        rooms.shell(
            INNER,
            OUTER,
            -Z,
            Z,
            HEIGHT,
            CARPET,
            p.CEILING,
            {**plain, "east": MINT},
            bright,
            "bright room",
        )
    )
    scene.place(
        rooms.shell(-OUTER, OUTER, *CORRIDOR, HEIGHT, CARPET, p.CEILING, plain, passage, "corridor")
    )
    frame = rooms.doorway(*DOOR, -Z - CORRIDOR[1], CARPET, p.WHITE)
    scene.place(frame, (-DOOR_X, 0, -Z), 0, "dark room's doorway")
    scene.place(frame, (DOOR_X, 0, -Z), 0, "bright room's doorway")
    gap = [(low - INNER - 0.06, high - INNER + 0.06)]
    mirrored = [(OUTER - high - 0.06, OUTER - low + 0.06)]
    scene.place(rooms.skirting(-OUTER, -INNER, -Z, Z, p.WHITE, {"north": mirrored}))
    scene.place(
        rooms.skirting(INNER, OUTER, -Z, Z, p.WHITE, {"north": gap}), name="second skirting"
    )
    both = [(OUTER - high - 0.06, OUTER - low + 0.06), (OUTER + low - 0.06, OUTER + high + 0.06)]
    scene.place(
        rooms.skirting(-OUTER, OUTER, *CORRIDOR, p.WHITE, {"south": both}), name="third skirting"
    )


def dark_room(scene, chair, shelf, rows):
    scene.place(
        workplace.desk(p.OAK, p.BLACK, 1.5, 0.75, p.OAK), (-2.95, 0, -0.75), 180, "dark desk"
    )
    top = DESK_TOP + 0.0005
    scene.place(books.open_book(p.PAGES, p.TERRACOTTA), (-3.05, top, -0.7), 8)
    scene.place(workplace.mug(p.WHITE, p.SOIL), (-2.65, top, -0.6), 200)
    scene.place(Model("glass ball").add(p.GLASS, ball(0.06, 9)), (-2.4, top + 0.0605, -0.75))
    pile = books.stack(((0.045, 0.25, 0.18), (0.03, 0.26, 0.19), (0.05, 0.23, 0.17)), 9)
    scene.place(pile, (-3.45, top, -0.8), 10)
    scene.place(chair, (-2.9, 0, -1.45), -12, "dark room's chair")
    visitor = seating.wooden_chair(p.OAK, p.DARK_WOOD)
    scene.place(visitor, (-2.35, 0, 0.1), 195)
    case, levels = shelf
    scene.place(case, (-3.6, 0, -Z), 0, "dark room's shelf")
    for j, y in enumerate(levels):
        scene.place(rows[j % len(rows)], (-4.05, y, -Z + 0.27), 0, f"books {j + 1}")
    green = decor.plant(p.TERRACOTTA, p.SOIL, p.LEAVES, p.STEM, 30, 1.0)
    scene.place(green, (-0.5, 0, -1.1), 40)
    scene.place(decor.framed_picture(p.ABSTRACT, p.DARK_WOOD, 0.7, 0.7), (-INNER, 1.55, -0.4), -90)
    scene.place(
        decor.framed_picture(p.LANDSCAPE, p.DARK_WOOD, 0.8, 0.6),
        (-OUTER, 1.5, -0.6),
        90,
        "second picture",
    )


def bright_room(scene, chair, shelf, rows):
    scene.place(workplace.desk(p.OAK, p.BLACK, 1.5, 0.75, p.OAK), (3.0, 0, 0.4), 180, "bright desk")
    scene.place(chair, (3.0, 0, -0.35), 10, "bright room's chair")
    case, levels = shelf
    scene.place(case, (3.4, 0, Z), 180, "bright room's shelf")
    for j, y in enumerate(levels[:4]):
        scene.place(rows[(j + 1) % len(rows)], (3.85, y, Z - 0.27), 180, f"more books {j + 1}")
    lamp = rooms.ceiling_panel(1.5, 0.6, p.WHITE, LAMP)
    scene.place(lamp, (1.7, HEIGHT, -1.2), 0, "ceiling lamp")


def build():
    scene = Scene("u_office")
    shells(scene)
    chair = seating.office_chair(FABRIC, p.STEEL, p.BLACK)
    shelf = workplace.shelf(p.OAK, p.WHITE, 0.95, 1.9, 5)
    rows = [books.row(0.9, 60 + k, 0.29, f"row of books {k + 1}") for k in range(3)]
    dark_room(scene, chair, shelf, rows)
    bright_room(scene, chair, shelf, rows)
    scene.camera("from the dark", (-3.3, 1.65, 2.0), (-1.85, 0.95, -1.4), 56)
    scene.camera("the bright room", (0.5, 1.65, -1.95), (3.0, 0.9, 0.9), 60)
    return scene

"""A conference room: 84 lamps in the ceiling and 20 on the walls, a long table with 22 padded
chairs, panelled walls. Few different things, stored once and placed often."""

from . import decor, palette as p, pictures, seating, textures, vectors as vec
from . import room as rooms
from .curved import disc, lathe, rounded_box, table_top, tube
from .materials import light, matte, picture, textured
from .mesh import Model
from .scene import Scene
from .shapes import box, rectangle, slab

X, Z, HEIGHT = 6.5, 4.0, 3.2
TABLE = (8.0, 1.9, 0.74)  # length along x, width, height
CARPET = textured("carpet", textures.carpet((126, 116, 110), (176, 164, 152), 15), 0.8, 0.8)
LEATHER = matte("leather", 0.34, 0.075, 0.05)
PANEL = matte("cloth panel", 0.26, 0.44, 0.52)
END_PANEL = matte("warm cloth panel", 0.66, 0.38, 0.14)
SLIDE = picture("slide", pictures.landscape(23, 256, 160))
DOWNLIGHT = light("ceiling light", 80, 73, 62)
SCONCE_LIGHT = light("wall light", 60, 46, 30)

WAINSCOT = 0.95


def downlight():
    """A shallow can under the ceiling (y = 0) with a shining disc 12 mm above its mouth."""
    model = Model("ceiling light")
    profile = [(0.075, -0.028), (0.078, -0.04), (0.1, -0.042), (0.112, -0.03), (0.115, 0.002)]
    model.add(p.STEEL, lathe(profile, 24))
    return model.add(DOWNLIGHT, disc(0.0755, -0.028, 24, up=False))


def sconce():
    """A half cylinder on a wall at z = 0; the light inside looks up."""
    model = Model("wall light").add(p.BRASS, box((-0.05, -0.12, -0.005), (0.05, 0.12, 0.02)))
    inside = [(0, -0.095), (0.068, -0.095), (0.09, 0.14)]
    outside = [(0, -0.11), (0.072, -0.11), (0.095, 0.14)]
    bowl = vec.move(0, 0, 0.11)
    model.add(p.CREAM, lathe([*outside, *inside[::-1]], 28).moved(bowl))
    model.add(SCONCE_LIGHT, disc(0.07, 0.06, 20).moved(bowl))
    return model


def panel(width, cloth):
    """Stands at a wall at z = 0: walnut below, a frame with cloth above, mouldings between."""
    w = width / 2 - 0.01
    top = HEIGHT - 0.3
    model = Model("wall panel").add(p.WALNUT, box((-w, -0.002, -0.01), (w, WAINSCOT, 0.03)))
    model.add(p.WALNUT, rounded_box((2 * w - 0.3, 0.6, 0.04), 0.015, 2, (0, 0.2, 0.028)))
    model.add(p.WALNUT, rounded_box((2 * w, 0.05, 0.07), 0.02, 1, (0, WAINSCOT - 0.012, 0.02)))
    middle = (WAINSCOT + top) / 2
    model.add(
        cloth,
        rounded_box(
            (2 * w - 0.2, top - WAINSCOT - 0.24, 0.06), 0.02, 2, (0, WAINSCOT + 0.12, 0.01)
        ),
    )
    for y in (WAINSCOT + 0.06, top - 0.09):
        model.add(p.WALNUT, rounded_box((2 * w - 0.06, 0.04, 0.05), 0.012, 1, (0, y, 0.01)))
    for x in (-w + 0.06, w - 0.06):
        bar = rounded_box((0.04, top - WAINSCOT - 0.16, 0.046), 0.012, 1, (x, 0, 0.01))
        model.add(p.WALNUT, bar.moved(vec.move(0, middle - (top - WAINSCOT - 0.16) / 2)))
    return model


def table():
    length, width, height = TABLE
    model = Model("conference table")
    model.add(p.OAK, table_top(length, width, 0.05, 160, 3.2, 4, height - 0.05))
    model.add(p.BLACK, table_top(length - 1.2, 0.32, 0.006, 96, 4, 1, height - 0.002))
    for x in (-length / 2 + 1.3, 0, length / 2 - 1.3):
        model.add(p.WALNUT, rounded_box((0.5, height - 0.1, 0.7), 0.04, 3, (x, 0.03, 0)))
        model.add(p.STEEL, rounded_box((0.7, 0.04, 1.1), 0.015, 2, (x, -0.002, 0)))
    return model


def tumbler():
    outer = [(0, 0.0005), (0.026, 0.0005), (0.029, 0.003), (0.032, 0.05), (0.0345, 0.11)]
    inner = [(0.0325, 0.11), (0.03, 0.05), (0.0265, 0.012), (0, 0.011)]
    return Model("tumbler").add(p.GLASS, lathe(outer + inner, 40))


def notepad():
    model = Model("notepad").add(p.BLACK, slab((0.22, 0.006, 0.31), (0, 0.0005, 0), ("-y",)))
    page = rectangle((-0.105, 0.0075, 0.15), (0.21, 0, 0), (0, 0, -0.3), fit=True)
    model.add(p.LETTER, page)
    pen = tube([(0.13, 0.005, 0.08), (0.15, 0.005, -0.06)], 0.0045, 10)
    return model.add(p.BRASS, pen)


def microphone():
    model = Model("microphone").add(
        p.BLACK, rounded_box((0.09, 0.02, 0.12), 0.008, 2, (0, 0.0005, 0))
    )
    neck = seating.smooth([(0, 0.018, -0.03), (0, 0.14, -0.02), (0, 0.24, 0.05), (0, 0.26, 0.1)], 6)
    model.add(p.STEEL, tube(neck, 0.004, 10))
    return model.add(p.BLACK, tube([neck[-1], vec.add(neck[-1], (0, 0.008, 0.04))], 0.009, 14))


def seats(scene):
    """(x, z, turn) of each of the 22 seats."""
    length, width, _ = TABLE
    result = []
    for k in range(10):
        x = (k - 4.5) * 0.7
        inset = 0.13 * abs(x / (length / 2)) ** 3.2
        result.append((x, -(width / 2 - inset) - 0.28, 0))
        result.append((x, width / 2 - inset + 0.28, 180))
    result += [(-length / 2 - 0.3, 0, 90), (length / 2 + 0.3, 0, -90)]
    return result


def furnish_table(scene):
    chair = seating.office_chair(LEATHER, p.STEEL, p.BLACK, 2, "conference chair")
    pad, glass, mic = notepad(), tumbler(), microphone()
    scene.place(table())
    for k, (x, z, turn) in enumerate(seats(scene)):
        wobble = (17 * k % 11 - 5) * 2.2
        scene.place(chair, (x, 0, z), turn + wobble, f"chair {k + 1}")

        def ahead(distance, side):
            m = vec.chain(vec.move(x, TABLE[2], z), vec.turn("y", turn))
            return vec.on_point(m, (side, 0, distance))

        scene.place(pad, ahead(0.62, 0.02), turn + 180, f"notepad {k + 1}")
        scene.place(glass, ahead(0.8, 0.22), 0, f"tumbler {k + 1}")
        if k % 2 == k // 2 % 2:
            scene.place(mic, ahead(0.92, 0.0), turn + 180, f"microphone {k + 1}")
    scene.place(decor.bowl(p.TERRACOTTA, 48), (0, TABLE[2] + 0.005, 0), 0, "bowl", 0, 1.3)


def walls(scene):
    sides = {"north": p.PLASTER, "south": p.PLASTER, "west": p.CREAM, "east": p.CREAM}
    scene.place(rooms.shell(-X, X, -Z, Z, HEIGHT, CARPET, p.CEILING, sides))
    wide, end = panel(13 / 8, PANEL), panel(8 / 5, END_PANEL)
    lamp = sconce()
    for k in range(8):
        x = -X + 13 / 8 * (k + 0.5)
        scene.place(wide, (x, 0, -Z), 0, f"north panel {k + 1}")
        scene.place(wide, (x, 0, Z), 180, f"south panel {k + 1}")
        if k < 7:
            scene.place(lamp, (x + 13 / 16, 2.0, -Z), 0, f"north wall light {k + 1}")
            scene.place(lamp, (x + 13 / 16, 2.0, Z), 180, f"south wall light {k + 1}")
    for k in range(5):
        z = -Z + 8 / 5 * (k + 0.5)
        scene.place(end, (-X, 0, z), 90, f"west panel {k + 1}")
        scene.place(end, (X, 0, z), -90, f"east panel {k + 1}")
    for k, z in enumerate((-2.4, -0.8, 0.8, 2.4)):
        scene.place(lamp, (X, 2.0, z), -90, f"east wall light {k + 1}")
    for k, z in enumerate((-2.4, 2.4)):
        scene.place(lamp, (-X, 2.0, z), 90, f"west wall light {k + 1}")


def screen():
    """A framed slide on the west wall."""
    return decor.framed_picture(SLIDE, p.BLACK, 2.72, 1.7)


def build():
    scene = Scene("conference")
    walls(scene)
    furnish_table(scene)
    ceiling_light = downlight()
    for j in range(7):
        for i in range(12):
            at = (-X + 13 / 12 * (i + 0.5), HEIGHT, -Z + 8 / 7 * (j + 0.5))
            scene.place(ceiling_light, at, 0, f"ceiling light {j * 12 + i + 1}")
    scene.place(screen(), (-X + 0.075, 1.95, 0), 90, "slide")
    plant = decor.plant(p.WHITE, p.SOIL, p.LEAVES, p.STEM, 44, 1.35, 8)
    for k, (x, z) in enumerate(((-X + 0.7, -Z + 0.7), (-X + 0.7, Z - 0.7), (X - 0.7, -Z + 0.7))):
        scene.place(plant, (x, 0, z), 77 * k, f"plant {k + 1}")
    scene.camera("from the end", (5.7, 1.85, 2.7), (-0.6, 0.95, -0.7), 52)
    scene.camera("table", (3.1, 1.2, 1.6), (-0.3, 0.8, -0.2), 45)
    return scene

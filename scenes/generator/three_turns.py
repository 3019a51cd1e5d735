"""A room behind a passage with three turns, after Segovia and others (2006), Figure 6a. Light makes
three bounces or more before it comes into the room. From above, lamp L, camera C:

    +---------+------------+
    | C       | L     |    |    Gaps on the right begin at x = GAPS[1], those on the left end at
    |         +--------    |    x = GAPS[0] < GAPS[1]. The lamp is left of its gap, so that straight
    |         |    --------+    lines through that gap go to the right, then, from what they meet,
    |         +--------    |    through the next one to the left, and so on: one bounce for each of
    |         -            |    the first three gaps, before the door.
    +---------+------------+
"""

from . import decor, palette as p, seating, workplace
from . import room as rooms
from .curved import ball
from .materials import light, matte
from .mesh import Mesh, Model
from .scene import Scene
from .shapes import box, rectangle
from .workplace import DESK_TOP

WIDTH, DEPTH, HEIGHT = 8.2, 6.0, 2.6
ROOM = (4.5, 4.62)  # x of the wall between room and passage
GAPS = (6.02, 6.8)
TURNS = ((1.4, 1.5), (2.9, 3.0), (4.4, 4.5))  # z of the walls in the passage
DOOR = (4.7, 5.8, 2.1)  # z from, to, height
EDGE = 0.01  # what stands in a wall reaches so far into it
WALL = p.PLASTER
FLOOR = matte("cork floor", 0.5, 0.38, 0.26)
CEILING = matte("white ceiling", 0.82, 0.82, 0.8)
WOOD = matte("light wood", 0.55, 0.4, 0.24)
CORAL = matte("coral wall", 0.7, 0.3, 0.2)
BLUE = matte("blue cushion", 0.1, 0.25, 0.5)
LAMP = light("ceiling light", 120000, 114000, 102000)


def shell():
    model = Model("house")
    model.add(FLOOR, rectangle((0, 0, DEPTH), (WIDTH, 0, 0), (0, 0, -DEPTH)))
    model.add(CEILING, rectangle((0, HEIGHT, 0), (WIDTH, 0, 0), (0, 0, DEPTH)))
    for side in rooms.SIDES:
        corner, right = rooms.wall_frame(side, 0, WIDTH, 0, DEPTH)
        material = CORAL if side == "west" else WALL
        model.add(material, rectangle(corner, right, (0, HEIGHT, 0)))
    return model


def partitions():
    top, low = HEIGHT + EDGE, -EDGE
    mesh = Mesh()
    for z0, z1 in ((-EDGE, DOOR[0]), (DOOR[1], DEPTH + EDGE)):
        mesh.join(box((ROOM[0], low, z0), (ROOM[1], top, z1)))
    over = box((ROOM[0] + 0.002, DOOR[2], DOOR[0] - EDGE), (ROOM[1] - 0.002, top, DOOR[1] + EDGE))
    mesh.join(over)
    for (z0, z1), to_the_right in zip(TURNS, (False, True, False)):
        x0, x1 = (GAPS[0], WIDTH + EDGE) if to_the_right else (ROOM[1] - EDGE, GAPS[1])
        mesh.join(box((x0, low, z0), (x1, top, z1)))
    return Model("inner walls").add(WALL, mesh)


def furniture(scene):
    scene.place(workplace.desk(WOOD, p.BLACK, 1.5, 0.75, WOOD), (2.3, 0, 2.9), 200, "desk")
    top = DESK_TOP + 0.0005
    scene.place(workplace.mug(p.WHITE, p.SOIL), (2.1, top, 2.9), 200)
    scene.place(Model("glass ball").add(p.GLASS, ball(0.07, 9)), (2.5, top + 0.0705, 3.0))
    scene.place(seating.wooden_chair(WOOD, BLUE), (2.4, 0, 2.1), -15, "chair")
    scene.place(seating.wooden_chair(WOOD, BLUE), (0.7, 0, 4.6), 120, "second chair")
    green = decor.plant(p.TERRACOTTA, p.SOIL, p.LEAVES, p.STEM, 12, 1.1)
    scene.place(green, (4.0, 0, 1.2), 40)


def build():
    scene = Scene("three_turns")
    scene.place(shell())
    scene.place(partitions())
    furniture(scene)
    scene.place(rooms.ceiling_panel(0.7, 0.6, p.WHITE, LAMP), (5.2, HEIGHT, 0.7), 0, "ceiling lamp")
    scene.camera("from the dark", (0.7, 1.6, 0.5), (2.9, 0.95, 4.2), 58)
    scene.camera("the passage", (7.6, 1.6, 5.5), (6.8, 1.2, 3.2), 70)
    return scene

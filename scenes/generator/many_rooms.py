"""Forty rooms side by side, a lamp in each. The camera is in one of them, and a door leads to one
neighbour: most lamps bring nothing to the picture, and nothing tells which but to look."""

from .materials import light, matte
from .mesh import Model
from .scene import Scene
from .shapes import box, rectangle, wall

COLUMNS, ROWS = 8, 5
WIDTH, DEPTH, HEIGHT = 3.2, 2.8, 2.5  # of a room
GAP = 0.2  # between rooms
DOOR = (0.9, 0, 1.8, 2.05)  # in the walls to the east and to the west
WHITE = matte("white", 0.75, 0.74, 0.7)
FLOOR = matte("floor", 0.45, 0.35, 0.28)
GREEN = matte("green", 0.2, 0.4, 0.25)
LAMP = light("lamp", 60, 56.5, 49.5)


def room(doors):
    """`doors`: "east" or "west". A passage through the wall belongs to the room west of it."""
    w, d, h = WIDTH / 2, DEPTH / 2, HEIGHT
    model = Model("room, door to the " + doors[0])
    shell = box((-w, 0, -d), (w, h, d), ("-x", "+x", "-y"), inward=True)
    shell.join(wall((w, 0, -d), (0, 0, DEPTH), (0, h, 0), [DOOR] if "east" in doors else ()))
    # The door of the wall to the west, seen from the other side.
    mirrored = (DEPTH - DOOR[2], DOOR[1], DEPTH - DOOR[0], DOOR[3])
    shell.join(wall((-w, 0, d), (0, 0, -DEPTH), (0, h, 0), [mirrored] if "west" in doors else ()))
    model.add(WHITE, shell)
    model.add(FLOOR, rectangle((-w, 0, d), (WIDTH, 0, 0), (0, 0, -DEPTH)))
    if "east" in doors:
        low, high = (w, 0, -d + DOOR[0]), (w + GAP, DOOR[3], -d + DOOR[2])
        model.add(WHITE, box(low, high, ("-x", "+x"), inward=True))
    return model


def table():
    mesh = box((-0.6, 0.7, -0.35), (0.6, 0.74, 0.35))
    for x in (-0.55, 0.49):
        for z in (-0.3, 0.24):
            mesh.join(box((x, -0.01, z), (x + 0.06, 0.71, z + 0.06)))
    return Model("table").add(GREEN, mesh)


def build():
    scene = Scene("many_rooms")
    rooms = {doors: room(doors) for doors in (("east",), ("west",))}
    lamp = Model("lamp").add(LAMP, rectangle((-0.3, 0, -0.15), (0.6, 0, 0), (0, 0, 0.3)))
    furniture = table()
    for row in range(ROWS):
        for column in range(COLUMNS):
            doors = ("west",) if column % 2 else ("east",)
            at = (column * (WIDTH + GAP), 0, row * (DEPTH + GAP))
            number = f"{row}-{column}"
            scene.place(rooms[doors], at, name="room " + number)
            scene.place(lamp, (at[0] + 0.4, HEIGHT - 0.01, at[2]), name="lamp " + number)
            scene.place(furniture, (at[0] - 0.3, 0, at[2] - 0.2), turn=15 * (row + column), name="table " + number)
    x, z = 3 * (WIDTH + GAP), 2 * (DEPTH + GAP)
    scene.camera("one of forty", (x + 1.4, 1.55, z + 1.2), (x - 1.2, 0.8, z - 0.7), 60)
    scene.camera("towards the door", (x + 1.3, 1.5, z + 0.6), (x - 1.6, 1.0, z - 0.1), 55)
    return scene

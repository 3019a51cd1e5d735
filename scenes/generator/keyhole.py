"""Two bare rooms and a hole of 16 cm in the wall between. The lamp is in one, the camera in the
other: all light comes through the hole. Light paths find it by luck."""

from .materials import light, matte
from .mesh import Mesh, Model
from .scene import Scene
from .shapes import box, rectangle

WHITE = matte("white", 0.75, 0.75, 0.75)
RED = matte("red", 0.63, 0.065, 0.05)
LAMP = light("lamp", 2400, 2280, 2040)
HALF = 0.08  # of the hole [m]
EDGE = 0.01  # what stands in a wall reaches so far into it; also half of the wall between


def wall_with_a_hole():
    low, high, end = 1 - HALF, 1 + HALF, 1 + EDGE
    mesh = Mesh()
    for y0, y1, z0, z1 in (
        (-EDGE, low, -end, end),
        (high, 2 + EDGE, -end, end),
        (low, high, -end, -HALF),
        (low, high, HALF, end),
    ):
        mesh.join(box((-EDGE, y0, z0), (EDGE, y1, z1)))
    return Model("wall with a hole").add(WHITE, mesh)


def build():
    scene = Scene("keyhole")
    shell = Model("rooms").add(WHITE, box((-2, 0, -1), (2, 2, 1), ("-x",), inward=True))
    shell.add(RED, rectangle((-2, 0, 1), (0, 0, -2), (0, 2, 0)))
    scene.place(shell)
    scene.place(wall_with_a_hole())
    panel = rectangle((1.2, 1.99, -0.3), (0.6, 0, 0), (0, 0, 0.6))
    scene.place(Model("lamp").add(LAMP, panel))
    block = box((-1.5, -EDGE, -0.6), (-1.0, 0.7, -0.1))
    scene.place(Model("block").add(WHITE, block), turn=0)
    scene.camera("from the dark", (-0.1, 1.3, 0.9), (-1.5, 0.7, -0.6), 62)
    scene.camera("the bright room", (0.15, 1.6, 0.85), (1.4, 0.5, -0.4), 62)
    return scene

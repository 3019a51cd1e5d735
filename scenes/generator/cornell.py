"""The Cornell box, as Cornell University's Program of Computer Graphics measured it, in metres.

Its numbers are in millimetres with x to the left of the picture. The opening is where it was, in
front; the lamp lies flush in its hole in the ceiling, so it lights everything but the ceiling.
"""

from . import vectors as vec
from .materials import light, matte
from .mesh import Mesh, Model
from .scene import Scene

WHITE = matte("white", 0.725, 0.71, 0.68)
RED = matte("red", 0.63, 0.065, 0.05)
GREEN = matte("green", 0.14, 0.45, 0.091)
LAMP = light("lamp", 34, 24, 8)

SHORT_BLOCK = ((130, 65), (82, 225), (240, 272), (290, 114)), 165
TALL_BLOCK = ((423, 247), (265, 296), (314, 456), (472, 406)), 330


def polygon(*corners):
    """Corners in millimetres, counter-clockwise seen from the front."""
    corners = [vec.mul(c, 0.001) for c in corners]
    normal = vec.unit(vec.cross(vec.sub(corners[1], corners[0]), vec.sub(corners[-1], corners[0])))
    return Mesh().fan([(c, normal, (0, 0)) for c in corners])


def block(ground, height):
    """Without a bottom: it would lie in the floor."""
    mesh = polygon(*((x, height, z) for x, z in ground))
    for (x0, z0), (x1, z1) in zip(ground, ground[1:] + ground[:1]):
        mesh.join(polygon((x0, 0, z0), (x1, 0, z1), (x1, height, z1), (x0, height, z0)))
    return mesh


def ceiling():
    """Nine fields without the middle one."""
    xs, zs = (0, 213, 343, 556), (0, 227, 332, 559.2)
    mesh = Mesh()
    for x0, x1 in zip(xs, xs[1:]):
        for z0, z1 in zip(zs, zs[1:]):
            if (x0, z0) != (213, 227):
                mesh.join(lying(x0, z0, x1, z1))
    return mesh


def lying(x0, z0, x1, z1):
    """Looks down from the height of the ceiling."""
    y = 548.8
    return polygon((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))


def build():
    scene = Scene("cornell")
    floor = polygon((552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))
    back = polygon((0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2), (549.6, 0, 559.2))
    right = polygon((0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2), (0, 0, 559.2))
    left = polygon((552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0))
    room = Model("box").add(WHITE, floor, ceiling(), back).add(GREEN, right).add(RED, left)
    scene.place(room)
    scene.place(Model("short block").add(WHITE, block(*SHORT_BLOCK)))
    scene.place(Model("tall block").add(WHITE, block(*TALL_BLOCK)))
    scene.place(Model("lamp").add(LAMP, lying(213, 227, 343, 332)))
    scene.camera("classic", (0.278, 0.273, -0.8), (0.278, 0.273, 0), 39.3)
    scene.camera("inside", (0.278, 0.3, 0.02), (0.278, 0.24, 0.4), 75)
    return scene

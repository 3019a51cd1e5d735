"""A bare wall, washed by one goniometric lamp and marked by another: the shapes on it are the lamps' tables
alone. A bench in front of it takes their light from above."""

from . import photometry
from .materials import matte
from .mesh import Model
from .scene import Scene
from .shapes import box, rectangle

WIDTH, DEPTH, HEIGHT = 3.6, 3.0, 2.6
EDGE = 0.01  # the bench reaches so far into the floor
PLASTER = matte("plaster", 0.75, 0.73, 0.69)
FLOOR = matte("clay floor", 0.45, 0.3, 0.2)
BENCH = matte("painted bench", 0.2, 0.35, 0.4)


def bench():
    mesh = box((-0.7, 0.38, -0.2), (0.7, 0.44, 0.2))
    for x in (-0.62, 0.54):
        mesh.join(box((x, -EDGE, -0.17), (x + 0.08, 0.39, 0.17)))
    return Model("bench").add(BENCH, mesh)


def build():
    scene = Scene("wall_washers")
    shell = Model("room").add(PLASTER, box((-WIDTH / 2, 0, -DEPTH), (WIDTH / 2, HEIGHT, 0), ("-y",), inward=True))
    shell.add(FLOOR, rectangle((-WIDTH / 2, 0, 0), (WIDTH, 0, 0), (0, 0, -DEPTH)))
    scene.place(shell)
    scene.place(bench(), at=(0.35, 0, -1.7), turn=8)
    scene.lamp("washer", photometry.wall_washer(), (-0.75, 2.52, -DEPTH + 0.75))
    scene.lamp("scallop", photometry.scallop(), (0.95, 2.52, -DEPTH + 0.3), colour=(1, 0.82, 0.6))
    scene.exposure = -8
    scene.camera("the wall", (0.1, 1.25, -0.15), (0, 1.05, -DEPTH), 50)
    scene.camera("along the wall", (1.6, 1.5, -1.2), (-0.9, 0.9, -DEPTH), 55)
    return scene

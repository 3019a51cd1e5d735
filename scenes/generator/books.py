"""Books: rows for shelves, stacks, and an open one. All covers share one atlas of spines."""

import functools
import math
import random

from . import vectors as vec
from .materials import Material, Texture, matte
from .mesh import Mesh, Model
from .shapes import box, rectangle

COVERS = 16
_INK = (226, 200, 132)
_COLOURS = [
    (132, 32, 34),
    (24, 52, 96),
    (34, 84, 62),
    (196, 148, 50),
    (222, 212, 188),
    (84, 84, 90),
    (20, 104, 112),
    (104, 62, 36),
    (158, 70, 40),
    (60, 40, 84),
    (176, 186, 190),
    (40, 44, 52),
    (204, 96, 60),
    (92, 128, 78),
    (70, 112, 160),
    (150, 120, 90),
]


def _paint_spines():
    """Sixteen columns of 16 pixels, 128 high: title, bands, and plain cover in the last 16 rows."""
    palette = [tuple(round(c * f) for c in colour) for colour in _COLOURS for f in (1, 0.72)] + [
        _INK,
        (30, 26, 24),
    ]
    rnd = random.Random(5)
    indices = bytearray(256 * 128)
    for k in range(COVERS):
        ink = 32 if sum(_COLOURS[k]) < 420 else 33
        top, tall = rnd.randrange(14, 30), rnd.randrange(26, 54)
        bands = rnd.choice(((6, 8), (4, 92), (8, 10, 88, 90), (94, 96)))
        for y in range(128):
            for i in range(16):
                texel = 2 * k + (1 if i in (0, 15) else 0)
                if y < 112 and y in bands:
                    texel = ink
                elif top <= y < top + tall and 5 <= i < 11 and (y * 7 // 3 + i * 5 + k) % 4:
                    texel = ink
                indices[y * 256 + k * 16 + i] = texel
    return 256, 128, palette, bytes(indices)


SPINES = Material("book covers", texture=Texture("book covers", functools.lru_cache(_paint_spines)))
PAPER = matte("paper", 0.74, 0.7, 0.6)


def _book(model, thickness, height, depth, cover, place):
    """Stands on y = 0 between x = 0 and its thickness; the spine looks towards +z at z = 0."""
    plain = ((cover + 0.5) / COVERS, 0.94)
    board = 0.0022
    covers = box((0, 0, -depth), (board, height, 0), skip=("+z",))
    covers.join(
        box((thickness - board, 0, -depth), (thickness, height, 0), skip=("+z",)),
        rectangle((thickness - board, 0, -board), (2 * board - thickness, 0, 0), (0, height, 0)),
    )
    covers.vertices = [(p, n, plain) for p, n, _ in covers.vertices]
    spine = rectangle((0, 0, 0), (thickness, 0, 0), (0, height, 0), fit=True)
    spine.vertices = [
        (p, n, ((cover + 0.03 + 0.94 * u) / COVERS, v * 0.86)) for p, n, (u, v) in spine.vertices
    ]
    pages = box(
        (board, 0.004, 0.004 - depth),
        (thickness - board, height - 0.004, -board),
        ("-x", "+x", "+z"),
    )
    model.add(SPINES, covers.moved(place), spine.moved(place)).add(PAPER, pages.moved(place))


def row(width, seed, tallest=0.3, name="books"):
    """Fills a shelf board from x = 0; a gap or a leaning book here and there."""
    model, rnd, x = Model(name), random.Random(seed), 0.004
    while True:
        thickness = rnd.uniform(0.018, 0.052)
        height = tallest * rnd.uniform(0.66, 0.98)
        depth = rnd.uniform(0.15, 0.22)
        cover, fate = rnd.randrange(COVERS), rnd.random()
        lean = 0
        if fate < 0.06:
            lean = -9
            x += 0.004 + height * math.sin(math.radians(9))
        if x + thickness > width:
            return model
        place = vec.chain(
            vec.move(x, 0.001 + (thickness * 0.16 if lean else 0), rnd.uniform(-0.02, 0)),
            vec.turn("z", -lean),
        )
        _book(model, thickness, height, depth, cover, place)
        x += thickness + 0.0015 + (0.09 if fate > 0.965 else 0)


def stack(sizes, seed, name="stack of books"):
    """Lying books, each turned a little; sizes are (thickness, height, depth)."""
    model, rnd, y = Model(name), random.Random(seed), 0.0005
    for thickness, height, depth in sizes:
        place = vec.chain(
            vec.move(0, y, 0),
            vec.turn("y", rnd.uniform(-14, 14)),
            vec.turn("z", -90),
            vec.move(-thickness, -height / 2, depth / 2),
        )
        _book(model, thickness, height, depth, rnd.randrange(COVERS), place)
        y += thickness + 0.0005
    return model


def open_book(page, cover, width=0.36, depth=0.25):
    """Lies on y = 0. Each half is a bulging stack of pages with one printed page on top."""
    model = Model("open book")
    model.add(
        cover,
        box(
            (-width / 2 - 0.005, 0.0005, -depth / 2 - 0.004),
            (width / 2 + 0.005, 0.004, depth / 2 + 0.004),
            skip=("-y",),
        ),
    )
    steps = 10

    def outline(s):
        return 0.006 + 0.03 * (1 - s) ** 0.6 * s**0.35 + 0.006 * (1 - s)

    for side in (-1, 1):
        top = [(side * width / 2 * k / steps, outline(k / steps)) for k in range(steps + 1)]
        slopes = []
        for k in range(steps + 1):
            a, b = top[max(0, k - 1)], top[min(steps, k + 1)]
            slopes.append(vec.unit((a[1] - b[1], b[0] - a[0], 0)))
        if side < 0:
            top, slopes = top[::-1], [vec.mul(n, -1) for n in slopes[::-1]]
        rows = []
        for z, v in ((depth / 2, 1), (-depth / 2, 0)):
            rows.append(
                [((x, y, z), n, (k / steps, v)) for k, ((x, y), n) in enumerate(zip(top, slopes))]
            )
        model.add(page, Mesh().grid(rows))
        for z, facing in ((depth / 2, 1), (-depth / 2, -1)):
            low = [((x, 0.004, z), (0, 0, facing), (0, 0)) for x, _ in top]
            high = [((x, y, z), (0, 0, facing), (0, 0)) for x, y in top]
            model.add(PAPER, Mesh().grid([low, high] if facing > 0 else [high, low]))
        edge = rectangle(
            (side * width / 2, 0.004, side * depth / 2),
            (0, 0, -side * depth),
            (0, outline(1) - 0.004, 0),
        )
        model.add(PAPER, edge)
    return model

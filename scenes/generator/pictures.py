"""Painted things that are fitted to one rectangle: paintings."""

import functools
import math

from .noise import cloud

_HILLS = 5


def _landscape_colours():
    sky = [(236 - 8 * i, 196 - 2 * i, 150 + 9 * i) for i in range(9)]
    hills = [(196, 146, 96), (150, 130, 74), (98, 118, 72), (58, 92, 76), (32, 60, 70)]
    return [*sky, (250, 226, 150), *hills]


def landscape(seed=11, width=256, height=192):
    """Hills one behind the other under an evening sky with a low sun."""

    @functools.lru_cache(maxsize=None)
    def paint():
        palette, indices = _landscape_colours(), bytearray()
        lines = [
            [
                0.42 + 0.12 * k + 0.16 * (cloud(x * 4 / width + k, k, 64, 64, 4, seed) - 0.5)
                for x in range(width)
            ]
            for k in range(_HILLS)
        ]
        for y in range(height):
            for x in range(width):
                v = y / height
                hill = sum(v > lines[k][x] for k in range(_HILLS))
                sun = math.hypot((x / width - 0.66) * 4 / 3, v - 0.34) < 0.09
                shade = 9 if sun else max(0, min(8, int(9 - v * 20)))
                indices.append(9 + hill if hill else shade)
        return width, height, palette, bytes(indices)

    return paint

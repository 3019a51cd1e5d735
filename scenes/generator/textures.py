"""Painted surfaces that repeat: wood, floors, stone, carpet, cloth.

Each function returns a painter without arguments, as materials.Texture takes it. Colours here are
sRGB, 0 to 255, as they stand in the file.
"""

import functools
import math

from .noise import cloud, hashed, value


def ramp(dark, light, steps=48):
    return [
        tuple(round(d + (l - d) * i / (steps - 1)) for d, l in zip(dark, light))
        for i in range(steps)
    ]


def tones(width, height, dark, light, tone, steps=48):
    """A painter from tone(x, y) in [0, 1], x and y in pixels."""

    @functools.lru_cache(maxsize=None)
    def paint():
        indices = bytes(
            min(steps - 1, max(0, int(tone(x, y) * steps)))
            for y in range(height)
            for x in range(width)
        )
        return width, height, ramp(dark, light, steps), indices

    return paint


def grain(u, v, seed):
    """Wood: u along the grain, v across, one period each on [0, 1)."""
    bend = value(u * 3, v * 4, 3, 4, seed)
    rings = 0.5 + 0.5 * math.sin(2 * math.pi * (v * 7 + 1.3 * bend))
    fibre = cloud(u * 6, v * 48, 6, 48, 2, seed + 7)
    return 0.45 * rings + 0.55 * fibre


def wood(dark, light, seed=1, size=256):
    return tones(size, size, dark, light, lambda x, y: grain(x / size, y / size, seed), 32)


def planks(dark, light, rows=8, seed=3, size=512):
    """A floor of boards: each row is shifted, each board has its own tone, joints are dark."""

    def tone(x, y):
        row, inside = divmod(y * rows, size)
        shift = int(hashed(row, 0, seed) * size)
        board, along = divmod((x + shift) % size * 2, size)
        if inside < rows or along < 4:
            return 0.0
        own = hashed(row, board, seed + 1)
        return 0.12 + 0.4 * own + 0.45 * grain(x / size, (y / size + own) % 1, seed + 2)

    return tones(size, size, dark, light, tone, 40)


def marble_tiles(dark, light, grout, tiles=2, seed=5, size=512):
    """Square tiles with veins; every second one a little darker."""

    def tone(x, y):
        i, a = divmod(x * tiles, size)
        j, b = divmod(y * tiles, size)
        if min(a, b) < 2 * tiles:
            return grout
        turned = (x, y) if (i + j) % 2 else (y, x)
        u, v = turned[0] / size, turned[1] / size
        warp = cloud(u * 4, v * 4, 4, 4, 4, seed)
        vein = abs(math.sin(2 * math.pi * (u + v + 1.6 * warp)))
        return 0.97 - 0.45 * math.exp(-9 * vein) - 0.2 * warp - 0.12 * ((i + j) % 2)

    return tones(size, size, dark, light, tone)


def checker(dark, light, seed=6, size=256):
    def tone(x, y):
        odd = (x * 2 // size + y * 2 // size) % 2
        cloudy = cloud(x * 8 / size, y * 8 / size, 8, 8, 3, seed)
        return 0.85 * odd + 0.15 * cloudy

    return tones(size, size, dark, light, tone)


def carpet(dark, light, seed=8, size=128):
    def tone(x, y):
        tuft = hashed(x, y, seed)
        worn = cloud(x * 4 / size, y * 4 / size, 4, 4, 2, seed)
        return 0.5 * tuft + 0.5 * worn

    return tones(size, size, dark, light, tone, 12)


def rug(dark, light, size=256):
    """A fitted pattern: a border of bands around a field of diamonds."""

    def tone(x, y):
        edge = min(x, y, size - 1 - x, size - 1 - y) * 256 // size
        if edge < 40:
            return (0.1, 0.9, 0.3, 0.7)[edge // 10] + 0.08 * hashed(x, y)
        diamond = (abs((x % 44) - 22) + abs((y % 44) - 22)) / 44
        return (0.25 if diamond < 0.5 else 0.8 if diamond < 0.62 else 0.5) + 0.08 * hashed(x, y)

    return tones(size, size, dark, light, tone, 12)


def weave(dark, light, size=64):
    """Threads that pass over and under each other, 16 each way."""

    def tone(x, y):
        over = (x // 4 + y // 4) % 2
        bulge = math.sin(math.pi * ((y if over else x) % 4 + 0.5) / 4)
        return 0.25 * over + 0.45 * bulge + 0.25 * hashed(x, y, 2)

    return tones(size, size, dark, light, tone, 12)


def speckle(dark, light, seed=9, size=128):
    """Ceiling board: light, with a joint along two edges and small holes."""

    def tone(x, y):
        if min(x, y) < 2:
            return 0.0
        return 1.0 if hashed(x, y, seed) > 0.04 else 0.35

    return tones(size, size, dark, light, tone, 8)

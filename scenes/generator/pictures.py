"""Pictures that are fitted to one rectangle: paintings, screens, pages, the view outside."""

import functools
import math

from .noise import cloud, hashed

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


def dusk(width=128, height=128):
    """The view from a window in the evening: roofs with a few lit windows under a blue sky."""

    @functools.lru_cache(maxsize=None)
    def paint():
        palette = [(46 + 5 * i, 66 + 6 * i, 118 + 4 * i) for i in range(20)] + [
            (26, 28, 40),
            (36, 38, 52),
            (236, 196, 120),
        ]
        indices = bytearray()
        for y in range(height):
            for x in range(width):
                tower, inside = divmod(x, 16)
                roof = 0.5 + 0.28 * hashed(tower, 0, 3)
                if y / height < roof:
                    indices.append(min(19, int(y / height * 26)))
                    continue
                lit = hashed(x // 4, y // 5, 8) > 0.82 and x % 4 in (1, 2) and y % 5 in (1, 2, 3)
                indices.append(22 if lit and 2 < inside < 14 else 20 + tower % 2)
        return width, height, palette, bytes(indices)

    return paint


def printed_page(seed, width=128, height=192):
    """Lines of words; a page in three begins with a figure."""

    @functools.lru_cache(maxsize=None)
    def paint():
        palette = [(238, 232, 214), (92, 88, 84), (150, 176, 190), (176, 96, 70)]
        pixels = bytearray(width * height)
        figure = height // 3 if seed % 3 == 0 else 0
        for y in range(14, height - 14):
            line, inside = divmod(y - 14, 6)
            for x in range(12, width - 12):
                if y < figure:
                    hill = math.sin(x * 0.09) * 8 + figure * 0.62
                    pixels[y * width + x] = 3 if y > hill else 2
                elif y > figure + 4 and inside < 3 and line % 9 != 8:
                    if (
                        hashed(x // 2 + line * 97, line, seed) > 0.22
                        and hashed(x // 9, line, seed) > 0.1
                    ):
                        pixels[y * width + x] = 1
        return width, height, palette, bytes(pixels)

    return paint


def screen(seed, width=256, height=160):
    """A monitor with an editor: a bar at the side and coloured lines of text."""

    @functools.lru_cache(maxsize=None)
    def paint():
        palette = [
            (28, 32, 40),
            (40, 46, 58),
            (150, 200, 220),
            (220, 170, 110),
            (160, 210, 130),
            (190, 190, 196),
        ]
        pixels = bytearray(width * height)
        for y in range(height):
            line, inside = divmod(y, 5)
            indent = int(hashed(line, 1, seed) * 4) * 8
            extent = 60 + indent + int(hashed(line, 2, seed) * 130)
            for x in range(width):
                texel = 1 if x < 40 or y < 8 else 0
                if inside in (1, 2) and y > 10 and hashed(x // 2, line, seed) > 0.2:
                    if 50 + indent < x < extent and line % 7:
                        texel = 2 + int(hashed((x + line * 5) // 17, line, seed + 1) * 4)
                    elif 6 < x < 14 + hashed(line, 3, seed) * 24:
                        texel = 5
                pixels[y * width + x] = texel
        return width, height, palette, bytes(pixels)

    return paint


def abstract(seed, width=192, height=192):
    """Overlapping discs on a warm ground."""

    @functools.lru_cache(maxsize=None)
    def paint():
        palette = [
            (228, 214, 188),
            (196, 78, 52),
            (32, 70, 96),
            (222, 164, 60),
            (60, 120, 110),
            (40, 36, 40),
        ]
        discs = [
            (hashed(k, 0, seed), hashed(k, 1, seed), 0.08 + 0.2 * hashed(k, 2, seed), 1 + k % 5)
            for k in range(9)
        ]
        pixels = bytearray()
        for y in range(height):
            for x in range(width):
                u, v, texel = x / width, y / height, 0
                for cx, cy, r, colour in discs:
                    d = math.hypot(u - cx, v - cy)
                    if d < r and not 0.7 * r < d < 0.76 * r:
                        texel = colour
                pixels.append(texel)
        return width, height, palette, bytes(pixels)

    return paint

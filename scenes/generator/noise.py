"""Periodic noise for textures that repeat, from integer hashes: the same texels everywhere."""

import math


def hashed(x, y, seed=0):
    """A number in [0, 1) for a lattice point."""
    h = (x * 0x8DA6B343 + y * 0xD8163841 + seed * 0xCB1AB31F) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 0x5BD1E995) & 0xFFFFFFFF
    h = ((h ^ (h >> 15)) * 0x27D4EB2F) & 0xFFFFFFFF
    return ((h ^ (h >> 14)) & 0xFFFFFF) / 0x1000000


def value(x, y, period_x, period_y, seed=0):
    """Smooth noise in [0, 1) on the unit lattice, periodic."""
    ix, iy = math.floor(x), math.floor(y)
    fx, fy = x - ix, y - iy
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    x0, y0 = ix % period_x, iy % period_y
    x1, y1 = (x0 + 1) % period_x, (y0 + 1) % period_y
    low = hashed(x0, y0, seed) * (1 - fx) + hashed(x1, y0, seed) * fx
    high = hashed(x0, y1, seed) * (1 - fx) + hashed(x1, y1, seed) * fx
    return low * (1 - fy) + high * fy


def cloud(x, y, period_x, period_y, octaves, seed=0):
    """Octaves of noise, each twice as fine and half as strong, in [0, 1)."""
    total, strength, size = 0.0, 1.0, 0.0
    for k in range(octaves):
        f = 1 << k
        total += strength * value(x * f, y * f, period_x * f, period_y * f, seed + k)
        size += strength
        strength /= 2
    return total / size

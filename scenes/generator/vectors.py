"""Vectors as tuples and affine transforms as 3 rows of 4 numbers. Right-handed, y up, metres."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def mul(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return mul(a, 1 / length(a))


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


IDENTITY = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))


def move(x=0, y=0, z=0):
    return ((1, 0, 0, x), (0, 1, 0, y), (0, 0, 1, z))


def scale(x, y=None, z=None):
    y, z = x if y is None else y, x if z is None else z
    return ((x, 0, 0, 0), (0, y, 0, 0), (0, 0, z, 0))


def turn(axis, degrees):
    """Rotation about an axis 'x', 'y' or 'z', counter-clockwise seen from its tip."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {
        "x": ((1, 0, 0, 0), (0, c, -s, 0), (0, s, c, 0)),
        "y": ((c, 0, s, 0), (0, 1, 0, 0), (-s, 0, c, 0)),
        "z": ((c, -s, 0, 0), (s, c, 0, 0), (0, 0, 1, 0)),
    }[axis]


def chain(*transforms):
    """The product: the last transform acts first."""
    result = IDENTITY
    for t in transforms:
        full = (*t, (0, 0, 0, 1))
        result = tuple(
            tuple(sum(row[k] * full[k][j] for k in range(4)) for j in range(4)) for row in result
        )
    return result


def on_point(m, p):
    return tuple(r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3] for r in m)


def on_normal(m, n):
    """Normals move by the cofactors, that is by the inverse transpose times the determinant."""
    a, b, c = (row[:3] for row in m)
    return unit((dot(cross(b, c), n), dot(cross(c, a), n), dot(cross(a, b), n)))


def determinant(m):
    return dot(m[0][:3], cross(m[1][:3], m[2][:3]))

"""Flat shapes: rectangles, walls with holes, boxes, prisms."""

from . import vectors as vec
from .mesh import Mesh


def rectangle(corner, right, up, fit=False):
    """Front face towards right x up. `fit`: one copy of the texture, upright, instead of metres."""
    normal = vec.unit(vec.cross(right, up))
    width, height = (1, 1) if fit else (vec.length(right), vec.length(up))
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    return Mesh().fan(
        [
            (
                vec.add(corner, vec.add(vec.mul(right, s), vec.mul(up, t))),
                normal,
                (s * width, (1 - t) * height),
            )
            for s, t in corners
        ]
    )


def wall(corner, right, up, holes=()):
    """A rectangle with rectangular holes (x0, y0, x1, y1) in metres from its corner. Cut along all
    edges of the holes, so that neighbouring pieces share their vertices and no light gets through.
    """
    width, height = vec.length(right), vec.length(up)
    xs = sorted({0, width, *(x for h in holes for x in (h[0], h[2]))})
    ys = sorted({0, height, *(y for h in holes for y in (h[1], h[3]))})
    normal = vec.unit(vec.cross(right, up))
    right, up = vec.unit(right), vec.unit(up)

    def vertex(x, y):
        place = vec.add(corner, vec.add(vec.mul(right, x), vec.mul(up, y)))
        return (place, normal, (x, height - y))

    mesh = Mesh()
    for y0, y1 in zip(ys, ys[1:]):
        for x0, x1 in zip(xs, xs[1:]):
            if not any(h[0] <= x0 and x1 <= h[2] and h[1] <= y0 and y1 <= h[3] for h in holes):
                mesh.fan([vertex(x0, y0), vertex(x1, y0), vertex(x1, y1), vertex(x0, y1)])
    return mesh


# Each face of a box: the corner (0 = low, 1 = high), then the axes that run right and up.
_FACES = {
    "-x": ((0, 0, 0), 2, 1, 1, 1),
    "+x": ((1, 0, 1), 2, 1, -1, 1),
    "-y": ((0, 0, 0), 0, 2, 1, 1),
    "+y": ((0, 1, 1), 0, 2, 1, -1),
    "-z": ((1, 0, 0), 0, 1, -1, 1),
    "+z": ((0, 0, 1), 0, 1, 1, 1),
}


def box(low, high, skip=(), inward=False):
    """A box between two corners; `inward` turns its faces to the inside, as for a room. The grain
    of a texture (its u) runs along the longest edge of each face."""
    mesh = Mesh()
    size = vec.sub(high, low)
    for name, (where, across, upward, sign_across, sign_up) in _FACES.items():
        if name in skip:
            continue
        corner = tuple(h if w else l for w, l, h in zip(where, low, high))
        right, up = [0, 0, 0], [0, 0, 0]
        right[across], up[upward] = sign_across * size[across], sign_up * size[upward]
        if inward:
            corner, right = vec.add(corner, right), [-x for x in right]
        if abs(up[upward]) > abs(right[across]):
            corner, right, up = vec.add(corner, right), up, [-x for x in right]
        mesh.join(rectangle(corner, right, up))
    return mesh


def slab(size, at=(0, 0, 0), skip=()):
    """A box by size and centre of its bottom."""
    x, y, z = size[0] / 2, size[1], size[2] / 2
    return box((at[0] - x, at[1], at[2] - z), (at[0] + x, at[1] + y, at[2] + z), skip)


def taper(bottom, top, height, at=(0, 0, 0), lean=(0, 0)):
    """A square leg without a lower end that widens or narrows; `lean` shifts its top in x and z."""

    def ring(side, y, dx, dz):
        h = side / 2
        corners = ((-h, h), (h, h), (h, -h), (-h, -h))
        return [vec.add(at, (x + dx, y, z + dz)) for x, z in corners]

    low, high = ring(bottom, 0, 0, 0), ring(top, height, *lean)
    mesh = Mesh()
    for i in range(4):
        a, b, c, d = low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]
        normal = vec.unit(vec.cross(vec.sub(b, a), vec.sub(d, a)))
        uvs = ((0, 0), (0, bottom), (height, bottom), (height, 0))
        mesh.fan([(p, normal, uv) for p, uv in zip((a, b, c, d), uvs)])
    return mesh.fan([(p, (0, 1, 0), (0, 0)) for p in high])

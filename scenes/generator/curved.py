"""Curved shapes with exact or smoothly averaged vertex normals."""

import math

from . import vectors as vec
from .mesh import Mesh


def rounded_box(size, radius, steps=2, at=(0, 0, 0)):
    """A box by size and centre of its bottom; its edges are round, in `steps` * 2 pieces."""
    half = [s / 2 for s in size]
    core = [h - radius for h in half]
    tangents = [radius * math.tan(math.pi / 4 * k / steps) for k in range(steps + 1)]
    lines = [[-c - t for t in reversed(tangents)] + [c + t for t in tangents] for c in core]
    mesh = Mesh()
    for axis in range(3):
        for sign in (-1, 1):
            across, upward = (axis + 1) % 3, (axis + 2) % 3
            if sign < 0:
                across, upward = upward, across
            turned = half[upward] > half[across]

            def vertex(a, b):
                flat = [0, 0, 0]
                flat[axis], flat[across], flat[upward] = sign * half[axis], a, b
                inner = [max(-c, min(c, f)) for c, f in zip(core, flat)]
                normal = vec.unit(vec.sub(flat, inner))
                place = vec.add(inner, vec.mul(normal, radius))
                place = vec.add(place, (at[0], at[1] + half[1], at[2]))
                return (place, normal, (b, a) if turned else (a, -b))

            mesh.grid([[vertex(a, b) for a in lines[across]] for b in lines[upward]])
    return mesh


def _profile_normals(profile, crease):
    """Splits an (r, y) line into runs of (r, y, normal) where it bends by over `crease` degrees."""
    edges = []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        size = math.hypot(r1 - r0, y1 - y0)
        edges.append(((y1 - y0) / size, (r0 - r1) / size))
    runs, run = [], [(*profile[0], edges[0])]
    for point, before, after in zip(profile[1:], edges, edges[1:] + [None]):
        bend = after and before[0] * after[0] + before[1] * after[1] < math.cos(
            math.radians(crease)
        )
        if after is None or bend:
            runs.append(run + [(*point, before)])
            run = [(*point, after)]
        else:
            s = (before[0] + after[0], before[1] + after[1])
            size = math.hypot(*s)
            run.append((*point, (s[0] / size, s[1] / size)))
    return runs


def lathe(profile, segments, crease=40):
    """Turns an (r, y) line, drawn upwards for outer faces, about the y axis."""
    mesh = Mesh()
    for run in _profile_normals(profile, crease):
        mesh.join(revolve(run, segments))
    return mesh


def revolve(run, segments):
    """Turns points (r, y, (normal_r, normal_y)) about the y axis."""
    widest = max(p[0] for p in run)
    rows, along = [], 0
    for i, (r, y, (nr, ny)) in enumerate(run):
        along += math.hypot(r - run[i - 1][0], y - run[i - 1][1]) if i else 0
        row = []
        for k in range(segments + 1):
            a = 2 * math.pi * (k % segments) / segments
            s, c = math.sin(a), math.cos(a)
            uv = (2 * math.pi * widest * k / segments, -along)
            row.append(((r * s, y, r * c), (nr * s, ny, nr * c), uv))
        rows.append(row)
    return Mesh().grid(rows)


def disc(radius, y, segments, up=True):
    ring = []
    for k in range(segments):
        a = 2 * math.pi * k / segments
        x, z = radius * math.sin(a), radius * math.cos(a)
        ring.append(((x, y, z), (0, 1 if up else -1, 0), (x, z)))
    return Mesh().fan(ring if up else ring[::-1])


def egg(radius, height, segments, rings, blunt=0.22):
    """An egg that stands on y = 0, its blunt end below, with exact normals:
    r = R sin t (1 + k cos t), y = H/2 (1 - cos t)."""
    run = []
    for k in range(rings + 1):
        t = math.pi * k / rings
        s, c = math.sin(t), math.cos(t)
        slope_r = radius * (c + blunt * math.cos(2 * t))
        slope_y = height / 2 * s
        size = math.hypot(slope_r, slope_y)
        r = 0 if k in (0, rings) else radius * s * (1 + blunt * c)
        run.append((r, height / 2 * (1 - c), (slope_y / size, -slope_r / size)))
    return revolve(run, segments)


def ball(radius, frequency, at=(0, 0, 0)):
    """A geodesic sphere of 20 * frequency^2 triangles with exact normals."""
    g = (1 + math.sqrt(5)) / 2
    corners = [(0, 1, g), (0, -1, g), (0, 1, -g), (0, -1, -g)]
    corners = [vec.unit(p) for x, y, z in corners for p in ((x, y, z), (y, z, x), (z, x, y))]
    edge = min(vec.length(vec.sub(corners[0], p)) for p in corners[1:]) * 1.01
    near = [[vec.length(vec.sub(p, q)) < edge for q in corners] for p in corners]
    mesh = Mesh()
    for i in range(12):
        for j in range(i):
            for k in range(j):
                if near[i][j] and near[j][k] and near[i][k]:
                    a, b, c = corners[i], corners[j], corners[k]
                    if vec.dot(vec.cross(vec.sub(b, a), vec.sub(c, a)), a) < 0:
                        b, c = c, b
                    _geodesic_face(mesh, (a, b, c), frequency, radius, at)
    return mesh


def _geodesic_face(mesh, corners, n, radius, at):
    a, b, c = corners
    index = {}
    for j in range(n + 1):
        for i in range(n + 1 - j):
            index[i, j] = len(mesh.vertices)
            weights = ((n - i - j) / n, i / n, j / n)
            normal = vec.unit([sum(w * p[x] for w, p in zip(weights, (a, b, c))) for x in range(3)])
            mesh.vertices.append((vec.add(at, vec.mul(normal, radius)), normal, (0, 0)))
    for i, j in index:
        if i + j < n:
            mesh.triangles.append((index[i, j], index[i + 1, j], index[i, j + 1]))
        if i + j < n - 1:
            mesh.triangles.append((index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]))


def cushion(size, segments, rings, squareness=0.45, at=(0, 0, 0)):
    """A superellipsoid by size and centre of its bottom; squareness 1 is an ellipsoid, 0 a box.
    x = a C(v) C(u), y = b S(v), z = c C(v) S(u) with C, S = signed powers of cos and sin; normals
    by the same formula with 2 - squareness as the power and 1/a, 1/b, 1/c."""
    a, b, c = (s / 2 for s in size)

    def power(x, e):
        return math.copysign(abs(x) ** e, x) if abs(x) > 1e-12 else 0.0

    def surface(u, v, e, f):
        cv = power(math.cos(v), f)
        return (cv * power(math.cos(u), e), power(math.sin(v), f), cv * power(math.sin(u), e))

    rows = []
    for j in range(rings + 1):
        v = math.pi * (j / rings - 0.5)
        row = []
        for i in range(segments + 1):
            u = -2 * math.pi * (i % segments) / segments
            p = surface(u, v, squareness, squareness)
            n = surface(u, v, 2 - squareness, 2 - squareness)
            n = (0, math.copysign(1, v), 0) if j in (0, rings) else n
            p = (0, math.copysign(1, v), 0) if j in (0, rings) else p
            place = (p[0] * a + at[0], p[1] * b + b + at[1], p[2] * c + at[2])
            row.append((place, vec.unit((n[0] / a, n[1] / b, n[2] / c)), (p[0] * a, p[2] * c)))
        rows.append(row)
    return Mesh().grid(rows)


def tube(path, radius, segments, ends=True):
    """A round bar along a line of points. The ring is carried along without twist."""
    mesh, rows = Mesh(), []
    side, along = None, 0
    for i, p in enumerate(path):
        before = vec.unit(vec.sub(p, path[i - 1])) if i else None
        after = vec.unit(vec.sub(path[i + 1], p)) if i + 1 < len(path) else None
        forward = vec.unit(vec.add(before, after)) if before and after else before or after
        if side is None:
            side = (1, 0, 0) if abs(forward[0]) < 0.8 else (0, 0, 1)
        side = vec.unit(vec.sub(side, vec.mul(forward, vec.dot(side, forward))))
        other = vec.cross(forward, side)
        along += vec.length(vec.sub(p, path[i - 1])) if i else 0
        row = []
        for k in range(segments + 1):
            a = 2 * math.pi * (k % segments) / segments
            n = vec.add(vec.mul(side, math.cos(a)), vec.mul(other, math.sin(a)))
            row.append((vec.add(p, vec.mul(n, radius)), n, (along, radius * a)))
        rows.append(row)
        if ends and i in (0, len(path) - 1):
            ring = [(q[0], vec.mul(forward, -1 if i == 0 else 1), q[2]) for q in row[:-1]]
            mesh.fan(ring[::-1] if i == 0 else ring)
    return mesh.grid(rows)


def table_top(width, depth, thickness, segments, power=4.0, edge=3, y=0.0):
    """A slab over the outline |x/a|^n + |z/b|^n = 1 with a half-round edge of `edge` * 2 pieces;
    `y` is the height of its lower side. Power 2 is an ellipse."""
    a, b, r = width / 2, depth / 2, thickness / 2
    outline = []
    for k in range(segments):
        t = 2 * math.pi * k / segments
        s, c = math.sin(t), math.cos(t)
        size = (abs(s) ** power + abs(c) ** power) ** (-1 / power)
        x, z = s * size, c * size
        n = (
            math.copysign(abs(x) ** (power - 1), x) / a,
            math.copysign(abs(z) ** (power - 1), z) / b,
        )
        outline.append((x * a, z * b, *vec.mul((*n, 0), 1 / math.hypot(*n))[:2]))
    rows = []
    for j in range(2 * edge + 1):
        angle = math.pi * (j / (2 * edge) - 0.5)
        inset, up = r * (math.cos(angle) - 1), math.sin(angle)
        row = []
        for x, z, nx, nz in [*outline, outline[0]]:
            place = (x + nx * inset, y + r + r * up, z + nz * inset)
            normal = (nx * math.cos(angle), up, nz * math.cos(angle))
            row.append((place, vec.unit(normal), (place[0], place[2])))
        rows.append(row)
    mesh = Mesh().grid(rows)
    mesh.fan([(p, (0, 1, 0), uv) for p, _, uv in rows[-1][:-1]])
    return mesh.fan([(p, (0, -1, 0), uv) for p, _, uv in rows[0][-2::-1]])

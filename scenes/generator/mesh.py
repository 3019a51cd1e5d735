"""A triangle mesh of one material, and a model: a thing made of such meshes.

A vertex is (position, unit normal, (u, v)). Texture coordinates count metres on the surface, so
that one texture fits everything; the writer divides them by the size of the material's texture.
v grows downwards, as in glTF. Front faces are counter-clockwise.
"""

from . import vectors as vec


class Mesh:
    def __init__(self):
        self.vertices = []
        self.triangles = []

    def grid(self, rows, closed=False):
        """Joins rows of vertices, each row running to the right of the one below it; `closed` also
        joins the last row with the first. Triangles that have shrunk to a line are left out."""
        first, width = len(self.vertices), len(rows[0])
        for row in rows:
            self.vertices.extend(row)
        for j in range(len(rows) if closed else len(rows) - 1):
            low, high = first + j * width, first + (j + 1) % len(rows) * width
            for i in range(width - 1):
                self._corner(low + i, low + i + 1, high + i + 1)
                self._corner(low + i, high + i + 1, high + i)
        return self

    def fan(self, vertices):
        """A convex polygon, counter-clockwise."""
        first = len(self.vertices)
        self.vertices.extend(vertices)
        for i in range(1, len(vertices) - 1):
            self._corner(first, first + i, first + i + 1)
        return self

    def _corner(self, a, b, c):
        p, q, r = (self.vertices[i][0] for i in (a, b, c))
        if vec.length(vec.cross(vec.sub(q, p), vec.sub(r, p))) > 1e-12:
            self.triangles.append((a, b, c))

    def join(self, *others):
        for other in others:
            first = len(self.vertices)
            self.vertices.extend(other.vertices)
            self.triangles.extend(tuple(first + i for i in t) for t in other.triangles)
        return self

    def moved(self, *transforms):
        """A copy; the last transform acts first."""
        m = vec.chain(*transforms)
        result = Mesh()
        result.vertices = [
            (vec.on_point(m, p), vec.on_normal(m, n), uv) for p, n, uv in self.vertices
        ]
        flip = vec.determinant(m) < 0
        result.triangles = [t[::-1] for t in self.triangles] if flip else list(self.triangles)
        if flip:
            result.vertices = [(p, vec.mul(n, -1), uv) for p, n, uv in result.vertices]
        return result


class Model:
    """A named thing: its meshes by material, in the order in which they were added."""

    def __init__(self, name):
        self.name = name
        self.meshes = {}

    def add(self, material, *meshes):
        self.meshes.setdefault(material, Mesh()).join(*meshes)
        return self

    def join(self, other, *transforms):
        for material, mesh in other.meshes.items():
            self.add(material, mesh.moved(*transforms))
        return self

    def triangle_count(self):
        return sum(len(mesh.triangles) for mesh in self.meshes.values())

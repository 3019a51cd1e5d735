"""Writes a scene as one glTF 2.0 binary.

Layout of the binary chunk: positions, normals, texture coordinates, 16-bit indices, 32-bit indices, motions
(one view each, accessors side by side), then the images, then photometric files.
"""

import json
import struct

from . import materials, png

_FLOAT, _USHORT, _UINT = 5126, 5123, 5125


class _Views:
    """The binary chunk while it grows: named views, each a list of packed pieces."""

    NAMES = ("positions", "normals", "uvs", "indices16", "indices32", "motions")
    STRIDE = {"positions": 12, "normals": 12, "uvs": 8}

    def __init__(self):
        self.pieces = {name: bytearray() for name in self.NAMES}
        self.images = []
        self.profiles = []

    def put(self, name, data):
        piece = self.pieces[name]
        piece.extend(b"\0" * (-len(piece) % 4))
        offset = len(piece)
        piece.extend(data)
        return offset

    def finish(self):
        """The chunk, its views, and for each name the index of its view."""
        chunk, views, index = bytearray(), [], {}
        for name in self.NAMES:
            if not self.pieces[name]:
                continue
            view = {"buffer": 0, "byteOffset": len(chunk), "byteLength": len(self.pieces[name])}
            if name != "motions":
                view["target"] = 34963 if name.startswith("indices") else 34962
            if name in self.STRIDE:
                view["byteStride"] = self.STRIDE[name]
            index[name] = len(views)
            views.append(view)
            chunk.extend(self.pieces[name] + b"\0" * (-len(self.pieces[name]) % 4))
        for blob in self.images + self.profiles:
            views.append({"buffer": 0, "byteOffset": len(chunk), "byteLength": len(blob)})
            chunk.extend(blob + b"\0" * (-len(blob) % 4))
        return bytes(chunk), views, index


def _rounded(values):
    """As a reader will see them: float32, without -0 and the last digits of sin and cos."""
    return [struct.unpack("<f", struct.pack("<f", round(v, 6) + 0.0))[0] for v in values]


def _compact(mesh, with_uv, texture_size):
    """Packed unique vertices and the triangles that refer to them."""
    seen, packed, triangles = {}, [], []
    slots = []
    for place, normal, uv in mesh.vertices:
        uv = (uv[0] / texture_size[0], uv[1] / texture_size[1]) if with_uv else ()
        key = tuple(_rounded((*place, *normal, *uv)))
        if key not in seen:
            seen[key] = len(packed)
            packed.append(key)
        slots.append(seen[key])
    for t in mesh.triangles:
        triangles.extend(slots[i] for i in t)
    used = sorted(set(triangles))
    renumber = {old: new for new, old in enumerate(used)}
    return [packed[i] for i in used], [renumber[i] for i in triangles]


class _Document:
    def __init__(self):
        self.views = _Views()
        self.accessors, self.materials, self.textures = [], [], []
        self.material_index, self.texture_index = {}, {}

    def accessor(self, view, values, kind, component, **more):
        code = {_FLOAT: "f", _USHORT: "H", _UINT: "I"}[component]
        offset = self.views.put(view, struct.pack(f"<{len(values)}{code}", *values))
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[kind]
        self.accessors.append(
            {
                "bufferView": view,
                "byteOffset": offset,
                "componentType": component,
                "count": len(values) // width,
                "type": kind,
                **more,
            }
        )
        return len(self.accessors) - 1

    def primitive(self, material, mesh):
        texture = material.texture
        vertices, indices = _compact(mesh, bool(texture), texture.size if texture else (1, 1))
        columns = list(zip(*vertices))
        bounds = {
            "min": [min(c) for c in columns[:3]],
            "max": [max(c) for c in columns[:3]],
        }

        def flat(a, b):
            return [x for v in vertices for x in v[a:b]]

        attributes = {
            "POSITION": self.accessor("positions", flat(0, 3), "VEC3", _FLOAT, **bounds),
            "NORMAL": self.accessor("normals", flat(3, 6), "VEC3", _FLOAT),
        }
        if texture:
            attributes["TEXCOORD_0"] = self.accessor("uvs", flat(6, 8), "VEC2", _FLOAT)
        small = len(vertices) < 65535
        view, component = ("indices16", _USHORT) if small else ("indices32", _UINT)
        return {
            "attributes": attributes,
            "indices": self.accessor(view, indices, "SCALAR", component),
            "material": self.material(material),
        }

    def material(self, material):
        if material not in self.material_index:
            texture = material.texture
            index = None
            if texture:
                index = self.texture_index.setdefault(texture, len(self.texture_index))
                if index == len(self.textures):
                    self.textures.append(texture.name)
                    self.views.images.append(png.encode(*texture.paint()))
            self.material_index[material] = len(self.materials)
            self.materials.append(materials.describe(material, index))
        return self.material_index[material]


def _cameras(scene):
    return [
        {
            "name": c.name,
            "type": "perspective",
            "perspective": {"yfov": c.fov, "aspectRatio": 4 / 3, "znear": 0.01},
        }
        for c in scene.cameras
    ]


def _nodes(scene, mesh_index):
    nodes = []
    for i, c in enumerate(scene.cameras):
        nodes.append(
            {"name": c.name, "camera": i, "translation": list(c.eye), "rotation": list(c.rotation)}
        )
    for p in scene.placements:
        node = {"name": p.name, "mesh": mesh_index[id(p.model)]}
        if any(p.at):
            node["translation"] = list(p.at)
        if p.rotation != (0, 0, 0, 1):
            node["rotation"] = list(p.rotation)
        if p.scale != (1, 1, 1):
            node["scale"] = list(p.scale)
        nodes.append(node)
    profiles = _profiles(scene)
    for lamp in scene.lamps:
        use = {"light": profiles.index(lamp.profile)}
        if lamp.colour != (1, 1, 1):
            use["color"] = list(lamp.colour)
        # -z goes down, x to the north.
        node = {"name": lamp.name, "translation": list(lamp.at), "rotation": [-0.5, 0.5, 0.5, 0.5]}
        nodes.append({**node, "extensions": {"EXT_lights_ies": use}})
    return nodes


def _profiles(scene):
    return list(dict.fromkeys(lamp.profile for lamp in scene.lamps))


def _animation(document, scene):
    """All motions as one animation. Node i + cameras is placement i."""
    channels, samplers = [], []
    for motion in scene.motions:
        place = [p.name for p in scene.placements].index(motion.name)
        at = scene.placements[place].at
        flat = [x for offset in motion.offsets for x in _rounded([a + b for a, b in zip(at, offset)])]
        span = {"min": [motion.times[0]], "max": [motion.times[-1]]}
        times = document.accessor("motions", motion.times, "SCALAR", _FLOAT, **span)
        places = document.accessor("motions", flat, "VEC3", _FLOAT)
        target = {"node": len(scene.cameras) + place, "path": "translation"}
        channels.append({"sampler": len(samplers), "target": target})
        samplers.append({"input": times, "output": places, "interpolation": "LINEAR"})
    return {"channels": channels, "samplers": samplers}


def encode(scene):
    """The bytes of the .glb file."""
    document, meshes, mesh_index = _Document(), [], {}
    for p in scene.placements:
        if id(p.model) not in mesh_index:
            mesh_index[id(p.model)] = len(meshes)
            primitives = [document.primitive(m, mesh) for m, mesh in p.model.meshes.items()]
            meshes.append({"name": p.model.name, "primitives": primitives})
    animation = _animation(document, scene)
    document.views.profiles = [profile.encode() for profile in _profiles(scene)]
    chunk, views, view_index = document.views.finish()
    for accessor in document.accessors:
        accessor["bufferView"] = view_index[accessor["bufferView"]]
    nodes = _nodes(scene, mesh_index)
    first_profile = len(views) - len(document.views.profiles)
    first_image = first_profile - len(document.textures)
    content = {
        "asset": {"version": "2.0", "generator": "scenes/generate.py of Ninefold"},
        "scene": 0,
        "scenes": [{"name": scene.name, "nodes": list(range(len(nodes))), "extras": {"exposure": scene.exposure}}],
        "nodes": nodes,
        "cameras": _cameras(scene),
        "meshes": meshes,
        "materials": document.materials,
        "accessors": document.accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(chunk)}],
    }
    if scene.motions:
        content["animations"] = [animation]
    if document.textures:
        content["samplers"] = [{"magFilter": 9729, "minFilter": 9987}]
        content["textures"] = [{"sampler": 0, "source": i} for i in range(len(document.textures))]
        content["images"] = [
            {"name": name, "mimeType": "image/png", "bufferView": first_image + i}
            for i, name in enumerate(document.textures)
        ]
    if scene.lamps:
        content["extensions"] = {
            "EXT_lights_ies": {
                "lights": [
                    {"bufferView": first_profile + i, "mimeType": "application/x-ies-lm-63"}
                    for i in range(len(document.views.profiles))
                ]
            }
        }
    used = sorted({e for m in document.materials for e in m.get("extensions", {})})
    used += ["EXT_lights_ies"] if scene.lamps else []
    if used:
        content["extensionsUsed"] = used
    return _container(content, chunk)


def _container(content, chunk):
    text = json.dumps(content, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(chunk)
    return (
        struct.pack("<4sII", b"glTF", 2, total)
        + struct.pack("<I4s", len(text), b"JSON")
        + text
        + struct.pack("<I4s", len(chunk), b"BIN\0")
        + chunk
    )

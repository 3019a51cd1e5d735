"""bending_square.py: a glTF scene whose animation bends a mesh, by a joint and by a morph target, made here."""
import base64
import json
import struct

from moving_square import square


def bending_square(at=None):
    """A floor, and over it a square: its right side hangs on a joint that sinks by a quarter of a metre in two seconds,
    its left side morphs half a metre to the left meanwhile. Or it stands as it is `at` that time."""
    floor, top = square(0, 0, 0, 4), square(0, 0, 0, 1)
    morph = [(-0.5 if x < 0 else 0, 0, 0) for x, _, _ in top]
    held = [1 if x > 0 else 0 for x, _, _ in top]
    parts = [b"".join(struct.pack("<3f", *p) for p in points) for points in (floor, top, morph)]
    parts += [struct.pack("<6H", 0, 1, 2, 0, 2, 3), b"".join(struct.pack("<4B", joint, 0, 0, 0) for joint in held),
              struct.pack("<16f", *([1, 0, 0, 0] * 4)),
              struct.pack("<32f", *([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] * 2)),
              struct.pack("<2f", 0, 2), struct.pack("<6f", 0, 0, 0, 0, -0.25, 0), struct.pack("<2f", 0, 1)]
    data, views, accessors = b"", [], []
    kinds = [(5126, 4, "VEC3")] * 3 + [(5123, 6, "SCALAR"), (5121, 4, "VEC4"), (5126, 4, "VEC4"), (5126, 2, "MAT4"),
                                       (5126, 2, "SCALAR"), (5126, 2, "VEC3"), (5126, 2, "SCALAR")]
    for part, (component, count, kind) in zip(parts, kinds):
        accessors.append({"bufferView": len(views), "componentType": component, "count": count, "type": kind})
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
        data += part
    share = (at or 0) / 2
    part = {"indices": 3, "material": 0}
    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 4]}],
        "nodes": [{"name": "floor", "mesh": 0}, {"name": "square", "mesh": 1, "skin": 0, "weights": [share]},
                  {"translation": [0, 0.5, 0], "children": [3]}, {"translation": [0, -0.25 * share, 0]},
                  {"camera": 0, "translation": [0, 3, 4], "rotation": [-0.3, 0, 0, 0.954]}],
        "skins": [{"joints": [2, 3], "inverseBindMatrices": 6}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}}],
        "meshes": [{"primitives": [dict(part, attributes={"POSITION": 0})]},
                   {"primitives": [dict(part, attributes={"POSITION": 1, "JOINTS_0": 4, "WEIGHTS_0": 5}, material=1,
                                        targets=[{"POSITION": 2}])]}],
        "materials": [{"doubleSided": True}, {"pbrMetallicRoughness": {"baseColorFactor": [0.75, 0.25, 0.25, 1]}}],
        "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    if at is None:
        scene["animations"] = [{"name": "bend",
                                "channels": [{"sampler": 0, "target": {"node": 3, "path": "translation"}},
                                             {"sampler": 1, "target": {"node": 1, "path": "weights"}}],
                                "samplers": [{"input": 7, "output": 8}, {"input": 7, "output": 9}]}]
    return json.dumps(scene)

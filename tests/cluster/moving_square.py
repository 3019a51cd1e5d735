"""moving_square.py: a glTF scene with an animation, made here."""
import base64
import json
import struct


def square(x, y, z, side):
    """Facing up, with its middle at (x, y, z)."""
    h = side / 2
    return [(x - h, y, z + h), (x + h, y, z + h), (x + h, y, z - h), (x - h, y, z - h)]


def moving_square(at=None):
    """A floor, and over it a square that goes from x = -1 to 1 in two seconds, or stands `at` that place."""
    data = b"".join(struct.pack("<3f", *p) for p in square(0, 0, 0, 4) + square(0, 0, 0, 1))
    data += struct.pack("<6H", 0, 1, 2, 0, 2, 3) + struct.pack("<2f", 0, 2) + struct.pack("<6f", -1, 0.5, 0, 1, 0.5, 0)
    views, begin = [], 0
    for length in (48, 48, 12, 8, 24):
        views.append({"buffer": 0, "byteOffset": begin, "byteLength": length})
        begin += length
    part = {"indices": 2, "material": 0}
    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"name": "floor", "mesh": 0}, {"name": "square", "mesh": 1, "translation": [at or 0, 0.5, 0]},
                  {"camera": 0, "translation": [0, 3, 4], "rotation": [-0.3, 0, 0, 0.954]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}}],
        "meshes": [{"primitives": [dict(part, attributes={"POSITION": 0})]},
                   {"primitives": [dict(part, attributes={"POSITION": 1}, material=1)]}],
        "materials": [{"doubleSided": True}, {"pbrMetallicRoughness": {"baseColorFactor": [0.75, 0.25, 0.25, 1]}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},
                      {"bufferView": 3, "componentType": 5126, "count": 2, "type": "SCALAR"},
                      {"bufferView": 4, "componentType": 5126, "count": 2, "type": "VEC3"}],
        "bufferViews": views,
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    if at is None:
        scene["animations"] = [{"channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}],
                                "samplers": [{"input": 3, "output": 4, "interpolation": "LINEAR"}]}]
    return json.dumps(scene)

#!/usr/bin/env python3
"""Looks into the committed scenes without any renderer: are they what scenes/README.md promises?

Run it from anywhere: python3 tests/scenes/scenes_test.py
"""

import json
import math
import pathlib
import struct
import sys
import unittest

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
sys.path.insert(0, str(SCENES))

from generator import cornell, glb, keyhole, many_rooms, three_turns, wall_washers  # noqa: E402

# Triangles after instancing and lights, as the paper's tests had them (cornell, u_office and what follows: our own).
EXPECTED = {
    "cornell": (46, 1),
    "table_room": (800, 1),
    "egg_room": (4000, 2),
    "invisible_date": (9000, 2),
    "office": (34000, 3),
    "conference": (290000, 104),
    "u_office": (19000, 1),
    "keyhole": (74, 1),
    "three_turns": (4400, 1),
    "wall_washers": (48, 2),
    "many_rooms": (3440, 40),
}
_WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}
_CODE = {5126: "f", 5123: "H", 5125: "I"}


class File:
    def __init__(self, name):
        data = (SCENES / f"{name}.glb").read_bytes()
        size = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20 : 20 + size])
        self.binary = data[28 + size :]

    def column(self, index):
        """An accessor as a list of tuples, or of numbers if it is scalar."""
        a = self.json["accessors"][index]
        start = self.json["bufferViews"][a["bufferView"]]["byteOffset"] + a["byteOffset"]
        width = _WIDTH[a["type"]]
        count = a["count"] * width
        flat = struct.unpack_from(f"<{count}{_CODE[a['componentType']]}", self.binary, start)
        return flat if width == 1 else list(zip(*(flat[k::width] for k in range(width))))

    def primitives(self):
        for mesh in self.json["meshes"]:
            for p in mesh["primitives"]:
                yield mesh["name"], self.json["materials"][p["material"]], p

    def uses(self, mesh):
        return sum(node.get("mesh") == mesh for node in self.json["nodes"])


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Scenes(unittest.TestCase):
    def each(self):
        for name in EXPECTED:
            with self.subTest(scene=name):
                yield name, File(name)

    def test_have_the_promised_size_and_lights(self):
        for name, file in self.each():
            triangles = 0
            lights = sum("EXT_lights_ies" in node.get("extensions", {}) for node in file.json["nodes"])
            for i, mesh in enumerate(file.json["meshes"]):
                for p in mesh["primitives"]:
                    count = file.json["accessors"][p["indices"]]["count"] // 3
                    triangles += count * file.uses(i)
                    emits = "emissiveFactor" in file.json["materials"][p["material"]]
                    lights += file.uses(i) if emits else 0
            wanted, lamps = EXPECTED[name]
            self.assertLess(abs(triangles - wanted), 0.25 * wanted, f"{triangles} triangles")
            self.assertEqual(lights, lamps)

    def test_have_unit_normals_on_the_side_where_triangles_are_counter_clockwise(self):
        for _, file in self.each():
            for mesh, material, p in file.primitives():
                where = f"{mesh}, {material['name']}"
                places = file.column(p["attributes"]["POSITION"])
                normals = file.column(p["attributes"]["NORMAL"])
                worst = max(abs(math.sqrt(dot(n, n)) - 1) for n in normals)
                self.assertLess(worst, 1e-4, where)
                indices = file.column(p["indices"])
                for a, b, c in zip(indices[::3], indices[1::3], indices[2::3]):
                    facing = cross(sub(places[b], places[a]), sub(places[c], places[a]))
                    self.assertGreater(dot(facing, facing), 0, where)
                    for corner in (a, b, c):
                        self.assertGreater(dot(facing, normals[corner]), 0, where)

    def test_have_lights_that_look_up_only_where_the_ceiling_is_meant_to_be_lit(self):
        upward = {"floor lamp", "wall light"}
        for _, file in self.each():
            for mesh, material, p in file.primitives():
                if "emissiveFactor" in material:
                    for normal in file.column(p["attributes"]["NORMAL"]):
                        self.assertEqual(normal[1] > 0, mesh in upward, mesh)

    def test_have_solid_glass_a_camera_and_nothing_outside_the_file(self):
        for name, file in self.each():
            self.assertTrue(file.json["cameras"])
            self.assertNotIn("extensionsRequired", file.json)
            for thing in file.json["buffers"] + file.json.get("images", []):
                self.assertNotIn("uri", thing)
            glass = [m for m in file.json["materials"] if m["name"] == "glass"]
            self.assertEqual(len(glass), 0 if name in ("cornell", "keyhole", "wall_washers", "many_rooms") else 1)
            for material in glass:
                self.assertGreater(
                    material["extensions"]["KHR_materials_volume"]["thicknessFactor"], 0
                )

    def test_come_from_this_generator(self):
        """Those without textures stand for all: they are made in a moment."""
        for scene in (cornell, keyhole, three_turns, wall_washers, many_rooms):
            made = scene.build()
            self.assertEqual(glb.encode(made), (SCENES / f"{made.name}.glb").read_bytes())


if __name__ == "__main__":
    unittest.main()

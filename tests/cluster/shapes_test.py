"""Pictures of odd sizes and patterns, smaller than the pattern too, by the real programs.

Inside of a box whose walls emit radiance 1 and reflect nothing every pixel is 1, but for the codec's rounding of 1/127.5:
a pixel that nobody rendered, or that lies elsewhere, would show.
"""
import json
import subprocess
import unittest

from programs import BIN, ClusterTest

BOX = """mtllib box.mtl
usemtl lamp
""" + "".join(f"v {x} {y} {z}\n" for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)) + """
f 1 2 4 3
f 5 7 8 6
f 1 5 6 2
f 3 4 8 7
f 1 3 7 5
f 2 6 8 4
"""


class Shapes(ClusterTest):
    def setUp(self):
        super().setUp()
        (self.folder / "box.obj").write_text(BOX)
        (self.folder / "box.mtl").write_text("newmtl lamp\nKd 0 0 0\nKs 0 0 0\nKe 1 1 1\n")

    def shape(self, size, pattern, method, name):
        master = self.start(BIN / "ninefold-master", "box.obj", "--camera", "0,0,0:0.2,0.3,-1:60", "--size", size,
                            "--interleave", pattern, "--method", method, "--local-clients", 2, "--frames", 2,
                            "--output", name)
        self.assertEqual(master.ends(), 0, master.text)

    def difference(self, one, other):
        said = subprocess.run([BIN / "ninefold-compare", one, other, "--json"], cwd=self.folder, check=True,
                              capture_output=True, text=True)
        return json.loads(said.stdout)

    def test_every_pixel_is_there(self):
        for size in ("1x1", "7x5", "641x479"):
            self.shape(size, "1x1", "path-trace", "reference.exr")
            for pattern in ("1x1", "2x2", "3x3", "5x4", "8x8"):
                if size == "641x479" and pattern not in ("3x3", "8x8"):
                    continue
                self.shape(size, pattern, "instant-radiosity", "picture.exr")
                found = self.difference("picture.exr", "reference.exr")
                self.assertLess(found["rmse_percent"], 0.8, f"{size}, {pattern}")
                for channel in found["bias"]:
                    self.assertLess(abs(channel), 0.008, f"{size}, {pattern}")


if __name__ == "__main__":
    unittest.main()

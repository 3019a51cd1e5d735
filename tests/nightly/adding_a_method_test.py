"""docs/adding-a-method.md, done: its commands are run one after the other in a copy of the tree, which they patch, build,
test and render with. Then the new method meets its closed form through a real cluster:

    E = pi everywhere, so that a matte wall of reflectance rho shows L = rho

as the code 255 OETF(rho) of a PNG (IEC 61966-2-1; rho below 0.8, where the tone curve is straight), give or take 1.5,
half a code by rounding and one by the table of common/image/tone_map.h. On the wire reflectance and E are rounded, too, without
bias (proto/tile_codec.h): so that the mean over the pixels has that code, and each pixel that of a radiance with

    |L - rho| <= d + (rho + d)/127.5,   d = (2 sqrt(rho) + 1/255)/255

Of the test programs that the page builds, only the files with suites that it runs are copied: the others need not be
compiled.
"""
import math
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / folder) for folder in ("cluster", "docs")]

import page  # noqa: E402
import png  # noqa: E402
from programs import ClusterTest  # noqa: E402

PARTS = ("CMakeLists.txt", "CMakePresets.json", "cmake", "common", "proto", "client", "master", "tools", "tests", "docs",
         "scenes", "scripts", ".clang-format")
REFLECTANCE = (0.6, 0.3, 0.1)
TONE = 1.5  # codes


def copy(tree):
    tree.mkdir()
    for part in PARTS:
        if (page.TREE / part).is_dir():
            shutil.copytree(page.TREE / part, tree / part, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(page.TREE / part, tree / part)
    for folder, suites in page.SUITES.items():
        for test in tree.glob(f"tests/{folder}/*_test.cpp"):
            text = test.read_text(encoding="utf-8")
            if not any(page.has_suite(text, suite) for suite in suites):
                test.unlink()


def code(radiance):
    """Of sRGB, before it is rounded."""
    return 255 * (1.055 * radiance ** (1 / 2.4) - 0.055)


def rounding(rho):
    """Of L on the wire, at most."""
    d = (2 * math.sqrt(rho) + 1 / 255) / 255
    return d + (rho + d) / 127.5


class AddingAMethod(ClusterTest):
    def follow(self, command):
        # A cache that knows nothing of where the copy lies has most of it on the second night.
        environment = page.environment(CCACHE_BASEDIR=str(self.tree), CCACHE_NOHASHDIR="1",
                                       GIT_CEILING_DIRECTORIES=str(self.folder))
        done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=self.tree, env=environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout[-8000:]}")
        if "--gtest_filter" in command:
            self.assertRegex(done.stdout, r"\[  PASSED  \] [1-9]\d* test", command)

    def wall(self):
        (self.folder / "wall.mtl").write_text("newmtl wall\nKd {} {} {}\nKs 0 0 0\n".format(*REFLECTANCE))
        (self.folder / "wall.obj").write_text("mtllib wall.mtl\nusemtl wall\nv -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\n"
                                              "f 1 2 3 4\n")
        return "wall.obj"

    def pixels(self, clients):
        out = self.folder / f"wall{clients}.png"
        master = self.start(self.tree / "build/bin/ninefold-master", self.wall(), "--camera", "0,0,2:0,0,0:40",
                            "--environment", "none", "--method", "constant-light", "--size", "48x36", "--frames", 2,
                            "--local-clients", clients, "--output", out)
        self.assertEqual(master.ends(), 0, master.text)
        return [pixel for row in png.read(out)[2] for pixel in row]

    def test_who_follows_the_page_has_a_method(self):
        self.tree = self.folder / "tree"
        copy(self.tree)
        for command in page.COMMANDS:
            self.follow(command)
        self.assertTrue((self.tree / "constant.png").stat().st_size > 0)

        told = subprocess.run([self.tree / "build/bin/ninefold-master", "--help"], text=True, capture_output=True,
                              check=True).stdout
        self.assertIn("constant-light", told)
        pixels = self.pixels(clients=2)
        self.assertEqual(len(pixels), 48 * 36)
        for channel, rho in zip(zip(*pixels), REFLECTANCE):
            self.assertGreaterEqual(min(channel), code(rho - rounding(rho)) - TONE)
            self.assertLessEqual(max(channel), code(rho + rounding(rho)) + TONE)
            self.assertAlmostEqual(sum(channel) / len(channel), code(rho), delta=TONE)
        self.assertEqual(pixels, self.pixels(clients=1), "whoever renders it")


if __name__ == "__main__":
    unittest.main()

"""Each debug view, headless: what it shows is what it says."""
import collections
import math
import unittest

import png
from programs import BIN, SCENES, ClusterTest, methods

VIEWS = ("beauty", "albedo", "normal", "depth", "direct", "indirect", "caustics", "sets", "error", "objects", "weights")
FRAMES = {"error": 2, "caustics": 4}
SETS = 9


def linear(code):
    """What common/image/tone_map.h made a code of."""
    c = code / 255
    y = c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
    return y if y <= 0.8 else 0.8 - 0.2 * math.log(max(1e-3, 1 - (y - 0.8) / 0.2))


class Views(ClusterTest):
    def view(self, name, scene="table_room", frames=1, *options):
        """Its pixels, row by row, as codes."""
        out = self.folder / f"{name}.png"
        master = self.start(BIN / "ninefold-master", SCENES / f"{scene}.glb", "--size", "96x72", "--local-clients", 2,
                            "--frames", frames, "--view", name, "--output", out, *options)
        self.assertEqual(master.ends(), 0, master.text)
        return [pixel for row in png.read(out)[2] for pixel in row]

    def light(self, pixels):
        return [tuple(map(linear, p)) for p in pixels]

    def mean(self, pixels):
        return sum(sum(p) for p in pixels) / (3 * len(pixels))

    def test_each_shows_what_it_says_by_every_method(self):
        for method in methods():
            with self.subTest(method):
                pictures = {name: self.view(name, "table_room", FRAMES.get(name, 1), "--method", method) for name in VIEWS}
                self.check(method, pictures)

    def is_unfiltered(self, method, beauty):
        """Whether the filter changes nothing in the method's picture."""
        return self.view("beauty", "table_room", 1, "--method", method, "--filter", "none") == beauty

    def check(self, method, pictures):
        self.assertEqual(len(set(map(tuple, pictures.values()))), len(VIEWS), "each is another picture")
        for name, pixels in pictures.items():
            self.assertGreater(self.mean(pixels), 0.2, f"{name} is not black")
        for name in ("depth", "error", "weights"):
            self.assertTrue(all(r == g == b for r, g, b in pictures[name]), f"{name} is grey")
        with self.subTest("normal"):  # n = 2 c - 1 is of length 1
            lengths = [sum((2 * c - 1) ** 2 for c in p) ** 0.5 for p in self.light(pictures["normal"])]
            self.assertGreater(sum(0.97 < length < 1.03 for length in lengths), 0.95 * len(lengths))
        with self.subTest("weights"):
            shares = [p[0] for p in self.light(pictures["weights"])]
            if self.is_unfiltered(method, pictures["beauty"]):  # each pixel is one of the window's nine
                self.assertGreater(sum(abs(s - 1 / SETS) < 0.01 for s in shares), 0.95 * len(shares))
            else:  # most of the room is smooth; along its edges the window is not whole
                self.assertGreater(sum(s > 0.98 for s in shares), 0.6 * len(shares))
                self.assertGreater(sum(0.1 < s < 0.9 for s in shares), 0.03 * len(shares))
        with self.subTest("caustics"):  # below the glass sphere, and hardly anything elsewhere
            caustics = self.light(pictures["caustics"])
            lit = sum(sum(p) > 0.01 for p in caustics)
            self.assertTrue(3 <= lit < 0.3 * len(caustics), f"{lit} pixels in caustics")
            self.assertLess(self.mean(caustics), self.mean(self.light(pictures["beauty"])))
        with self.subTest("sets"):  # interleaved: each has its share of the pixels
            colours = collections.Counter(pictures["sets"])
            self.assertEqual(set(colours.values()), {96 * 72 // SETS})
        with self.subTest("objects"):  # a colour each
            colours = collections.Counter(pictures["objects"])
            self.assertTrue(8 <= len(colours) <= 40, f"{len(colours)} colours")
        with self.subTest("exposure is for light only"):
            brighter = self.view("albedo", "table_room", 1, "--method", method, "--exposure", "2")
            self.assertEqual(pictures["albedo"], brighter)

    def test_photons_are_dots_in_the_dark(self):
        # Some 4,000 hits on 8 R^2, each seen within 0.004 R: 2 to 3 % of the pixels, and the lamp.
        pixels = self.light(self.view("photons", "cornell", 1, "--method", "photon-map", "--filter", "none"))
        lit, dark = (sum(test(sum(p)) for p in pixels) / len(pixels) for test in (lambda s: s > 0.3, lambda s: s == 0))
        self.assertTrue(0.01 < lit < 0.12, f"{lit} of the pixels are lit")
        self.assertGreater(dark, 0.85)
        self.assertGreater(sum(max(p) > 2 * min(p) for p in pixels), 5, "some are coloured")

    def test_direct_and_indirect_light_add_up(self):
        # A diffuse room: beauty is their sum. The lamp itself is in both and is left out.
        beauty, direct, indirect = (self.light(self.view(v, "cornell", 32, "--exposure", "-2"))
                                    for v in ("beauty", "direct", "indirect"))
        part = [i for i in range(len(beauty)) if max(beauty[i]) < 0.9]
        self.assertGreater(len(part), 0.9 * len(beauty))
        means = [self.mean([picture[i] for i in part]) for picture in (beauty, direct, indirect)]
        self.assertAlmostEqual((means[1] + means[2]) / means[0], 1, delta=0.03)
        self.assertTrue(all(m > 0.1 * means[0] for m in means[1:]))


if __name__ == "__main__":
    unittest.main()

"""Every method converges to what the path tracer converges to: small pictures of the shipped scenes, by the real
programs. Where light only comes round corners, path tracing is what knows least: there all methods, path tracing
too, are held against the bidirectional one.

RUNS pictures of each method, each with its own seed; their spread gives the standard errors e (blocks.py).

    bias of each channel    |x - r| / r   at most 0.5 % + 4 e, e itself at most CONFIDENT
    blocks of 16 x 16       t by Student: P of the largest above 1e-4 for all blocks together, unless the block is off
                            by less than 1 % of the image's mean: the photons' radius and the filter at edges
"""
import math
import os
import pathlib
import sys
import unittest

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cluster"))

from programs import ClusterTest, methods  # noqa: E402
from report_lib import blocks  # noqa: E402

RUNS = 8
REFERENCE = "path-trace"
BOTH_ENDS = "bidirectional"
# Scene: frames of a run of a method and of the reference, and how well the mean is then known.
SCENES = {
    "cornell": (64, 64, 0.01), "table_room": (64, 64, 0.01), "egg_room": (64, 64, 0.015),
    "invisible_date": (64, 64, 0.015), "office": (64, 64, 0.015), "conference": (96, 64, 0.03),
}
# The same by method; of the reference first.
DARK_SCENES = {
    "u_office": {BOTH_ENDS: (768, 0.01), REFERENCE: (192, 0.01), "instant-radiosity": (768, 0.02)},
}


class Agreement(ClusterTest):
    SIZE = "64x48"

    def pictures(self, scene, method, frames):
        names = []
        for seed in range(1, RUNS + 1):
            self.render("--local-clients", os.cpu_count() or 1, "--method", method, "--seed", seed, scene=scene,
                        frames=frames)
            names.append(str(self.folder / f"out{self.runs}.exr"))
        return blocks.of_pictures(names)

    def test_scenes_converge_to_the_reference(self):
        for scene, (frames, reference_frames, confident) in SCENES.items():
            r = self.pictures(scene, REFERENCE, reference_frames)
            for method in methods():
                if method != REFERENCE:
                    with self.subTest(scene=scene, method=method):
                        self.converges(f"{scene} by {method}", self.pictures(scene, method, frames), r, confident)

    def test_dark_scenes_converge_to_the_bidirectional_method(self):
        for scene, runs in DARK_SCENES.items():
            r = self.pictures(scene, BOTH_ENDS, runs[BOTH_ENDS][0])
            self.assertLess((r.channel_error / r.channel_mean).max(), runs[BOTH_ENDS][1])
            for method, (frames, confident) in runs.items():
                if method != BOTH_ENDS:
                    with self.subTest(scene=scene, method=method):
                        self.converges(f"{scene} by {method}", self.pictures(scene, method, frames), r, confident)

    def converges(self, what, x, r, confident):
        bias = (x.channel_mean - r.channel_mean) / r.channel_mean
        error = numpy.sqrt(x.channel_error ** 2 + r.channel_error ** 2) / r.channel_mean
        apart = blocks.difference(x, r)
        chance = [1 if f == 0 else blocks.two_sided(abs(t), f)
                  for t, f in zip(apart.t.flat, apart.freedom.flat)]
        beyond = [i for i, p in enumerate(chance)
                  if p < 1e-4 / len(chance) and abs(apart.relative.flat[i]) > 0.01]
        print(f"{what}: bias {100 * bias} % +- {100 * error} %, blocks differ by "
              f"{100 * math.sqrt((apart.relative ** 2).mean()):.2f} % ({100 * apart.expected:.2f} % expected), "
              f"least P {min(chance):.2g}", flush=True)
        self.assertLess(error.max(), confident)
        self.assertTrue((abs(bias) <= 0.005 + 4 * error).all(), bias)
        self.assertEqual(beyond, [])


if __name__ == "__main__":
    unittest.main()

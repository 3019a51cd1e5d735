"""The intersection field at the size that was published, 76 x 127 x 76 x 127 in each of four groups of lines, by the real programs: on
the Cornell box, against the path tracer. Lines that count alike, as published, find another V than lines that count by their measure.
"""
import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cluster"))

from programs import ClusterTest  # noqa: E402
from report_lib import pictures  # noqa: E402

REFERENCE_FRAMES = 512
FRAMES = 8


class PublishedField(ClusterTest):
    SIZE = "64x48"

    def mean(self, *options, frames=FRAMES):
        self.render("--local-clients", 1, "--client-threads", os.cpu_count() or 1, "--filter", "none", *options, frames=frames)
        return pictures.read(str(self.folder / f"out{self.runs}.exr")).mean(axis=(0, 1))

    def test_it_has_the_light_of_the_cornell_box(self):
        reference = self.mean("--method", "path-trace", frames=REFERENCE_FRAMES)
        for flags, allowed in (((), 0.06), (("--field-weights", "measure"), 0.02)):
            found = self.mean("--preset", "ren", *flags)
            for channel, (x, r) in enumerate(zip(found, reference)):
                self.assertLess(abs(x - r) / r, allowed, f"{flags}, channel {channel}: {x} for {r}")


if __name__ == "__main__":
    unittest.main()

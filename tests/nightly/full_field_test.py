"""An intersection field with as many lines as published, in a cluster of real programs: the same picture on any of them."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cluster"))

from programs import ClusterTest  # noqa: E402


class FullField(ClusterTest):
    def test_one_client_and_two_make_the_same_picture(self):
        for direct in ("vpls", "field"):
            hashes = {self.render("--method", "intersection-field", "--field-directions", 76, "--field-distances", 127,
                                  "--field-direct", direct, "--local-clients", clients, frames=8)["image_hash"] for clients in (1, 2)}
            self.assertEqual(len(hashes), 1, hashes)


if __name__ == "__main__":
    unittest.main()

"""An intersection field in a cluster of real programs: whoever dies and joins, in a run at rest or in the middle of an edit,
the pictures are those of a run in peace.
"""
import unittest

from programs import BIN, SCENES
from state_test import State


class IntersectionField(State):
    METHOD = ("--method", "intersection-field", "--field-photons", 4096, "--field-directions", 7, "--field-distances", 12)
    UNITS = 4096 // 256
    LONG = 40
    LATE = 400

    # Its sums are nobody's to overflow.
    test_a_sum_that_overflows_ends_the_run_and_says_which = None

    def test_direct_light_by_lines_is_the_same_on_any_cluster(self):
        hashes = {self.render(*self.METHOD, "--field-direct", "field", "--local-clients", clients, frames=4)["image_hash"]
                  for clients in (1, 2)}
        self.assertEqual(len(hashes), 1, hashes)
        self.assertNotIn(self.render(*self.METHOD, frames=4)["image_hash"], hashes)

    def test_a_field_that_is_too_large_is_refused_in_one_line(self):
        master = self.master("--method", "intersection-field", "--max-field-memory", 1, "--local-clients", 1, frames=1)
        self.assertEqual(master.ends(), 1, master.text)
        self.assertRegex(master.text, "the intersection field would take \\d+ MiB, --max-field-memory is 1: raise it, or use "
                                      "--field-directions \\d+ --field-distances \\d+")

    def test_so_it_is_in_a_session_in_real_time(self):
        (self.folder / "s.json").write_text('{"seconds": 30, "events": []}')
        master = self.start(BIN / "ninefold-master", SCENES / "cornell.glb", "--size", self.SIZE, "--script", "s.json",
                            "--method", "intersection-field", "--max-field-memory", 1, "--local-clients", 1, "--output", "a.exr")
        self.assertEqual(master.ends(), 1, master.text)
        self.assertRegex(master.text, "the intersection field would take \\d+ MiB, --max-field-memory is 1")


del State  # its own tests run elsewhere

if __name__ == "__main__":
    unittest.main()

"""An intersection field in a cluster of real programs: whoever dies and joins, in a run at rest or in the middle of an edit,
the pictures are those of a run in peace.
"""
import json
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

    # The tall block of cornell grows by a twist: 37 MiB have room for the field before, not for the one after.
    TWIST = {"from": 0, "to": 4, "object": "tall block", "twist": 340}
    SMALL = ("--method", "intersection-field", "--field-photons", 4096, "--max-field-memory", 37)
    FEWER = ("after this edit the intersection field would take \\d+ MiB, --max-field-memory is 37: raise it, or use "
             "--field-directions \\d+ --field-distances \\d+; the picture goes on with \\d+ x \\d+")

    def script(self, **more):
        (self.folder / "s.json").write_text(json.dumps({"seconds": 4, "events": [self.TWIST], **more}))
        return SCENES / "cornell.glb", "--size", self.SIZE, "--script", "s.json", *self.SMALL

    def test_an_edit_that_makes_it_too_large_goes_on_with_fewer_lines(self):
        master = self.start(BIN / "ninefold-master", *self.script(), "--local-clients", 1, "--output", "a.png")
        self.assertEqual(master.ends(), 0, master.text)
        self.assertRegex(master.text, self.FEWER)  # more than once if a state between has room for all lines
        self.assertNotIn("is gone", master.text)

    def test_and_all_clients_go_on_with_as_many(self):
        stills = []
        for clients in (1, 2):
            master = self.start(BIN / "ninefold-master", *self.script(rate=1, frames=2), "--local-clients", clients,
                                "--wait-clients", clients, "--output", f"{clients}.#.png")
            self.assertEqual(master.ends(), 0, master.text)
            self.assertRegex(master.text, self.FEWER)
            stills.append([file.read_bytes() for file in sorted(self.folder.glob(f"{clients}.*.png"))])
        self.assertEqual(len(stills[0]), 5)
        self.assertTrue(stills[0] == stills[1])


del State  # its own tests run elsewhere

if __name__ == "__main__":
    unittest.main()

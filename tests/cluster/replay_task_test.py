"""A task done again alone has the bytes that the client sent: from a recording, from flags, from a client's line.

The tool compares decoded tiles: a hash of all planes. A run with one client has every task in its recording.
"""
import json
import re
import subprocess
import unittest

from programs import BIN, SCENES, ClusterTest


class ReplayTask(ClusterTest):
    SIZE = "200x150"

    def again(self, *arguments, status=0):
        done = subprocess.run([str(a) for a in (BIN / "ninefold-replay-task", *arguments)], cwd=self.folder,
                              capture_output=True, text=True, timeout=100)
        if status is not None:
            self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout if done.returncode == 0 else done.stderr.splitlines()[-1]

    def recorded(self, *options, **more):
        """A run whose only client keeps what it did in the file r."""
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", *options, **more)
        self.record(master)
        return self.finish(master)

    def record(self, master):
        client = self.start(BIN / "ninefold-client", "--master", self.address_of(master), "--key-file", "cluster.key",
                            "--threads", 1, "--cache", "none", "--record", "r")
        self.assertEqual(client.ends(), 0, client.text)

    def hash_of(self, text):
        return re.search(r"^hash ([0-9a-f]{16})$", text, re.M).group(1)

    def task(self, frame, tile, phase):
        return ["--frame", frame, "--tile", tile, "--phase", phase]

    def same_as_recorded(self, scene, place, *more):
        text = self.again(SCENES / f"{scene}.glb", *self.task(*place), "--recording", "r", *more)
        self.assertIn(f"recorded {self.hash_of(text)}, ", text)
        return text

    def test_without_a_scene_it_names_its_own_help(self):
        self.assertEqual(self.again(*self.task(0, 0, 0), status=2),
                         "ninefold-replay-task: SCENE is missing; see ninefold-replay-task --help")

    def test_tasks_of_a_still_have_the_recorded_bytes_from_the_recording_and_from_flags(self):
        flags = ["--size", self.SIZE]
        self.recorded("--seed", 7, scene="table_room", frames=3)
        hashes = set()
        for place in ((0, 0, 0), (1, 3, 4), (2, 1, 8)):
            text = self.same_as_recorded("table_room", place)
            hashes.add(self.hash_of(text))
            self.assertRegex(text, r"\d+\.\d+ ms with 1 light set\(s\); rays: \d+ of the eye")
            self.assertIn("values that are not finite or negative: 0\n", text)
            alone = self.again(SCENES / "table_room.glb", *self.task(*place), *flags, "--seed", 7)
            self.assertEqual(self.hash_of(alone), self.hash_of(text))
            other = self.again(SCENES / "table_room.glb", *self.task(*place), *flags, "--seed", 8)
            self.assertNotEqual(self.hash_of(other), self.hash_of(text))
        self.assertEqual(len(hashes), 3)

    def test_tiles_that_clients_filter_are_done_again_as_well(self):
        self.recorded("--filter-at", "clients", "--wire-level", 0, frames=4)
        self.same_as_recorded("cornell", (3, 0, 0))

    def test_edits_are_part_of_the_recorded_task(self):
        (self.folder / "s.json").write_text(json.dumps({"seconds": 1, "rate": 4, "frames": 2, "events": [
            {"from": 0, "to": 1, "object": "glass sphere", "by": [0.3, 0, 0.1]},
            {"from": 0, "to": 1, "material": "lamp", "emission": [4, 1, 1]}]}))
        self.new_key()
        master = self.start(BIN / "ninefold-master", SCENES / "table_room.glb", "--size", self.SIZE, "--script",
                            "s.json", "--output", "p.#.png", "--local-clients", 0, "--key-file", "cluster.key")
        self.record(master)
        self.assertEqual(master.ends(), 0, master.text)
        seen = {self.hash_of(self.same_as_recorded("table_room", (frame, 0, 2))) for frame in (0, 4, 8)}
        self.assertEqual(len(seen), 3, "the edits do not show")

    def test_tasks_of_a_gesture_are_done_again_as_well(self):
        (self.folder / "s.json").write_text(json.dumps({"seconds": 2, "events": [
            {"from": 0, "to": 2, "object": "glass sphere", "by": [0.3, 0, 0.1]}]}))
        self.new_key()
        master = self.start(BIN / "ninefold-master", SCENES / "table_room.glb", "--size", self.SIZE, "--script",
                            "s.json", "--output", "last.png", "--local-clients", 0, "--key-file", "cluster.key",
                            "--frame-time", 1000)
        self.record(master)
        self.assertEqual(master.ends(), 0, master.text)
        # Tile 1 has the sphere itself: it shows each step, however small. A busy machine makes few frames; so much time
        # for each keeps them large enough to have such a tile.
        scene = SCENES / "table_room.glb"
        texts = [self.again(scene, *self.task(frame, 1, 2), "--recording", "r", status=None) for frame in range(12)]
        done = [text for text in texts if "hash" in text and "recorded" in text]
        self.assertGreater(len(done), 1, texts)
        self.assertEqual(len({self.hash_of(text) for text in done}), len(done), "the gesture does not show")

    def test_light_that_was_made_for_the_last_views_is_made_again(self):
        (self.folder / "s.json").write_text(json.dumps({"seconds": 2, "events": [
            {"from": 0, "to": 2, "camera": ["0.15,1.5,2.25:0,1.5,-0.5:60", "0.35,1.5,2.2:0.4,1.5,-0.5:60"]}]}))
        self.new_key()
        master = self.start(BIN / "ninefold-master", SCENES / "table_room.glb", "--size", "100x75", "--script", "s.json",
                            "--output", "last.png", "--local-clients", 0, "--key-file", "cluster.key", "--method",
                            "bidirectional")
        self.record(master)
        self.assertEqual(master.ends(), 0, master.text)
        scene = SCENES / "table_room.glb"
        texts = [self.again(scene, *self.task(frame, 0, 2), "--recording", "r", status=None) for frame in range(12)]
        done = [text for text in texts if "hash" in text and "recorded" in text]
        self.assertGreater(len(done), 1, texts)
        self.assertEqual(len({self.hash_of(text) for text in done}), len(done), "the walk does not show")

    def test_light_for_other_views_by_a_flag(self):
        """With so few candidates that no pilot is asked, which only a view at rest has."""
        def hash_for(*more):
            return self.hash_of(self.again(SCENES / "table_room.glb", *self.task("3:0:0:0.1", 0, 2), "--size", "100x75",
                                           "--method", "bidirectional", "--resampling", 4, *more))
        own, other = hash_for(), "0.35,1.5,2.2:0.4,1.5,-0.5:60"
        self.assertEqual(hash_for("--light-cameras", "/".join(8 * "0")), own)
        self.assertNotEqual(hash_for("--light-cameras", f"0/{other}"), own)
        self.assertIn("9 are given, at most 8 can be", self.again(SCENES / "table_room.glb", *self.task(0, 0, 0), "--light-cameras",
                                              "/".join(9 * "0"), status=2))

    def test_what_is_not_there_ends_in_one_line(self):
        self.recorded(frames=1)
        scene, recording = SCENES / "cornell.glb", ["--recording", "r"]
        for line, expected in ((self.again(scene, *self.task(5, 0, 0), *recording, status=1),
                                "the recording holds no task of frame 5, tile 0, phase 0; it begins with frame 0"),
                               (self.again(SCENES / "office.glb", *self.task(0, 0, 0), *recording, status=1),
                                "is not the scene of r; give the file that the master had then"),
                               (self.again(scene, *self.task(0, 900, 0), status=1),
                                "tile 900, phase 0: there are 35 tiles of 9 phases"),
                               (self.again(scene, *self.task(0, 0, 0), *recording, "--seed", 3, status=2),
                                "--seed: with --recording the picture is the recorded one"),
                               (self.again(scene, "--frame", 0, "--tile", 0, status=2), "--phase is missing"),
                               (self.again(scene, *self.task("1:2", 0, 0), status=2),
                                "--frame 1:2: must be N or N:RANDOMIZATION:ROTATION:RADIUS"),
                               (self.again(scene, *self.task(0, 0, 0), "--recording", "none", status=1),
                                "recording none: No such file or directory")):
            self.assertIn(expected, line)


if __name__ == "__main__":
    unittest.main()

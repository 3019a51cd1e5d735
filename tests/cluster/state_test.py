"""A method's state in a cluster of real programs. The method state-check shows which state lit a frame, to the bit:
each step depends on all before it (common/gi/state_check). Builds for tests have it.
"""
import json
import re
import subprocess
import unittest

from programs import BIN, SCENES, ClusterTest, signal


class State(ClusterTest):
    SIZE = "48x36"
    METHOD = ("--method", "state-check")
    UNITS = 6  # of a step
    LONG = 60  # frames: enough to lose or find somebody in the middle
    LATE = 700  # and for somebody to come late

    def test_any_number_of_clients_and_threads(self):
        hashes = set()
        for clients, threads in ((1, 1), (2, 1), (5, 1), (1, 2), (2, 2)):
            stats = self.render(*self.METHOD, "--local-clients", clients, "--client-threads", threads, frames=4)
            hashes.add(stats["image_hash"])
            self.assertEqual(stats["state"]["steps"], 4, stats)
            self.assertEqual(stats["state"]["units"], 4 * self.UNITS)
            self.assertGreater(stats["state"]["bytes_received"], 0)
            self.assertGreater(stats["state"]["bytes_sent"], 0)
        self.assertEqual(len(hashes), 1, hashes)

    def test_each_step_counts_for_all_pictures_after_it(self):
        hashes = [self.render(*self.METHOD, "--seed", seed, frames=frames)["image_hash"]
                  for seed, frames in ((1, 1), (1, 2), (1, 3), (2, 3))]
        self.assertEqual(len(set(hashes)), 4)

    def test_a_killed_client_does_not_show(self):
        undisturbed = self.render(*self.METHOD, "--local-clients", 2, frames=self.LONG)
        master = self.master(*self.METHOD, "--local-clients", 2, "--wait-clients", 2, frames=self.LONG)
        master.waits_for(r"client \d+ is ready(.|\n)*client \d+ is ready")
        self.send(master.children()[0], signal.SIGKILL)
        stats = self.finish(master)
        self.assertIn("signal 9", master.text)
        self.assertEqual(stats["image_hash"], undisturbed["image_hash"])

    def test_who_comes_late_has_the_state_of_all_others(self):
        self.new_key()
        frames = self.LATE
        undisturbed = self.render(*self.METHOD, "--local-clients", 1, frames=frames)
        master = self.master(*self.METHOD, "--local-clients", 0, "--key-file", "cluster.key", frames=frames)
        address = self.address_of(master)
        first = self.client(address)
        master.waits_for(r"progress: \d+% frame [1-9]")
        late = self.client(address)
        master.waits_for("client 2 is ready")
        first.process.kill()  # what is left is the late one's alone
        stats = self.finish(master)
        self.assertEqual(late.ends(), 0, late.text)
        self.assertEqual(stats["image_hash"], undisturbed["image_hash"])
        self.assertEqual(sum(client["tasks"] > 0 for client in stats["clients"]), 2)

    def test_all_clients_may_be_lost(self):
        self.new_key()
        frames = 60
        undisturbed = self.render(*self.METHOD, "--local-clients", 1, frames=frames)
        master = self.master(*self.METHOD, "--local-clients", 0, "--key-file", "cluster.key", frames=frames)
        address = self.address_of(master)
        for number in (1, 2):
            client = self.client(address)
            master.waits_for(rf"client {number} is ready")
            client.process.kill()
            master.waits_for(rf"client {number} is gone")
        self.client(address)
        self.assertEqual(self.finish(master)["image_hash"], undisturbed["image_hash"])

    def test_edits_of_a_script_meet_the_same_state_whoever_dies_and_joins(self):
        (self.folder / "s.json").write_text(json.dumps({"seconds": 4, "rate": 10, "frames": 2, "events": [
            {"from": 0, "to": 4, "object": "glass sphere", "by": [0.3, 0, 0.1]}]}))
        options = (SCENES / "table_room.glb", "--size", self.SIZE, *self.METHOD, "--script", "s.json")
        calm = self.start(BIN / "ninefold-master", *options, "--local-clients", 2, "--output", "calm.##.png")
        self.assertEqual(calm.ends(), 0, calm.text)
        self.new_key()
        wild = self.start(BIN / "ninefold-master", *options, "--local-clients", 0, "--key-file", "cluster.key",
                          "--output", "wild.##.png")
        address = self.address_of(wild)
        before = self.client(address)
        for number, picture in enumerate((3, 12, 21), 2):  # somebody is always there: each step counts once
            wild.waits_for(f"picture {picture} of 41")
            after = self.client(address)
            wild.waits_for(f"client {number} is ready")
            self.send(before.process.pid, signal.SIGKILL)
            before = after
        self.assertEqual(wild.ends(), 0, wild.text)
        pictures = [[p.read_bytes() for p in sorted(self.folder.glob(f"{kind}.*.png"))] for kind in ("calm", "wild")]
        self.assertEqual(len(set(pictures[0])), 41)
        self.assertEqual([i for i in range(41) if pictures[0][i] != pictures[1][i]], [])

    def test_a_sum_that_overflows_ends_the_run_and_says_which(self):
        master = self.master(*self.METHOD, "--seed", 0, "--local-clients", 1, frames=8)
        self.assertEqual(master.ends(), 1, master.text)
        self.assertRegex(master.text, "sum 7 of page 1.0 of a method's state overflows")

    def test_a_task_is_done_again_by_the_same_state(self):
        """By the flags of a headless run the state is made anew, step by step."""
        hashes = set()
        for frame in (0, 3):
            hashes.add(self.replayed("--size", self.SIZE, *self.METHOD, "--frame", frame))
        self.assertEqual(len(hashes), 2)
        self.new_key()
        master = self.master(*self.METHOD, "--local-clients", 0, "--key-file", "cluster.key", frames=4)
        recorder = self.start(BIN / "ninefold-client", "--master", self.address_of(master), "--key-file", "cluster.key",
                              "--threads", 1, "--cache", "none", "--record", "run.bin")
        self.finish(master)
        self.assertEqual(recorder.ends(), 0, recorder.text)
        last = 7  # number of the last frame: each has a step before it
        self.assertIn(self.replayed("--recording", "run.bin", "--frame", last), hashes)

    def test_replay_clients_say_that_they_cannot_answer_steps(self):
        self.new_key()
        master = self.master(*self.METHOD, "--local-clients", 0, "--key-file", "cluster.key", frames=2)
        recorder = self.start(BIN / "ninefold-client", "--master", self.address_of(master), "--key-file", "cluster.key",
                              "--threads", 1, "--cache", "none", "--record", "run.bin")
        self.finish(master)
        self.assertEqual(recorder.ends(), 0, recorder.text)
        master = self.master(*self.METHOD, "--local-clients", 0, "--key-file", "cluster.key", frames=2)
        replay = self.start(BIN / "ninefold-replay-client", "--master", self.address_of(master), "--key-file",
                            "cluster.key", "--recording", "run.bin")
        self.assertEqual(replay.ends(), 1, replay.text)
        self.assertRegex(replay.text, "has a state, whose steps no recording can answer")

    def replayed(self, *options):
        """The hash of a task's tile, done again."""
        done = subprocess.run([BIN / "ninefold-replay-task", SCENES / "cornell.glb", *map(str, options), "--tile", "0",
                               "--phase", "0"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return re.search(r"hash (\w+)", done.stdout).group(1)


if __name__ == "__main__":
    unittest.main()

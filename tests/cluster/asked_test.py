"""SIGUSR2 asks a running master what is under way; it tells that in its log, and nothing else changes."""
import json
import time
import unittest

from programs import BIN, SCENES, ClusterTest, eventually, signal


class Asked(ClusterTest):
    def ask(self, program, pattern):
        """Asks until the log has an answer like that: what is under way differs from moment to moment."""
        def answered():
            self.assertIsNone(program.process.poll(), f"no {pattern!r} in:\n{program.text}")
            self.send(program.process.pid, signal.SIGUSR2)
            time.sleep(0.02)
            return pattern in program.text
        eventually(answered, pattern)

    def test_a_master_without_clients_says_for_how_many_it_waits(self):
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", "--wait-clients", 2)
        self.address_of(master)
        self.ask(master, "state: no frame yet: 0 of 2 clients are ready (--wait-clients)")
        self.send(master.process.pid, signal.SIGTERM)
        self.assertEqual(master.ends(), 143, master.text)

    def test_a_run_tells_frames_tasks_and_clients_and_gives_the_same_picture(self):
        calm = self.render("--local-clients", 2, "--frames", 40, frames=None)
        master = self.master("--local-clients", 2, "--frames", 40, frames=None)
        eventually(lambda: master.lines, "a line: its main has begun")
        while master.process.poll() is None:  # from then on to its last moment
            self.send(master.process.pid, signal.SIGUSR2)
            time.sleep(0.005)
        stats = self.finish(master)
        self.assertEqual(stats["image_hash"], calm["image_hash"])
        states = "\n".join(line for line in master.lines if "state: " in line)
        self.assertRegex(states, r"state: 2 ready")
        self.assertRegex(states, r"state: frame \d+: \d+ of 9 tasks are done, \d+ are at clients, \d+ wait")
        self.assertRegex(states, r"state: tile \d+ phase \d of frame \d+: in flight at client [12] for \d+ ms")
        self.assertRegex(states, r"state: client [12], local[12] \(127\.0\.0\.1:\d+\): holds \d+ tasks, refilled at "
                                 r"\d+ up to \d+, [\d.]+ ms each; the oldest is frame \d+, tile \d+, set \d")
        self.assertNotIn("internal error", master.text)

    def test_a_script_is_asked_as_well(self):
        (self.folder / "s.json").write_text(json.dumps({"seconds": 1, "rate": 4, "frames": 40, "events": [
            {"from": 0, "to": 1, "camera": ["0.15,1.5,2.25:0,1.5,-0.5:60", "0.4,1.5,2.25:0,1.5,-0.5:60"]}]}))
        program = self.start(BIN / "ninefold-master", SCENES / "table_room.glb", "--size", self.SIZE,
                             "--local-clients", 1, "--script", "s.json", "--output", "p.#.png")
        program.waits_for("picture 1 of 5")
        self.ask(program, "state: client 1, local1 ")
        self.assertEqual(program.ends(), 0, program.text)


if __name__ == "__main__":
    unittest.main()

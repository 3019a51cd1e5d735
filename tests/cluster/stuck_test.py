"""Clients with a task that never ends: told of, worked around, restarted; and when to give up.

The sleeping client (sleeping_client.cpp) is a real one of which one task sleeps while its heartbeats go
on. Its deadline is 10 s and a little, once it has given results (master/scheduling/scheduler_client.h).
"""
import json
import shutil
import unittest

from programs import BIN, SCENES, ClusterTest, eventually, is_running, signal

SLEEPER = BIN / "sleeping-client"


class Stuck(ClusterTest):
    def sleeper(self, address, **variables):
        """Alone with the master; `after=40` sets SLEEPER_AFTER=40."""
        return self.start("env", *self.settings(variables), SLEEPER, "--master", address, "--key-file",
                          "cluster.key", "--threads", 1, "--cache", "none")

    def settings(self, variables):
        return [f"SLEEPER_{name.upper()}={value}" for name, value in variables.items()]

    def remote_master(self, *options, **more):
        self.new_key()
        return self.master("--local-clients", 0, "--key-file", "cluster.key", *options, **more)

    def local_master(self, variables, *options):
        """A master whose local clients sleep: it starts the program beside itself."""
        shutil.copy(BIN / "ninefold-master", self.folder)
        shutil.copy(SLEEPER, self.folder / "ninefold-client")
        self.runs += 1
        master = self.start("env", *self.settings(variables), self.folder / "ninefold-master",
                            SCENES / "cornell.glb", "--size", self.SIZE, "--local-clients", 1,
                            "--frames", 8, "--output", f"out{self.runs}.exr", "--stats",
                            f"stats{self.runs}.json", *options)
        master.picture = self.folder / f"out{self.runs}.exr"
        master.stats_file = self.folder / f"stats{self.runs}.json"
        return master

    def expected_hash(self):
        return self.render("--local-clients", 1)["image_hash"]

    def test_a_stuck_client_is_told_of_and_others_do_its_work_with_the_same_bytes(self):
        master = self.remote_master()
        address = self.address_of(master)
        self.sleeper(address, after=40)
        task = master.waits_for(r"client 1, .*, is stuck: (frame \d+, tile \d+, set \d) is not done after "
                                r"1\d s; its tasks go to others")
        self.assertTrue(task.group(1).startswith("frame 4, "), "40 are four frames of 9 and some")
        master.waits_for(r"nothing has moved for 1\d s: all clients are stuck")
        master.waits_for(r"progress: .*1 stuck")
        self.client(address)
        stats = self.finish(master)
        self.assertEqual(stats["clients_stuck"], 1)
        self.assertEqual(stats["stalls"], 1)
        self.assertEqual([c["stuck"] for c in stats["clients"]], [1, 0])
        self.assertEqual(stats["values_not_finite"], 0)
        self.assertEqual(stats["image_hash"], self.expected_hash())
        self.assertEqual(master.text.count(" is stuck: "), 1, master.text)

    def test_when_nothing_moves_for_long_the_run_ends_with_what_there_is(self):
        master = self.remote_master("--patience", 2)
        self.sleeper(self.address_of(master), after=20)  # two frames of 9 and some
        self.assertEqual(master.ends(), 1, master.text)
        self.assertTrue(master.picture.exists())
        stats = json.loads(master.stats_file.read_text())
        self.assertEqual((stats["frames"], stats["clients_stuck"], stats["stalls"]), (2, 1, 1))
        last = [line for line in master.lines if line][-1]
        self.assertRegex(last, r"^ninefold-master: all clients are stuck and nothing has moved for 1\d s: "
                         r"client 1 in frame 2, tile 0, set \d; --patience S waits longer$")

    def test_when_all_local_clients_are_silent_the_run_ends_with_what_there_is(self):
        master = self.master("--local-clients", 2, "--patience", 2, frames=100000)
        master.waits_for(r"progress: \d+% frame [1-9]")
        clients = master.children()
        self.assertEqual(len(clients), 2)
        for client in clients:
            self.send(client, signal.SIGSTOP)
        master.waits_for(r"no client is left\n")
        self.assertEqual(master.ends(), 1, master.text)
        self.assertTrue(master.picture.exists())
        last = [line for line in master.lines if line][-1]
        self.assertRegex(last, r"^ninefold-master: no client has been there for \d+ s; --patience S waits longer$")
        eventually(lambda: not any(is_running(client) for client in clients), "no client is left behind")

    def test_a_client_that_comes_back_goes_on(self):
        master = self.remote_master("--patience", 60)
        self.sleeper(self.address_of(master), **{"after": 40, "for": 14})
        master.waits_for(r"client 1, .*, is stuck: ")
        master.waits_for(r"client 1, .*, is back after being stuck for \d s")
        stats = self.finish(master)
        self.assertEqual(stats["image_hash"], self.expected_hash())

    def test_a_local_client_that_hangs_three_times_without_a_result_ends_the_run(self):
        master = self.local_master({"after": 0, "grace": -29.5})
        self.assertEqual(master.ends(), 1, master.text)
        self.assertEqual(master.text.count("this client ends: not done after "), 3, master.text)
        self.assertRegex(master.text, r"client local1.*: not done after \d+ s is frame 0, tile \d+, set \d "
                                      r"\(again: ninefold-replay-task SCENE .*--size 96x72 .*--seed 1[ )]")
        last = [line for line in master.lines if line][-1]
        self.assertRegex(last, r"^ninefold-master: local client 1 hung 3 times in a row without a result, "
                               r"at last in frame 0, tile \d+, set \d, and is given up")
        stats = json.loads(master.stats_file.read_text())
        self.assertEqual((stats["frames"], [c["tasks"] for c in stats["clients"]]), (0, [0, 0, 0]))
        self.assertFalse(master.picture.exists())

    def test_a_local_client_that_gives_results_between_its_hangs_is_started_again(self):
        master = self.local_master({"after": 15, "grace": -9.5})  # of 72 tasks
        stats = self.finish(master)
        self.assertGreaterEqual(master.text.count("this client ends: not done after "), 4, master.text)
        self.assertRegex(master.text, r"local client 1 hung in frame \d, tile \d, set \d and ended itself; "
                                      "starting it again")
        self.assertEqual(stats["image_hash"], self.expected_hash())


if __name__ == "__main__":
    unittest.main()

"""--verify: who gives wrong results is found, expelled, and leaves no trace in the picture.

The wrong client (wrong_client.cpp) is a real one that adds 1 % of light to one pixel in a thousand, or one amount
to a unit of a step. Where the picture is to be healed for certain, each task of it is wrong, so that it never agrees with
anybody: which results are checked is a function of the seed, but who is given them is not.
"""
import json
import unittest

from programs import BIN, ClusterTest

WRONG = BIN / "wrong-client"


class Verify(ClusterTest):
    FRAMES = 60

    def wrong_client(self, address, **variables):
        settings = [f"WRONG_{name.upper()}={value}" for name, value in variables.items()]
        return self.start("env", *settings, WRONG, "--master", address, "--key-file", "cluster.key", "--threads", 1,
                          "--cache", "none")

    def remote_master(self, *options, clients, frames=FRAMES, **more):
        self.new_key() if not (self.folder / "cluster.key").exists() else None
        return self.master("--local-clients", 0, "--key-file", "cluster.key", "--wait-clients", clients, *options,
                           frames=frames, **more)

    def spoilt_run(self, *options, fraction=0.3, frames=FRAMES, scene="cornell", **variables):
        """A run with two good clients and a wrong one; its statistics, and those of a calm one."""
        calm = self.render("--local-clients", 2, *options, frames=frames, scene=scene)
        master = self.remote_master("--verify", fraction, *options, clients=3, frames=frames, scene=scene)
        address = self.address_of(master)
        wrong = self.wrong_client(address, **variables)
        self.client(address), self.client(address)
        stats = self.finish(master)
        self.assertEqual(wrong.ends(), 1, wrong.text)
        self.assertRegex(wrong.text, "two others gave something else")
        self.assertRegex(master.text, r"client \d+ is gone: .*: its result for .* is wrong: two others gave something else")
        self.assertRegex(master.text, r"goes back to the picture of \d+ frame\(s\), which is trusted")
        self.assertEqual(stats["image_hash"], calm["image_hash"])
        self.assertEqual(stats["relative_error"], calm["relative_error"])
        self.assertEqual(stats["frames"], frames)
        self.assertGreaterEqual(stats["verify"]["wrong"], 1)
        self.assertEqual(stats["verify"]["expelled"], 1)
        self.assertEqual(stats["verify"]["disputed"], 0)
        return stats

    def test_a_wrong_client_shows_without_verification(self):
        calm = self.render("--local-clients", 1, frames=8)
        master = self.remote_master(clients=1, frames=8)
        self.wrong_client(self.address_of(master), pixels=1000)
        self.assertNotEqual(self.finish(master)["image_hash"], calm["image_hash"])

    def test_one_percent_in_one_of_a_thousand_pixels_is_found_and_undone(self):
        self.spoilt_run(pixels=1000)

    def test_the_same_when_all_are_checked(self):
        self.spoilt_run(fraction=1, pixels=200)

    def test_units_of_steps_are_checked_too(self):
        self.spoilt_run("--method", "state-check", units=1)

    def test_a_unit_that_is_wrong_now_and_then_leaves_no_trace_if_all_are_checked(self):
        """Whether the client meets such a unit depends on what it is given; that it shows must not."""
        options = ("--method", "state-check")
        calm = self.render("--local-clients", 2, *options, frames=self.FRAMES)
        master = self.remote_master("--verify", 1, *options, clients=3)
        address = self.address_of(master)
        self.wrong_client(address, units=20)
        self.client(address), self.client(address)
        self.assertEqual(self.finish(master)["image_hash"], calm["image_hash"])

    def faulty_run(self, fraction):
        """A client that errs in one task of twenty, beside two good ones; the statistics, and those of a calm run."""
        calm = self.render("--local-clients", 2, frames=self.FRAMES)
        master = self.remote_master("--verify", fraction, clients=3)
        address = self.address_of(master)
        wrong = self.wrong_client(address, pixels=200, tasks=20)
        self.client(address), self.client(address)
        stats = self.finish(master)
        wrong.close()
        return stats, calm

    def test_faults_now_and_then_leave_no_trace_if_all_are_checked(self):
        stats, calm = self.faulty_run(1)
        self.assertEqual(stats["image_hash"], calm["image_hash"])
        self.assertEqual(stats["verify"]["expelled"], min(1, stats["verify"]["wrong"]))

    def test_of_faults_now_and_then_no_checked_one_stays(self):
        """What nobody checked may (verification_test.cpp says how much); the run must end well, whatever was met."""
        stats, _ = self.faulty_run(0.3)
        self.assertEqual(stats["frames"], self.FRAMES)
        self.assertEqual(stats["verify"]["disputed"], 0)
        self.assertEqual(stats["verify"]["expelled"], min(1, stats["verify"]["wrong"]))

    def test_a_photon_map_with_wrong_photons_is_undone(self):
        self.spoilt_run("--method", "photon-map", "--map-photons", 400, "--map-photons-per-frame", 20, units=1, frames=20)

    def test_good_clients_agree_by_every_wire_level(self):
        calm = self.render("--local-clients", 2, frames=10)
        for level in ("auto", 0, 3):
            stats = self.render("--local-clients", 2, "--wait-clients", 2, "--verify", 0.5, "--wire-level", level,
                                frames=10)
            self.assertEqual(stats["image_hash"], calm["image_hash"])
            self.assertGreater(stats["verify"]["checked"], 0)
            self.assertEqual(stats["verify"]["wrong"], 0)

    def test_tiles_that_clients_filter_are_checked_too(self):
        stats = self.render("--local-clients", 2, "--wait-clients", 2, "--verify", 1, "--filter-at", "clients", frames=4)
        self.assertGreater(stats["verify"]["checked"], 0)
        self.assertEqual(stats["verify"]["wrong"], 0)

    def test_a_client_that_dies_among_checks_does_not_show(self):
        calm = self.render("--local-clients", 2, frames=400)
        master = self.master("--local-clients", 3, "--wait-clients", 3, "--verify", 0.5, frames=400)
        master.waits_for(r"progress: \d+% frame [1-9]")
        self.send(master.children()[0], 9)
        stats = self.finish(master)
        self.assertEqual(stats["image_hash"], calm["image_hash"])
        self.assertEqual(stats["verify"]["wrong"], 0)

    def test_two_that_differ_and_no_third_end_with_status_1(self):
        master = self.remote_master("--verify", 1, clients=2, frames=8)
        address = self.address_of(master)
        self.wrong_client(address, pixels=200), self.client(address)
        self.assertEqual(master.ends(), 1, master.text)
        self.assertRegex(master.lines[-1], r"^ninefold-master: \d+ result\(s\) differ between two clients, and no third "
                                           "one of their kind was there to tell which is right")
        self.assertTrue(master.picture.exists())
        self.assertGreater(json.loads(master.stats_file.read_text())["verify"]["disputed"], 0)

    def test_alone_nothing_is_checked_and_the_run_says_so(self):
        master = self.master("--local-clients", 1, "--verify", 1, frames=4)
        stats = self.finish(master)
        self.assertEqual(stats["verify"]["checked"], 0)
        self.assertGreater(stats["verify"]["alone"], 0)
        self.assertRegex(master.text, "of the results that --verify chose were not checked")

    def test_a_run_that_is_complete_already_leaves_its_checkpoint_as_it_is(self):
        keeps = ("--local-clients", 2, "--checkpoint", "run.checkpoint")
        self.render(*keeps, frames=20)
        before = (self.folder / "run.checkpoint").read_bytes()
        self.render(*keeps, "--verify", 0.5, frames=20)
        self.assertEqual((self.folder / "run.checkpoint").read_bytes(), before)

    def test_a_checkpoint_of_a_spoilt_run_is_good(self):
        calm = self.render("--local-clients", 2, frames=self.FRAMES)
        keeps = ("--checkpoint", "run.checkpoint", "--save-every", 0.02, "--verify", 0.5)
        master = self.remote_master(*keeps, clients=3)
        address = self.address_of(master)
        self.wrong_client(address, pixels=1000)
        self.client(address), self.client(address)
        master.waits_for(r"goes back to the picture of")
        self.send(master.process.pid, 9)
        master.ends()
        on = self.master("--local-clients", 2, "--checkpoint", "run.checkpoint", frames=self.FRAMES)
        self.assertEqual(self.finish(on)["image_hash"], calm["image_hash"])


if __name__ == "__main__":
    unittest.main()

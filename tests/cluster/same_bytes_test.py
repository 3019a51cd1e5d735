"""The same job gives the same bytes, whoever renders it and whatever happens to them.

What is about the wire, a frozen process or an instruction set, by the default method alone; the number of clients, by every
method: methods_same_bytes_test.py.
"""
import pathlib
import re
import unittest

from programs import SCENES, ClusterTest, eventually, is_running, methods, signal

CHOICE = "auto"  # the method that is one of the others


class SameBytes(ClusterTest):
    LONG = 60  # frames: enough to lose somebody in the middle

    def test_light_at_vertices_and_photons_in_a_simpler_scene(self):
        simple = ("--photon-scene", SCENES / "cornell.glb")
        for options in (("--map-estimate", "vertices", "--map-subdivision", 2), simple):
            self.same_by("photon-map", [(1, 1), (2, 1), (1, 2)], *options, frames=2)

    def test_compression_does_not_show(self):
        hashes = {level: self.render("--local-clients", 2, "--wire-level", level, frames=3)["image_hash"]
                  for level in ("auto", 0, 1, 5)}
        self.assertEqual(len(set(hashes.values())), 1, hashes)

    def test_pictures_on_the_way_do_not_show(self):
        expected = self.render("--local-clients", 1, frames=24)["image_hash"]
        master = self.master("--local-clients", 1, "--save-every", 1e-3, frames=24)
        master.waits_for(r"(?m)^1 frame\(s\) in out\d+\.exr$")
        self.assertTrue(master.picture.exists())
        self.assertEqual(self.finish(master)["image_hash"], expected)
        told = re.findall(r"(?m)^(\d+) frame\(s\) in ", master.text)
        self.assertEqual(told[0], "1")
        self.assertEqual(told[-1], "24")
        self.assertGreater(len(told), 2, "none on the way")

    def test_the_first_frame_is_a_picture_however_seldom_the_others_are(self):
        master = self.master("--local-clients", 1, "--save-every", 1000, frames=24)
        self.finish(master)
        self.assertEqual(re.findall(r"(?m)^(\d+) frame\(s\) in ", master.text), ["1", "24"])

    def test_another_seed_or_method_is_another_picture(self):
        hashes = {self.hash_by(method, seed) for seed in (1, 2) for method in methods() if method != CHOICE}
        self.assertEqual(len(hashes), 2 * (len(methods()) - 1))

    def test_the_choice_of_a_trial_has_the_picture_of_the_method_that_it_names(self):
        master = self.master("--local-clients", 2, "--method", CHOICE, frames=2)
        stats = self.finish(master)
        chosen = re.search(r"method auto: ([a-z-]+), as ", master.text)
        self.assertIsNotNone(chosen, master.text)
        self.assertEqual(stats["image_hash"], self.hash_by(chosen[1], 1))

    def hash_by(self, method, seed):
        return self.render("--local-clients", 1, "--seed", seed, "--method", method, frames=2)["image_hash"]

    def test_a_killed_client_does_not_show(self):
        self.SIZE = "48x36"  # so many frames must not take long by any method
        for method in methods():
            with self.subTest(method):
                self.kill_one_of_two("--method", method)

    def kill_one_of_two(self, *options):
        undisturbed = self.render("--local-clients", 2, *options, frames=self.LONG)
        master = self.master("--local-clients", 2, "--wait-clients", 2, *options, frames=self.LONG)
        master.waits_for(r"client \d+ is ready(.|\n)*client \d+ is ready")
        victim = master.children()[0]
        self.send(victim, signal.SIGKILL)
        stats = self.finish(master)
        self.assertIn("signal 9", master.text)
        self.assertEqual(stats["image_hash"], undisturbed["image_hash"])

    def test_a_frozen_client_does_not_show_and_is_not_left_behind(self):
        undisturbed = self.render("--local-clients", 2, frames=self.LONG)
        master = self.master("--local-clients", 2, "--wait-clients", 2, frames=self.LONG)
        master.waits_for(r"client \d+ is ready(.|\n)*client \d+ is ready")
        clients = master.children()
        self.send(clients[1], signal.SIGSTOP)
        stats = self.finish(master)
        self.assertEqual(stats["image_hash"], undisturbed["image_hash"])
        for pid in clients:
            eventually(lambda: not is_running(pid), f"end of client process {pid}")

    def test_both_instruction_sets_are_reproducible(self):
        if "avx512vl" not in pathlib.Path("/proc/cpuinfo").read_text():
            self.skipTest("this machine lacks AVX-512")
        for isa in ("avx2", "avx512"):
            one = self.render("--local-clients", 1, "--isa", isa, frames=2)
            two = self.render("--local-clients", 2, "--isa", isa, frames=2)
            self.assertEqual(one["image_hash"], two["image_hash"])
            self.assertEqual({c["isa"] for c in two["clients"]}, {isa})
            self.assertTrue(two["reproducible"])


if __name__ == "__main__":
    unittest.main()

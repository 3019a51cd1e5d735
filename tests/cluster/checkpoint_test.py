"""A run that is killed goes on where it stopped, by the same command, and ends with the bytes of a calm one."""
import json
import os
import random
import re
import resource
import time
import unittest

from programs import BIN, SCENES, ClusterTest, eventually, signal

OFTEN = ("--save-every", 0.02)


class Checkpoint(ClusterTest):
    SIZE = "48x36"
    FRAMES = 40
    KILLS = 4

    def keeps(self, *options, frames=FRAMES, **more):
        return self.master("--local-clients", 2, "--checkpoint", "run.checkpoint", *options, frames=frames, **more)

    def kill_at_seeded_moments(self, *options, scene="table_room"):
        """Kills masters with SIGKILL after seeded numbers of frames. Then one may end; its statistics."""
        file = self.folder / "run.checkpoint"
        file.unlink(missing_ok=True)
        calm = self.render("--local-clients", 2, *options, frames=self.FRAMES, scene=scene)
        rng = random.Random(repr(options))
        reached = 0
        for _ in range(self.KILLS):
            reached += rng.randint(2, self.FRAMES // self.KILLS - 2)
            master = self.keeps(*OFTEN, *options, frames=self.FRAMES, scene=scene)
            master.waits_for(rf"progress: \d+% frame ({'|'.join(map(str, range(reached, self.FRAMES + 1)))}) ")
            time.sleep(rng.uniform(0, 0.05))
            self.send(master.process.pid, signal.SIGKILL)
            master.ends()
        last = self.keeps(*OFTEN, *options, frames=self.FRAMES, scene=scene)
        stats = self.finish(last)
        self.assertRegex(last.text, r"goes on behind \d+ frame\(s\) of run.checkpoint")
        self.assertGreater(stats["frames_before"], 0)
        self.assertEqual(stats["frames"], self.FRAMES)
        self.assertEqual(stats["image_hash"], calm["image_hash"])
        self.assertEqual(stats["relative_error"], calm["relative_error"])
        self.assertTrue(stats["reproducible"])
        return stats

    def test_instant_radiosity_goes_on_after_kills(self):
        self.kill_at_seeded_moments("--method", "instant-radiosity")

    def test_a_photon_map_goes_on_after_kills(self):
        self.kill_at_seeded_moments("--method", "photon-map")

    def test_selective_photons_go_on_after_kills(self):
        self.kill_at_seeded_moments("--method", "selective-photons", "--photon-pool", 4608, "--photon-groups", 36)

    def test_a_state_of_which_each_step_counts_goes_on_after_kills(self):
        self.kill_at_seeded_moments("--method", "state-check", scene="cornell")

    def test_the_choice_of_a_trial_goes_on_after_kills(self):
        stats = self.kill_at_seeded_moments("--method", "auto", scene="cornell")
        self.assertNotIn("state", stats, "the trial is not made again")

    def test_extra_layers_guides_and_filters_at_clients_go_on_too(self):
        for options in (("--aovs", "--denoise", "on"), ("--filter-at", "clients"), ("--view", "error")):
            with self.subTest(options):
                (self.folder / "run.checkpoint").unlink(missing_ok=True)
                calm = self.master("--local-clients", 2, *options, frames=12, scene="table_room")
                self.finish(calm)
                self.finish(self.keeps(*options, frames=5, scene="table_room"))
                on = self.keeps(*options, frames=12, scene="table_room")
                self.assertEqual(self.finish(on)["frames_before"], 5)
                self.assertEqual(self.content(on.picture), self.content(calm.picture))

    def content(self, picture):
        """All bytes of an EXR file but those of its date."""
        return re.sub(rb"\d{4}:\d\d:\d\d \d\d:\d\d:\d\d", b"", picture.read_bytes())

    def test_an_ended_run_keeps_all_whole_frames_and_a_finished_one_needs_no_client(self):
        frames = 900  # so many that the signal comes before the last one
        calm = self.render("--local-clients", 2, frames=frames)
        master = self.keeps(frames=frames)
        master.waits_for(r"progress: \d+% frame [1-9]")
        self.send(master.process.pid, signal.SIGTERM)
        self.assertEqual(master.ends(), 143, master.text)
        so_far = json.loads(master.stats_file.read_text())
        on = self.finish(self.keeps(frames=frames))
        self.assertEqual(on["frames_before"], so_far["frames"])
        self.assertEqual(on["image_hash"], calm["image_hash"])
        again = self.finish(self.keeps(frames=frames))
        self.assertEqual((again["frames_before"], again["fps"]), (frames, 0))
        self.assertEqual(again["image_hash"], calm["image_hash"])

    def test_another_command_is_refused_in_one_line(self):
        self.finish(self.keeps(frames=2))
        for options, word in ((("--seed", 2), "seed is 1 there, 2 here"),
                              (("--method", "path-trace"), "method is instant-radiosity there, path-trace here"),
                              (("--view", "albedo"), "view is beauty there, albedo here"),
                              (("--camera", "0,1,2:0,1,0:40"), "camera is ")):
            with self.subTest(options):
                self.refused(self.keeps(*options), "is of another job: " + word)
        self.refused(self.keeps(scene="table_room"), "the scene's hash is ")
        self.SIZE = "40x36"
        self.refused(self.keeps(), "width is 48 there, 40 here")

    def test_two_masters_do_not_keep_one_file(self):
        calm = self.render("--local-clients", 2, frames=4)
        first = self.keeps(*OFTEN, "--seconds", 1000, frames=None)
        first.waits_for(r"progress: \d+% frame [2-9]")
        second = self.keeps(frames=4)
        self.assertEqual(second.ends(), 1, second.text)
        self.assertIn("run.checkpoint is in use by another run; end that, or give another file", second.lines[-1])
        self.send(first.process.pid, signal.SIGKILL)
        first.ends()
        (self.folder / "run.checkpoint").unlink()
        self.assertEqual(self.finish(self.keeps(frames=4))["image_hash"], calm["image_hash"])
        self.assertEqual([file.name for file in self.folder.iterdir() if file.name.endswith(".lock")], [])

    def test_damaged_files_are_refused_in_one_line(self):
        file = self.folder / "run.checkpoint"
        self.finish(self.keeps(frames=2))
        whole = file.read_bytes()
        spoilt = bytearray(whole)
        spoilt[len(whole) // 2] ^= 1
        for content, word in ((b"", "is no checkpoint"), (whole[:40], "is no checkpoint"), (whole[:-1], "is damaged"),
                              (bytes(spoilt), "is damaged"), (b"x" + whole[1:], "is no checkpoint"),
                              (whole[:8] + b"\2" + whole[9:], "is of format 2")):
            file.write_bytes(content)
            self.refused(self.keeps(), word)
            self.assertEqual(file.read_bytes(), content)

    def refused(self, master, word):
        self.assertEqual(master.ends(), 1, master.text)
        self.assertRegex(master.lines[-1], "^ninefold-master: checkpoint run.checkpoint: ")
        self.assertIn(word, master.lines[-1])
        self.assertNotIn("listening", master.text)

    def test_a_checkpoint_that_cannot_be_written_is_known_before_the_scene_is_read(self):
        os.mkdir(self.folder / "folder")
        for name, word in (("none/c", "there is no folder"), ("folder", "a folder")):
            master = self.master("--checkpoint", name, scene="no scene is read")
            self.assertEqual(master.ends(), 1)
            self.assertEqual(len(master.lines), 1, master.text)
            self.assertIn(word, master.lines[0])

    def test_too_little_room_is_known_before_the_first_frame(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
        master = self.keeps(preexec_fn=limit)
        self.assertEqual(master.ends(), 1)
        self.assertRegex(master.lines[-1], r"cannot write run.checkpoint: File too large; it needs about 0\.\d MB")
        self.assertNotIn("listening", master.text)

    def test_a_folder_that_goes_away_costs_one_line_and_no_frame(self):
        calm = self.render("--local-clients", 2, frames=200)
        os.mkdir(self.folder / "away")
        master = self.master("--local-clients", 2, "--checkpoint", "away/c", *OFTEN, frames=200)
        eventually(lambda: (self.folder / "away" / "c").exists(), "a checkpoint")
        os.rename(self.folder / "away", self.folder / "gone")
        master.waits_for(r"cannot write away/c: there is no folder .*; the run goes on and tries again")
        self.assertEqual(master.ends(), 1)
        self.assertEqual(master.text.count("the run goes on"), 1, master.text)
        self.assertRegex(master.lines[-1], "^ninefold-master: cannot write away/c: there is no folder")
        self.assertEqual(json.loads(master.stats_file.read_text())["image_hash"], calm["image_hash"])

    def test_a_picture_that_cannot_be_written_at_the_end_is_kept_elsewhere(self):
        os.mkdir(self.folder / "away")
        master = self.start(BIN / "ninefold-master", SCENES / "cornell.glb", "--size", self.SIZE, "--seconds", 5,
                            "--local-clients", 2, "--output", "away/a.png")
        master.waits_for(r"progress: \d+% frame [1-9]")
        os.rename(self.folder / "away", self.folder / "gone")
        self.assertEqual(master.ends(), 1)
        found = master.waits_for(r"cannot write away/a.png: .*; it is in (\S+/ninefold-\w+/a.png)\n?$").group(1)
        with open(found, "rb") as picture:
            self.assertEqual(picture.read(4), b"\x89PNG")

    def test_a_film_that_cannot_be_kept_in_the_end_is_somewhere_else(self):
        frames = 900
        calm = self.render("--local-clients", 2, frames=frames)
        os.mkdir(self.folder / "away")
        master = self.master("--local-clients", 2, "--checkpoint", "away/run.checkpoint", frames=frames)
        master.waits_for(r"progress: \d+% frame [1-9]")
        os.rename(self.folder / "away", self.folder / "gone")
        self.send(master.process.pid, signal.SIGTERM)
        self.assertEqual(master.ends(), 1, master.text)
        found = master.waits_for(r"cannot write away/run.checkpoint: .*; it is in (\S+/run.checkpoint)\n?$").group(1)
        so_far = json.loads(master.stats_file.read_text())["frames"]
        stats = self.render("--local-clients", 2, "--checkpoint", found, frames=frames)
        self.assertEqual((stats["frames_before"], stats["image_hash"]), (so_far, calm["image_hash"]))

    def test_the_picture_is_there_while_it_converges_whole_at_every_moment(self):
        master = self.keeps(*OFTEN, frames=200)
        whole = 0
        while master.process.poll() is None:
            if master.picture.exists():
                content = master.picture.read_bytes()
                self.assertEqual(content[:4], b"\x76\x2f\x31\x01")
                whole += 1
            time.sleep(0.01)
        self.finish(master)
        self.assertGreater(whole, 3)

    def test_the_picture_is_saved_though_no_client_is_left(self):
        self.new_key()
        for option, asks in (("--frames", True), ("--save-every", False)):
            with self.subTest(option):
                master = self.master("--local-clients", 0, "--key-file", "cluster.key", option, 100000 if asks else 2,
                                     frames=None if asks else 100000)
                client = self.client(self.address_of(master))
                master.waits_for(r"progress: \d+% frame [1-9]")
                client.process.kill()
                master.waits_for(r"no client is left; others may join\n")

                def told():
                    return re.findall(r"(\d+) frame\(s\) in out", master.text)
                before = len(told())
                if asks:
                    self.assertEqual(before, 0)
                    self.send(master.process.pid, signal.SIGUSR1)
                eventually(lambda: len(told()) > before, "another picture")
                saved = int(told()[-1])
                self.send(master.process.pid, signal.SIGINT)
                master.ends()
                self.assertEqual(saved, json.loads(master.stats_file.read_text())["frames"])

    def test_metrics_are_there_from_the_start_to_the_end(self):
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", "--metrics", "run.prom", frames=20)
        metrics = self.folder / "run.prom"
        eventually(metrics.exists, "the first metrics")
        self.assertIn("ninefold_picture_frames 0\n", metrics.read_text())
        self.client(self.address_of(master))
        self.finish(master)
        self.assertIn("ninefold_picture_frames 20\n", metrics.read_text())
        self.assertIn("ninefold_frames_total 20\n", metrics.read_text())

    def test_a_signal_asks_for_the_picture_and_the_run_goes_on(self):
        calm = self.render("--local-clients", 2, frames=2500)
        master = self.master("--local-clients", 2, frames=2500)
        master.waits_for(r"progress: \d+% frame [1-9]")
        self.assertFalse(master.picture.exists())
        self.send(master.process.pid, signal.SIGUSR1)
        eventually(master.picture.exists, "a picture")
        self.assertIsNone(master.process.poll())
        self.assertEqual(self.finish(master)["image_hash"], calm["image_hash"])


if __name__ == "__main__":
    unittest.main()

"""Films of animations: --output x.mp4, made by the real ffmpeg, without which most of this is skipped."""
import pathlib
import re
import resource
import shutil
import subprocess
import tempfile
import unittest

import png
from moving_square import moving_square
from programs import BIN, ClusterTest, signal

FFMPEG = shutil.which("ffmpeg")
needs_ffmpeg = unittest.skipUnless(FFMPEG, "no ffmpeg here: apt-get install ffmpeg")


class Film(ClusterTest):

    def film(self, output, path=None, size="63x48", clients=2, **more):
        """63 pixels are an odd side, which H.264 does not know."""
        (self.folder / "moves.gltf").write_text(moving_square())
        there = ["env", f"PATH={path}"] if path else []
        return self.start(*there, BIN / "ninefold-master", "moves.gltf", "--size", size, "--animate", "0:2:5", "--frames", 2, "--exposure", 0,
                          "--local-clients", clients, "--output", output, **more)

    def pictures_of(self, name, width=64, height=48):
        """Of a film, as rows of codes."""
        raw = subprocess.run([FFMPEG, "-loglevel", "error", "-i", name, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], check=True,
                             capture_output=True, cwd=self.folder, stdin=subprocess.DEVNULL).stdout
        size = width * height * 3
        return [raw[i:i + size] for i in range(0, len(raw), size)]

    def beside(self):
        return [p.name for p in self.folder.iterdir() if p.name.endswith(".part")]

    def kept(self, film):
        return len(list(self.folder.glob(f"{film}.*.png")))

    @needs_ffmpeg
    def test_it_shows_the_pictures_that_are_written_otherwise(self):
        self.assertEqual(self.film("a.mp4").ends(), 0)
        self.assertEqual(self.film("a.##.png").ends(), 0)
        pictures = self.pictures_of("a.mp4")
        self.assertEqual(len(pictures), 11)
        self.assertEqual(self.kept("a.mp4"), 0)
        for i, film in enumerate(pictures):
            width, height, rows = png.read(self.folder / f"a.{i:02}.png")
            error = [abs(film[3 * (64 * y + x) + c] - rows[y][x][c]) for y in range(height) for x in range(width) for c in range(3)]
            self.assertLess(sum(error) / len(error), 4, f"picture {i}")  # of 255; half the resolution in colour
        self.assertEqual(self.beside(), [])

    @needs_ffmpeg
    def test_the_same_command_gives_the_same_bytes(self):
        self.assertEqual(self.film("a.mp4").ends(), 0)
        self.assertEqual(self.film("b.mp4", clients=1).ends(), 0)
        self.assertTrue((self.folder / "a.mp4").read_bytes() == (self.folder / "b.mp4").read_bytes())

    @needs_ffmpeg
    def test_a_run_that_is_ended_leaves_the_film_so_far(self):
        master = self.film("a.mp4", size="640x480")
        master.waits_for("picture 2 of 11")
        self.send(master.process.pid, signal.SIGINT)
        self.assertEqual(master.ends(), 130)
        self.assertGreater((self.folder / "a.mp4").stat().st_size, 1000)
        self.pictures_of("a.mp4")
        self.assertEqual(self.kept("a.mp4"), 0)

    @needs_ffmpeg
    def test_an_ffmpeg_that_is_killed_costs_no_picture_and_the_line_that_is_told_makes_the_film(self):
        master = self.film("a.mp4", size="640x480")
        master.waits_for("picture 2 of 11")
        self.send(self.child(master.process.pid, "ffmpeg"), signal.SIGKILL)
        self.assertEqual(master.ends(), 1)
        self.assertEqual(len([line for line in master.lines if "the pictures go on as a.mp4.####.png" in line]), 1, master.text)
        told = re.search(r"cannot write a\.mp4: ffmpeg ended with .*signal 9.*; nothing is lost, this makes the film: (ffmpeg .*)$",
                         master.lines[-1])
        self.assertTrue(told, master.lines[-1])
        self.assertEqual(self.kept("a.mp4"), 11)
        self.assertFalse((self.folder / "a.mp4").exists())
        subprocess.run(told[1] + " -loglevel error", shell=True, check=True, cwd=self.folder, stdin=subprocess.DEVNULL)
        self.assertEqual(len(self.pictures_of("a.mp4", 640, 480)), 11)

    def child(self, parent, name):
        """The process id of a program that another one has started."""
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                number, rest = (process / "stat").read_text().split(" (", 1)
            except OSError:
                continue  # ended meanwhile
            program, _, state = rest.rpartition(") ")
            if program == name and int(state.split()[1]) == parent:
                return int(number)
        self.fail(f"{parent} has no child {name}")

    def test_without_ffmpeg_one_line_says_how_before_anything_is_rendered(self):
        master = self.film("a.mp4", path=self.folder)
        self.assertEqual(master.ends(), 1)
        self.assertEqual(len(master.lines), 1, master.text)
        self.assertRegex(master.text, r"cannot write a\.mp4: there is no program ffmpeg in PATH; install it, or write pictures")

    def test_an_ffmpeg_that_dies_is_told(self):
        self.program("exit 7")
        master = self.film("a.mp4", path=f"{self.folder}:/usr/bin:/bin")
        self.assertEqual(master.ends(), 1)
        self.assertRegex(master.lines[-1], r"cannot write a\.mp4: ffmpeg ended with exit status 7")
        self.assertEqual(self.kept("a.mp4"), 11)
        self.assertFalse((self.folder / "a.mp4").exists())
        self.assertEqual(self.beside(), [])

    def program(self, text):
        (self.folder / "ffmpeg").write_text(f"#!/bin/sh\n{text}\n")
        (self.folder / "ffmpeg").chmod(0o755)

    @needs_ffmpeg
    def test_a_full_disk_is_told_and_the_old_film_stays(self):
        disk = tempfile.mkdtemp(dir=self.folder)
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "none", disk], capture_output=True).returncode:
            self.skipTest("no file system can be mounted here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        with open(f"{disk}/a.mp4", "w") as old:
            old.write("old")
        master = self.film(f"{disk}/a.mp4", size="640x480")
        self.assertEqual(master.ends(), 1)
        self.assertRegex(master.lines[-1], r"cannot write .*a\.mp4.*: No space left on device")
        with open(f"{disk}/a.mp4") as old:
            self.assertEqual(old.read(), "old")

    @needs_ffmpeg
    def test_a_film_that_gets_too_large_is_told(self):
        master = self.film("a.mp4", size="640x480", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000)))
        self.assertEqual(master.ends(), 1)
        self.assertRegex(master.lines[-1], r"cannot write a\.mp4.*: ")
        self.assertFalse((self.folder / "a.mp4").exists())

    def test_a_still_picture_is_no_film(self):
        self.program("exit 7")
        master = self.start(BIN / "ninefold-master", "moves.gltf", "--output", "a.mp4")
        self.assertEqual(master.ends(), 2)
        self.assertRegex(master.lines[-1], "a film needs --animate, or a --script with a rate")


if __name__ == "__main__":
    unittest.main()

"""Films of animations: --output x.mp4, made by the real ffmpeg, without which most of this is skipped."""
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

    def pictures_of(self, name):
        """Of a film, as rows of codes."""
        raw = subprocess.run([FFMPEG, "-loglevel", "error", "-i", name, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], check=True,
                             capture_output=True, cwd=self.folder, stdin=subprocess.DEVNULL).stdout
        return [raw[i:i + 64 * 48 * 3] for i in range(0, len(raw), 64 * 48 * 3)]

    def beside(self):
        return [p.name for p in self.folder.iterdir() if p.name.endswith(".part")]

    @needs_ffmpeg
    def test_it_shows_the_pictures_that_are_written_otherwise(self):
        self.assertEqual(self.film("a.mp4").ends(), 0)
        self.assertEqual(self.film("a.##.png").ends(), 0)
        pictures = self.pictures_of("a.mp4")
        self.assertEqual(len(pictures), 11)
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
        self.assertRegex(master.lines[-1], r"cannot write .*a\.mp4: No space left on device")
        with open(f"{disk}/a.mp4") as old:
            self.assertEqual(old.read(), "old")

    @needs_ffmpeg
    def test_a_film_that_gets_too_large_is_told(self):
        master = self.film("a.mp4", size="640x480", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000)))
        self.assertEqual(master.ends(), 1)
        self.assertRegex(master.lines[-1], r"cannot write a\.mp4: ")
        self.assertFalse((self.folder / "a.mp4").exists())

    def test_a_still_picture_is_no_film(self):
        self.program("exit 7")
        master = self.start(BIN / "ninefold-master", "moves.gltf", "--output", "a.mp4")
        self.assertEqual(master.ends(), 2)
        self.assertRegex(master.lines[-1], "a film needs --animate, or a --script with a rate")


if __name__ == "__main__":
    unittest.main()

"""The Blender add-on, in a Blender without window: its pictures beside those of Cycles, and how it ends.

Needs Debian's package blender, 3.4 or later, and python3-numpy; without them everything is skipped.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

try:
    import numpy as np
except ImportError:
    np = None

SOURCE = pathlib.Path(os.environ["NINEFOLD_SOURCE"])
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cluster"))
from programs import BIN, methods  # noqa: E402

BLENDER = shutil.which("blender")
DEADLINE = 900  # seconds; only there to end a broken test

# Relative differences of patches. glTF says the same as Cycles, or (docs/blender.md) takes what a
# dielectric or a coat reflects from what is scattered below, which Cycles up to Blender 3 does not: the
# test of layers says by how much. The light of a small sphere is noisy: by 2.3 % between two seeds of ours.
SAME = 0.02
OTHERWISE = {"principled, usual": 0.08, "specular 1": 0.15, "coat": 0.09, "glass, rough": 0.04, "bounced": 0.06,
             "sphere that shines": 0.05}

# Means over all directions of what a layer of glTF reflects, and so keeps from what lies below: GGX of
# that roughness with Schlick's Fresnel, integrated by a million samples. Cycles' coat has a quarter.
LAYERS = {"specular": (0.0532, 1), "specular 1": (0.1192, 1), "coat": (0.0857, 4)}


def programs_in(folder):
    """Process ids and names of our programs whose command line names the folder, or whose parent's does."""
    found, parents = {}, {}
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            line = (process / "cmdline").read_bytes()
            state, parent = (process / "stat").read_text().rpartition(")")[2].split()[:2]
        except OSError:
            continue  # ended meanwhile
        name = os.path.basename(line.split(b"\0")[0]).decode()
        if state == "Z" or not line:
            continue
        parents[int(process.name)] = (int(parent), name)
        if name == "ninefold-master" and str(folder).encode() in line:
            found[int(process.name)] = name
    found.update({pid: name for pid, (parent, name) in parents.items() if parent in found and name == "ninefold-client"})
    return found


@unittest.skipUnless(BLENDER and np, "no Blender here, or no numpy for Python: apt-get install blender python3-numpy")
class Blender(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ninefold-blender-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("out", "tmp", "home", "scripts/addons"):
            (self.folder / name).mkdir(parents=True)
        shutil.copy(SOURCE / "integrations/blender/ninefold_render.py", self.folder / "scripts/addons")
        self.out = self.folder / "out"
        self.environment = {k: v for k, v in os.environ.items() if not k.startswith("NINEFOLD_")} | {
            "BLENDER_USER_SCRIPTS": str(self.folder / "scripts"), "HOME": str(self.folder / "home"),
            "TMPDIR": str(self.folder / "tmp"), "PATH": f"{BIN}:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}

    def start(self, script, *arguments):
        """A Blender that runs a script of this folder. Its lines go into `lines` as they come."""
        command = [BLENDER, "--background", "--factory-startup", "--addons", "ninefold_render", "--python-exit-code", "3",
                   "--python", HERE / script, "--", *arguments, self.out]
        blender = subprocess.Popen([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, errors="replace", env=self.environment)
        blender.lines = []
        reader = threading.Thread(target=lambda: blender.lines.extend(iter(blender.stdout.readline, "")))
        reader.start()

        def close():
            blender.kill()
            blender.wait()
            reader.join()
            blender.stdout.close()

        self.addCleanup(close)
        blender.reader = reader
        return blender

    def finish(self, blender):
        blender.wait(DEADLINE)
        blender.reader.join(DEADLINE)
        self.assertEqual(blender.returncode, 0, "".join(blender.lines[-40:]))
        return "".join(blender.lines)

    def eventually(self, condition, what, seconds=120):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.05)
        self.fail(f"never happened: {what}")

    def said(self, text, word):
        return [json.loads(line.partition(" ")[2]) for line in text.splitlines() if line.startswith(word + " ")]

    def nothing_is_left(self):
        self.eventually(lambda: not programs_in(self.folder), f"the end of {programs_in(self.folder)}", 30)
        self.assertEqual([p for p in (self.folder / "tmp").iterdir() if p.name.startswith("ninefold-")], [])

    def patches_of_both(self, scene):
        for engine in ("CYCLES", "NINEFOLD"):
            self.finish(self.start("blender_scenes.py", engine, scene))
            yield json.loads((self.out / f"{engine}_{scene}.json").read_text())

    def are_those_of_cycles(self, scene, count):
        patches = dict(zip(("CYCLES", "NINEFOLD"), self.patches_of_both(scene)))
        self.assertEqual(len(patches["CYCLES"]), count)
        for name, expected in patches["CYCLES"].items():
            with self.subTest(name):
                got = patches["NINEFOLD"][name]
                self.assertGreater(max(expected), 0.01)
                off = max(abs(g - e) for g, e in zip(got, expected)) / max(expected)
                self.assertLess(off, OTHERWISE.get(name, SAME), f"{got} for {expected}")

    def test_lamps_are_those_of_cycles(self):
        self.are_those_of_cycles("lamps", 13)

    def test_surfaces_are_those_of_cycles(self):
        self.are_those_of_cycles("surfaces", 16)

    def test_layers_are_those_of_cycles_less_what_they_keep_from_below(self):
        theirs, ours = ({name: np.array(colour) for name, colour in patches.items()}
                        for patches in self.patches_of_both("layers"))
        bare = theirs["bare, red"]

        def same(got, expected, what):
            self.assertLess(abs(got - expected).max(), SAME * expected.max(), f"{what}: {got} for {expected}")

        same(ours["bare, red"], bare, "bare")
        for layer, (kept, share) in LAYERS.items():
            with self.subTest(layer):
                reflected = theirs[f"{layer}, black"]
                if layer != "coat":  # under a sky Cycles' own coat and what lies below do not add up
                    same(theirs[f"{layer}, red"], bare + reflected, "Cycles adds them")
                same(ours[f"{layer}, black"], share * reflected, "the layer alone")
                same(ours[f"{layer}, red"], (1 - kept) * bare + share * reflected, "both")

    def test_surfaces_seen_along_parallel_lines_are_those_of_cycles(self):
        self.are_those_of_cycles("parallel", 16)

    def test_what_is_outside_is_that_of_cycles(self):
        if "none|COLOR|FILE" not in self.help_of_master():
            self.skipTest("this master takes no pictures of what is outside")
        self.are_those_of_cycles("outside", 16)

    def help_of_master(self):
        return subprocess.run([BIN / "ninefold-master", "--help"], check=True, capture_output=True, text=True).stdout

    def test_what_is_seen_and_from_where_is_as_in_cycles(self):
        for engine in ("CYCLES", "NINEFOLD"):
            self.finish(self.start("blender_things.py", engine))
        with np.load(self.out / "CYCLES_things.npz") as expected, np.load(self.out / "NINEFOLD_things.npz") as got:
            self.assertGreater(len(expected.files), 8)
            for view in expected.files:
                with self.subTest(view):
                    self.assertEqual(got[view].shape, expected[view].shape)
                    self.assertGreater(expected[view].mean(), 0.02)
                    # Edges are smoothed at random. A thing that is missing is 0.3 or more in its pixels.
                    self.assertLess(abs(got[view] - expected[view]).max(), 0.15)
                    self.assertLess(abs(got[view] - expected[view]).mean(), 0.05 * expected[view].mean())
            for first, second in (("second frame", "wide"), ("blurred from the frame on", "wide"),
                                  ("blurred about the frame", "second frame"), ("blurred up to the frame", "second frame")):
                self.assertGreater(abs(got[first] - got[second]).max(), 0.2, (first, second))
        self.nothing_is_left()

    def test_the_panel_offers_the_methods_that_there_are(self):
        addon = (SOURCE / "integrations/blender/ninefold_render.py").read_text()
        offered = re.search(r"method: .*?items=\[(.*?)\]\)", addon, re.S).group(1)
        self.assertEqual(sorted(re.findall(r'\("([a-z-]+)", "', offered)), sorted(methods()))

    def test_passes_hold_what_they_are_called(self):
        passes, = self.said(self.finish(self.start("blender_session.py", "passes")), "PASSES")
        expected = {"Depth": 13, "Normal": (0, 0, 1), "Albedo": 0.5, "Irradiance": 2, "Caustic": 0, "Error": 0, "Object": 2}
        self.assertEqual(passes.keys(), expected.keys())
        for name, value in expected.items():
            np.testing.assert_allclose(passes[name], np.broadcast_to(value, 3), atol=0.01, err_msg=name)

    def test_the_picture_is_shown_while_it_converges(self):
        said = self.finish(self.start("blender_session.py", "converges"))
        self.assertGreater(self.said(said, "OUTCOME")[0]["mean"], 0.3)
        self.assertGreaterEqual(len(self.said(said, "SHOWN")), 3, "the first frame, one on the way, the end")

    def test_clients_that_come_from_elsewhere_render_one_picture_after_another(self):
        with socket.create_server(("127.0.0.1", 0)) as free:
            address = f"127.0.0.1:{free.getsockname()[1]}"
        (self.out / "address").write_text(address)
        key = self.out / "cluster.key"
        subprocess.run([BIN / "ninefold-master", "--new-key", key], check=True, capture_output=True)
        client = f"while sleep 0.5; do '{BIN}/ninefold-client' --master {address} --key-file '{key}' --cache none; done"
        loop = subprocess.Popen(["sh", "-c", client], stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        self.addCleanup(loop.wait)
        self.addCleanup(os.killpg, loop.pid, signal.SIGKILL)
        outcomes = self.said(self.finish(self.start("blender_session.py", "cluster")), "OUTCOME")
        self.assertEqual([o["what"] for o in outcomes], ["first", "second"])
        for outcome in outcomes:
            self.assertGreater(outcome.get("mean", 0), 0.3, outcome)

    def test_animations_have_a_picture_for_each_frame(self):
        means, = self.said(self.finish(self.start("blender_session.py", "animation")), "FRAMES")
        self.assertGreater(means[0], 0.3)
        self.assertEqual(means[1], 0)
        self.assertAlmostEqual(means[2] / means[0], 0.25, delta=0.02)
        self.nothing_is_left()

    def test_frames_in_which_things_only_move_are_those_of_stills_and_have_one_master(self):
        wrapper = self.folder / "bin/ninefold-master"
        wrapper.parent.mkdir()
        wrapper.write_text(f'#!/bin/sh\ncase "$*" in *--output*) echo "$*" >> "{self.folder}/starts";; esac\n'
                           f'exec "{BIN}/ninefold-master" "$@"\n')
        wrapper.chmod(0o755)
        self.environment["PATH"] = f"{wrapper.parent}:{self.environment['PATH']}"
        moved = self.said(self.finish(self.start("blender_session.py", "moves")), "MOVED")
        self.assertEqual(len(moved), 4)
        for frame in moved:
            self.assertGreater(frame["mean"], 0.1)
            self.assertLess(frame["difference"], 0.02 * frame["mean"])
        starts = (self.folder / "starts").read_text().splitlines()
        self.assertEqual(["--animate 0:3:1" in start for start in starts], [True] + 4 * [False])
        self.nothing_is_left()

    def test_blurred_frames_are_those_of_stills_and_what_cannot_be_blurred_is_told(self):
        said = self.finish(self.start("blender_session.py", "blurred"))
        moved = self.said(said, "MOVED")
        self.assertEqual(len(moved), 3)
        for frame in moved:
            self.assertLess(frame["difference"], 0.02 * frame["mean"])
        self.assertGreater(self.said(said, "BLUR")[0], 0.05)
        warnings = {what: len(re.findall(f"Warning: Ninefold: motion blur {what}", said)) for what in ("needs", "is of places")}
        self.assertEqual(warnings, {"needs": 1, "is of places": 1})
        self.nothing_is_left()

    def long_animation(self):
        blender = self.start("blender_session.py", "many")
        self.eventually(lambda: any(line.startswith("FRAME 3") for line in blender.lines), "the third frame")
        masters = [pid for pid, name in programs_in(self.folder).items() if name == "ninefold-master"]
        self.assertEqual(len(masters), 1)
        return blender, masters[0]

    def test_an_animation_that_is_cancelled_leaves_no_process(self):
        blender, _ = self.long_animation()
        blender.send_signal(signal.SIGINT)
        after, = self.said(self.finish(blender), "OUTCOME")
        self.assertGreater(after["mean"], 0.3)
        self.nothing_is_left()

    def test_an_animation_whose_master_dies_is_told_and_the_next_render_is_well(self):
        blender, master = self.long_animation()
        os.kill(master, signal.SIGKILL)
        first, second = self.said(self.finish(blender), "OUTCOME")
        self.assertIn("the master: killed by signal 9", first["error"])
        self.assertGreater(second["mean"], 0.3)
        self.nothing_is_left()

    def test_what_is_wrong_is_told_in_a_line_and_blender_goes_on(self):
        outcomes = self.said(self.finish(self.start("blender_session.py", "wrong")), "OUTCOME")
        told = {"no camera": "no camera", "a panorama": "is panoramic", "no square pixels": "must be square",
                "a far shift": "at most are 16384 a side",
                "no program": "/nowhere/ninefold-master", "another program": "/bin/true is no ninefold-master",
                "no end": "nothing ends the render", "no client": "no client can come", "no key": "--key-file",
                "no address": "--listen", "an address of another machine": "192.0.2.1",
                "no such option": "--brightness", "an open quotation": "more options"}
        self.assertEqual([o["what"] for o in outcomes], [*told, "all right"])
        for outcome in outcomes[:-1]:
            with self.subTest(outcome["what"]):
                self.assertIn("Ninefold: " if outcome["what"] != "no camera" else "Error: ", outcome["error"])
                self.assertIn(told[outcome["what"]], outcome["error"])
                self.assertEqual(len(outcome["error"].strip().splitlines()), 1)
        self.assertGreater(outcomes[-1]["mean"], 0.3)
        self.nothing_is_left()

    def test_pictures_of_what_is_outside_that_are_none_are_told_in_a_line(self):
        said = self.finish(self.start("blender_session.py", "pictures"))
        outcomes = {o["what"]: o for o in self.said(said, "OUTCOME")}
        for what, line in {"not a number": "no finite numbers", "infinite": "no finite numbers", "truncated HDR": "cannot be read",
                           "truncated EXR": "cannot be read"}.items():
            with self.subTest(what):
                self.assertRegex(outcomes[what]["error"], f"^Error: Ninefold: .*world world: .*{line}")
                self.assertEqual(len(outcomes[what]["error"].strip().splitlines()), 1)
        for what in ("negative", "one pixel", "two pixels"):
            self.assertGreater(outcomes[what]["mean"], 0.3, outcomes[what])
        self.assertIn("mean", outcomes["large"])
        for line in ("negative", "carried over as its mean colour", "its picture of 16384x8192 is carried over 8192 pixels wide"):
            self.assertRegex(said, f"Warning: Ninefold: .*{line}")
        self.nothing_is_left()

    def long_render(self):
        """A Blender in the middle of a render without end, and the processes of its master and client."""
        blender = self.start("blender_session.py", "long")
        self.eventually(lambda: any(re.search(r"% frame [1-9]", line) for line in blender.lines), "a frame")
        programs = programs_in(self.folder)
        self.assertEqual(sorted(programs.values()), ["ninefold-client", "ninefold-master"])
        return blender, {name: pid for pid, name in programs.items()}

    def test_a_master_that_dies_is_told_and_the_next_render_is_well(self):
        blender, programs = self.long_render()
        os.kill(programs["ninefold-master"], signal.SIGKILL)
        first, second = self.said(self.finish(blender), "OUTCOME")
        self.assertIn("the master: killed by signal 9", first["error"])
        self.assertGreater(second["mean"], 0.3)
        self.nothing_is_left()
        self.eventually(lambda: not os.path.exists(f"/proc/{programs['ninefold-client']}"), "the end of the client")

    def test_cancelling_keeps_the_picture_so_far_and_leaves_no_process(self):
        blender, programs = self.long_render()
        blender.send_signal(signal.SIGINT)
        first, second = self.said(self.finish(blender), "OUTCOME")
        self.assertGreater(first["mean"], 0.3)
        self.assertGreater(second["mean"], 0.3)
        self.nothing_is_left()
        self.eventually(lambda: not os.path.exists(f"/proc/{programs['ninefold-client']}"), "the end of the client")

    def test_a_blender_that_is_killed_leaves_no_process(self):
        blender, programs = self.long_render()
        blender.kill()
        for name, pid in programs.items():
            self.eventually(lambda: not os.path.exists(f"/proc/{pid}"), f"the end of {name}")


if __name__ == "__main__":
    unittest.main()

"""The real window on an X server in memory: a person walks, selects, moves, switches, undoes.

Screenshots are held against each other: what must have changed, and what must not. Every wait ends when the
screen shows what is waited for; its deadline only ends a broken test. NINEFOLD_SCREENSHOTS=FOLDER keeps them.
"""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cluster"))
from moving_square import moving_square  # noqa: E402
from programs import BIN, SCENES, Program, eventually  # noqa: E402
from screen import Screen  # noqa: E402

WIDTH, HEIGHT = 720, 480  # of the window; the picture of 320x240 fills its height when the panel is off
CALM = 2.5  # codes: noise of a picture at rest stays below
FRAMES = 6   # of a picture at rest
ISAS = ["avx2"] + (["avx512"] if " avx512f " in pathlib.Path("/proc/cpuinfo").read_text() else [])
LIT = 50     # mean code of table_room with its lamp on is above, with the panel too; half of it with the lamp off


def is_outline(r, g, b):
    return r > 200 and 110 < g < 210 and b < 90


class WindowTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.screen = Screen(WIDTH, HEIGHT)
        cls.folder = tempfile.TemporaryDirectory()
        cls.shots = os.environ.get("NINEFOLD_SCREENSHOTS")

    @classmethod
    def tearDownClass(cls):
        cls.screen.close()
        cls.folder.cleanup()

    def start(self, *options, scene=SCENES / "table_room.glb", camera="0.15,1.5,2.25:0,1.5,-0.5:60"):
        os.environ["DISPLAY"] = self.screen.display
        os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
        self.program = Program([BIN / "ninefold-master", scene, "--window", "--size", "320x240", "--camera", camera,
                                "--local-clients", "1", *options], self.folder.name)
        self.addCleanup(self.program.close)
        eventually(self.focus, "a window")

    def focus(self):
        try:
            self.screen.do("windowfocus", self.search())
            return True
        except subprocess.CalledProcessError:  # it is not there yet, or not mapped
            return False

    def search(self):
        return self.screen.do("search", "--onlyvisible", "--name", "^ninefold").split("\n")[0]

    def look(self, name=None):
        picture = self.screen.picture()
        if name and self.shots:
            picture.save(pathlib.Path(self.shots) / f"{name}.png")
        return picture

    def title(self):
        return self.screen.do("getwindowname", self.search())

    def frames(self):
        """That the picture is the mean of, as the title says; 0 in motion."""
        said = re.match(r"ninefold: (\d+) frame", self.title())
        return int(said.group(1)) if said else 0

    def rest(self, name=None):
        """A picture that has come to rest and lost most of its noise."""
        eventually(lambda: self.frames() >= FRAMES, f"rest: {name}")
        time.sleep(0.5)  # from the title to the screen
        return self.look(name)

    def until(self, condition, what, name=None):
        eventually(lambda: condition(self.look()), what)
        return self.look(name)

    def test_a_session(self):
        self.start()
        self.rest("panel")
        self.screen.key("Tab")  # without the panel
        first = self.rest("first")

        with self.subTest("walk, and back"):
            self.screen.hold("w", 0.5)
            walked = self.until(lambda p: p.difference(first) > 8, "the view after walking")
            self.screen.key("Home")
            self.until(lambda p: p.difference(first) < CALM, "the first view again")
            self.assertGreater(walked.difference(first), 8)

        with self.subTest("exposure"):
            self.screen.key("bracketright", "bracketright")
            bright = self.until(lambda p: p.mean() > first.mean() + 15, "a brighter picture", "exposure")
            dark_pixels = sum(b < f - 6 for b, f in zip(bright.data, first.data)) / len(first.data)
            self.assertLess(dark_pixels, 0.02, "exposure makes nothing darker")
            self.screen.key("bracketleft", "bracketleft")
            self.until(lambda p: p.difference(first) < CALM, "the first exposure again")

        with self.subTest("views"):
            for key, name in (("2", "albedo"), ("3", "normal"), ("4", "depth"), ("8", "sets"), ("shift+1", "objects"),
                              ("shift+2", "weights")):
                self.screen.key(key)
                self.until(lambda p: p.difference(first) > 8, name, f"view_{name}")
            self.screen.key("1")
            self.until(lambda p: p.difference(first) < CALM, "beauty again")

        with self.subTest("switch the lamp"):
            self.screen.click(*self.lamp_at)
            self.program.waits_for("selected lamp")
            self.screen.key("l")
            self.until(lambda p: p.mean() < 0.35 * first.mean(), "darkness", "lamp_off")
            self.screen.key("l", "Escape")
            self.until(lambda p: p.difference(first) < CALM, "light again")

        with self.subTest("another size of the window"):
            self.screen.do("windowsize", self.search(), 400, 500)
            small = self.until(lambda p: p.cut(0, 10, 400, 60).mean() < 20 and p.cut(50, 150, 300, 200).mean() > 30,
                               "a picture between two bars", "resized")
            self.assertLess(small.cut(0, 430, 400, 60).mean(), 20)
            self.screen.do("windowsize", self.search(), WIDTH, HEIGHT)
            self.until(lambda p: p.difference(first) < CALM, "the first size again")

        self.screen.key("ctrl+q")
        self.assertEqual(self.program.process.wait(60), 0, self.program.text)

    def test_a_thing_is_dragged_on_every_instruction_set(self):
        for isa in ISAS:
            with self.subTest(isa):
                self.start("--isa", isa)
                self.rest()
                self.screen.key("Tab")
                self.move_sphere(self.rest(f"before_{isa}"))
                self.screen.key("ctrl+q")
                self.assertEqual(self.program.process.wait(60), 0, self.program.text)

    def move_sphere(self, first):
        sphere = self.sphere_at
        self.screen.click(*sphere)
        self.program.waits_for("selected glass sphere")
        outlined = self.until(lambda p: len(p.places(is_outline)) > 60, "an outline", "selected")
        before = outlined.places(is_outline)
        self.screen.drag(*sphere, sphere[0] + 70, sphere[1])
        middle = lambda places: sum(x for x, _ in places) / len(places)  # noqa: E731

        def went_along(picture):
            places = picture.places(is_outline)
            return len(places) > 60 and middle(places) > middle(before) + 30
        self.until(went_along, "an outline that went along")
        moved = self.rest("moved")
        corner = (WIDTH - 120, 10, 110, 100)
        self.assertLess(moved.cut(*corner).difference(first.cut(*corner)), 2 * CALM, "a far wall stays as it was")

        def change(picture):
            return picture.cut(340, 270, 220, 120).difference(first.cut(340, 270, 220, 120))
        far = change(moved)
        self.assertGreater(far, 2 * CALM, "the sphere and its light are elsewhere")
        self.screen.key("ctrl+z", "Escape")
        self.until(lambda p: change(p) < CALM, "the sphere where it was")
        self.screen.key("ctrl+y")
        self.until(lambda p: change(p) > 0.8 * far, "moved again")
        self.screen.key("ctrl+z")
        self.until(lambda p: change(p) < CALM, "and back")

    def test_what_changes_no_light_leaves_the_mean_alone(self):
        """The number of frames in the title never falls, but for a painted view, which counts its own."""
        self.start()
        self.rest()
        self.screen.key("Tab")
        eventually(lambda: self.frames() >= 2 * FRAMES, "a good picture")
        seen = [self.frames()]

        def stays(what, name=None):
            for _ in range(20):
                now = self.frames()
                self.assertGreaterEqual(now, seen[0], f"after {what}: begun anew")
                seen[0] = now
                time.sleep(0.05)
            self.look(name)
        before = len(self.look().places(is_outline))
        self.screen.click(*self.sphere_at)
        self.program.waits_for("selected glass sphere")
        self.until(lambda p: len(p.places(is_outline)) > before + 60, "an outline")
        stays("a click", "click_at_rest")
        self.screen.key("Escape")
        self.until(lambda p: len(p.places(is_outline)) < before + 30, "no outline")
        stays("selecting nothing")
        self.screen.key("bracketright", "bracketleft")
        stays("another exposure")
        self.screen.key("v")
        stays("keeping the view")
        self.screen.key("Home")
        stays("going where it is")
        self.screen.do("windowsize", self.search(), 500, 400)
        stays("another size of the window")
        self.screen.do("windowsize", self.search(), WIDTH, HEIGHT)
        stays("the first size")
        plain = self.look()
        for key in ("Tab", "Tab", "F1", "question"):
            self.screen.key(key)
            stays(f"panel and keys: {key}", f"after_{key}")
            if key in ("F1", "question"):
                shows = self.look().cut(200, 100, 320, 280).difference(plain.cut(200, 100, 320, 280)) > 8
                self.assertEqual(shows, key == "F1", "F1 shows the keys, ? takes them away")
        for key in ("3", "9"):  # a painted view, and the error, which is the film's
            self.screen.key(key)
            eventually(lambda: self.frames() > 0 and (key == "9" or self.frames() < seen[0]), f"view {key}")
            time.sleep(0.5)
        self.screen.key("1")
        eventually(lambda: self.frames() >= seen[0], "the mean of all frames again, at once")
        self.screen.hold("w", 0.3)
        eventually(lambda: self.frames() < seen[0], "another view is another mean")

    def test_every_method_finds_what_is_clicked_at(self):
        self.start("--method", "path-trace")
        self.rest()
        self.screen.key("Tab")
        self.screen.click(*self.sphere_at)
        self.program.waits_for("selected glass sphere")

    def test_the_panel_folds_and_is_remembered(self):
        os.environ["XDG_CONFIG_HOME"] = str(pathlib.Path(self.folder.name) / "settings")
        self.addCleanup(os.environ.pop, "XDG_CONFIG_HOME")
        self.start()
        first = self.rest("unfolded")
        column = (10, 440, 280, 30)  # below the panel's parts, left of the picture
        self.assertLess(first.cut(*column).mean(), 60)
        self.screen.click(18, 18)  # the arrow in its title
        folded = self.until(lambda p: p.cut(100, 300, 200, 100).mean() > 40, "the picture where the panel was", "folded")
        self.assertGreater(folded.difference(first), 8)
        self.screen.key("ctrl+q")
        self.assertEqual(self.program.process.wait(60), 0, self.program.text)
        memory = pathlib.Path(os.environ["XDG_CONFIG_HOME"]) / "ninefold" / "window"
        self.assertEqual(memory.read_text(), f"width {WIDTH}\nheight {HEIGHT}\nfolded 1\n")
        memory.write_text("width 600\nheight 400\nfolded 1\n")
        self.start()
        again = self.rest("remembered")
        self.assertEqual(self.screen.do("getwindowgeometry", "--shell", self.search()).count("WIDTH=600\nHEIGHT=400"), 1)
        self.assertGreater(again.cut(100, 200, 200, 100).mean(), 40)
        self.screen.key("ctrl+q")
        self.assertEqual(self.program.process.wait(60), 0, self.program.text)

    def test_a_click_with_its_way_in_one_batch(self):
        """The pointer jumps and clicks at once: onto the panel, and from the panel onto the picture."""
        self.start()
        self.rest()
        sphere, panel = (537, 307), (200, 44)  # no button of it
        for _ in range(3):
            self.screen.do("mousemove", *sphere)
            time.sleep(0.3)
            self.screen.do("mousemove", *panel, "mousedown", 1, "mouseup", 1)
            time.sleep(0.5)
            self.assertNotIn("selected", self.program.text, "a press on the panel")
        self.look("pressed_on_panel")
        self.screen.do("mousemove", *panel)
        time.sleep(0.3)
        self.screen.do("mousemove", *sphere, "mousedown", 1, "mouseup", 1, "mousemove", 330, 100)
        self.program.waits_for("selected ")
        self.look("pressed_on_picture")
        self.assertIn("selected glass sphere", self.program.text)

    def test_a_script_plays_in_the_window(self):
        script, times = (pathlib.Path(self.folder.name) / name for name in ("s.json", "times.json"))
        script.write_text(json.dumps({"seconds": 3, "events": [
            {"from": 0, "to": 2.9, "object": "glass sphere", "by": [0.3, 0, 0]},
            {"at": 3, "material": "lamp", "emission": [0, 0, 0]}]}))
        self.start("--script", script, "--stats", times, "--filter-at", "clients")  # motion comes as codes
        bright = self.until(lambda p: p.mean() > LIT, "the beginning: light", "script")
        self.screen.key("Tab")
        self.until(lambda p: p.mean() < 0.5 * LIT, "the end: darkness")
        self.screen.key("space")
        self.until(lambda p: p.mean() > LIT, "the beginning again")
        self.until(lambda p: p.mean() < 0.5 * LIT, "the end again")
        self.screen.key("ctrl+q")
        self.assertEqual(self.program.process.wait(60), 0, self.program.text)
        self.assertGreater(json.loads(times.read_text())["latency_ms"]["count"], 1)

    def test_an_edit_without_room_for_its_lines_goes_on_with_fewer(self):
        """The tall block of cornell grows by a twist, which --max-field-memory has no room for; then a person switches the lamp."""
        script = pathlib.Path(self.folder.name) / "grows.json"
        script.write_text(json.dumps({"seconds": 2, "events": [{"from": 0, "to": 2, "object": "tall block", "twist": 340}]}))
        self.start("--script", script, "--method", "intersection-field", "--field-photons", "4096", "--max-field-memory", "37",
                   scene=SCENES / "cornell.glb", camera="0")
        self.program.waits_for("after this edit the intersection field would take \\d+ MiB, --max-field-memory is 37: .*; "
                               "the picture goes on with \\d+ x \\d+")
        self.screen.key("Tab")
        twisted = self.rest("too_large")
        self.assertGreater(twisted.mean(), LIT / 2)
        self.screen.click(*self.cornell_lamp_at)
        self.program.waits_for("selected lamp")
        self.screen.key("l")
        self.until(lambda p: p.mean() < 0.35 * twisted.mean(), "darkness", "too_large_dark")
        self.screen.key("l", "Escape")
        self.until(lambda p: p.difference(twisted) < CALM, "light again")
        self.assertNotIn("is gone", self.program.text)
        self.screen.key("ctrl+q")
        self.assertEqual(self.program.process.wait(60), 0, self.program.text)

    def test_an_animation_plays_over_and_over_and_pauses(self):
        scene = pathlib.Path(self.folder.name) / "moves.gltf"
        scene.write_text(moving_square())
        self.start("--animate", "0:2:25", scene=scene, camera="0")
        self.program.waits_for("is ready")
        self.screen.key("Tab")

        def where(picture):  # of the red square
            places = picture.places(lambda r, g, b: r > g + 30 and r > b + 30)
            return sum(x for x, _ in places) / len(places) if len(places) > 100 else WIDTH / 2
        left, right = WIDTH / 2 - 40, WIDTH / 2 + 40
        for turn in range(2):
            self.until(lambda p: where(p) < left, f"the square on the left, turn {turn}")
            self.until(lambda p: where(p) > right, f"the square on the right, turn {turn}")
        self.until(lambda p: where(p) < left, "on the left again")
        self.screen.key("space")
        stopped = where(self.rest("paused"))
        self.assertLess(abs(where(self.rest()) - stopped), 2, "it stays")
        self.screen.key("space")
        self.until(lambda p: abs(where(p) - stopped) > 40, "it goes on")

    def test_a_view_that_was_kept_is_a_camera_of_the_saved_scene(self):
        self.start()
        self.rest()
        self.screen.key("Tab")
        first = self.rest()
        self.screen.hold("d", 0.4)
        walked = self.rest()
        self.assertGreater(walked.difference(first), 8)
        self.screen.key("v")
        spec = self.program.waits_for(r"view 1: --camera (\S+)").group(1)
        self.assertIn("table_room.glb*", self.title(), "a view that no file has")
        self.screen.key("ctrl+s")
        time.sleep(0.5)
        self.look("save_dialog")
        self.screen.do("key", "ctrl+a")
        self.screen.do("type", str(pathlib.Path(self.folder.name) / "kept.glb"))
        time.sleep(0.5)
        self.look("save_dialog_named")
        self.screen.key("Return")
        saved = self.program.waits_for(r"the edited scene is in (\S+)").group(1)
        self.screen.key("ctrl+q")
        self.assertEqual(self.program.process.wait(60), 0, self.program.text)
        self.start(scene=saved, camera="view 1")
        self.rest()
        self.screen.key("Tab")
        self.until(lambda p: p.difference(walked) < CALM, "the view that was kept, from the file", "kept")
        self.screen.key("ctrl+q")
        self.program.process.wait(60)
        self.start(camera=spec)
        self.rest()
        self.screen.key("Tab")
        self.until(lambda p: p.difference(walked) < CALM, "the view that was kept, from its line")

    sphere_at = (397, 341)  # as the camera sees them
    lamp_at = (360, 113)
    cornell_lamp_at = (360, 60)

    def test_no_display_is_one_line_and_the_picture_is_made(self):
        os.environ.pop("DISPLAY", None)
        folder = pathlib.Path(self.folder.name)
        job = [BIN / "ninefold-master", SCENES / "cornell.glb", "--size", "48x36", "--frames", "2", "--view", "direct",
               "--local-clients", "1", "--output"]
        program = Program([*job, folder / "fallback.png", "--window"], self.folder.name)
        program.process.wait(120)
        program.reader.join()
        self.assertEqual(program.process.returncode, 0, program.text)
        self.assertEqual(len([line for line in program.lines if "going on without a window" in line]), 1, program.text)
        subprocess.run([*job, folder / "headless.png"], check=True, capture_output=True, timeout=120)
        self.assertEqual((folder / "fallback.png").read_bytes(), (folder / "headless.png").read_bytes())


if __name__ == "__main__":
    unittest.main(verbosity=2)

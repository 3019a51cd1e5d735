"""Pictures of scripts and animations: each is the still of its moment, whatever happens to the clients."""
import json
import unittest

import png
from bending_square import bending_square
from moving_square import moving_square
from programs import BIN, SCENES, ClusterTest, signal


class Pictures(ClusterTest):
    def pictures(self, pattern):
        return [p.read_bytes() for p in sorted(self.folder.glob(pattern))]

    def run_master(self, scene, *options):
        program = self.start(BIN / "ninefold-master", scene, "--size", self.SIZE, "--local-clients", 2, *options)
        self.assertEqual(program.ends(), 0, program.text)
        return program

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name


class Animation(Pictures):
    def test_every_picture_is_the_still_of_its_moment(self):
        """At the same exposure: without one the first picture of each run tells it."""
        scene = self.write("moves.gltf", moving_square())
        self.run_master(scene, "--animate", "0:2:2", "--frames", 3, "--exposure", 0, "--output", "a.##.png")
        played = self.pictures("a.*.png")
        self.assertEqual(len(played), 5)
        self.assertEqual(len(set(played)), 5)
        for i, place in ((0, -1), (3, 0.5)):
            self.run_master(self.write("still.gltf", moving_square(place)), "--frames", 3, "--exposure", 0, "--output", "still.png")
            still, picture = (png.read(self.folder / name) for name in ("still.png", f"a.0{i}.png"))
            self.assertTrue(still == picture, f"picture {i}, x = {place}")

    def test_what_bends_is_the_still_of_its_moment_too(self):
        scene = self.write("bends.gltf", bending_square())
        self.run_master(scene, "--animate", "0:2:2", "--frames", 3, "--exposure", 0, "--output", "a.##.png")
        self.assertEqual(len(set(self.pictures("a.*.png"))), 5)
        for i in (0, 3):
            self.run_master(self.write("still.gltf", bending_square(i / 2)), "--frames", 3, "--exposure", 0, "--output", "still.png")
            still, picture = (png.read(self.folder / name) for name in ("still.png", f"a.0{i}.png"))
            self.assertTrue(still == picture, f"picture {i}")

    def test_it_is_a_script(self):
        scene = self.write("moves.gltf", moving_square())
        self.write("s.json", json.dumps({"seconds": 1, "rate": 3, "frames": 2, "events": [
            {"from": 0, "to": 1, "animation": [0.5, 1.5]}]}))
        self.run_master(scene, "--script", "s.json", "--output", "s.#.png")
        self.run_master(scene, "--animate", "0.5:1.5:3", "--frames", 2, "--output", "a.#.png")
        self.assertEqual(len(self.pictures("a.*.png")), 4)
        self.assertTrue(self.pictures("a.*.png") == self.pictures("s.*.png"))

    def test_a_scene_without_animation_says_so_in_one_line(self):
        program = self.start(BIN / "ninefold-master", SCENES / "cornell.glb", "--animate", "0:1:5", "--output", "a.#.png")
        self.assertEqual(program.ends(), 1)
        self.assertRegex(program.lines[-1], r"^ninefold-master: --animate: nothing is animated")


class Deformation(Pictures):
    EVENT = {"object": "tall block", "twist": 60}

    def script(self, name, *events, frames=2):
        script = {"seconds": 1, "rate": 2, "frames": frames, "events": list(events)}
        return self.write(name, json.dumps(script))

    def test_a_twisted_thing_is_the_same_picture_whoever_dies_and_joins(self):
        cornell = SCENES / "cornell.glb"
        # So many frames that a client can die before the last one.
        script = self.script("s.json", {"from": 0, "to": 1, **self.EVENT}, frames=400)
        self.run_master(cornell, "--script", script, "--output", "a.#.png")
        twisted = self.pictures("a.*.png")
        self.assertEqual(len(set(twisted)), 3)
        master = self.start(BIN / "ninefold-master", cornell, "--size", self.SIZE, "--local-clients", 2, "--wait-clients", 2,
                            "--script", "s.json", "--output", "b.#.png")
        master.waits_for("the shape of '.*' changes")
        self.send(master.children()[0], signal.SIGKILL)
        self.assertEqual(master.ends(), 0, master.text)
        self.assertTrue(self.pictures("b.*.png") == twisted)

    def test_what_has_no_top_is_refused_in_one_line(self):
        self.script("s.json", {"at": 0, "object": "lamp", "twist": 60})
        program = self.start(BIN / "ninefold-master", SCENES / "cornell.glb", "--script", "s.json", "--output", "a.#.png")
        self.assertEqual(program.ends(), 1)
        self.assertRegex(program.lines[-1], r"s.json: event 0: 'lamp' is flat: it has no top to be twisted")


class Shots(Pictures):
    """What is on the screen of a session in real time."""
    SCRIPT = {"seconds": 1, "shots": 5, "events": [
        {"from": 0.25, "to": 0.75, "camera": ["classic", "0.1,0.2,-0.8:0.278,0.273,0:40"]}]}

    def play(self, script, *options):
        self.write("s.json", json.dumps(script))
        self.run_master(SCENES / "cornell.glb", "--script", "s.json", "--stats", "times.json", *options)
        return json.loads((self.folder / "times.json").read_text())

    def test_there_is_one_for_each_moment_and_each_tells_its_frame(self):
        times = self.play(self.SCRIPT, "--output", "s.##.png", "--denoise", "off")
        shots = times["shots"]
        self.assertEqual([s["shot"] for s in shots], [0, 1, 2, 3, 4, 5])
        self.assertEqual([p.name for p in sorted(self.folder.glob("s.*.png"))],
                         [f"s.{s['shot']:02d}.png" for s in shots if not s["lost"]])
        seen = {f["frame"]: f["time"] for f in times["frames"]}
        for shot in shots:
            self.assertLess(shot["opened"], shot["shown"])
            self.assertLessEqual(shot["shown"], shot["shot"] / 5)
            if shot["shown"] > 0:
                self.assertEqual(seen[shot["frame"]], shot["shown"])

    def test_radiance_is_written_too(self):
        self.play(self.SCRIPT, "--output", "s.##.exr")
        first, last = ((self.folder / f"s.0{i}.exr").read_bytes() for i in (0, 5))
        self.assertNotEqual(first, last)

    def test_they_need_numbered_files(self):
        self.write("s.json", json.dumps(self.SCRIPT))
        program = self.start(BIN / "ninefold-master", SCENES / "cornell.glb", "--script", "s.json", "--output", "s.png")
        self.assertEqual(program.ends(), 1)
        self.assertRegex(program.lines[-1], "a script with a rate or shots needs --output")


class Disturbed(Pictures):
    """Edits while clients join, die and rejoin leave no stale pixel."""
    SCRIPT = {"seconds": 4, "rate": 10, "frames": 2, "events": [
        {"from": 0, "to": 4, "object": "glass sphere", "by": [0.3, 0, 0.1]},
        {"from": 1, "to": 2, "material": "lamp", "emission": [4, 1, 1]},
        {"from": 2, "to": 3, "object": "table", "by": [0, 0.1, 0], "turn": 20},
        {"from": 3, "to": 4, "material": "lamp", "emission": [9, 9, 9]},
        {"from": 0, "to": 4, "camera": ["0.15,1.5,2.25:0,1.5,-0.5:60", "0.4,1.5,2.25:0,1.5,-0.5:60"]}]}

    def test_joining_dying_and_rejoining_clients_do_not_show(self):
        self.write("s.json", json.dumps(self.SCRIPT))
        scene, size = SCENES / "table_room.glb", ["--size", self.SIZE]
        self.run_master(scene, "--script", "s.json", "--output", "calm.##.png")
        self.new_key()
        master = self.start(BIN / "ninefold-master", scene, *size, "--script", "s.json", "--output", "wild.##.png",
                            "--local-clients", 0, "--key-file", "cluster.key")
        address = self.address_of(master)
        # Whoever is killed was alone: from then on all pictures are the next one's, who joins in mid-session.
        alone = self.client(address, cache="cache")
        for picture in (3, 9, 15):
            master.waits_for(f"picture {picture} of 41")
            self.send(alone.process.pid, signal.SIGKILL)
            alone = self.client(address, cache="cache")
        master.waits_for("picture 21 of 41")
        other = self.client(address)
        master.waits_for(r"(client \d+ is ready(.|\n)*){5}")
        self.send(alone.process.pid, signal.SIGKILL)
        master.waits_for("picture 30 of 41")
        self.client(address, cache="cache")
        self.send(other.process.pid, signal.SIGKILL)
        self.assertEqual(master.ends(), 0, master.text)
        calm, wild = self.pictures("calm.*.png"), self.pictures("wild.*.png")
        self.assertEqual(len(calm), 41)
        self.assertEqual(len(set(calm)), 41)
        self.assertEqual([i for i in range(41) if calm[i] != wild[i]], [])
        ready = master.text.count("is ready")
        self.assertEqual(ready, 6, master.text)


if __name__ == "__main__":
    unittest.main()

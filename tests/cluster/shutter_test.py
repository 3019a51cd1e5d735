"""Motion blur, --shutter: a picture is the mean of moments."""
import json
import unittest

import png
from moving_square import moving_square
from programs import BIN, ClusterTest, signal

SIZE = 64
LIGHT = 0.5  # of the square that shines [W/(m^2 sr)]


def shining(text):
    """The square of the scene shines and the floor is black, seen from straight above: 4 m are 64 pixels."""
    scene = json.loads(text)
    scene["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}},
                          {"emissiveFactor": [LIGHT] * 3, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}}]
    scene["nodes"][2] = {"camera": 0, "translation": [0, 4.5, 0], "rotation": [-0.70710678, 0, 0, 0.70710678]}
    scene["cameras"][0]["perspective"]["yfov"] = 0.92729522  # 2 atan(2 m / 4 m): the square's height is 0.5
    return json.dumps(scene)


def light(code):
    """Of a code of sRGB."""
    y = code / 255
    return y / 12.92 if y <= 0.04045 else ((y + 0.055) / 1.055) ** 2.4


class Shutter(ClusterTest):
    def render(self, output, *options, scene=None, animate="0:2:1", clients=2):
        (self.folder / "moves.gltf").write_text(scene or shining(moving_square()))
        master = self.start(BIN / "ninefold-master", "moves.gltf", "--size", f"{SIZE}x{SIZE}", "--exposure", 0, "--denoise", "off",
                            "--animate", animate, "--local-clients", clients, "--output", output, *options)
        self.assertEqual(master.ends(), 0, master.text)
        return master

    def profile(self, name):
        """Light along the middle row."""
        return [light(row) for row, _, _ in png.read(self.folder / name)[2][SIZE // 2]]

    def test_a_moving_square_leaves_a_trapezoid(self):
        """It goes 1 m a second, is 1 m wide and starts with its middle at x = -1 m. Open for half a second, at N = 32 moments, a
        pixel gets the fraction of moments at which the square is over it."""
        for method in ("path-trace", "instant-radiosity"):
            self.render("a.#.png", "--frames", 32, "--shutter", 0.5, "--method", method)
            for picture in (0, 1):
                begin = -1 + picture
                moments = [begin + 0.5 * (k + 0.5) / 32 for k in range(32)]
                for x, got in enumerate(self.profile(f"a.{picture}.png")):
                    place = (x + 0.5) / SIZE * 4 - 2
                    covered = sum(min(max((0.5 - abs(place - m)) * SIZE / 4 + 0.5, 0), 1) for m in moments) / 32
                    self.assertAlmostEqual(got, LIGHT * covered, delta=0.035, msg=f"{method}, picture {picture}, pixel {x}")

    def test_what_rests_has_the_same_bytes_as_without(self):
        """After the last key."""
        self.render("a.#.png", "--frames", 4, "--shutter", 1, scene=moving_square(), animate="3:5:1")
        self.render("b.#.png", "--frames", 4, scene=moving_square(), animate="3:5:1")
        for i in range(3):
            self.assertTrue((self.folder / f"a.{i}.png").read_bytes() == (self.folder / f"b.{i}.png").read_bytes(), i)

    def test_the_bytes_are_the_same_whatever_happens_to_the_clients(self):
        for method in ("instant-radiosity", "photon-map", "selective-photons"):
            options = ["--frames", 6, "--shutter", 0.8, "--method", method]
            self.render("a.#.png", *options, clients=1, scene=moving_square())
            self.render("b.#.png", *options, clients=3, scene=moving_square())
            for i in range(3):
                first, second = ((self.folder / f"{name}.{i}.png").read_bytes() for name in "ab")
                self.assertTrue(first == second, f"{method} {i}")

    def test_a_client_that_dies_and_comes_again_does_not_show(self):
        scene, options = moving_square(), ["--frames", 8, "--shutter", 1, "--method", "path-trace"]
        self.render("calm.#.png", *options, scene=scene, animate="0:2:3")
        self.new_key()
        master = self.start(BIN / "ninefold-master", "moves.gltf", "--size", f"{SIZE}x{SIZE}", "--exposure", 0, "--denoise", "off",
                            "--animate", "0:2:3", *options, "--local-clients", 0, "--key-file", "cluster.key", "--output", "wild.#.png")
        address = self.address_of(master)
        alone = self.client(address)
        for picture in (1, 3, 4):
            master.waits_for(f"picture {picture} of 7")
            self.send(alone.process.pid, signal.SIGKILL)
            alone = self.client(address)
        self.assertEqual(master.ends(), 0, master.text)
        for i in range(7):
            calm, wild = ((self.folder / f"{name}.{i}.png").read_bytes() for name in ("calm", "wild"))
            self.assertTrue(calm == wild, i)

    def test_a_script_has_it_too(self):
        (self.folder / "s.json").write_text(json.dumps({"seconds": 1, "rate": 1, "frames": 4, "events": [
            {"from": 0, "to": 1, "animation": [0, 1]}]}))
        self.render("a.#.png", "--frames", 4, "--shutter", 0.5, animate="0:1:1")
        master = self.start(BIN / "ninefold-master", "moves.gltf", "--size", f"{SIZE}x{SIZE}", "--exposure", 0, "--denoise", "off",
                            "--script", "s.json", "--shutter", 0.5, "--output", "s.#.png")
        self.assertEqual(master.ends(), 0, master.text)
        self.assertTrue((self.folder / "a.0.png").read_bytes() == (self.folder / "s.0.png").read_bytes())

    def test_what_cannot_be_blurred_is_told(self):
        (self.folder / "moves.gltf").write_text(moving_square())
        (self.folder / "live.json").write_text('{"seconds": 1, "events": []}')
        (self.folder / "one.json").write_text('{"seconds": 1, "rate": 2, "events": []}')
        for options, status, line in (
                (["--frames", 4, "--output", "a.png"], 2, "--shutter needs --animate"),
                (["--animate", "0:1:2", "--frames", 1, "--output", "a.#.png"], 2, "mean of a picture's frames"),
                (["--script", "live.json", "--output", "a.png"], 1, "need a script with a rate"),
                (["--script", "one.json", "--output", "a.#.png"], 1, "give the script \"frames\"")):
            master = self.start(BIN / "ninefold-master", "moves.gltf", "--shutter", 0.5, *options)
            self.assertEqual(master.ends(), status, master.text)
            self.assertIn(line, master.lines[-1])


if __name__ == "__main__":
    unittest.main()

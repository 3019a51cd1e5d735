"""Filtered by the clients, a picture is the one that the master makes, to the wire's precision, at borders too."""
import json
import math
import unittest

import png
from programs import BIN, SCENES, ClusterTest, methods

TILE = 96  # pixels: 32 of each of 3 x 3 phases


def pixels(path):
    """Rows of (r, g, b) of a Radiance .hdr without run-length coding, or with it."""
    data = path.read_bytes()
    head, _, rest = data.partition(b"\n\n")
    size, _, body = rest.partition(b"\n")
    height, width = int(size.split()[1]), int(size.split()[3])
    rows, at = [], 0
    for _ in range(height):
        channels, at = scanline(body, at, width)
        rows.append([tuple(channels[c][x] * 2.0 ** (channels[3][x] - 136) for c in range(3)) for x in range(width)])
    return rows


def scanline(body, at, width):
    if body[at] == 2 and body[at + 1] == 2 and width >= 8:
        at += 4
        channels = []
        for _ in range(4):
            values = bytearray()
            while len(values) < width:
                count = body[at]
                if count > 128:
                    values += bytes([body[at + 1]]) * (count - 128)
                    at += 2
                else:
                    values += body[at + 1:at + 1 + count]
                    at += 1 + count
            channels.append(values)
        return channels, at
    return [body[at + c:at + 4 * width:4] for c in range(4)], at + 4 * width


# Receivers of a task that lie together share rays that tell how much surface is around. At a border they lie with others.
SHARING = ("photon-map",)


class FilterAtClients(ClusterTest):
    def picture(self, where, *options):
        name = self.folder / f"{where}.hdr"
        master = self.start(BIN / "ninefold-master", SCENES / "table_room.glb", "--size", "200x200", "--frames", 1,
                            "--local-clients", 2, "--filter-at", where, *options, "--output", name)
        self.assertEqual(master.ends(), 0, master.text)
        return pixels(name)

    def errors(self, *options):
        """Root mean squares of the difference over the pixel's largest channel: within tiles, at their borders."""
        master, clients = self.picture("master", *options), self.picture("clients", *options)
        inside, border = [], []
        for y, (row, other) in enumerate(zip(master, clients)):
            for x, (a, b) in enumerate(zip(row, other)):
                scale = max(*a, *b, 1e-3)
                error = max(abs(p - q) for p, q in zip(a, b)) / scale
                at_border = x % TILE in (0, TILE - 1) or y % TILE in (0, TILE - 1)
                (border if at_border else inside).append(error)
        return [math.sqrt(sum(e * e for e in errors) / len(errors)) for errors in (inside, border)]

    def test_differs_by_no_more_than_quantization_and_not_at_borders(self):
        # The master's pixel is of nine quantized E, each off by up to 1/127.5 of its largest channel, and of a
        # reflectance off by up to 2/255 of its root; the clients' is quantized once; the file adds 1/128.
        for method in methods():
            with self.subTest(method):
                inside, border = self.errors("--method", method, "--vpl-roulette", 0)
                self.assertGreater(inside, 0, "the two modes are not the same code")
                self.assertLess(inside, 0.02)
                self.assertLess(border, (3 if method in SHARING else 1.3) * inside)

    def test_with_roulette_only_the_borders_noise_is_another(self):
        # Receivers that share a packet share their choice of lights; at a border they are in other packets.
        inside, _ = self.errors("--vpl-roulette", 2)
        self.assertLess(inside, 0.02)


def code(radiance):
    """As common/image/tone_map.h says, at exposure 0."""
    y = radiance if radiance <= 0.8 else 0.8 + 0.2 * (1 - math.exp(-(radiance - 0.8) / 0.2))
    return 255 * (12.92 * y if y <= 0.0031308 else 1.055 * y ** (1 / 2.4) - 0.055)


class Sessions(ClusterTest):
    """A frame that is not summed up comes as a display's codes, if nobody wants more."""
    CAMERA = "0.15,1.5,2.25:0,1.5,-0.5:60"
    SIZE = ["--size", "200x120"]

    def run_master(self, *options, clients=2, filter_at="clients"):
        master = self.start(BIN / "ninefold-master", SCENES / "table_room.glb", *self.SIZE, "--filter-at", filter_at,
                            "--local-clients", clients, *options)
        self.assertEqual(master.ends(), 0, master.text)

    def script(self, name, **fields):
        (self.folder / name).write_text(json.dumps(fields))
        return name

    def stills(self, name, frames, *options, **more):
        """Three pictures, the last with the camera where it stands in the file."""
        script = self.script(f"{name}.json", seconds=2, rate=1, frames=frames, events=[
            {"from": 0, "to": 2, "camera": ["0.4,1.5,2.25:0,1.5,-0.5:60", self.CAMERA]}])
        self.run_master("--script", script, "--output", f"{name}.#.png", *options, **more)
        return [self.folder / f"{name}.{i}.png" for i in range(3)]

    def test_a_still_of_one_frame_is_the_tone_mapped_radiance_to_its_bound(self):
        stills = self.stills("s", 1)
        self.run_master("--camera", self.CAMERA, "--frames", 1, "--output", "still.hdr")
        codes, radiance = png.read(stills[2])[2], pixels(self.folder / "still.hdr")
        differing = 0
        for row, other in zip(codes, radiance):
            for pixel, light in zip(row, other):
                off = max(light) * (1 / 127.5 + 1 / 128) * 1.02  # the wire's step, and the file's
                for got, wanted in zip(pixel, light):
                    self.assertGreaterEqual(got, code(max(0, wanted - off)) - 1.2)
                    self.assertLessEqual(got, code(wanted + off) + 1.2)
                    differing += got != round(code(wanted))
        self.assertGreater(differing, 0, "the codes were not made of the same rounded radiance")
        self.assertEqual([p.read_bytes() for p in stills], [p.read_bytes() for p in self.stills("t", 1, clients=1)])

    def test_stills_of_more_frames_are_those_of_a_headless_run(self):
        last = self.stills("s", 2)[2]
        self.run_master("--camera", self.CAMERA, "--frames", 2, "--output", "still.png")
        self.assertTrue(png.read(last) == png.read(self.folder / "still.png"))

    def test_what_is_no_light_is_made_by_the_master(self):
        clients = self.stills("s", 1, "--view", "normal")
        master = self.stills("m", 1, "--view", "normal", filter_at="master")
        self.assertEqual([p.read_bytes() for p in clients], [p.read_bytes() for p in master])

    def forms(self, output):
        """Of the frames of a session in real time: in motion, at rest."""
        script = self.script("live.json", seconds=1.5, frames=3, events=[
            {"from": 0, "to": 1.5, "camera": ["0.4,1.5,2.25:0,1.5,-0.5:60", self.CAMERA]}])
        self.run_master("--script", script, "--output", output, "--stats", "live.stats")
        frames = json.loads((self.folder / "live.stats").read_text())["frames"]
        return [{f["form"] for f in frames if f["moving"] == moving} for moving in (True, False)]

    def test_motion_comes_as_codes_and_rest_as_radiance(self):
        self.assertEqual(self.forms("end.png"), [{"codes"}, {"radiance"}])
        self.run_master("--camera", self.CAMERA, "--frames", 3, "--output", "still.png")
        end, still = (png.read(self.folder / name)[2] for name in ("end.png", "still.png"))
        off = [abs(p - q) for row, other in zip(end, still) for a, b in zip(row, other) for p, q in zip(a, b)]
        self.assertLess(sum(off) / len(off), 3, "the rest's frames, and no code from before it")

    def test_who_wants_radiance_gets_it_in_motion_too(self):
        self.assertEqual(self.forms("end.exr"), [{"radiance"}, {"radiance"}])


if __name__ == "__main__":
    unittest.main()

"""Filtered by the clients, a picture is the one that the master makes, to the wire's precision, at borders too."""
import math
import unittest

from programs import BIN, SCENES, ClusterTest

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


class FilterAtClients(ClusterTest):
    def picture(self, where, roulette):
        name = self.folder / f"{where}{roulette}.hdr"
        master = self.start(BIN / "ninefold-master", SCENES / "table_room.glb", "--size", "200x200", "--frames", 1,
                            "--local-clients", 2, "--filter-at", where, "--vpl-roulette", roulette, "--output", name)
        self.assertEqual(master.ends(), 0, master.text)
        return pixels(name)

    def errors(self, roulette):
        """Root mean squares of the difference over the pixel's largest channel: within tiles, at their borders."""
        master, clients = self.picture("master", roulette), self.picture("clients", roulette)
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
        inside, border = self.errors(roulette=0)
        self.assertGreater(inside, 0, "the two modes are not the same code")
        self.assertLess(inside, 0.02)
        self.assertLess(border, 1.3 * inside)

    def test_with_roulette_only_the_borders_noise_is_another(self):
        # Receivers that share a packet share their choice of lights; at a border they are in other packets.
        inside, _ = self.errors(roulette=2)
        self.assertLess(inside, 0.02)


if __name__ == "__main__":
    unittest.main()

"""screen.py: an X server in memory, real key and pointer events, and what is to be seen on it.

Xvfb keeps its screen in a file in the XWD format; events come from xdotool. Python's standard library only.
"""
import os
import pathlib
import struct
import subprocess
import tempfile
import time
import zlib


class Picture:
    """Part of the screen: rows of (r, g, b)."""

    def __init__(self, width, height, data):
        self.width, self.height, self.data = width, height, data

    def at(self, x, y):
        i = 3 * (y * self.width + x)
        return self.data[i], self.data[i + 1], self.data[i + 2]

    def cut(self, x0, y0, width, height):
        rows = [self.data[3 * (y * self.width + x0):3 * (y * self.width + x0 + width)] for y in range(y0, y0 + height)]
        return Picture(width, height, b"".join(rows))

    def mean(self):
        return sum(self.data) / len(self.data)

    def difference(self, other):
        """Mean absolute difference of the codes."""
        assert (self.width, self.height) == (other.width, other.height)
        return sum(abs(a - b) for a, b in zip(self.data, other.data)) / len(self.data)

    def places(self, is_wanted):
        return [(x, y) for y in range(self.height) for x in range(self.width) if is_wanted(*self.at(x, y))]

    def save(self, path):
        rows = b"".join(b"\0" + self.data[3 * y * self.width:3 * (y + 1) * self.width] for y in range(self.height))

        def chunk(kind, body):
            return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        head = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) +
                                       chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Screen:
    def __init__(self, width, height):
        self.folder = tempfile.TemporaryDirectory()
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", self.folder.name,
             "-nolisten", "tcp", "-noreset"], pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.display = ":" + pipe.readline().strip()
        self.environment = dict(os.environ, DISPLAY=self.display)

    def close(self):
        self.server.terminate()
        self.server.wait()
        self.folder.cleanup()

    def picture(self):
        data = (pathlib.Path(self.folder.name) / "Xvfb_screen0").read_bytes()
        head = struct.unpack(">25I", data[:100])
        width, height, pitch, start = head[4], head[5], head[12], head[0] + 12 * head[19]
        rows = []
        for y in range(height):
            row = data[start + y * pitch:start + y * pitch + 4 * width]
            rgb = bytearray(3 * width)
            rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
            rows.append(bytes(rgb))
        return Picture(width, height, b"".join(rows))

    def do(self, *arguments):
        return subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, check=True,
                              capture_output=True, text=True).stdout.strip()

    def key(self, *names):
        for name in names:
            self.do("key", name)

    def hold(self, name, seconds):
        self.do("keydown", name)
        time.sleep(seconds)
        self.do("keyup", name)

    def click(self, x, y):
        self.do("mousemove", x, y)
        time.sleep(0.2)  # a click and the way to it are two events to ImGui
        self.do("click", 1)

    def drag(self, x0, y0, x1, y1, steps=8):
        self.do("mousemove", x0, y0)
        time.sleep(0.2)
        self.do("mousedown", 1)
        for i in range(1, steps + 1):
            self.do("mousemove", x0 + (x1 - x0) * i // steps, y0 + (y1 - y0) * i // steps)
            time.sleep(0.05)
        self.do("mouseup", 1)

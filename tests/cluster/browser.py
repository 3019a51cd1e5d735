"""browser.py: what a browser does, by the standard library alone: requests, and a WebSocket (RFC 6455) whose
messages are those of master/web/viewer_message.h and master/web/web_offer.h.
"""
import base64
import hashlib
import json
import os
import re
import socket
import ssl
import struct
import time

from programs import BIN, DEADLINE, SCENES, ClusterTest

MAGIC = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Closed(Exception):
    """The master has closed the connection; the reason that it gave, if any."""


def open_socket(host, port, certificate=None):
    """With TLS if `certificate` is given: the PEM that must be shown, or True for any."""
    plain = socket.create_connection((host, port), DEADLINE)
    if not certificate:
        return plain
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = certificate is not True
    context.verify_mode = ssl.CERT_NONE if certificate is True else ssl.CERT_REQUIRED
    if certificate is not True:
        context.load_verify_locations(cadata=certificate)
    return context.wrap_socket(plain, server_hostname=host)


class Reader:
    def __init__(self, connection, rest=b""):
        self.connection, self.bytes = connection, rest

    def _more(self):
        try:
            more = self.connection.recv(65536)
        except (ConnectionError, ssl.SSLError) as error:
            raise Closed(str(error)) from error
        if not more:
            raise Closed("")
        self.bytes += more

    def take(self, size):
        while len(self.bytes) < size:
            self._more()
        taken, self.bytes = self.bytes[:size], self.bytes[size:]
        return taken

    def take_until(self, end):
        while end not in self.bytes:
            self._more()
        at = self.bytes.index(end) + len(end)
        return self.take(at)


def request(host, port, path="/", certificate=None, method="GET", **headers):
    """(status, headers, body) of one request. Header names have _ for -."""
    lines = {"Host": f"{host}:{port}", "Connection": "close"} | {k.replace("_", "-"): v for k, v in headers.items()}
    with open_socket(host, port, certificate) as connection:
        text = f"{method} {path} HTTP/1.1\r\n" + "".join(f"{k}: {v}\r\n" for k, v in lines.items()) + "\r\n"
        connection.sendall(text.encode())
        return read_response(Reader(connection), method)


def read_response(reader, method="GET"):
    head = reader.take_until(b"\r\n\r\n").decode().split("\r\n")
    fields = {name.lower(): value.strip() for name, value in (line.split(":", 1) for line in head[1:] if line)}
    size = 0 if method == "HEAD" else int(fields.get("content-length", 0))
    return int(head[0].split()[1]), fields, reader.take(size)


class WebSocket:
    def __init__(self, host, port, path="/live", certificate=None, **headers):
        """Upgraded, or self.status is not 101."""
        self.connection = open_socket(host, port, certificate)
        key = base64.b64encode(os.urandom(16))
        lines = {"Host": f"{host}:{port}", "Upgrade": "websocket", "Connection": "Upgrade",
                 "Sec-WebSocket-Key": key.decode(), "Sec-WebSocket-Version": "13"}
        lines |= {k.replace("_", "-"): v for k, v in headers.items()}
        text = f"GET {path} HTTP/1.1\r\n" + "".join(f"{k}: {v}\r\n" for k, v in lines.items()) + "\r\n"
        self.connection.sendall(text.encode())
        self.reader = Reader(self.connection)
        self.status, fields, self.refusal = read_response(self.reader)
        if self.status == 101:
            wanted = base64.b64encode(hashlib.sha1(key + MAGIC).digest()).decode()
            assert fields["sec-websocket-accept"] == wanted, fields

    def send(self, text, kind=TEXT, masked=True):
        body = text.encode() if isinstance(text, str) else text
        mask = os.urandom(4)
        size = len(body)
        head = bytes([0x80 | kind])
        flag = 0x80 if masked else 0
        head += bytes([flag | size]) if size < 126 else bytes([flag | 126]) + struct.pack(">H", size)
        data = bytes(b ^ mask[i % 4] for i, b in enumerate(body)) if masked else body
        try:
            self.connection.sendall(head + (mask if masked else b"") + data)
        except (ConnectionError, ssl.SSLError):
            self._read_to_the_end()

    def _read_to_the_end(self):
        """Who is turned away may notice only at the second message after it; why is in what has come."""
        while True:
            self.receive()

    def receive(self):
        """The next message as bytes. Pings are answered."""
        whole, end = b"", time.monotonic() + DEADLINE
        while time.monotonic() < end:  # pings alone are no news
            first, second = self.reader.take(2)
            size = second & 0x7F
            if size == 126:
                size = struct.unpack(">H", self.reader.take(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self.reader.take(8))[0]
            body = self.reader.take(size)
            kind = first & 0xF
            if kind == CLOSE:
                raise Closed(body[2:].decode())
            if kind == PING:
                self.send(body, PONG)
            elif kind != PONG:
                whole += body
                if first & 0x80:
                    return whole
        raise AssertionError(f"nothing came within {DEADLINE} s")

    def wait(self, seconds):
        """Whether something comes within that time."""
        if self.reader.bytes:
            return True
        self.connection.settimeout(seconds)
        try:
            self.reader.bytes += self.connection.recv(65536)
            return True
        except (TimeoutError, socket.timeout):
            return False
        finally:
            self.connection.settimeout(DEADLINE)

    def close(self):
        self.connection.close()


class Viewer(WebSocket):
    """A page that looks on: says hello, shows what it gets."""

    def __init__(self, host, port, token="", **more):
        super().__init__(host, port, **more)
        assert self.status == 101, (self.status, self.refusal)
        self.head, self.picture, self.files = {}, b"", {}
        self.send(f"hello {token}".strip())
        self.send("size 96 72")

    def look(self, shows=True):
        """The next update: its head. What comes with it is in `picture` or `files`."""
        message = self.receive()
        size = struct.unpack("<I", message[:4])[0]
        self.head = json.loads(message[4:4 + size])
        body = message[4 + size:]
        if "file" in self.head:
            self.files[self.head["file"]] = body
        elif body:
            self.picture = body
        if shows:
            self.send("shown")
        return self.head

    def look_until(self, condition):
        end = time.monotonic() + DEADLINE
        while time.monotonic() < end:
            self.look()
            if condition(self.head):
                return self.head
        raise AssertionError(f"never seen; last: {self.head}")

    def click(self, x, y, held="-"):
        self.send(f"button down left {x} {y} {held}")
        self.send(f"button up left {x} {y} {held}")

    def press(self, key, held="-"):
        self.send(f"key down {key} {held}")
        self.send(f"key up {key} {held}")


class ServeTest(ClusterTest):
    """A master that serves, and viewers at it."""

    def serve(self, *options, address="127.0.0.1:0", scene="table_room", clients=1):
        self.master = self.start(BIN / "ninefold-master", SCENES / f"{scene}.glb", "--size", self.SIZE, "--serve",
                                 address, "--local-clients", clients, *options)
        found = self.master.waits_for(r"serving at (https?)://(\S+):(\d+)/#token=(\S+)")
        self.port, self.token = int(found.group(3)), found.group(4)
        return found

    def view(self, **more):
        viewer = Viewer("127.0.0.1", self.port, **{"token": self.token} | more)
        self.addCleanup(viewer.close)
        return viewer

    def metrics(self, **more):
        return request("127.0.0.1", self.port, "/metrics", Authorization=f"Bearer {self.token}", **more)

    def at_rest(self, viewer, frames=2):
        return viewer.look_until(lambda head: head.get("frames", 0) >= frames and not head["moving"])

    def expect_line(self, pattern):
        self.master.waits_for(pattern)

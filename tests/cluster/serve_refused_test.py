"""Who is turned away by a master that serves browsers."""
import contextlib
import unittest

from browser import BINARY, Closed, ServeTest, WebSocket, open_socket, request


class TurnsAway(ServeTest):
    def turned_away(self, viewer, pattern):
        with self.assertRaises(Closed) as closed:
            while True:
                viewer.receive()
        self.expect_line(pattern)
        return str(closed.exception)

    def status_of(self, **headers):
        """Of a WebSocket's request."""
        socket = WebSocket("127.0.0.1", self.port, **headers)
        self.addCleanup(socket.close)
        return socket.status

    def test_bad_messages_end_the_connection_and_nothing_else(self):
        self.serve()
        good = self.view()
        self.at_rest(good)
        for message, why in (("fly away", "unknown verb"), ("view nothing", "unknown view"), ("hello", "second hello"),
                             ("move 1 nan -", "bad y")):
            bad = self.view()
            bad.send(message)
            self.assertIn(why, self.turned_away(bad, why))
            good.look_until(lambda head: head["viewers"] == 1)  # who answers no ping for long is sent away, too
        binary = self.view()
        binary.send(b"shown", BINARY)
        self.turned_away(binary, "not text")
        good.look_until(lambda head: head["viewers"] == 1)
        long = self.view()
        long.send("x" * 1000)
        self.turned_away(long, "warning: browser at")
        bare = self.view()
        bare.send("shown", masked=False)
        self.turned_away(bare, "warning: browser at")
        good.look_until(lambda head: head["viewers"] == 1)
        eager = self.view()
        with self.assertRaises(Closed):
            for _ in range(100):
                eager.send("shown")
            while True:
                eager.receive()
        self.expect_line("no update was under way")
        good.look_until(lambda head: head["viewers"] == 1)

    def test_a_flood(self):
        self.serve()
        viewer = self.view()
        self.at_rest(viewer)
        try:
            for _ in range(5000):
                viewer.send("ask")
        except Closed:
            pass
        self.expect_line("messages a second")

    def test_strangers(self):
        self.serve()
        at = f"127.0.0.1:{self.port}"
        for headers in {"Host": "evil.test"}, {"Host": at, "Origin": "http://evil.test"}, {"Host": at, "Origin": "null"}:
            for path in "/", "/metrics":
                self.assertEqual(request("127.0.0.1", self.port, path, **headers)[0], 403, headers)
            self.assertEqual(self.status_of(**headers), 403, headers)
        self.assertEqual(self.status_of(Origin=f"http://{at}"), 101)
        self.assertEqual(request("127.0.0.1", self.port, method="POST")[0], 405)
        self.assertEqual(request("127.0.0.1", self.port, "/none")[0], 404)
        self.expect_line("browser at 127.0.0.1")

    def test_no_hello(self):
        self.serve()
        silent = WebSocket("127.0.0.1", self.port)
        self.addCleanup(silent.close)
        with self.assertRaises(Closed):
            silent.receive()
        self.expect_line("no hello within 5 s")

    def test_one_viewer_too_many(self):
        self.serve()
        viewers = [self.view() for _ in range(16)]
        viewers[-1].look_until(lambda head: head["viewers"] == 16)
        self.assertIn("16 viewers", self.turned_away(self.view(), "16 viewers"))

    def test_garbage_and_half_requests(self):
        self.serve()
        ends = []
        for sent in (b"\x16\x03\x01\x00\xff" * 100, b"GET / HTTP/1.1\r\nHost: a\r\n" + b"X: y\r\n" * 5000, b"\r\n" * 9000,
                     b"GET / HTT"):
            ends.append(open_socket("127.0.0.1", self.port))
            self.addCleanup(ends[-1].close)
            with contextlib.suppress(ConnectionError):
                ends[-1].sendall(sent)
        self.at_rest(self.view())
        for end in ends:  # at once, or after the deadline of a request
            with contextlib.suppress(ConnectionError):
                while end.recv(1000):
                    pass


if __name__ == "__main__":
    unittest.main()

"""Who is turned away by a master that serves browsers, and what makes it safe here and beyond loopback."""
import hashlib
import re
import ssl
import subprocess
import unittest

from browser import BINARY, Closed, ServeTest, WebSocket, open_socket, request
from programs import BIN, SCENES


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
        binary = self.view()
        binary.send(b"shown", BINARY)
        self.turned_away(binary, "not text")
        long = self.view()
        long.send("x" * 1000)
        self.turned_away(long, "warning: browser at")
        bare = self.view()
        bare.send("shown", masked=False)
        self.turned_away(bare, "warning: browser at")
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
        for garbage in b"\x16\x03\x01\x00\xff" * 100, b"GET / HTTP/1.1\r\nHost: a\r\n" + b"X: y\r\n" * 5000, b"\r\n" * 9000:
            with open_socket("127.0.0.1", self.port) as connection:
                try:
                    connection.sendall(garbage)
                    connection.recv(1)
                except ConnectionError:
                    pass
        half = open_socket("127.0.0.1", self.port)
        self.addCleanup(half.close)
        half.sendall(b"GET / HTT")
        self.at_rest(self.view())
        self.assertEqual(half.recv(1), b"")  # after its deadline


class Secrets(ServeTest):
    def expect_token(self, **more):
        """Without it there are no numbers and no pictures."""
        wrong = "0" * 64
        self.assertEqual(request("127.0.0.1", self.port, "/metrics", **more)[0], 401)
        self.assertEqual(request("127.0.0.1", self.port, "/metrics", Authorization=f"Bearer {wrong}", **more)[0], 401)
        self.assertEqual(self.metrics(**more)[0], 200)
        for token in "", wrong, self.token[:-1]:
            with self.assertRaises(Closed) as closed:
                self.view(token=token, **more).receive()
            self.assertIn("wrong token", str(closed.exception))
        self.expect_line("wrong token")
        self.at_rest(self.view(**more))

    def test_other_users_of_this_machine_have_no_token(self):
        self.serve()
        self.assertEqual(len(self.token), 64)
        self.expect_token()

    def test_token_and_tls(self):
        found = self.serve(address="0.0.0.0:0")
        self.assertEqual(found.group(1), "https")
        self.assertEqual(len(self.token), 64)
        with open_socket("127.0.0.1", self.port, True) as connection:
            self.assertEqual(connection.version(), "TLSv1.3")
            shown = connection.getpeercert(binary_form=True)
        fingerprint = hashlib.sha256(shown).hexdigest().upper()
        self.expect_line(":".join(fingerprint[i:i + 2] for i in range(0, 64, 2)))
        certificate = ssl.DER_cert_to_PEM_cert(shown)  # good for this address
        self.assertEqual(request("127.0.0.1", self.port, certificate=certificate)[0], 200)

        self.expect_token(certificate=certificate)
        plain = open_socket("127.0.0.1", self.port)
        self.addCleanup(plain.close)
        plain.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
        self.assertNotIn(b"HTTP", plain.recv(100))
        self.assertEqual(self.master.text.count(self.token), len(re.findall("#token=", self.master.text)))

    def test_a_certificate_of_ones_own(self):
        """On loopback, too; its names are hosts."""
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days",
                        "2", "-subj", "/CN=x", "-addext", "subjectAltName=DNS:render.test,IP:127.0.0.1", "-keyout",
                        "key.pem", "-out", "cert.pem"], cwd=self.folder, check=True, capture_output=True)
        found = self.serve("--serve-certificate", "cert.pem", "--serve-key", "key.pem")
        self.assertEqual(found.group(1), "https")
        certificate = (self.folder / "cert.pem").read_text()
        self.assertEqual(request("127.0.0.1", self.port, certificate=certificate)[0], 200)
        self.assertEqual(request("127.0.0.1", self.port, certificate=certificate, Host="render.test")[0], 200)
        self.assertEqual(request("127.0.0.1", self.port, certificate=certificate, Host="other.test")[0], 403)

    def test_what_cannot_be_served_is_told_at_once(self):
        def says(status, *options):
            master = self.start(BIN / "ninefold-master", SCENES / "cornell.glb", *options)
            self.assertEqual(master.ends(), status, master.text)
            return master.text
        self.assertIn("--serve nowhere", says(2, "--serve", "nowhere"))
        self.assertIn("exclude each other", says(2, "--serve", "127.0.0.1:0", "--window"))
        self.assertIn("go together", says(2, "--serve", "127.0.0.1:0", "--serve-key", "x"))
        self.assertIn("is for --serve", says(2, "--serve-key", "x", "--serve-certificate", "y", "--output", "a.png"))
        self.assertIn("--serve-certificate none.pem", says(1, "--serve", "127.0.0.1:0", "--serve-certificate", "none.pem",
                                                           "--serve-key", "none.pem"))
        self.serve()
        self.assertIn("cannot serve at", says(1, "--serve", f"127.0.0.1:{self.port}"))


if __name__ == "__main__":
    unittest.main()

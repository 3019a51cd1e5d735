"""What makes a master that serves browsers safe, here and beyond loopback."""
import hashlib
import re
import ssl
import subprocess
import unittest

from browser import Closed, ServeTest, open_socket, request
from programs import BIN, SCENES, eventually


class Secrets(ServeTest):
    def expect_token(self, **more):
        """Without it there are no numbers and no pictures."""
        wrong = "0" * 64
        self.assertEqual(request("127.0.0.1", self.port, "/metrics", **more)[0], 401)
        self.assertEqual(request("127.0.0.1", self.port, "/metrics", Authorization=f"Bearer {wrong}", **more)[0], 401)
        self.assertEqual(self.metrics(**more)[0], 200)
        eventually(lambda: b"ninefold_viewers_refused_total 2\n" in self.metrics(**more)[2], "both are counted")
        self.expect_line("browser at 127.0.0.1:[0-9]+: wrong token")
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
        self.expect_line("speaks HTTP, and here is TLS; its address must begin with https://")
        self.assertEqual(self.master.text.count(self.token), len(re.findall("#token=", self.master.text)))

    def test_a_certificate_of_ones_own(self):
        """On loopback, too; its names are hosts."""
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days",
                        "2", "-subj", "/CN=x", "-addext", "subjectAltName=DNS:render.test,IP:127.0.0.1", "-keyout",
                        "key.pem", "-out", "cert.pem"], cwd=self.folder, check=True, capture_output=True)
        found = self.serve("--serve-certificate", "cert.pem", "--serve-key", "key.pem")
        self.assertEqual(found.group(1), "https")
        certificate = (self.folder / "cert.pem").read_text()
        for key, why in ("cert.pem", "holds no private key in PEM"), ("none.pem", "No such file or directory"):
            master = self.start(BIN / "ninefold-master", SCENES / "cornell.glb", "--serve", "127.0.0.1:0",
                                "--serve-certificate", "cert.pem", "--serve-key", key)
            self.assertEqual(master.ends(), 1)
            self.assertIn(f"--serve-key {key}: {why}; give a PEM file", master.text)
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
        self.assertIn("none.pem: No such file or directory; give", says(1, "--serve", "127.0.0.1:0", "--serve-certificate",
                                                                        "none.pem", "--serve-key", "none.pem"))
        (self.folder / "text").write_text("no certificate\n")
        self.assertIn("text: holds no certificate in PEM; give", says(1, "--serve", "127.0.0.1:0", "--serve-certificate",
                                                                      "text", "--serve-key", "text"))
        self.serve()
        self.assertIn("cannot serve at", says(1, "--serve", f"127.0.0.1:{self.port}"))


if __name__ == "__main__":
    unittest.main()

"""ninefold-doctor against real masters: what it finds, what it says to do, and that it changes nothing there."""
import os
import re
import socket
import subprocess
import time
import unittest

from programs import BIN, ClusterTest

CHECKS = ["processor", "cache", "descriptors", "window", "name", "port", "key", "release", "pixel class", "clock",
          "round trip", "line"]


class Doctor(ClusterTest):
    def examine(self, *options, program=BIN / "ninefold-doctor", prefix=(), **variables):
        """Its exit status, and by the name of what it looked at (grade, what it says)."""
        environment = {k: v for k, v in os.environ.items() if not k.startswith("NINEFOLD_")} | variables
        command = [str(word) for word in (*prefix, program, *options)]
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, timeout=60)
        lines = re.findall(r"^(ok|note|BAD|-) +(.{16}) (.*)$", done.stdout, re.MULTILINE)
        self.text = done.stdout + done.stderr
        return done.returncode, {what.strip(): (grade, rest) for grade, what, rest in lines}

    def master_with_key(self, *options, **more):
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", *options, **more)
        return master, self.address_of(master)

    def assert_bad(self, found, what, text, grade="BAD"):
        self.assertEqual(found[what][0], grade, self.text)
        self.assertIn(text, found[what][1])

    def assert_note(self, found, what, text):
        self.assert_bad(found, what, text, grade="note")

    def test_a_machine_that_can_join_gets_a_line_for_each_thing_and_the_run_does_not_notice(self):
        alone = self.render("--local-clients", 1)
        master, address = self.master_with_key(scene="cornell")
        status, found = self.examine("--master", address, "--key-file", "cluster.key", "--cache", "cache")
        self.assertEqual(status, 0, self.text)
        self.assertEqual(list(found), CHECKS)
        self.assertEqual({g for g, _ in found.values()} - {"ok", "note"}, set(), self.text)
        self.assertIn("no client has set one yet", found["pixel class"][1])
        self.assertLess(abs(float(re.search(r"([-+][0-9.]+) s", found["clock"][1]).group(1))), 1)
        self.assertGreater(float(re.match(r"[0-9.]+", found["line"][1]).group()), 0)
        self.assertTrue((self.folder / "cache").is_dir())
        client = self.client(address)
        stats = self.finish(master)
        self.assertEqual(client.ends(), 0)
        self.assertEqual(stats["image_hash"], alone["image_hash"])
        self.assertTrue(stats["reproducible"])
        self.assertEqual(len(stats["clients"]), 1, "the doctor is no client")
        self.assertIn("has looked whether it can join", master.text)

    def test_flags_may_come_from_the_environment_as_those_of_the_client(self):
        _, address = self.master_with_key()
        status, _ = self.examine(NINEFOLD_MASTER=address, NINEFOLD_KEY_FILE="cluster.key", NINEFOLD_CACHE="none")
        self.assertEqual(status, 0, self.text)

    def test_the_pixel_class_is_that_of_the_run(self):
        master, address = self.master_with_key("--seconds", 1000, frames=None)
        client = self.client(address)
        master.waits_for("client 1 is ready")
        _, found = self.examine("--master", address, "--key-file", "cluster.key", "--cache", "none")
        self.assertEqual(found["pixel class"], ("ok", "that of the other clients"))
        client.close()

    def test_a_wrong_key_no_key_and_a_key_that_others_may_read(self):
        _, address = self.master_with_key()
        self.new_key("wrong.key")
        status, found = self.examine("--master", address, "--key-file", "wrong.key", "--cache", "none")
        self.assertEqual(status, 1)
        self.assert_bad(found, "key", "--key-file")
        self.assertEqual(found["port"][0], "ok")
        self.assertEqual(found["release"][0], "-", "nothing is known of it")
        status, found = self.examine("--master", address, "--cache", "none")
        self.assertEqual(status, 1)
        self.assert_bad(found, "key", "none is given")
        self.assertEqual(found["port"][0], "ok", "a master answers all the same")
        (self.folder / "wrong.key").chmod(0o644)
        status, found = self.examine("--master", address, "--key-file", "wrong.key", "--cache", "none")
        self.assertEqual(status, 1)
        self.assert_bad(found, "key", "chmod 600")

    def test_a_closed_port_a_name_that_is_none_and_a_port_of_something_else(self):
        self.new_key()
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))  # not listening
            status, found = self.examine("--master", f"127.0.0.1:{taken.getsockname()[1]}", "--key-file", "cluster.key")
        self.assertEqual(status, 1)
        self.assert_bad(found, "port", "nobody listens there")
        status, found = self.examine("--master", "no..host:4700", "--key-file", "cluster.key")
        self.assertEqual(status, 1)
        self.assert_bad(found, "name", "check the name")
        with socket.create_server(("127.0.0.1", 0)) as mute:  # takes connections and says nothing
            begin = time.monotonic()
            status, found = self.examine("--master", f"127.0.0.1:{mute.getsockname()[1]}", "--key-file", "cluster.key")
            self.assertLess(time.monotonic() - begin, 30)
        self.assertEqual(status, 1)
        self.assert_bad(found, "port", "no answer")

    def test_another_release(self):
        _, address = self.master_with_key()
        release = subprocess.run([BIN / "ninefold-doctor", "--version"], capture_output=True, text=True,
                                 check=True).stdout.split()[1]
        # The compiler may keep a text in pieces of eight bytes and more: the first is changed.
        begin = release[:8].encode()
        program = self.folder / "other-doctor"
        text = (BIN / "ninefold-doctor").read_bytes()
        self.assertIn(begin, text)
        program.write_bytes(text.replace(begin, b"9" + begin[1:]))
        program.chmod(0o755)
        status, found = self.examine("--master", address, "--key-file", "cluster.key", "--cache", "none", program=program)
        self.assertEqual(status, 1)
        self.assert_bad(found, "release", release)
        self.assertIn("9" + release[1:], found["release"][1])

    def test_a_cache_folder_that_is_not_private_or_cannot_be_keeps_nobody_out(self):
        _, address = self.master_with_key()
        (self.folder / "open").mkdir(mode=0o755)
        for cache, remedy in (("open", "chmod 700"), ("cluster.key/below", "--cache"), ("/proc/ninefold", "--cache")):
            status, found = self.examine("--master", address, "--key-file", "cluster.key", "--cache", cache)
            self.assertEqual(status, 0, self.text)
            self.assert_note(found, "cache", remedy)

    def test_few_descriptors_are_a_note_as_the_client_joins_with_them(self):
        master, address = self.master_with_key()
        few = ["sh", "-c", 'ulimit -n 40; exec "$0" "$@"']
        status, found = self.examine("--master", address, "--key-file", "cluster.key", "--cache", "none", prefix=few)
        self.assertEqual(status, 0, self.text)
        self.assert_note(found, "descriptors", "ulimit -n")
        client = self.client(address, prefix=few)
        self.finish(master)
        self.assertEqual(client.ends(), 0, client.text)

    def test_without_a_display_it_says_who_needs_one(self):
        _, address = self.master_with_key()
        status, found = self.examine("--master", address, "--key-file", "cluster.key", "--cache", "none", DISPLAY="",
                                     WAYLAND_DISPLAY="")
        self.assertEqual((status, found["window"][0]), (0, "note"))

    def test_wrong_usage(self):
        for options in ([], ["--master", "4700"], ["--master", "a:1", "--isa", "mmx"], ["--colour"]):
            status, _ = self.examine(*options)
            self.assertEqual(status, 2, self.text)
            self.assertEqual(len(self.text.splitlines()), 1, self.text)


if __name__ == "__main__":
    unittest.main()

"""How a run ends: by Ctrl-C, by the loss of its master, by mistakes in the command line."""
import json
import os
import pty
import shutil
import subprocess
import time
import unittest

from programs import BIN, SCENES, ClusterTest, eventually, is_running, signal


class Ending(ClusterTest):
    def endless(self, **more):
        master = self.master("--local-clients", 2, "--wait-clients", 2, "--seconds", 1000, frames=None, **more)
        master.waits_for(r"progress: \d+% frame [1-9]")
        return master, master.children()

    def test_interrupts_write_what_there_is_and_leave_nobody(self):
        for sig, status in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGPIPE, 141)):
            master, clients = self.endless()
            self.assertEqual(len(clients), 2)
            began = time.monotonic()
            self.send(master.process.pid, sig)
            self.assertEqual(master.ends(), status, master.text)
            self.assertLess(time.monotonic() - began, 10)  # within a second when nothing else runs
            self.assertTrue(master.picture.exists())
            for pid in clients:
                eventually(lambda: not is_running(pid), f"end of client process {pid}")

    def test_ctrl_c_in_a_terminal_reaches_all_and_only_the_master_answers(self):
        master, clients = self.endless()
        for pid in [master.process.pid] + clients:
            self.send(pid, signal.SIGINT)
        self.assertEqual(master.ends(), 130, master.text)
        self.assertNotIn("ended with", master.text)
        self.assertTrue(master.picture.exists())

    def test_a_terminal_that_hangs_up_more_than_once_ends_the_run_well(self):
        master, clients = self.endless()
        for pid in [master.process.pid] + clients:
            self.send(pid, signal.SIGHUP)
        for sig in (signal.SIGHUP, signal.SIGTERM, signal.SIGHUP):
            self.send(master.process.pid, sig)
        # Signals that are pending together reach the program's threads in any order.
        self.assertIn(master.ends(), (129, 143), master.text)
        self.assertTrue(master.picture.exists())

    @unittest.skipUnless(os.path.exists("/dev/pts/ptmx"), "no pseudo-terminals here: /dev/pts is not mounted")
    def test_a_terminal_that_is_closed_takes_nothing_along(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        said = []

        def become_its_foreground():
            os.setsid()
            os.close(os.open(os.ttyname(theirs), os.O_RDWR))  # the controlling terminal from now on

        master = self.master("--local-clients", 2, "--wait-clients", 2, "--seconds", 1000, frames=None,
                             stdin=theirs, stderr=theirs, preexec_fn=become_its_foreground)
        os.close(theirs)
        while not any(b"frame 2" in piece for piece in said):
            said.append(os.read(ours, 1 << 16))
        clients = master.children()
        self.assertEqual(len(clients), 2)
        with open("/dev/null", "rb") as nothing:
            os.dup2(nothing.fileno(), ours)  # closes the terminal
        self.assertEqual(master.ends(), 129)
        self.assertTrue(master.picture.exists())
        for pid in clients:
            eventually(lambda: not is_running(pid), f"end of client process {pid}")

    def test_who_was_started_to_survive_a_hang_up_does(self):
        master, clients = self.endless(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.send(master.process.pid, signal.SIGHUP)
        self.send(clients[0], signal.SIGHUP)
        frames = len(master.lines)
        eventually(lambda: len(master.lines) > frames + 1, "more frames")
        self.send(master.process.pid, signal.SIGTERM)
        self.assertEqual(master.ends(), 143, master.text)

    def lost_streams(self):
        """Standard errors that take nothing, each with its name."""
        reader, gone = os.pipe()
        os.close(reader)
        yield "a pipe without a reader", {"stderr": gone}
        os.close(gone)
        with open("/dev/full", "wb") as full:
            yield "a full disk", {"stderr": full}
        reader, stuck = os.pipe()
        os.set_blocking(stuck, False)
        try:
            while True:
                os.write(stuck, b"x" * 4096)
        except BlockingIOError:
            os.set_blocking(stuck, True)
        yield "a pipe that nobody reads", {"stderr": stuck}
        os.close(reader), os.close(stuck)
        yield "closed", {"stderr": subprocess.DEVNULL, "preexec_fn": lambda: os.close(2)}

    def test_lost_standard_error_is_no_reason_to_die(self):
        self.new_key()
        expected = self.render("--local-clients", 1)["image_hash"]
        for what, streams in self.lost_streams():
            with self.subTest(what):
                master = self.master("--local-clients", 1, **streams)
                self.assertEqual(self.finish(master)["image_hash"], expected)
                remote = self.master("--local-clients", 0, "--key-file", "cluster.key")
                client = self.start(BIN / "ninefold-client", "--master", self.address_of(remote), "--key-file",
                                    "cluster.key", "--cache", "none", **streams)
                self.assertEqual(self.finish(remote)["image_hash"], expected)
                self.assertEqual(client.ends(), 0)

    def test_remote_clients_end_by_the_same_signals(self):
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", "--seconds", 1000, frames=None)
        address = self.address_of(master)
        for sig in (signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
            client = self.client(address)
            client.waits_for("joined")
            self.send(client.process.pid, sig)
            self.assertEqual(client.ends(), 0, client.text)
            self.assertIn("stopped by a signal", client.text)

    def test_a_script_that_is_ended_writes_what_there_is(self):
        (self.folder / "still.json").write_text(json.dumps({"seconds": 600, "events": []}))
        master = self.master("--local-clients", 1, "--script", "still.json", frames=None)
        master.waits_for("is ready")
        time.sleep(1)  # a picture or more; if there is none the line below is missing
        self.send(master.process.pid, signal.SIGHUP)
        self.assertEqual(master.ends(), 129, master.text)
        self.assertTrue(master.picture.exists() and master.stats_file.exists(), master.text)

    def test_clients_of_a_killed_master_end_even_when_frozen(self):
        master, clients = self.endless()
        self.send(clients[0], signal.SIGSTOP)
        self.send(master.process.pid, signal.SIGKILL)
        for pid in clients:
            eventually(lambda: not is_running(pid), f"end of client process {pid}")

    def test_an_interrupt_before_the_first_frame_writes_nothing_and_says_so(self):
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key")
        master.waits_for("listening on")
        self.send(master.process.pid, signal.SIGINT)
        self.assertEqual(master.ends(), 130)
        self.assertFalse(master.picture.exists())
        self.assertIn("nothing is written", master.text)

    def test_local_clients_that_keep_dying_end_the_run_in_one_clear_line(self):
        for content, reason in ((None, "cannot start"), ("#!/bin/sh\nexit 1\n", "given up")):
            shutil.copy(BIN / "ninefold-master", self.folder)
            if content:
                client = self.folder / "ninefold-client"
                client.write_text(content)
                client.chmod(0o700)
            master = self.start(self.folder / "ninefold-master", SCENES / "cornell.glb",
                                "--local-clients", 2, "--output", "o.exr")
            self.assertEqual(master.ends(), 1, master.text)
            self.assertIn(reason, master.text)
            self.assertTrue(master.lines[-1].startswith("ninefold-master: "), master.text)
            self.assertFalse((self.folder / "o.exr").exists())

    def one_line(self, program):
        lines = [l for l in program.lines if l and not l.startswith("[")]
        self.assertEqual(len(lines), 1, program.text)
        return lines[0]

    def test_wrong_usage_is_one_line_and_status_2(self):
        scene = SCENES / "cornell.glb"
        for options, flag in (
            (["--listen", "0.0.0.0:0"], "--key-file"),
            (["--local-clients", "0"], "--key-file"),
            (["--size", "0x10"], "--size"),
            (["--isa", "mmx"], "--isa"),
        ):
            master = self.start(BIN / "ninefold-master", scene, "--output", "o.exr", *options)
            self.assertEqual(master.ends(), 2, master.text)
            self.assertIn(flag, self.one_line(master))
        client = self.start(BIN / "ninefold-client")
        self.assertEqual(client.ends(), 2)
        self.assertIn("--key-file", self.one_line(client))

    def test_bad_scenes_keys_and_outputs_are_one_line_and_status_1(self):
        (self.folder / "broken.glb").write_bytes(b"glTF\2\0\0\0")
        (self.folder / "short.key").write_bytes(b"short")
        os.chmod(self.folder / "short.key", 0o600)
        scene = SCENES / "cornell.glb"
        for arguments, word in (
            (["broken.glb", "--output", "o.exr"], "broken.glb"),
            (["nowhere.glb", "--output", "o.exr"], "nowhere.glb"),
            ([scene, "--output", "o.exr", "--key-file", "short.key"], "short.key"),
            ([scene, "--output", "no/such/folder/o.exr"], "no/such/folder"),
        ):
            master = self.start(BIN / "ninefold-master", *arguments)
            self.assertEqual(master.ends(), 1, master.text)
            self.assertIn(word, self.one_line(master))


if __name__ == "__main__":
    unittest.main()

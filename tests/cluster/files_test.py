"""What the programs write: whole or as it was before, and in one line why not."""
import json
import os
import pathlib
import resource
import shutil
import socket
import stat
import subprocess
import unittest

from programs import BIN, SCENES, ClusterTest, signal

CORNELL = SCENES / "cornell.glb"


class Files(ClusterTest):
    def run_master(self, *options, **more):
        return self.start(BIN / "ninefold-master", CORNELL, "--size", self.SIZE, "--frames", 1, "--local-clients", 1,
                          *options, **more)

    def refused(self, program, word, status=1):
        """The one line of a program that does not even begin."""
        self.assertEqual(program.ends(), status, program.text)
        self.assertEqual(len(program.lines), 1, program.text)
        self.assertIn(word, program.lines[0])

    def fails(self, program, word):
        """The last line of a run that cannot keep its files."""
        self.assertEqual(program.ends(), 1, program.text)
        self.assertIn(word, program.lines[-1])
        self.assertEqual(len([l for l in program.lines if "cannot write" in l]), 1, program.text)

    def parts(self, folder=None):
        return [p.name for p in (folder or self.folder).iterdir() if p.name.endswith(".part")]

    def test_what_is_no_file_or_has_no_folder_is_refused_before_the_scene_is_read(self):
        os.mkdir(self.folder / "folder.png")
        os.mkfifo(self.folder / "pipe.json")
        (self.folder / "file").write_text("text")
        (self.folder / "device.json").symlink_to("/dev/null")
        for options, word in (
            (["--stats", "/dev/null"], "a device"),
            (["--stats", "device.json"], "a device"),
            (["--stats", "pipe.json"], "a pipe"),
            (["--stats", "none/s.json"], "there is no folder"),
            (["--stats", "file/s.json"], "no folder"),
            (["--output", "folder.png"], "a folder"),
            (["--output", "none/a.exr"], "there is no folder"),
            (["--output", "a" * 256 + ".png"], "too long"),
            (["--output", "a.png", "--stats", "."], "a folder"),
            (["--output", "none/a.##.png", "--animate", "0:1:1"], "there is no folder"),
        ):
            master = self.start(BIN / "ninefold-master", self.folder / "no scene is read.glb", *options)
            self.refused(master, word)
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))
        self.assertEqual(self.parts(), [])

    def test_links_are_followed_and_modes_stay(self):
        (self.folder / "far").mkdir()
        for name in ("a.png", "s.json"):
            (self.folder / "far" / name).write_text("old")
            os.chmod(self.folder / "far" / name, 0o604)
            (self.folder / name).symlink_to(pathlib.Path("far") / name)
        master = self.run_master("--output", "a.png", "--stats", "s.json")
        self.assertEqual(master.ends(), 0, master.text)
        for name in ("a.png", "s.json"):
            self.assertTrue((self.folder / name).is_symlink())
            self.assertEqual(stat.S_IMODE(os.stat(self.folder / "far" / name).st_mode), 0o604)
        self.assertTrue((self.folder / "far" / "a.png").read_bytes().startswith(b"\x89PNG"))
        self.assertEqual(json.loads((self.folder / "far" / "s.json").read_text())["frames"], 1)
        self.assertEqual(self.parts(), [])

    def test_the_longest_name_and_what_a_killed_process_left_are_no_trouble(self):
        (self.folder / ".ninefold.999999999.0.part").write_bytes(b"half a picture")
        name = "n" * 251 + ".png"
        master = self.run_master("--output", name)
        self.assertEqual(master.ends(), 0, master.text)
        self.assertGreater((self.folder / name).stat().st_size, 100)
        self.assertEqual(self.parts(), [])

    def test_statistics_may_go_to_standard_output(self):
        master = self.run_master("--stats", "-", stdout=subprocess.PIPE)
        said = master.process.stdout.read()
        master.process.stdout.close()
        self.assertEqual(master.ends(), 0, master.text)
        self.assertEqual(json.loads(said)["frames"], 1)
        with open("/dev/full", "wb") as full:
            master = self.run_master("--stats", "-", stdout=full)
            self.assertEqual(master.ends(), 1)
            self.assertIn("cannot write to standard output", master.lines[-1])

    def test_a_limit_of_bytes_leaves_the_old_file_and_status_1(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        for name, more in (("a.png", []), ("a.exr", []), ("a.hdr", []), ("s.json", [])):
            (self.folder / name).write_text("old")
            flag = "--stats" if name == "s.json" else "--output"
            self.fails(self.run_master(flag, name, *more, preexec_fn=limit), f"cannot write {name}: File too large")
            self.assertEqual((self.folder / name).read_text(), "old")
        self.assertEqual(self.parts(), [])

    def test_a_series_on_a_full_disk_ends_at_the_picture_that_does_not_fit(self):
        (self.folder / "script.json").write_text(json.dumps({"seconds": 1, "rate": 2, "events": []}))
        (self.folder / "a.0.png").write_text("old")
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        master = self.start(BIN / "ninefold-master", CORNELL, "--size", self.SIZE, "--local-clients", 1, "--script",
                            "script.json", "--output", "a.#.png", preexec_fn=limit)
        self.fails(master, "cannot write a.0.png: File too large")
        self.assertEqual((self.folder / "a.0.png").read_text(), "old")

    @unittest.skipUnless(os.geteuid() == 0, "needs root, to mount a small disk")
    def test_a_full_disk_leaves_the_old_file_and_status_1(self):
        disk = self.folder / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "none", disk], capture_output=True).returncode:
            self.skipTest("no disk can be mounted here")
        self.addCleanup(subprocess.run, ["umount", "-l", disk])
        for name in ("a.png", "a.exr", "a.hdr"):
            (disk / name).write_text("old")
            (disk / "rest").write_bytes(b"")
            while True:  # what is left of the disk
                try:
                    with open(disk / "rest", "ab") as rest:
                        rest.write(b"x" * 1024)
                except OSError:
                    break
            self.fails(self.run_master("--output", disk / name), "No space left on device")
            self.assertEqual((disk / name).read_text(), "old")
            (disk / "rest").unlink()
        self.assertEqual(self.parts(disk), [])

    @unittest.skipUnless(os.geteuid() == 0, "needs root, to mount a file")
    def test_a_file_that_is_mounted_is_refused_before_the_scene_is_read(self):
        for name in ("inside.png", "outside.png"):
            (self.folder / name).write_text("old")
        mount = ["mount", "--bind", self.folder / "outside.png", self.folder / "inside.png"]
        if subprocess.run(mount, capture_output=True).returncode:
            self.skipTest("nothing can be mounted here")
        self.addCleanup(subprocess.run, ["umount", "-l", self.folder / "inside.png"])
        self.refused(self.run_master("--output", "inside.png"), "mounted by itself")

    def test_keys_are_new_files_only(self):
        self.new_key()
        key = (self.folder / "cluster.key").read_bytes()
        for name, word in (("cluster.key", "exists already"), ("/dev/null", "exists already"),
                           ("none/k", "there is no folder")):
            self.refused(self.start(BIN / "ninefold-master", "--new-key", name), word)
        self.assertEqual((self.folder / "cluster.key").read_bytes(), key)

    def remote(self, *options, **more):
        """A master without clients, and one that is given these options."""
        self.new_key() if not (self.folder / "cluster.key").exists() else None
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", frames=1)
        client = self.start(BIN / "ninefold-client", "--master", self.address_of(master), "--key-file", "cluster.key",
                            "--threads", 1, *options, **more)
        return master, client

    def test_a_cache_that_cannot_be_is_told_once_and_harms_nothing(self):
        (self.folder / "file").write_text("text")
        (self.folder / "open").mkdir()
        (self.folder / "open").chmod(0o755)
        folders = ["/proc/ninefold", "file", "open", "file/below"]
        if os.geteuid() == 0:
            (self.folder / "foreign").mkdir(0o700)
            shutil.chown(self.folder / "foreign", 4711)
            folders.append("foreign")
        for folder in folders:
            master, client = self.remote("--cache", folder)
            self.finish(master)
            self.assertEqual(client.ends(), 0, client.text)
            self.assertEqual(len([l for l in client.lines if "going on without a cache" in l]), 1, client.text)

    @unittest.skipUnless(os.geteuid() == 0, "needs root, to mount disks")
    def test_a_cache_on_a_full_or_read_only_disk_is_told_once(self):
        for option in ("size=4k", "ro"):
            disk = self.folder / option
            disk.mkdir()
            mount = ["mount", "-t", "tmpfs", "-o", option + ",mode=0700", "none", disk]
            if subprocess.run(mount, capture_output=True).returncode:
                self.skipTest("no disk can be mounted here")
            self.addCleanup(subprocess.run, ["umount", "-l", disk])
            master, client = self.remote("--cache", disk)
            self.finish(master)
            self.assertEqual(client.ends(), 0, client.text)
            self.assertEqual(len([l for l in client.lines if "warning" in l]), 1, client.text)

    def test_a_recording_is_whole_or_refused(self):
        for name in ("/dev/null", "none/r"):
            self.new_key() if not (self.folder / "cluster.key").exists() else None
            self.refused(self.start(BIN / "ninefold-client", "--master", "127.0.0.1:9", "--key-file", "cluster.key",
                                    "--cache", "none", "--record", name), f"cannot write {name}")
        (self.folder / "r").write_text("old")
        master, client = self.remote("--cache", "none", "--record", "r")
        self.finish(master)
        self.assertEqual(client.ends(), 0, client.text)
        self.assertGreater((self.folder / "r").stat().st_size, 1000)
        self.assertEqual(self.parts(), [])

    def test_a_recording_on_a_full_disk_leaves_the_old_one_and_status_1(self):
        """Whether it is what the master sends that has no room, or what the client answers."""
        for room in (400, 1000, 2500):
            (self.folder / "r").write_text("old")
            limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
            _, client = self.remote("--cache", "none", "--record", "r", preexec_fn=limit)
            self.assertEqual(client.ends(), 1, client.text)
            self.assertIn("cannot write r: File too large", client.lines[-1])
            self.assertEqual((self.folder / "r").read_text(), "old")
            self.assertEqual(self.parts(), [])


RELEASE = r"^{} \d+\.\d+\.\d+(\+[0-9a-f]{{12}}(-dirty\.[0-9a-f]{{8}})?)?\n$"


class Usage(ClusterTest):
    PROGRAMS = sorted(p for p in BIN.glob("ninefold-*") if os.access(p, os.X_OK))

    def said(self, *command):
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""), command)
        return done.stdout

    def test_every_program_tells_its_version_its_flags_and_its_exit_status(self):
        self.assertIn(BIN / "ninefold-master", self.PROGRAMS)
        for program in self.PROGRAMS:
            self.assertRegex(self.said(program, "--version"), RELEASE.format(program.name))
            text = self.said(program, "--help")
            self.assertEqual(self.said(program, "-h"), text)
            self.assertRegex(text, r"Exit status: 0 [^\0]*1 a failure[^\0]*2 wrong usage", program)

    def test_help_that_does_not_arrive_is_a_failure(self):
        for program in self.PROGRAMS:
            with open("/dev/full", "wb") as full:
                done = subprocess.run([program, "--help"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, program)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_a_window_without_a_display_and_without_a_picture_is_refused_at_once(self):
        plain = ["env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", BIN / "ninefold-master"]
        master = self.start(*plain, self.folder / "no scene is read.glb", "--window")
        self.assertEqual(master.ends(), 1, master.text)
        self.assertEqual(len(master.lines), 1, master.text)
        self.assertIn("--output", master.lines[0])
        master = self.start(*plain, CORNELL, "--window", "--size", self.SIZE, "--frames", 1, "--output", "a.png")
        self.assertEqual(master.ends(), 0, master.text)
        self.assertTrue((self.folder / "a.png").exists())


class Names(ClusterTest):
    def test_a_name_that_does_not_resolve_is_tried_again(self):
        self.new_key()
        client = self.client("no-such-host.invalid:4700")
        client.waits_for(r"no-such-host\.invalid.*trying again")
        self.assertIsNone(client.process.poll())
        self.send(client.process.pid, signal.SIGTERM)
        self.assertEqual(client.ends(), 0, client.text)

    def test_a_name_that_resolves_later_is_found(self):
        hosts = self.folder / "hosts"
        hosts.write_text("127.0.0.1 localhost\n")
        bind = 'mount --bind "$0" /etc/hosts && exec "$@"'
        private = ["unshare", "--mount", "sh", "-c", bind, hosts]
        if subprocess.run([*private, "true"], capture_output=True).returncode:
            self.skipTest("no private /etc/hosts here")
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", frames=1)
        port = self.address_of(master).rpartition(":")[2]
        client = self.client(f"late.ninefold.invalid:{port}", prefix=private)
        client.waits_for(r"late\.ninefold\.invalid.*trying again")
        hosts.write_text("127.0.0.1 localhost late.ninefold.invalid\n")
        self.finish(master)
        self.assertEqual(client.ends(), 0, client.text)

    def test_a_master_on_all_interfaces_names_addresses_and_no_names(self):
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", "--listen", "0.0.0.0:0", frames=1)
        address, port = master.waits_for(r"--master (\S+):(\d+) --key-file").groups()
        socket.inet_aton(address)
        client = self.client(f"{address}:{port}")
        self.finish(master)
        self.assertEqual(client.ends(), 0, client.text)


if __name__ == "__main__":
    unittest.main()

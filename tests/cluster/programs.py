"""programs.py: starts the real master and clients in a folder of their own and watches them.

Every wait has a deadline that is only there to end a broken test; no test decides by time.
"""
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import threading
import time
import unittest

BIN = pathlib.Path(os.environ["NINEFOLD_BIN"])
SCENES = pathlib.Path(os.environ["NINEFOLD_SCENES"])
DEADLINE = 120  # seconds
LOOK = 0.01  # seconds between two looks


def looks():
    """Until the deadline, counted in looks: a machine that stands still meanwhile, and its programs with it, is waited for."""
    for _ in range(round(DEADLINE / LOOK)):
        yield
        time.sleep(LOOK)


def eventually(condition, what):
    for _ in looks():
        result = condition()
        if result:
            return result
    raise AssertionError(f"never happened: {what}")


class Program:
    """A running program whose standard error is collected line by line.

    `more` goes to subprocess.Popen. With a standard error of the test's own nothing is collected."""

    def __init__(self, command, cwd, **more):
        environment = {k: v for k, v in os.environ.items() if not k.startswith("NINEFOLD_")}
        environment["HOME"] = environment["TMPDIR"] = str(cwd)
        environment.pop("XDG_CACHE_HOME", None)
        self.lines = []
        streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
        self.process = subprocess.Popen([str(c) for c in command], cwd=cwd, env=environment, text=True,
                                        errors="replace", **streams | more)
        self.reader = threading.Thread(target=self._read)
        self.reader.start()

    def _read(self):
        for line in self.process.stderr or ():
            self.lines.append(line.rstrip("\n"))

    @property
    def text(self):
        return "\n".join(self.lines)

    def waits_for(self, pattern):
        """The first match of `pattern` in what the program said."""
        def said():
            if self.process.poll() is not None and not re.search(pattern, self.text):
                self.reader.join()
                if not re.search(pattern, self.text):
                    raise AssertionError(f"ended without saying {pattern!r}:\n{self.text}")
            return re.search(pattern, self.text)
        return eventually(said, f"{pattern!r} in:\n{self.text}")

    def ends(self):
        for _ in looks():
            if self.process.poll() is not None:
                self.reader.join(DEADLINE)
                return self.process.returncode
        self.process.kill()
        raise AssertionError(f"did not end; it said:\n{self.text}")

    def children(self):
        """Process ids of the clients that a master has started."""
        found = []
        for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
            try:
                fields = stat.read_text().rpartition(")")[2].split()
            except OSError:
                continue  # ended meanwhile
            if int(fields[1]) == self.process.pid and fields[0] != "Z":
                found.append(int(stat.parent.name))
        return sorted(found)

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.reader.join()
        if self.process.stderr:
            self.process.stderr.close()


def methods():
    """The names of all methods, as the program's help lists them: "NAME (note), NAME or NAME (note)"."""
    said = subprocess.run([BIN / "ninefold-master", "--help"], check=True, capture_output=True, text=True).stdout
    text = re.search(r"--method NAME +how light is computed: (.*?)\n +--", said, re.S).group(1)
    names = re.split(r", | or ", re.sub(r" \([^)]*\)", "", " ".join(text.split())))
    assert len(set(names)) == len(names) > 1 and all(re.fullmatch("[a-z-]+", name) for name in names), text
    return names


def is_running(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def own_memory(pid):
    """Bytes that no file stands behind; None if the process has ended."""
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return None
    found = re.search(r"RssAnon:\s+(\d+) kB", status)
    return 1024 * int(found.group(1)) if found else None


class ClusterTest(unittest.TestCase):
    """Starts programs in a temporary folder; ends them all when the test is over."""
    maxDiff = None
    SIZE = "96x72"

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ninefold-cluster-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.runs = 0

    def start(self, *command, **more):
        program = Program(command, self.folder, **more)
        self.addCleanup(program.close)
        return program

    def master(self, *options, scene="cornell", frames=8, prefix=(), **more):
        """A master that writes out<N>.exr and stats<N>.json."""
        self.runs += 1
        limit = ["--frames", frames] if frames else []
        program = self.start(*prefix, BIN / "ninefold-master", SCENES / f"{scene}.glb", "--size",
                             self.SIZE, *limit, "--output", f"out{self.runs}.exr", "--stats",
                             f"stats{self.runs}.json", *options, **more)
        program.picture = self.folder / f"out{self.runs}.exr"
        program.stats_file = self.folder / f"stats{self.runs}.json"
        return program

    def client(self, address, key="cluster.key", prefix=(), cache="none"):
        return self.start(*prefix, BIN / "ninefold-client", "--master", address, "--key-file", key,
                          "--threads", 1, "--cache", cache)

    def new_key(self, name="cluster.key"):
        maker = self.start(BIN / "ninefold-master", "--new-key", name)
        self.assertEqual(maker.ends(), 0, maker.text)
        return name

    def address_of(self, master):
        return master.waits_for(r"listening on (\S+)").group(1)

    def finish(self, master):
        """The statistics of a master that ends well."""
        self.assertEqual(master.ends(), 0, master.text)
        self.assertTrue(master.picture.exists())
        return json.loads(master.stats_file.read_text())

    def same_by(self, method, crews, *options, frames):
        with self.subTest(method):
            hashes = {}
            for clients, threads in crews:
                stats = self.render("--local-clients", clients, "--client-threads", threads, "--method", method,
                                    *options, scene="table_room", frames=frames)
                self.assertEqual(stats["method"], method)
                self.assertTrue(stats["reproducible"])
                hashes[clients, threads] = stats["image_hash"]
            self.assertEqual(len(set(hashes.values())), 1, hashes)

    def render(self, *options, **more):
        return self.finish(self.master(*options, **more))

    def send(self, pid, sig):
        os.kill(pid, sig)


__all__ = ["BIN", "SCENES", "ClusterTest", "eventually", "is_running", "methods", "own_memory", "signal"]

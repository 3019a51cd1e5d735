"""A master with real or replayed clients for the benchmarks: starts them, waits, gives back --stats."""
import contextlib
import json
import os
import re
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
START_WITHIN = 60  # seconds until the master listens


class Failure(Exception):
    """A program failed; the text says which and why."""


def progress(text):
    print(f"{os.path.basename(sys.argv[0])}: {text}", file=sys.stderr, flush=True)


def program(name):
    path = os.path.join(ROOT, "build/bin", name)
    if not os.access(path, os.X_OK):
        raise Failure(f"no program {path}; build it")
    return path


def scene_file(name):
    return os.path.join(ROOT, "scenes", name + ".glb")


def answer(command):
    """What a program that prints JSON says."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Failure(f"{' '.join(command)}: {done.stderr.strip()}")
    return json.loads(done.stdout)


class Cluster:
    """Keeps a cluster key and recordings in a folder that goes away with it."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory(prefix="ninefold-bench-")
        self.folder = self._folder.name
        self.key = os.path.join(self.folder, "key")
        subprocess.run([program("ninefold-master"), "--new-key", self.key], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._folder.cleanup()

    def run(self, scene, arguments, clients, listen="127.0.0.1:0", prefix=()):
        """Runs a master and what `clients(address)` lists: (command, prefix) pairs. Returns the stats."""
        stats = os.path.join(self.folder, "stats.json")
        command = [*prefix, program("ninefold-master"), scene_file(scene), *map(str, arguments), "--listen", listen,
                   "--key-file", self.key, "--stats", stats]
        with contextlib.ExitStack() as stack:
            log = stack.enter_context(open(os.path.join(self.folder, "master.log"), "w+", encoding="utf-8"))
            master = stack.enter_context(ended(subprocess.Popen(command, stdin=subprocess.DEVNULL,
                                                                stdout=subprocess.DEVNULL, stderr=log)))
            for client in clients(listening(master, log.name)):
                stack.enter_context(ended(subprocess.Popen(client, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                                           stderr=subprocess.DEVNULL)))
            if master.wait() != 0:
                raise Failure(f"{' '.join(command)} failed: {last_line(log.name)}")
        with open(stats, encoding="utf-8") as file:
            return json.load(file)

    def real(self, scene, arguments, count, threads=1, record=None):
        """Real clients on this machine."""
        def clients(address):
            return [[program("ninefold-client"), "--master", address, "--key-file", self.key, "--threads", str(threads),
                     "--cache", "none", *(["--record", record] if record else [])] for _ in range(count)]
        return self.run(scene, [*arguments, "--local-clients", 0, "--wait-clients", count], clients)

    def record(self, scene, arguments, frames, threads):
        """Real results of some frames; returns (file, the stats of that run)."""
        name = "-".join([scene, *map(str, arguments)]).replace("/", "_")
        file = os.path.join(self.folder, name + ".recording")
        return file, self.real(scene, [*arguments, "--frames", frames], 1, threads, file)

    def replay(self, scene, arguments, recording, count, pace="full", slower=1, threads=1):
        """Clients that send a recording."""
        def clients(address):
            return [[program("ninefold-replay-client"), "--master", address, "--key-file", self.key,
                     "--recording", recording, "--clients", str(count), "--pace", pace, "--slower", str(slower),
                     "--threads", str(threads)]]
        return self.run(scene, [*arguments, "--local-clients", 0, "--wait-clients", count], clients)


@contextlib.contextmanager
def ended(process):
    """Nothing that was started outlives its use."""
    try:
        yield process
    finally:
        if process.poll() is None:
            process.terminate()
            try:
                process.wait(5)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def listening(master, log):
    """Waits for the master's line that says where it listens."""
    end = time.monotonic() + START_WITHIN
    while time.monotonic() < end and master.poll() is None:
        with open(log, encoding="utf-8") as file:
            found = re.search(r"listening on (\S+)", file.read())
        if found:
            return found[1]
        time.sleep(0.02)
    raise Failure(f"the master does not listen: {last_line(log)}")


def last_line(path):
    with open(path, encoding="utf-8") as file:
        lines = file.read().strip().splitlines()
    return lines[-1] if lines else "no word on stderr"

"""The three sessions of scripts/soak: in bad weather, then the same work in peace."""
import hashlib
import json
import pathlib
import random
import re
import socket
import subprocess
import sys
import tempfile
import time

from browser import Closed, Viewer
from programs import BIN, SCENES, Program, signal
from soak_lib.watch import Memory, files_of, processes_of
from soak_lib.weather import GUESTS, Weather

SIZE = "160x120"
DATE = re.compile(rb"\d{4}:\d\d:\d\d \d\d:\d\d:\d\d")  # in a file, of when it was made
# Bytes that a settled process may take more: a connected client's 0.3 MB, some kB of each that has left, what malloc keeps.
GROWTH = 4e6
EDITS = [{"from": 1, "to": 4, "object": "short block", "by": [0.05, 0, 0.02]},
         {"from": 4, "to": 8, "object": "short block", "by": [-0.04, 0, 0], "turn": 30},
         {"from": 2, "to": 6, "object": "tall block", "turn": -20},
         {"at": 7, "material": "red", "color": [0.2, 0.5, 0.1]}]


class Wrong(Exception):
    pass


def check(condition, what):
    if not condition:
        raise Wrong(what)


def tell(text):
    print(f"soak: {text}", file=sys.stderr, flush=True)


class Place:
    """A folder with keys and a client of another release; starts programs there and ends them all."""

    def __init__(self, folder):
        self.folder, self.programs = pathlib.Path(folder), []
        for name in "cluster.key", "wrong.key":
            subprocess.run([BIN / "ninefold-master", "--new-key", name], cwd=folder, check=True)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.other_client = self.folder / "other-client"
        release = subprocess.run([BIN / "ninefold-client", "--version"], check=True, capture_output=True).stdout.split()[1]
        other = release[:-1] + (b"0" if release[-1:] != b"0" else b"1")
        self.other_client.write_bytes((BIN / "ninefold-client").read_bytes().replace(release, other))
        self.other_client.chmod(0o755)
        check(other in subprocess.run([self.other_client, "--version"], check=True, capture_output=True).stdout,
              "ninefold-client does not hold its release's name in one piece")

    def start(self, *command):
        self.programs.append(Program(command, self.folder))
        return self.programs[-1]

    def master(self, *options, clients=1):
        return self.start(BIN / "ninefold-master", SCENES / "cornell.glb", "--size", SIZE, "--local-clients", clients, "--listen",
                          f"127.0.0.1:{self.port}", "--key-file", "cluster.key", *options)

    def forget(self, program):
        program.close()
        self.programs.remove(program)

    def close(self):
        for program in self.programs:
            program.close()


def end(master):
    """By SIGTERM, as people end it."""
    master.process.send_signal(signal.SIGTERM)
    status = master.ends()
    check(status == 143, f"a master ended with status {status}: {master.text[-2000:]}")


class Session:
    """`seconds` of bad weather, then peace. What is to be the same is what `weather` and `peace` give back."""
    FILES = {"cluster.key", "wrong.key", "other-client"}

    def __init__(self, seconds, seed):
        self.seconds, self.random = seconds, random.Random(seed)
        self.memory = Memory()

    def run(self):
        tell(f"{self.name}: {self.seconds:.0f} s of bad weather")
        with tempfile.TemporaryDirectory(prefix="ninefold-soak-") as folder:
            self.place = Place(folder)
            try:
                self.hold()
                left = processes_of(folder)
                check(not left, f"{self.name}: processes are left: {left}")
                more = {f for f in files_of(folder) if not self.is_expected(f)}
                check(not more, f"{self.name}: files are left: {sorted(more)}")
            finally:
                self.place.close()

    def hold(self):
        clients = Weather(self.place, self.place.port, self.random)
        outcome = self.weather(clients)
        check(not clients.faults, f"{self.name}: {clients.faults}")
        tell(f"{self.name}: {clients.counts}; in peace")
        check(self.is_same(outcome, self.peace(outcome)), f"{self.name}: in peace the bytes are others")
        for name, count, first, growth in self.memory.growths():
            tell(f"{self.name}: {name}: {first / 1e6:.1f} MB, grew by {growth / 1e6:+.2f} MB in {count} s")
            check(growth < GROWTH, f"{self.name}: {name} grew by {growth / 1e6:.2f} MB in {count} s")

    def blow(self, clients, master, meanwhile=lambda: None):
        """Until the time is over; gives back the master that is there then."""
        begin = time.monotonic()
        while time.monotonic() < begin + self.seconds:
            time.sleep(self.random.uniform(0.2, 1))
            clients.step()
            master = meanwhile() or master
            check(master.process.poll() is None, f"{self.name}: the master ended: {master.text[-2000:]}")
            self.memory.look([("master", master.process.pid), ("client", clients.guests[0].program.process.pid)])
        clients.clear_up()
        return master

    def is_same(self, outcome, peace):
        return outcome == peace

    def is_expected(self, file):
        return file in self.FILES


class Still(Session):
    """One picture; its master is killed now and then, and goes on."""
    name = "a picture with checkpoints"
    FILES = Session.FILES | {"a.exr", "stats.json", "film"}
    OFTEN = 15  # seconds between two ends of the master, in the mean

    def master(self):
        return self.place.master("--checkpoint", "film", "--save-every", 0.5, "--verify", 0.2, "--output", "a.exr", "--stats",
                                 "stats.json", "--seconds", 1e6)

    def weather(self, clients):
        master, kills, last = self.master(), 0, time.monotonic()

        def maybe_kill():
            nonlocal master, kills, last
            if time.monotonic() - last > self.random.uniform(0.5, 1.5) * self.OFTEN:
                master.process.send_signal(signal.SIGKILL)
                master.ends()
                master, kills, last = self.master(), kills + 1, time.monotonic()
            return master
        master = self.blow(clients, master, maybe_kill)
        master.waits_for(r"progress: .*frame [1-9]")
        end(master)
        clients.end()
        stats = json.loads((self.place.folder / "stats.json").read_text())
        check(stats["verify"]["wrong"] == 0 and stats["tiles_dropped"]["malformed"] == 0, f"results were refused: {stats}")
        tell(f"{self.name}: {stats['frames']} frames, the master killed {kills} times")
        check(kills == 0 or stats["frames_before"] > 0, "no master went on where one was killed")
        return stats["frames"], stats["image_hash"]

    def peace(self, outcome):
        master = self.place.master("--output", "a.exr", "--stats", "stats.json", "--frames", outcome[0],
                                   clients=GUESTS)
        check(master.process.wait() == 0, master.text)
        return outcome[0], json.loads((self.place.folder / "stats.json").read_text())["image_hash"]


class Pictures(Session):
    """A script's pictures, edits between any two of them."""
    name = "a script's pictures"

    def is_expected(self, file):
        return super().is_expected(file) or file == "s.json" or file.endswith(".png")

    def master(self, name, **more):
        repeated = [event | {key: event[key] + 10 * turn for key in ("from", "to", "at") if key in event}
                    for turn in range(500) for event in EDITS]
        (self.place.folder / "s.json").write_text(json.dumps({"seconds": 5000, "rate": 2, "frames": 4, "events": repeated}))
        return self.place.master("--script", "s.json", "--exposure", 0, "--output", f"{name}.#####.png", **more)

    def picture(self, name, number):
        return hashlib.sha256((self.place.folder / f"{name}.{number:05}.png").read_bytes()).hexdigest()

    def weather(self, clients):
        master = self.blow(clients, self.master("weather"))
        end(master)
        clients.end()
        count = master.text.count("picture ")
        tell(f"{self.name}: {count} pictures")
        check(count > 0, "no picture was made")
        return [self.picture("weather", i) for i in range(count)]

    def peace(self, outcome):
        master = self.master("peace", clients=GUESTS)
        while f"picture {len(outcome)} of" not in master.text and master.process.poll() is None:
            time.sleep(0.05)
        end(master)
        return [self.picture("peace", i) for i in range(len(outcome))]


class Watched(Session):
    """A live session: a script edits, browsers come and go and take turns. At the end all rests."""
    name = "a live session with browsers"
    FILES = Session.FILES | {"s.json"}
    FILMS = 20  # that are looked at

    def master(self):
        (self.place.folder / "s.json").write_text(json.dumps({"seconds": 10, "events": EDITS}))
        master = self.place.master("--script", "s.json", "--serve", "127.0.0.1:0", "--exposure", 0)
        found = master.waits_for(r"serving at http://\S+:(\d+)/#token=(\S+)")
        self.site = int(found.group(1)), found.group(2)
        return master

    def view(self):
        return Viewer("127.0.0.1", *self.site)

    def weather(self, clients):
        master, viewers = self.master(), []

        def come_and_go():
            if len(viewers) < 6 and self.random.random() < 0.4:
                viewers.append(self.view())
            if viewers and self.random.random() < 0.2:
                viewers.pop(self.random.randrange(len(viewers))).close()
            if viewers and not self.act(viewer := self.random.choice(viewers)):
                viewers.remove(viewer)
        master = self.blow(clients, master, come_and_go)
        for viewer in viewers:
            viewer.close()
        return self.at_the_end(master, clients)

    def act(self, viewer):
        """Looks, and asks for something; who is not in control is not heard, but may ask for it. False: it was turned away,
        as it had not shown for 30 s what it got."""
        try:
            viewer.look()
            viewer.send(self.random.choice(["camera 0", "camera 1", "view depth", "view beauty", "exposure 1", "ask", "give",
                                            "button down right 40 40 -", "move 60 45 -", "button up right 60 45 -"]))
            return True
        except (Closed, OSError):
            viewer.close()
            return False

    def at_the_end(self, master, clients=None):
        """Digests of the film's radiance at rest, from its first frame on, as one sees it."""
        viewer = self.view()
        viewer.look_until(lambda head: head.get("control") == head["you"])
        for message in "view beauty", "exposure 0", "camera 1":
            viewer.send(message)
        viewer.look_until(lambda head: head["view"] == "beauty" and not head["moving"] and head["frames"] > 12)
        viewer.send("camera 0")
        viewer.look_until(lambda head: head["frames"] < 4)  # the film begins
        digests = set()
        while len(digests) < self.FILMS:
            viewer.files.clear()
            viewer.send("download exr")
            head = viewer.look_until(lambda head: "file" in head)
            if not head["moving"]:
                digests.add(hashlib.sha256(DATE.sub(b"", viewer.files[head["file"]])).hexdigest())
        viewer.close()
        end(master)
        if clients:
            clients.end()
        return digests

    def peace(self, outcome):
        master = self.master()
        viewer = self.view()
        time.sleep(11)  # the script
        viewer.close()
        return self.at_the_end(master)

    def is_same(self, outcome, peace):
        """Neither sees the film at all frames; what both saw is enough, as films that differ have nothing in common."""
        tell(f"{self.name}: {len(outcome & peace)} of {len(outcome)} films seen again in peace")
        return len(outcome & peace) >= self.FILMS // 4


def soak(seconds, seed):
    for session, share in (Still, 0.4), (Pictures, 0.3), (Watched, 0.3):
        session(share * seconds, seed).run()

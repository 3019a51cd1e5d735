"""The three sessions of scripts/soak: in bad weather, then the same work in peace."""
import contextlib
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


def unlike(outcome, peace):
    """Which of two lists' members."""
    return f"{[i for i, (a, b) in enumerate(zip(outcome, peace)) if a != b]} of {len(outcome)}, {len(peace)}"


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
        peace = self.peace(outcome)
        check(outcome == peace, f"{self.name}: in peace the bytes are others: {unlike(outcome, peace)}")
        for name, count, first, growth in self.memory.growths():
            tell(f"{self.name}: {name}: {first / 1e6:.1f} MB, grew by {growth / 1e6:+.2f} MB in {count} s")
            check(growth < GROWTH, f"{self.name}: {name} grew by {growth / 1e6:.2f} MB in {count} s")

    def blow(self, clients, master, seconds, meanwhile=lambda: None):
        """Gives back the master that is there at the end."""
        begin = time.monotonic()
        while time.monotonic() < begin + seconds:
            clients.wait_for_gust()
            master = meanwhile() or master
            check(master.process.poll() is None, f"{self.name}: the master ended: {master.text[-2000:]}")
            self.memory.look([("master", master.process.pid), ("client", clients.guests[0].program.process.pid)])
        return master

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
        master = self.blow(clients, master, self.seconds, maybe_kill)
        clients.clear_up()
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
        master = self.blow(clients, self.master("weather"), self.seconds)
        clients.clear_up()
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
    """A live session: a script edits, browsers come and go and take turns. Between two crowds one browser is alone in control
    and takes turns of its own, each of which ends in a film of as many frames."""
    name = "a live session with browsers"
    FILES = Session.FILES | {"s.json"}
    CROWD = 10  # seconds of it
    FRAMES = 12  # of a film
    BLOCK = 57, 58  # where camera 0 sees the short block, on a page of 96x72

    def master(self):
        (self.place.folder / "s.json").write_text(json.dumps({"seconds": 10, "events": EDITS}))
        master = self.place.master("--script", "s.json", "--serve", "127.0.0.1:0", "--exposure", 0, "--frames", self.FRAMES)
        found = master.waits_for(r"serving at http://\S+:(\d+)/#token=(\S+)")
        self.site = int(found.group(1)), found.group(2)
        return master

    def view(self):
        return Viewer("127.0.0.1", *self.site)

    def weather(self, clients):
        master, films = self.master(), []
        begin = time.monotonic()
        while (left := begin + self.seconds - time.monotonic()) > 0:
            self.crowd(clients, master, min(self.CROWD, left))
            films += self.films(len(films), clients.gust)
        clients.clear_up()
        end(master)
        clients.end()
        tell(f"{self.name}: {len(films)} films")
        return films

    def crowd(self, clients, master, seconds):
        viewers = []

        def come_and_go():
            if len(viewers) < 6 and self.random.random() < 0.4:
                viewers.append(self.view())
            if viewers and self.random.random() < 0.2:
                viewers.pop(self.random.randrange(len(viewers))).close()
            if viewers and not self.act(viewer := self.random.choice(viewers)):
                viewers.remove(viewer)
        self.blow(clients, master, seconds, come_and_go)
        for viewer in viewers:
            viewer.close()

    def act(self, viewer):
        """Looks, and asks for something; who is not in control is not heard, but may ask for it. False: it was turned away,
        as it had not shown for 30 s what it got."""
        try:
            if viewer.wait(0.05):  # nothing comes of a picture that is complete
                viewer.look()
            viewer.send(self.random.choice(["camera 0", "camera 1", "view depth", "view beauty", "exposure 1", "ask", "give",
                                            "button down right 40 40 -", "move 60 45 -", "button up right 60 45 -"]))
            return True
        except (Closed, OSError):
            viewer.close()
            return False

    def films(self, before, gust=lambda: None):
        """Digests of the films that four turns end in; `before`: how many films there were, which says how far this one drags."""
        with contextlib.closing(Director(self.view(), self.FRAMES, gust)) as director:
            director.viewer.look_until(lambda head: head.get("control") == head["you"] and head.get("playing") is False)
            director.go("view beauty", "camera 1")  # a film that the crowd saw may rest on: it is left
            digests = [director.film("camera 0")]
            x, y = self.BLOCK
            director.viewer.click(x, y)
            director.viewer.look_until(lambda head: head["selection"] == "short block")
            to = f"{x - 4 - before // 4 % 20} {y - 2} -"
            digests.append(director.film(f"button down left {x} {y} -", f"move {to}", f"button up left {to}"))
            digests.append(director.film("camera 1"))
            digests.append(director.film(*(f"key {way} {key}" for key in ("90 c", "256 -") for way in ("down", "up"))))
            check(len(set(digests)) == len(digests), f"{self.name}: turns that change nothing: {digests}")
            return digests

    def peace(self, outcome):
        master, films = self.master(), []
        while len(films) < len(outcome):
            films += self.films(len(films))
        end(master)
        return films


class Director:
    """Asks for films, in whatever weather: `gust` is called between two looks."""

    def __init__(self, viewer, frames, gust):
        self.viewer, self.frames, self.gust, self.turn = viewer, frames, gust, 0

    def go(self, *messages):
        """The head of the complete picture that the messages lead to. An exposure of its own tells that they were heard."""
        self.turn += 1
        for message in *messages, f"exposure {self.turn / 8}":
            self.viewer.send(message)
        return self.viewer.look_until(self.is_complete)

    def film(self, *messages):
        """The digest of its radiance."""
        frames = self.go(*messages)["frames"]
        check(frames == self.frames, f"a film has {frames} frames in place of {self.frames}")
        self.viewer.files.clear()
        self.viewer.send("download exr")
        head = self.viewer.look_until(lambda head: "file" in head)
        return hashlib.sha256(DATE.sub(b"", self.viewer.files[head["file"]])).hexdigest()

    def is_complete(self, head):
        self.gust()
        return head["exposure"] == self.turn / 8 and head["complete"]

    def close(self):
        self.viewer.close()


def soak(seconds, seed):
    for session, share in (Still, 0.4), (Pictures, 0.3), (Watched, 0.3):
        session(share * seconds, seed).run()

"""Runs ninefold-master and the tools that measure, and gives back what they say. No figure is computed here."""
import dataclasses
import json
import os
import re
import subprocess
import sys


class Failure(Exception):
    """A program failed; the text is its last line on stderr."""


@dataclasses.dataclass(frozen=True)
class Job:
    """A picture to make, without how long and with which seed."""
    scene: object  # scenes.Scene
    size: tuple  # (width, height)
    flags: tuple = ()

    def arguments(self):
        return [self.scene.file, "--size", "%dx%d" % self.size, *self.scene.flags, *self.flags]


class Programs:
    def __init__(self, folder, clients, progress):
        self.folder, self.clients, self.progress = folder, clients, progress
        for name in ("ninefold-master", "ninefold-client", "ninefold-compare", "ninefold-virtual-lights", "ninefold-photon-map",
                     "ninefold-selective-photons", "ninefold-intersection-field"):
            if not os.access(os.path.join(folder, name), os.X_OK):
                raise Failure(f"{folder} has no program {name}; build it, or name its folder by --programs")

    def render(self, job, seed, stop, picture):
        """Writes `picture` (.exr) and returns the object of --stats. stop: ("--seconds", 4) or ("--frames", 16)."""
        stats = os.path.splitext(picture)[0] + ".json"
        os.makedirs(os.path.dirname(picture), exist_ok=True)
        self.progress(f"{job.scene.name} {' '.join(job.flags)} seed {seed} {stop[0]} {stop[1]}")
        self._call("ninefold-master", *job.arguments(), "--seed", str(seed), stop[0], str(stop[1]),
                   "--local-clients", str(self.clients), "--wait-clients", str(self.clients),
                   "--output", picture, "--stats", stats)
        with open(stats, encoding="utf-8") as file:
            return json.load(file)

    def play(self, job, seed, script, output):
        """Plays a script (an object of docs/script.md); `output` is numbered (x.####.exr). Returns the object of --stats, or None
        of a script with a rate, which writes none."""
        folder = os.path.dirname(output)
        os.makedirs(folder, exist_ok=True)
        file, stats = os.path.join(folder, "script.json"), os.path.join(folder, "times.json")
        with open(file, "w", encoding="utf-8") as text:
            json.dump(script, text)
        self.progress(f"{job.scene.name} {' '.join(job.flags)} seed {seed}, a script of {script['seconds']} s"
                      + (f" as {script['rate']} stills a second" if "rate" in script else ""))
        self._call("ninefold-master", *job.arguments(), "--seed", str(seed), "--script", file, "--local-clients", str(self.clients),
                   "--wait-clients", str(self.clients), "--output", output, "--stats", stats)
        if "rate" in script:
            return None
        with open(stats, encoding="utf-8") as text:
            return json.load(text)

    def methods(self):
        """The names of all methods, as the program's help lists them: "NAME (note), NAME or NAME (note)"."""
        said = self._call("ninefold-master", "--help")
        text = re.search(r"--method NAME +how light is computed: (.*?)\n +--", said, re.S).group(1)
        return re.split(r", | or ", re.sub(r" \([^)]*\)", "", " ".join(text.split())))

    def compare(self, image, reference):
        """The object of ninefold-compare --json."""
        return json.loads(self._call("ninefold-compare", image, reference, "--json"))

    def lights(self, job, frames):
        """The object of ninefold-virtual-lights."""
        self.progress(f"{job.scene.name} {' '.join(job.flags)} virtual lights of {frames} frames")
        return json.loads(self._call("ninefold-virtual-lights", *job.arguments(), "--frames", str(frames)))

    def photon_map(self, *arguments):
        """The object of ninefold-photon-map."""
        self.progress(f"photon map: {' '.join(arguments)}")
        return json.loads(self._call("ninefold-photon-map", *arguments))

    def selective_photons(self, *arguments):
        """The object of ninefold-selective-photons."""
        self.progress(f"selective photons: {' '.join(arguments)}")
        return json.loads(self._call("ninefold-selective-photons", *arguments))

    def intersection_field(self, *arguments):
        """The object of ninefold-intersection-field."""
        self.progress(f"intersection field: {' '.join(arguments)}")
        return json.loads(self._call("ninefold-intersection-field", *arguments))

    def _call(self, name, *arguments):
        command = [os.path.join(self.folder, name), *arguments]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, check=False)
        if done.returncode != 0:
            last = (done.stderr.strip().splitlines() or ["no word on stderr"])[-1]
            raise Failure(f"{' '.join(command)}: status {done.returncode}: {last}")
        return done.stdout


class Progress:
    """Lines on stderr: what runs, and how long the report has been at it."""

    def __init__(self, clock):
        self.clock, self.begin = clock, clock()

    def __call__(self, text):
        minutes, seconds = divmod(int(self.clock() - self.begin), 60)
        print(f"report: {minutes:3d}:{seconds:02d}  {text}", file=sys.stderr, flush=True)

"""Reference pictures by the path tracer, made once and kept in out/references.

A reference is the mean of batches: path-traced pictures of equal numbers of frames and different seeds. More batches
are added until its relative standard error (blocks.py) is small enough or the time is spent; a later report with more
time goes on where this one stopped.

A reference's folder is named after the SHA-256 of scene bytes, size, camera, flags, seed and the hash of one frame of
that very job: promise 1 makes this hash the program's version, as far as the picture can tell.
"""
import dataclasses
import hashlib
import json
import os

from report_lib import blocks, pictures
from report_lib.programs import Job

FIRST_SEED = 900001  # tested pictures have small seeds
LEAST_BATCHES = 4
METHOD = ("--method", "path-trace")


@dataclasses.dataclass
class Reference:
    picture: str  # the mean of all batches
    batches: list  # pictures
    frames: int
    seconds: float
    error: float  # relative standard error of block means
    noise_rmse_percent: float  # what a picture without any error would be charged for the reference's noise
    noise_relmse: float


class References:
    def __init__(self, programs, folder, target, budget):
        self.programs, self.folder = programs, folder
        self.target, self.budget = target, budget  # relative error; seconds for each reference
        self.known = {}

    def get(self, scene, size):
        if (scene, size) not in self.known:
            self.known[scene, size] = self._make(scene, size)
        return self.known[scene, size]

    def _make(self, scene, size):
        job = Job(scene, size, METHOD)
        folder = self._folder(job)
        state = _load(folder)
        while self._wants_more(state):
            self._add_batch(job, folder, state)
        return self._finish(folder, state)

    def _folder(self, job):
        probe = os.path.join(self.folder, "probe.exr")
        first = self.programs.render(job, FIRST_SEED, ("--frames", 1), probe)
        key = json.dumps([job.size, job.scene.flags, job.flags, FIRST_SEED, first["image_hash"]]).encode()
        name = hashlib.sha256(job.scene.bytes() + key).hexdigest()[:16]
        return os.path.join(self.folder, f"{job.scene.name}-{job.size[0]}x{job.size[1]}-{name}")

    def _wants_more(self, state):
        done = len(state["batches"])
        if done < LEAST_BATCHES:
            return True
        return state["error"] > self.target and state["seconds"] < self.budget

    def _add_batch(self, job, folder, state):
        number = len(state["batches"])
        picture = os.path.join(folder, f"batch_{number:03d}.exr")
        # The first batch tells how many frames fit into its time; all others have as many.
        stop = ("--frames", state["frames"]) if number else ("--seconds", max(1, min(20, self.budget / 16)))
        stats = self.programs.render(job, FIRST_SEED + number, stop, picture)
        state["frames"] = stats["frames"]
        state["batches"].append(os.path.basename(picture))
        state["seconds"] += stats["seconds"]
        if number:
            state["error"] = blocks.of_pictures(_paths(folder, state)).relative_error()
        _save(folder, state)

    def _finish(self, folder, state):
        paths = _paths(folder, state)
        names = [os.path.join(folder, name) for name in ("mean.exr", "even.exr", "odd.exr")]
        even, odd = paths[0::2], paths[1::2]
        for name, some in zip(names, (paths, even, odd)):
            pictures.write(name, pictures.mean(some))
        # Halves of a and b batches differ by the variance v (1/a + 1/b); the mean of all has v/(a + b).
        apart = self.programs.compare(names[1], names[2])
        share = len(even) * len(odd) / len(paths) ** 2
        return Reference(names[0], paths, state["frames"] * len(paths), state["seconds"], state["error"],
                         apart["rmse_percent"] * share ** 0.5, apart["relmse"] * share)


def _paths(folder, state):
    return [os.path.join(folder, name) for name in state["batches"]]


def _load(folder):
    try:
        with open(os.path.join(folder, "state.json"), encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return {"batches": [], "frames": 0, "seconds": 0.0, "error": float("inf")}


def _save(folder, state):
    path = os.path.join(folder, "state.json")
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump(state, file)
    os.replace(path + ".part", path)

"""Reference pictures, made once and kept in out/references: by the path tracer, or, where it hardly finds the light
(scenes.DARK), by the bidirectional method, which the section of that name holds against the path tracer.

A reference is the mean of batches: pictures of equal numbers of frames and different seeds. More batches
are added until it is good enough or the time is spent; a later report with more time goes on where this one stopped.
Good enough: each channel's mean over the image has a relative standard error of at most `target`, and the noise of
pixels, which every comparison is charged for, is at most NOISE_RELMSE. Where seconds to an error are asked for, that of
TARGETS_NOISE_RELMSE.

A reference's folder is named after the SHA-256 of scene bytes, size, camera, flags and seed. A program that renders
another picture of the same scene is held against the reference of before; delete the folder if that was the wrong one.
"""
import dataclasses
import hashlib
import json
import os

from report_lib import blocks, pictures
from report_lib.programs import Job
from report_lib.scenes import DARK, TARGETS

FIRST_SEED = 900001  # tested pictures have small seeds
LEAST_BATCHES = 4
TRACER = ("--method", "path-trace")
# Nothing is blurred.
BIDIRECTIONAL = ("--method", "bidirectional", "--filter", "none")
NOISE_RELMSE, TARGETS_NOISE_RELMSE = 0.01, 0.0008


@dataclasses.dataclass
class Reference:
    picture: str  # the mean of all batches
    batches: list  # pictures
    frames: int
    seconds: float
    error: float  # relative standard error of the image's mean, of the worst channel
    noise: dict  # by figure of measure.py: what a picture without any error would be charged for the reference's noise


class References:
    def __init__(self, programs, folder, target, budget):
        self.programs, self.folder = programs, folder
        self.target, self.budget = target, budget  # relative error; seconds for each reference
        self.known = {}

    def get(self, scene, size, method=None):
        """method: flags; None: that of the scene."""
        job = Job(scene, size, method or (BIDIRECTIONAL if scene.name in DARK else TRACER))
        if job not in self.known:
            self.known[job] = self._make(job)
        return self.known[job]

    def _make(self, job):
        folder = self._folder(job)
        state = _load(folder)
        while self._wants_more(job.scene, state):
            self._add_batch(job, folder, state)
        return self._finish(folder, state)

    def _folder(self, job):
        key = json.dumps([job.size, job.scene.flags, job.flags, FIRST_SEED]).encode()
        name = hashlib.sha256(job.scene.bytes() + key).hexdigest()[:16]
        return os.path.join(self.folder, f"{job.scene.name}-{job.size[0]}x{job.size[1]}-{name}")

    def _wants_more(self, scene, state):
        if len(state["batches"]) < LEAST_BATCHES:
            return True
        noise = TARGETS_NOISE_RELMSE if scene.name in TARGETS else NOISE_RELMSE
        return (state["error"] > self.target or state["noise"]["relmse"] > noise) and state["seconds"] < self.budget

    def _add_batch(self, job, folder, state):
        number = len(state["batches"])
        picture = os.path.join(folder, f"batch_{number:03d}.exr")
        # The first batch tells how many frames fit into its time; all others have as many. Long ones: within a
        # batch a pixel's samples go on with one sequence, and edges of what mirrors and glass show gain by that.
        stop = ("--frames", state["frames"]) if number else ("--seconds", max(1, self.budget / 16))
        stats = self.programs.render(job, FIRST_SEED + number, stop, picture)
        state["frames"] = stats["frames"]
        state["batches"].append(os.path.basename(picture))
        state["seconds"] += stats["seconds"]
        if number:
            state["error"] = blocks.of_pictures(_paths(folder, state)).image_error()
            state["noise"] = self._noise(folder, state)
        _save(folder, state)

    def _noise(self, folder, state):
        """Halves of a and b batches differ by the variance v (1/a + 1/b); the mean of all has v/(a + b)."""
        paths = _paths(folder, state)
        halves = paths[0::2], paths[1::2]
        names = [os.path.join(folder, name) for name in ("even.exr", "odd.exr")]
        for name, some in zip(names, halves):
            pictures.write(name, pictures.mean(some))
        apart = self.programs.compare(*names)
        share = len(halves[0]) * len(halves[1]) / len(paths) ** 2
        return {"rmse_percent": apart["rmse_percent"] * share ** 0.5, "relmse": apart["relmse"] * share,
                "relmse_trimmed": apart["relmse_trimmed"] * share}

    def _finish(self, folder, state):
        paths = _paths(folder, state)
        name = os.path.join(folder, "mean.exr")
        pictures.write(name, pictures.mean(paths))
        return Reference(name, paths, state["frames"] * len(paths), state["seconds"], state["error"],
                         state["noise"])


def _paths(folder, state):
    return [os.path.join(folder, name) for name in state["batches"]]


def _load(folder):
    try:
        with open(os.path.join(folder, "state.json"), encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return {"batches": [], "frames": 0, "seconds": 0.0, "error": float("inf"), "noise": {}}


def _save(folder, state):
    path = os.path.join(folder, "state.json")
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump(state, file)
    os.replace(path + ".part", path)

"""The truth of a script's moments: stills of many frames by instant radiosity, which the section agreement holds against the path
tracer. Two series of unlike seeds: their mean is the truth, their difference its noise. Made once and kept beside the
references, in a folder named after the SHA-256 of scene bytes, size, flags, script and seed."""
import dataclasses
import hashlib
import json
import os

from report_lib import motion_errors, motion_scripts, pictures
from report_lib.programs import Job

SEEDS = (900001, 900002)  # of pictures that are measured: small ones
METHOD = ("--method", "instant-radiosity")


@dataclasses.dataclass
class Truth:
    """For each moment a picture, and its noise as motion_errors.noise gives it."""
    pictures: list
    noise: list


def get(context, scene, size, rate, frames):
    job = Job(scene, size, METHOD)
    script = motion_scripts.script(motion_scripts.COURSES[scene.name], rate=rate, frames=frames)
    halves = [_series(context, job, script, seed) for seed in SEEDS]
    truth = Truth([], [])
    for files in zip(*halves):
        a, b = (pictures.read(file) for file in files)
        truth.pictures.append((a + b) / 2)
        truth.noise.append(motion_errors.noise(a, b))
    return truth


def _series(context, job, script, seed):
    """The files, by the moment."""
    folder = _folder(context.options.references, job, script, seed)
    files = [os.path.join(folder, f"truth.{i:04d}.exr") for i in range(motion_scripts.count(script["rate"]))]
    if not all(os.path.exists(file) for file in files):
        os.makedirs(folder, exist_ok=True)
        context.programs.play(job, seed, script, os.path.join(folder, "truth.####.exr"))
    return files


def _folder(references, job, script, seed):
    key = json.dumps([job.size, job.scene.flags, job.flags, script, seed]).encode()
    name = hashlib.sha256(job.scene.bytes() + key).hexdigest()[:16]
    return os.path.join(references, f"{job.scene.name}-motion-{job.size[0]}x{job.size[1]}-{name}")

"""One run and how wrong its picture is: figures of --stats and of ninefold-compare side by side.

The reference has noise of its own, n in the mean squared, which adds to what is measured. As picture and reference are
independent, measured - n has the right mean; below a quarter of n that difference is no measurement any more.
"""
import math
import os

import numpy

LEAST_PART_OF_NOISE = 0.25


def measure(context, job, seed, stop, reference, path):
    stats = context.programs.render(job, seed, stop, path)
    m = context.programs.compare(path, reference.picture)
    return {
        "seed": seed, "seconds": stats["seconds"], "frames": stats["frames"], "rays": sum(stats["rays"].values()),
        "rmse_percent": m["rmse_percent"], "relmse": m["relmse"], "relmse_trimmed": m["relmse_trimmed"],
        "bias_r": m["bias"][0], "bias_g": m["bias"][1], "bias_b": m["bias"][2], "ssim": m["ssim"],
        "error_stated": stats["relative_error"], "not_finite": m["non_finite"]["image"],
        "reference_error": reference.error, **{"noise_" + key: value for key, value in reference.noise.items()}}


def repeated(context, job, stop, reference, name):
    """The same with seeds 1, 2, ... One list of entries; path(context, name, seed) is the picture of each."""
    return [measure(context, job, seed, stop, reference, path(context, name, seed))
            for seed in range(1, context.options.seeds + 1)]


def path(context, name, seed):
    return os.path.join(context.folder, "runs", f"{name}_{seed}.exr")


def mean(entries, key):
    """And its standard error."""
    values = [entry[key] for entry in entries]
    return float(numpy.mean(values)), float(numpy.std(values, ddof=1) / math.sqrt(len(values)))


def squared(key, value):
    """Noise adds to squares."""
    return value ** 2 if key == "rmse_percent" else value


def squared_net(entry, key):
    """The squared error without the reference's noise; it may be negative when hardly anything is left."""
    return squared(key, entry[key]) - squared(key, entry["noise_" + key])


def net(entry, key):
    """A figure without the reference's noise; None if too little is left."""
    left = squared_net(entry, key)
    if left < LEAST_PART_OF_NOISE * squared(key, entry["noise_" + key]):
        return None
    return math.sqrt(max(left, 0)) if key == "rmse_percent" else left


def can_tell(reference, key, limit):
    """Whether an error as small as `limit` can be measured against this reference."""
    return squared(key, limit) >= LEAST_PART_OF_NOISE * squared(key, reference.noise[key])

"""The photon map's bias against the path tracer as the pool grows."""
import math
import os

import numpy

from report_lib import pictures, plots
from report_lib.measure import path
from report_lib.programs import Job
from report_lib.scenes import shipped
from report_lib.section import Picture
from report_lib.tables import Table, figure

# Paths, of them a unit, frames of a run.
POOLS = ((1000, 1000, 64), (10000, 10000, 64), (100000, 50000, 32), (1000000, 50000, 8))


def add_to(context, section):
    table = Table("photon_map_bias", ["scene", "paths", "frames", "relMSE of one run", "bias", "reference's noise"])
    series = {}
    for name in ("cornell",) if context.options.quick else ("cornell", "office"):
        series[name] = _scene(context, shipped(name), table)
    section.tables.append(table)
    slopes = {name: slope(points) for name, points in series.items()}
    plots.bias(os.path.join(context.folder, "bias.png"), series, slopes)
    section.pictures.append(Picture("bias.png", "relMSE that stays when frames are averaged, over the paths of the pool; 100 nearest",
                                    plot=True))
    section.text.append("Slope of the bias: " + ", ".join(f"{name} {figure(found, 2)}" for name, found in slopes.items()) + ".")


def _scene(context, scene, table):
    size = scene.size(context.options.width)
    reference = context.references.get(scene, size)
    halves = pictures.mean(reference.batches[0::2]), pictures.mean(reference.batches[1::2])
    points = []
    for paths, unit, frames in POOLS:
        frames = frames // 2 if context.options.quick else frames
        job = Job(scene, size, ("--method", "photon-map", "--filter", "none", "--map-photons", str(paths),
                                "--map-photons-per-frame", str(unit)))
        files = [path(context, f"{scene.name}_{paths}", seed) for seed in (1, 2)]
        for seed, file in enumerate(files, 1):
            context.programs.render(job, seed, ("--frames", frames), file)
        made = [pictures.read(file) for file in files]
        bias = common_error(*made, *halves)
        entry = {"scene": scene.name, "paths": paths, "frames": frames,
                 "relmse": context.programs.compare(files[0], reference.picture)["relmse"], "bias": bias,
                 "noise": reference.noise["relmse"]}
        table.data.append(entry)
        table.rows.append([scene.name, str(paths), str(frames)] + [figure(entry[key]) for key in ("relmse", "bias", "noise")])
        points.append((paths, bias))
    return points


def common_error(x1, x2, r1, r2):
    """relMSE of common/image/metrics.h with the product (x1 - r1)(x2 - r2) in place of a square: noise, which is independent in
    all four pictures, has no part in its mean. Mean of that and of the same with r1 and r2 exchanged."""
    truth = 0.5 * (r1.astype(numpy.float64) + r2)
    scale = 1 / pictures.luminance(truth).mean()
    products = sum((x1.astype(numpy.float64) - a) * (x2.astype(numpy.float64) - b) for a, b in ((r1, r2), (r2, r1)))
    return float((0.5 * scale ** 2 * products / ((scale * truth) ** 2 + 0.01)).mean())


def slope(points):
    """Of the least squares' line through the logarithms; points that are not positive are left out."""
    seen = [(math.log(x), math.log(y)) for x, y in points if y > 0]
    if len(seen) < 2:
        return None
    return float(numpy.polyfit(*zip(*seen), 1)[0])

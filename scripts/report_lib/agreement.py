"""Section: does instant radiosity converge to what the path tracer converges to?"""
import math
import os

import numpy

from report_lib import blocks, pictures
from report_lib.programs import Job
from report_lib.section import Picture, Section
from report_lib.tables import Table, figure, percent, signed_percents

HEAD = ["scene", "runs x frames", "error between runs", "error as stated", "reference's error of the image", "bias R G B [%]",
        "error of that [%]", "blocks beyond 2 (chance)", "beyond 3 (chance)", "block difference (noise alone)",
        "worst block: t, difference"]
TEXT = [
    "Several runs of instant radiosity with different seeds, their mean held against the reference. "
    "Bias: of the means of the image, from ninefold-compare, with the standard error of that difference. "
    "Blocks: means of 16 x 16 pixels; t is their difference over the standard error that the runs of both sides show, "
    "beside it the share of blocks that Student's t puts there by chance. "
    "Block difference: root mean square over blocks in percent of the image's mean, and what the standard errors alone "
    "would make it. Error as stated: relative_error of --stats, for the mean of all runs; it ought to be the error between runs.",
    "Pictures: reference; mean of the runs; signed error, full colour at 10 %; t of each block, full colour at 5."]


def run(context):
    section = Section("agreement", "Convergence", list(TEXT))
    table = Table("agreement", HEAD)
    for scene in context.scenes:
        _add_scene(context, scene, section, table)
    section.tables.append(table)
    return section


def _add_scene(context, scene, section, table):
    size = scene.size(context.options.width)
    reference = context.references.get(scene, size)
    paths, runs = _runs(context, scene, size)
    mean_path = os.path.join(context.folder, scene.name + "_mean.exr")
    pictures.write(mean_path, pictures.mean(paths))
    compared = context.programs.compare(mean_path, reference.picture)
    x, r = blocks.of_pictures(paths), blocks.of_pictures(reference.batches)
    apart = blocks.difference(x, r)
    bias_error = numpy.sqrt(x.channel_error ** 2 + r.channel_error ** 2) / r.channel_mean
    entry = {
        "scene": scene.name, "runs": len(runs), "frames": sum(run["frames"] for run in runs),
        "error_between_runs": x.relative_error(),
        "error_stated": math.sqrt(sum(run["relative_error"] ** 2 for run in runs)) / len(runs),
        "reference_error": reference.error, "bias_r": compared["bias"][0], "bias_g": compared["bias"][1],
        "bias_b": compared["bias"][2], "bias_error_r": bias_error[0], "bias_error_g": bias_error[1],
        "bias_error_b": bias_error[2], "blocks": apart.t.size,
        "block_difference": float(numpy.sqrt((apart.relative ** 2).mean())), "block_noise": apart.expected}
    for limit in (2, 3):
        entry[f"beyond_{limit}"], entry[f"chance_{limit}"] = apart.beyond(limit)
    column, row = apart.worst()
    entry.update(worst_column=column, worst_row=row, worst_t=float(apart.t[row, column]),
                 worst_difference=float(apart.relative[row, column]))
    table.data.append(entry)
    table.rows.append(_row(scene, entry))
    section.pictures.append(_picture(context, scene, mean_path, reference, apart))


def _runs(context, scene, size):
    paths, runs = [], []
    for seed in range(1, context.options.runs + 1):
        path = os.path.join(context.folder, "runs", f"{scene.name}_{seed}.exr")
        runs.append(context.programs.render(Job(scene, size), seed, ("--seconds", context.options.run_seconds), path))
        paths.append(path)
    return paths, runs


def _row(scene, e):
    return [scene.name, f"{e['runs']} x {e['frames'] // e['runs']}",
            percent(e["error_between_runs"]), percent(e["error_stated"]), percent(e["reference_error"]),
            signed_percents([e["bias_r"], e["bias_g"], e["bias_b"]]),
            " ".join(f"{100 * e['bias_error_' + c]:.2f}" for c in "rgb"),
            f"{percent(e['beyond_2'])} ({percent(e['chance_2'])})", f"{percent(e['beyond_3'])} ({percent(e['chance_3'])})",
            f"{percent(e['block_difference'])} ({percent(e['block_noise'])})",
            f"{figure(e['worst_t'])} at ({e['worst_column']}, {e['worst_row']}): {100 * e['worst_difference']:+.2f} %"]


def _picture(context, scene, mean_path, reference, apart):
    mean, truth = pictures.read(mean_path), pictures.read(reference.picture)
    exposure = pictures.good_exposure(truth)
    t = numpy.repeat(numpy.repeat(apart.t, blocks.BLOCK, axis=0), blocks.BLOCK, axis=1)[:truth.shape[0], :truth.shape[1]]
    row = [pictures.shown(truth, exposure), pictures.shown(mean, exposure), pictures.signed_error(mean, truth, 0.1),
           pictures.diverging(t, 5)]
    name = scene.name + ".png"
    pictures.write(os.path.join(context.folder, name), pictures.sheet([row]))
    return Picture(name, f"{scene.name}: reference, instant radiosity, signed error (10 %), t of blocks (5)")

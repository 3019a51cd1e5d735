"""Section: what each scene turned on, and what a diffuse scene pays for the features that it does not use."""
import os
import statistics

from report_lib import plain_build
from report_lib.programs import Job
from report_lib.section import Section
from report_lib.tables import Table, figure

NEEDS = ("reflection", "transmission", "rough_specular", "textures", "alpha_mask", "area_lights", "punctual_lights",
         "environment")
RAYS = ("eye", "shadow", "photon", "compensation")
COST_SIZE, COST_FRAMES = (320, 240), 16
TEXT = ["Needs as --stats gives them, and where one frame's rays went: a feature that is off has no rays."]
COST_TEXT = (
    "Cost of what is not used: a scene without any lobe but the diffuse one, rendered by this build and by one of the same "
    f"sources in which the compiler can see that there are no other lobes (scripts/report_lib/plain_build.py), "
    f"{COST_SIZE[0]}x{COST_SIZE[1]}, {COST_FRAMES} frames, the two in turn. The picture must be the same, bit for bit. "
    "The spread says what this machine's noise is.")


def run(context):
    section = Section("needs", "Only what the scene needs", list(TEXT))
    section.tables.append(_needs(context))
    if context.options.rounds:
        section.text.append(COST_TEXT)
        section.tables.append(_cost(context))
    return section


def _needs(context):
    table = Table("needs", ["scene"] + [name.replace("_", " ") for name in NEEDS] + [f"{name} rays a pixel" for name in RAYS])
    for scene in context.scenes:
        stats = _render(context.programs, context, scene, scene.size(context.options.width), 1)
        pixels = stats["settings"]["width"] * stats["settings"]["height"]
        entry = {"scene": scene.name, **{name: stats["needs"][name] for name in NEEDS},
                 **{name + "_rays_per_pixel": stats["rays"][name] / pixels for name in RAYS}}
        table.data.append(entry)
        table.rows.append([scene.name] + ["yes" if entry[name] else "-" for name in NEEDS]
                          + [figure(entry[name + "_rays_per_pixel"]) for name in RAYS])
    return table


def _cost(context):
    table = Table("feature_cost", ["scene", "rounds", "with [s], median (best to worst)", "without [s]", "with/without: medians",
                                   "of the best", "same picture"])
    without = plain_build.make(context)
    for scene in context.scenes:
        stats = _render(context.programs, context, scene, scene.size(context.options.width), 1)
        if not (stats["needs"]["reflection"] or stats["needs"]["transmission"]):
            _add_cost(context, without, scene, table)
    return table


def _add_cost(context, without, scene, table):
    seconds, hashes = {"with": [], "without": []}, set()
    for _ in range(context.options.rounds):
        for name, programs in (("with", context.programs), ("without", without)):
            stats = _render(programs, context, scene, COST_SIZE, COST_FRAMES)
            seconds[name].append(stats["seconds"])
            hashes.add(stats["image_hash"])
    median = {name: statistics.median(values) for name, values in seconds.items()}
    best = {name: min(values) for name, values in seconds.items()}
    table.data.append({"scene": scene.name, "rounds": context.options.rounds, "same_picture": len(hashes) == 1,
                       **{f"{name}_{k + 1}": s for name, values in seconds.items() for k, s in enumerate(values)}})
    table.rows.append([scene.name, str(context.options.rounds)]
                      + [f"{figure(median[n])} ({figure(best[n])} to {figure(max(seconds[n]))})" for n in seconds]
                      + [f"{median['with'] / median['without']:.3f}", f"{best['with'] / best['without']:.3f}",
                         "yes" if len(hashes) == 1 else "no"])


def _render(programs, context, scene, size, frames):
    picture = os.path.join(context.folder, "runs", scene.name + ".exr")
    return programs.render(Job(scene, size), 1, ("--frames", frames), picture)

"""Section: selective photons beside their paper: how soon the photons that an edit concerns are traced anew (Figures 5 and 7), two
groups of photons (Figure 6), what steps and the state cost, and the bias that mesh elements leave."""
import json
import os

from report_lib import pictures, plots
from report_lib.measure import path
from report_lib.photon_bias import common_error
from report_lib.programs import Job
from report_lib.scenes import shipped
from report_lib.section import Picture, Section
from report_lib.tables import Table, figure

METHOD = ("--method", "selective-photons")
# Scene, name of the edit, events of a script of one second.
EDITS = (("office", "chair moves", [{"object": "main chair", "by": [0.4, 0, 0.3], "turn": 40}]),
         ("office", "door opens", [{"object": "door", "by": [0.3, 0, 0.3], "turn": 60}]),
         ("office", "desk lamp dims", [{"material": "desk light", "emission": [10, 9, 8]}]),
         ("table_room", "chair moves", [{"object": "chair on the right", "by": [0.4, 0, 0], "turn": 40}]),
         ("u_office", "chair in the dark room moves", [{"object": "dark room's chair", "by": [0.4, 0, 0.3], "turn": 40}]))
POOL, QUICK_POOL = 650000, 160000  # about; the published one is 1,152,000
GROUPS, RATIOS = (288, 10080), (8, 16, 32)
SIZES = (0.02, 0.04, 0.08, 0.16, 0.32)  # of elements, in R
TEXT = [
    "After Dmitriev, Brabec, Myszkowski and Seidel, \"Interactive Global Illumination Using Selective Photon Tracing\", 2002. "
    "ninefold-selective-photons makes a pool, edits the scene, and traces the groups again in the order that the method gives them, "
    "in one thread. Found: of all hits that the edit displaces or dims, the share that is right again; theirs counts photons. Light "
    "straight from lamps is not in the pool, so hits are those of light that has bounced.",
    "The published pilots belong to groups and are traced with them. Here pilots, one of R photons, and groups go by turns, as "
    "long as there are pilots; the first groups go before any pilot has told of the edit. Dotted: groups by chance. Their Figure 5: with the object lit directly 288 and 10,080 groups do alike; lit "
    "indirectly, 10,080 do better. Their Figure 7: 16 is about the best R. They trace changed paths twice, which costs them up to 25 %; "
    "here hits are kept, and nothing is traced twice.",
    "Bias: relMSE against the reference that stays when frames are averaged, over the size of elements; of two runs of unlike seeds "
    "and two halves of the reference, so that noise cancels."]


def run(context):
    section = Section("selective-photons", "Selective photons", list(TEXT))
    _add_found(context, section)
    _add_paths(context, section)
    _add_costs(context, section)
    _add_bias(context, section)
    return section


def _found(context, number, *flags):
    scene, name, events = EDITS[number]
    file = os.path.join(context.folder, f"edit_{number}.json")
    with open(file, "w", encoding="utf-8") as out:
        json.dump({"seconds": 1, "events": [{"from": 0, "to": 1, **event} for event in events]}, out)
    return context.programs.selective_photons(shipped(scene).file, "--edit", file, *METHOD, *flags)


def pool_near(wanted, groups, ratio):
    """The pool of that many photons that groups and pilots divide."""
    return max(round(wanted / (groups * ratio)), 1) * groups * ratio


def until(curve, share, key):
    """The first value of `key` at which so much is found."""
    return next(point[key] for point in curve if point["found"] >= share)


def _add_found(context, section):
    wanted = QUICK_POOL if context.options.quick else POOL
    table = Table("selective_found", ["scene", "edit", "groups", "R", "hits amiss [%]", "photons until 50 % [%]", "until 80 %", "until 95 %",
                                      "seconds until 95 %", "all"])
    numbers = (0, 4) if context.options.quick else range(len(EDITS))
    for file, caption, cases in (
            ("found_groups.png", "Found over photons traced, by the number of groups, R = 16 (their Figure 5)", [(g, 16) for g in GROUPS]),
            ("found_pilots.png", "Found over photons traced, by R, 288 groups (their Figure 7)", [(288, ratio) for ratio in RATIOS])):
        series = {}
        for number in numbers:
            scene, name, _ = EDITS[number]
            lines = series.setdefault(f"{scene}: {name}", {})
            for groups, ratio in cases:
                step, pool = max(groups // 36, 1), pool_near(wanted, groups, ratio)
                made = _found(context, number, "--photon-groups", str(groups), "--photon-pool", str(pool), "--pilot-ratio", str(ratio),
                              "--units", str(step))
                lines[f"{groups} groups, R = {ratio}"] = [(p["photons"] / pool, p["found"]) for p in made["curve"]]
                _fill(table, scene, name, made, pool)
        plots.shares(os.path.join(context.folder, file), series)
        section.pictures.append(Picture(file, caption, plot=True))
    section.tables.append(table)


def _fill(table, scene, name, made, pool):
    curve = made["curve"]
    entry = {"scene": scene, "edit": name, "groups": made["photon_groups"], "ratio": made["pilot_ratio"],
             "amiss": made["amiss"] / made["hits"], "seconds95": until(curve, 0.95, "seconds"), "seconds": curve[-1]["seconds"]}
    for share in (50, 80, 95):
        entry[f"photons{share}"] = until(curve, share / 100, "photons") / pool
    if entry in table.data:
        return
    table.data.append(entry)
    table.rows.append([scene, name, str(entry["groups"]), str(entry["ratio"]), figure(100 * entry["amiss"])] +
                      [figure(100 * entry[f"photons{share}"]) for share in (50, 80, 95)] +
                      [figure(entry["seconds95"]), figure(entry["seconds"])])


def _add_paths(context, section):
    made = _found(context, 0, "--photon-groups", "10080", "--photon-pool", str(pool_near(POOL, 10080, 16)), "--units", "10080", "--paths", "1200,6400")
    plots.paths(os.path.join(context.folder, "two_groups.png"), {"from above": (0, 2), "from the front": (0, 1)}, made["paths"])
    section.pictures.append(Picture("two_groups.png", "Photons of two of 10,080 groups in the office, up to the second surface that they "
                                                      "meet (their Figure 6)", plot=True))


def _add_costs(context, section):
    table = Table("selective_costs", ["scene", "photons", "hits", "state [MB]", "bytes a photon", "seconds for all", "photons a second"])
    for number in (0, 3, 4):
        for pool in (73728, 147456) if context.options.quick else (73728, 294912, 1179648):
            made = _found(context, number, "--photon-pool", str(pool))
            seconds = made["curve"][-1]["seconds"]
            table.data.append({"scene": EDITS[number][0], "photons": pool, "hits": made["hits"], "bytes": made["state_bytes"],
                               "seconds": seconds})
            table.rows.append([EDITS[number][0], str(pool), str(made["hits"]), figure(made["state_bytes"] / 1e6),
                               figure(made["state_bytes"] / pool), figure(seconds), figure(pool / seconds)])
    section.tables.append(table)


def _add_bias(context, section):
    table = Table("selective_bias", ["scene", "element size [R]", "relMSE of one run", "bias", "reference's noise"])
    frames = 32 if context.options.quick else 128
    for name in ("cornell",) if context.options.quick else ("cornell", "office"):
        scene = shipped(name)
        size = scene.size(context.options.width)
        reference = context.references.get(scene, size)
        halves = pictures.mean(reference.batches[0::2]), pictures.mean(reference.batches[1::2])
        for element in SIZES:
            job = Job(scene, size, (*METHOD, "--filter", "none", "--element-size", str(element)))
            files = [path(context, f"{name}_{element}", seed) for seed in (1, 2)]
            for seed, file in enumerate(files, 1):
                context.programs.render(job, seed, ("--frames", frames), file)
            entry = {"scene": name, "size": element, "relmse": context.programs.compare(files[0], reference.picture)["relmse"],
                     "bias": common_error(*[pictures.read(file) for file in files], *halves), "noise": reference.noise["relmse"]}
            table.data.append(entry)
            table.rows.append([name, figure(element)] + [figure(entry[key]) for key in ("relmse", "bias", "noise")])
    section.tables.append(table)

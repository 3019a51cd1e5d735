"""Times of the photon map's stages over what they depend on: Figures 21 to 24 of Jozwowski 2002."""
import math
import os

from report_lib import plots
from report_lib.scenes import shipped
from report_lib.section import Picture
from report_lib.tables import Table, figure

PUBLISHED = ("--map-direct", "on", "--map-photons", "2000", "--map-photons-per-frame", "100", "--map-nearest", "100",
             "--map-index", "tree", "--path-length", "3")
SIZE, QUICK_SIZE = (512, 512), (256, 256)
# Name, flag, values, label. 800, his last, does not divide 2,000.
FIGURES = (("Figure 21", "--map-photons-per-frame", (25, 50, 100, 200, 400, 1000), "photons shot anew per frame"),
           ("Figure 22", "--map-photons", (500, 1000, 2000, 4000, 8000, 16000), "photons in all"),
           ("Figure 23", "--path-length", (1, 2, 3, 4, 5), "path length"))
SURFACES = ("Figure 24", "--box", (16, 64, 256, 1024), "surfaces")
STAGES = ("shoot", "balance", "build", "update", "estimate", "rest", "total")


def add_to(context, section):
    table = Table("photon_map_stages", ["scene", "as", "", "hits"] + [stage + " [ms]" for stage in STAGES])
    repeats = 5 if context.options.quick else 25
    for scene, files, figures in (("box", ("--box", "16"), FIGURES + (SURFACES,)), ("office", (shipped("office").file,), FIGURES)):
        series = {}
        for name, flag, values, label in figures:
            made = [_stages(context, files, flag, value, repeats) for value in values]
            _fill(table, scene, name, label, values, made)
            series[f"{name}: {scene}"] = (label, values, {stage: [m[stage + "_ms"] for m in made] for stage in STAGES},
                                          _meeting_of(values, made) if flag.startswith("--map") else None)
        _add_rule(section, scene, series)
        file, size = f"stages_{scene}.png", "%dx%d" % _size(context)
        plots.times(os.path.join(context.folder, file), series)
        section.pictures.append(Picture(file, f"{scene}: ms of each stage of a frame, one thread, {size} pixels; 'total' is shoot, "
                                              "balance, estimate and rest. Dotted: shooting time = balancing time", plot=True))
    section.tables.append(table)


def _stages(context, files, flag, value, repeats):
    chosen = files if flag != "--box" else ()
    return context.programs.photon_map(*chosen, *replaced(PUBLISHED, flag, value), "--size", "%dx%d" % _size(context),
                                       "--repeats", str(repeats))["stages"]


def _size(context):
    return QUICK_SIZE if context.options.quick else SIZE


def replaced(flags, flag, value):
    """`flags` with another value of one of them, or with one more."""
    kept = [word for name, text in zip(flags[0::2], flags[1::2]) if name != flag for word in (name, text)]
    return (*kept, flag, str(value))


def _fill(table, scene, name, label, values, made):
    for value, m in zip(values, made):
        table.data.append({"scene": scene, "figure": name, "over": label, "value": value, **m})
        table.rows.append([scene, name, f"{value} {label}", str(m["hits"])] + [figure(m[stage + "_ms"]) for stage in STAGES])


def meeting(x, first, second):
    """Where two curves meet, straight lines in the log-log plot between the points; None if they do not."""
    apart = [math.log(a / b) for a, b in zip(first, second)]
    for i in range(len(x) - 1):
        if apart[i] == 0:
            return float(x[i])
        if apart[i] * apart[i + 1] < 0:
            share = apart[i] / (apart[i] - apart[i + 1])
            return x[i] * (x[i + 1] / x[i]) ** share
    return float(x[-1]) if apart[-1] == 0 else None


def _meeting_of(values, made):
    return meeting(values, [m["shoot_ms"] for m in made], [m["balance_ms"] for m in made])


def _add_rule(section, scene, series):
    found = []
    for label, _, _, meets in series.values():
        if label in ("photons shot anew per frame", "photons in all"):
            found.append(f"{figure(meets)} {label}" if meets else f"nowhere over {label}")
    section.text.append(f"His rule on {scene}: shooting takes as long as balancing at {' and at '.join(found)}.")

"""The photon map in motion: Table 1 of Jozwowski 2002 as measured rows, the four distributions, the answer to a jump."""
import glob
import os

from report_lib import pictures, plots
from report_lib.photon_stages import PUBLISHED, replaced
from report_lib.section import Picture
from report_lib.tables import Table, figure

BOX, SIZE, JUMP_SIZE = ("--box", "256"), ("--size", "64x48"), ("--size", "32x24")
WORDS = ("too small", "appropriate", "too large")
TOTALS, PER_FRAME = (500, 2000, 8000), (20, 100, 500)
# What he says of them.
HIS = {("too small", "too small"): "fast, inaccurate estimates", ("too small", "appropriate"): "fast, slight fluctuation",
       ("too small", "too large"): "fluctuation, slow shooting", ("appropriate", "too small"): "inaccurate estimates",
       ("appropriate", "appropriate"): "great results, good time", ("appropriate", "too large"): "slight fluctuation, slow shooting",
       ("too large", "too small"): "reacts slowly, slow balancing", ("too large", "appropriate"): "reacts slowly, slow balancing",
       ("too large", "too large"): "very slow"}
SOURCE = {"on": "photons", "off": "virtual lights"}
DISTRIBUTIONS = {"random": "by chance", "frame": "alike each frame", "turn": "alike each turn", "nets": "alike each turn, nets"}


def add_to(context, section):
    frames = ("--frames", "16" if context.options.quick else "50")
    section.tables += [_guidelines(context, frames), _distributions(context, frames)]
    section.pictures += [_answers(context), _moments(context)]


def _motion(context, flags, light, frames, *more):
    """Truths are the same for all of them: made once."""
    truths = os.path.join(context.folder, "truths")
    os.makedirs(truths, exist_ok=True)
    return context.programs.photon_map(*BOX, *SIZE, *flags, *(more or ("--repeats", "0")), "--light", light, *frames,
                                       "--truths", truths)


def _jump(context, flags):
    flags = replaced(flags, "--map-index", "grid")
    runs = "1" if context.options.quick else "4"
    return context.programs.photon_map(*BOX, *JUMP_SIZE, *flags, "--repeats", "0", "--light", "jump", "--runs", runs)["motion"]


def _guidelines(context, frames):
    table = Table("photon_map_guidelines", ["total", "per frame", "shoot [ms]", "balance [ms]", "variance at rest",
                                            "flicker on the circle", "relMSE on the circle", "lag [frames]", "theory", "Table 1 says"])
    measured = ("shoot_ms", "balance_ms", "variance_at_rest", "flicker", "relmse")
    for total, much in zip(TOTALS, WORDS):
        for part, many in zip(PER_FRAME, WORDS):
            flags = replaced(replaced(PUBLISHED, "--map-photons", total), "--map-photons-per-frame", part)
            flags = (*flags, "--map-distribution", "random")
            rest = _motion(context, flags, "still", frames, "--repeats", "25")
            circle, jump = _motion(context, flags, "circle", frames)["motion"], _jump(context, flags)
            entry = {"total": total, "per_frame": part, "shoot_ms": rest["stages"]["shoot_ms"],
                     "balance_ms": rest["stages"]["balance_ms"], "variance_at_rest": rest["motion"]["variance"],
                     "flicker": circle["flicker"], "relmse": circle["relmse_mean"], "lag": jump["lag_frames"],
                     "theory": jump["lag_theory"], "his": HIS[much, many]}
            table.data.append(entry)
            table.rows.append([f"{total} ({much})", f"{part} ({many})"] + [figure(entry[key]) for key in measured]
                              + [str(entry["lag"]), str(entry["theory"]), entry["his"]])
    return table


def _distributions(context, frames):
    table = Table("photon_map_distributions", ["distribution", "direct light", "variance at rest", "relMSE at rest",
                                               "flicker on the circle", "variance of the error", "relMSE on the circle"])
    measured = ("variance_at_rest", "relmse_at_rest", "flicker", "error_variance", "relmse")
    for direct in ("on", "off"):
        for name, text in DISTRIBUTIONS.items():
            flags = (*replaced(PUBLISHED, "--map-direct", direct), "--map-distribution", name)
            rest, circle = (_motion(context, flags, light, frames)["motion"] for light in ("still", "circle"))
            entry = {"distribution": name, "direct": direct, "variance_at_rest": rest["variance"], "relmse_at_rest": rest["relmse_mean"],
                     "flicker": circle["flicker"], "error_variance": circle["error_variance"], "relmse": circle["relmse_mean"]}
            table.data.append(entry)
            table.rows.append([f"{name}: {text}", SOURCE[direct]] + [figure(entry[key]) for key in measured])
    return table


def _answers(context):
    answers = {}
    for direct, name in (("on", "random"), ("on", "nets"), ("off", "nets")):
        flags = (*replaced(PUBLISHED, "--map-direct", direct), "--map-distribution", name)
        answers[f"{name}, direct light by {SOURCE[direct]}"] = _jump(context, flags)["response"]
    plots.answers(os.path.join(context.folder, "lag.png"), answers)
    return Picture("lag.png", "The lamp jumps in frame 0; 2,000 paths, 100 a frame. Grey: k per-frame/total, and the 95 % that "
                              "lag is told by", plot=True)


def _moments(context):
    """The box at four moments, above their truths."""
    folder = os.path.join(context.folder, "moments")
    os.makedirs(folder)
    context.programs.photon_map(*BOX, "--size", "192x144", *PUBLISHED, "--map-distribution", "random", "--repeats", "0",
                                "--light", "circle", "--frames", "4", "--every", "25", "--pictures", folder)
    frames, truths = ([pictures.read(path) for path in sorted(glob.glob(os.path.join(folder, name + "_*.exr")))]
                      for name in ("frame", "truth"))
    exposure = pictures.good_exposure(truths[0])
    rows = [[pictures.shown(picture, exposure) for picture in row] for row in (frames, truths)]
    pictures.write(os.path.join(context.folder, "moments.png"), pictures.sheet(rows))
    return Picture("moments.png", "The box at four moments of the lamp's circle, 2,000 paths, 100 a frame, all light by photons (as his "
                                  "Figure 28, but at each pixel); below them the truth of the moment")

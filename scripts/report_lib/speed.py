"""Section: error over time, for each scene and method, and pictures at equal time."""
import os
import re

from report_lib import pictures, plots
from report_lib.measure import can_tell, measure, net
from report_lib.programs import Job
from report_lib.scenes import TARGETS
from report_lib.section import Picture, Section
from report_lib.seconds_to_error import WANTED, has_met_all, targets_table
from report_lib.tables import Table, figure, percent, signed_percents

INSTANT, SINGLE, PAPER, TRACER = "instant radiosity", "instant radiosity, 1x1", "the paper's pipeline", "path tracer"
BOTH_ENDS, BOTH_ENDS_SINGLE = "bidirectional", "bidirectional, 1x1"
METHODS = {INSTANT: ("--method", "instant-radiosity"), SINGLE: ("--interleave", "1x1"), BOTH_ENDS: ("--method", "bidirectional"),
           BOTH_ENDS_SINGLE: ("--method", "bidirectional", "--interleave", "1x1"), PAPER: ("--preset", "paper"),
           TRACER: ("--method", "path-trace")}
UNBIASED = set(METHODS) - {PAPER}
HEAD = ["scene", "method", "budget [s]", "time [s]", "frames", "Mrays", "RMSE %", "less noise", "relMSE", "less noise",
        "trimmed", "less noise", "bias R G B [%]", "SSIM", "error as stated", "reference's error"]
TEXT = [
    "Each line is a run of its own (--seconds), with its own seed, on all cores of the machine; time is from the first "
    "task sent out to the last frame complete. All figures are ninefold-compare's. The reference has noise of its own, "
    "which adds to each of them; 'less noise' has it taken off: RMSE'^2 = RMSE^2 - noise^2 and relMSE' = relMSE - noise, "
    "which has the right mean because reference and picture are independent ('-': too little is left to be measured). "
    "The noise is found by holding two halves of the reference against each other. Plots and seconds to error use 'less noise'.",
    "Trimmed: without the 0.1 % of pixels that differ most. Where a lamp is small and bright, a few pixels' paths to it over "
    "mirrors and glass decide the other figures, for every method.",
    "Instant radiosity, 1x1 (--interleave 1x1): all pixels of a frame share one light set, which a picture at rest hardly "
    "minds and a small one, whose frames are mostly the making of light sets, gains by.",
    "Bidirectional (--method bidirectional) looks for virtual lights from the lamps and from the camera. A light set costs it "
    "about ten times as much, so that 1x1, one set a frame, gains it most where the picture is small.",
    "The paper's pipeline (--preset paper) has known bias: four diffuse vertices at most, a filter and a photon radius that "
    "stay, a bound that loses energy, no anti-aliasing.",
    "Other methods of the program stand under the names of --method, with its defaults. They may have a bias that stays (--help tells it), "
    "so that nothing is extrapolated for them."]


def run(context):
    section = Section("speed", "Error over time", list(TEXT))
    table = Table("speed", HEAD)
    references = {}
    variants = with_all_methods(context.programs.methods())
    for scene in context.scenes:
        references[scene.name] = context.references.get(scene, scene.size(context.options.width))
        for method, flags in variants.items():
            table.data += _series(context, scene, method, flags, references[scene.name])
        section.pictures += _sheets(context, scene, variants, references[scene.name])
    table.rows = [_row(entry) for entry in table.data]
    section.tables += [targets_table(table.data, references, unbiased=UNBIASED), table]
    section.pictures[:0] = _plots(context, table.data, references)
    return section


def with_all_methods(names):
    """{variant: flags}: those above, and each method of the program that none of them is of, by its name."""
    covered = {word for flags in METHODS.values() for word in flags}
    return {**METHODS, **{name: ("--method", name) for name in names if name not in covered}}


def _series(context, scene, method, flags, reference):
    entries = [_measure(context, scene, method, flags, budget, reference) for budget in context.options.budgets]
    if scene.name in TARGETS and method in UNBIASED:
        budget = 2 * max(context.options.budgets)
        within_reach = [wanted for wanted in WANTED if can_tell(reference, wanted[0], wanted[2])]
        while budget <= context.options.target_seconds and not has_met_all(entries, within_reach):
            entries.append(_measure(context, scene, method, flags, budget, reference))
            budget *= 2
    return entries


def _path(context, scene, method, budget):
    return os.path.join(context.folder, "runs", f"{scene.name}_{re.sub('[^a-z0-9]+', '-', method)}_{budget:g}s.exr")


def _measure(context, scene, method, flags, budget, reference):
    job = Job(scene, scene.size(context.options.width), flags)
    seed = 1 + round(1000 * budget)
    made = measure(context, job, seed, ("--seconds", budget), reference, _path(context, scene, method, budget))
    return {"scene": scene.name, "method": method, "budget": budget, **made}


def _row(e):
    return [e["scene"], e["method"], figure(e["budget"]), figure(e["seconds"]), str(e["frames"]),
            figure(e["rays"] / 1e6), figure(e["rmse_percent"]), figure(net(e, "rmse_percent")), figure(e["relmse"]),
            figure(net(e, "relmse")), figure(e["relmse_trimmed"]), figure(net(e, "relmse_trimmed")),
            signed_percents([e["bias_r"], e["bias_g"], e["bias_b"]]), figure(e["ssim"]), percent(e["error_stated"]),
            percent(e["reference_error"])]


def _plots(context, data, references):
    shown = []
    for key, label, slope in (("rmse_percent", "RMSE %", -0.5), ("relmse", "relMSE", -1),
                              ("relmse_trimmed", "relMSE, trimmed", -1)):
        series = {}
        for e in data:
            points = series.setdefault(e["scene"], {}).setdefault(e["method"], [])
            if net(e, key) is not None:
                points.append((e["seconds"], net(e, key)))
        name = key + ".png"
        plots.error_over_time(os.path.join(context.folder, name), series, label, slope,
                              {scene: reference.noise[key] for scene, reference in references.items()})
        shown.append(Picture(name, f"{label} over time, the reference's noise taken off", plot=True))
    return shown


def _sheets(context, scene, methods, reference):
    shown = []
    truth = pictures.read(reference.picture)
    for budget in dict.fromkeys((min(context.options.budgets), max(context.options.budgets))):
        made = [pictures.read(_path(context, scene, method, budget)) for method in methods]
        name = f"{scene.name}_{budget:g}s.png"
        pictures.write(os.path.join(context.folder, name), pictures.beside_reference(truth, made))
        shown.append(Picture(name, f"{scene.name} after {budget:g} s: reference, {', '.join(methods)}; "
                                   "below them the signed error (full colour at 50 %)"))
    return shown

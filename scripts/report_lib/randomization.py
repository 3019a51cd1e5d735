"""Section: exclusive-or against Owen scrambling against plain pseudo-random points, at equal samples."""
from report_lib.measure import mean, repeated
from report_lib.programs import Job
from report_lib.section import Section
from report_lib.tables import Table, figure

KINDS = ("random", "xor", "owen")
CASES = {"instant radiosity, no filter": ("--filter", "none"), "instant radiosity": (),
         "path tracer": ("--method", "path-trace")}
HEAD = ["scene", "method", "frames"] + ["relMSE " + kind for kind in KINDS] + ["xor / random", "owen / random"]
TEXT = [
    "relMSE after the same number of frames, hence of samples: means over several seeds with their standard error, the "
    "reference's noise taken off. Frames are independent, so that the squared error falls as 1/samples: the quotients are "
    "also the share of samples that a kind needs for the error that random points reach, but for what bias all three have. "
    "Wald and others (2002) say about 30 % less work than stratified sampling; random points here are not even stratified. "
    "The path tracer has 4 paths a pixel and frame; over frames its points are one sequence."]


def run(context):
    section = Section("randomization", "XOR, Owen, random", list(TEXT))
    table = Table("randomization", HEAD)
    for scene in context.few_scenes:
        reference = context.references.get(scene, scene.size(context.options.width))
        for case in CASES:
            for frames in context.options.frames:
                _add(context, scene, reference, case, frames, table)
    section.tables.append(table)
    return section


def _add(context, scene, reference, case, frames, table):
    entry = {"scene": scene.name, "method": case, "frames": frames, "seeds": context.options.seeds}
    for kind in KINDS:
        job = Job(scene, scene.size(context.options.width), CASES[case] + ("--randomization", kind))
        name = f"{scene.name}_{list(CASES).index(case)}_{frames}_{kind}"
        made = repeated(context, job, ("--frames", frames), reference, name)
        value, error = mean(made, "relmse")
        entry["relmse_" + kind], entry["error_" + kind] = value - reference.noise["relmse"], error
    quotients = [_quotient(entry, kind) for kind in KINDS[1:]]
    for kind, (value, error) in zip(KINDS[1:], quotients):
        entry[f"{kind}_over_random"], entry[f"{kind}_over_random_error"] = value, error
    table.data.append(entry)
    table.rows.append([scene.name, case, str(frames)]
                      + [f"{figure(entry['relmse_' + kind])} ± {figure(entry['error_' + kind], 2)}" for kind in KINDS]
                      + [f"{value:.2f} ± {error:.2f}" for value, error in quotients])


def _quotient(entry, kind):
    """relMSE of a kind over that of random points, and its standard error."""
    a, b = entry["relmse_" + kind], entry["relmse_random"]
    if a <= 0 or b <= 0:
        return float("nan"), float("nan")
    return a / b, a / b * ((entry["error_" + kind] / a) ** 2 + (entry["error_random"] / b) ** 2) ** 0.5

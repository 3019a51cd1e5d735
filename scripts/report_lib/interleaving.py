"""Section: 1x1, 3x3 and 5x5 interleaving at equal time, with and without the filter: Figure 3 of Wald and others
(2002) as numbers and pictures."""
import os

from report_lib import pictures
from report_lib.measure import mean, path, repeated
from report_lib.programs import Job
from report_lib.section import Picture, Section
from report_lib.tables import Table, figure

PATTERNS = ("1x1", "3x3", "5x5")
FILTERS = ("none", "surface")
HEAD = ["scene", "run", "pattern", "filter", "time [s]", "frames", "Mrays", "RMSE %", "relMSE", "SSIM"]
TEXT = [
    "The same number of lights in each set, and as many sets side by side as the pattern has places. Without the filter a "
    "pixel's error is that of one set whatever the pattern, only its structure changes: with 1x1 all pixels share one set, "
    "shadows of single lights have hard edges; the others spread the error over neighbours, which the filter then averages. "
    "Runs of one frame, and runs of equal time at rest, where the pattern rotates and the film averages. Means over "
    "several seeds with the standard error of relMSE; the reference's noise is taken off.",
    "Pictures of one seed, of one frame and then of the longest run: reference; 1x1, 3x3, 5x5 without the filter; with it; "
    "below them the signed error, full colour at 50 %."]


def run(context):
    section = Section("interleaving", "Interleaving and the filter", list(TEXT))
    table = Table("interleaving", HEAD)
    for scene in context.few_scenes:
        reference = context.references.get(scene, scene.size(context.options.width))
        stops = [("--frames", 1)] + [("--seconds", budget) for budget in context.options.short_budgets]
        for stop in stops:
            for pattern in PATTERNS:
                for kind in FILTERS:
                    _add(context, scene, reference, stop, pattern, kind, table)
        for stop in (stops[0], stops[-1]):
            section.pictures.append(_sheet(context, scene, reference, stop))
    section.tables.append(table)
    return section


def _name(scene, stop, pattern, kind):
    return f"{scene.name}_{pattern}_{kind}{stop[0]}{stop[1]:g}"


def _run_text(stop):
    return "1 frame" if stop[0] == "--frames" else f"{stop[1]:g} s"


def _add(context, scene, reference, stop, pattern, kind, table):
    job = Job(scene, scene.size(context.options.width), ("--interleave", pattern, "--filter", kind))
    made = repeated(context, job, stop, reference, _name(scene, stop, pattern, kind))
    for entry in made:
        table.data.append({"scene": scene.name, "run": _run_text(stop), "pattern": pattern, "filter": kind, **entry})
    relmse, error = mean(made, "relmse")
    noise = reference.noise["relmse"]
    squared = sum(entry["rmse_percent"] ** 2 for entry in made) / len(made) - reference.noise["rmse_percent"] ** 2
    table.rows.append([scene.name, _run_text(stop), pattern, kind, figure(mean(made, "seconds")[0]),
                       figure(mean(made, "frames")[0]), figure(mean(made, "rays")[0] / 1e6),
                       figure(max(0.0, squared) ** 0.5), f"{figure(relmse - noise)} ± {figure(error, 2)}",
                       figure(mean(made, "ssim")[0])])


def _sheet(context, scene, reference, stop):
    truth = pictures.read(reference.picture)
    made = [pictures.read(path(context, _name(scene, stop, pattern, kind), 1)) for kind in FILTERS for pattern in PATTERNS]
    name = f"{scene.name}{stop[0]}{stop[1]:g}.png"
    pictures.write(os.path.join(context.folder, name), pictures.beside_reference(truth, made))
    return Picture(name, f"{scene.name}, {_run_text(stop)}: reference; {', '.join(PATTERNS)} without filter; "
                         f"{', '.join(PATTERNS)} with it")

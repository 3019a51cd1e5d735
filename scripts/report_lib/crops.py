"""Section: what is hard in each scene, seen close, at equal time beside the reference."""
import dataclasses
import os

from report_lib import pictures
from report_lib.measure import measure, path
from report_lib.programs import Job
from report_lib.section import Picture, Section
from report_lib.tables import Table, figure


@dataclasses.dataclass(frozen=True)
class Crop:
    """left, top, side: fractions of the picture's width and height, so that its shape is the picture's."""
    name: str
    left: float
    top: float
    side: float

    def of(self, pixels):
        height, width, _ = pixels.shape
        x, y = round(self.left * width), round(self.top * height)
        return pixels[y:y + round(self.side * height), x:x + round(self.side * width)]


CROPS = {
    "cornell": (Crop("corner", 0.64, 0.66, 0.24),),
    "table_room": (Crop("caustic", 0.48, 0.42, 0.2), Crop("chair", 0.68, 0.46, 0.2)),
    "egg_room": (Crop("caustic rim", 0.4, 0.48, 0.2), Crop("lamp", 0.1, 0.0, 0.16)),
    "invisible_date": (Crop("lamp", 0.84, 0.24, 0.16), Crop("glasses", 0.34, 0.58, 0.2)),
    "office": (Crop("blinds", 0.2, 0.16, 0.18), Crop("book spines", 0.45, 0.22, 0.18)),
    "conference": (Crop("chrome legs", 0.43, 0.8, 0.2), Crop("leaves", 0.0, 0.38, 0.18)),
    "u_office": (Crop("book spines", 0.01, 0.25, 0.22), Crop("leaves", 0.64, 0.41, 0.22)),
}
FILM, TOUCH, TRACER = "instant radiosity", "with the last touch", "path tracer"
METHODS = {FILM: ("--denoise", "off"), TOUCH: ("--denoise", "on"), TRACER: ("--method", "path-trace")}
LEAST_WIDTH = 240  # pixels that a crop is shown with, at least
HEAD = ["scene", "crop", "method", "budget [s]", "frames", "relMSE", "trimmed"]
TEXT = [
    "Parts of pictures of equal time (--seconds): the reference, the film's mean, the same with the last touch, which "
    "comes when the seconds are over, and the path tracer. relMSE is that of the crop; the reference's noise is in it. "
    "Pixels are shown as they are, each as a square."]


def run(context):
    section = Section("crops", "Seen close", list(TEXT))
    table = Table("crops", HEAD)
    for scene in context.scenes:
        if scene.name in CROPS:
            _add_scene(context, scene, section, table)
    table.rows = [[e["scene"], e["crop"], e["method"], figure(e["budget"]), str(e["frames"]), figure(e["relmse"]),
                   figure(e["relmse_trimmed"])] for e in table.data]
    section.tables.append(table)
    return section


def _add_scene(context, scene, section, table):
    size = scene.size(context.options.width)
    reference = context.references.get(scene, size)
    made = {(budget, method): _make(context, scene, budget, method, reference)
            for budget in context.options.short_budgets for method in METHODS}
    truth = pictures.read(reference.picture)
    for number, crop in enumerate(CROPS[scene.name]):
        stem = os.path.join(context.folder, f"{scene.name}_{number}")
        for (budget, method), (pixels, frames) in made.items():
            m = _compare(context, stem, crop.of(pixels), crop.of(truth))
            table.data.append({"scene": scene.name, "crop": crop.name, "method": method, "budget": budget,
                               "frames": frames, "relmse": m["relmse"], "relmse_trimmed": m["relmse_trimmed"]})
        section.pictures.append(_sheet(context, scene, crop, stem, truth, made))


def _make(context, scene, budget, method, reference):
    """The picture and its frames."""
    job = Job(scene, scene.size(context.options.width), METHODS[method])
    file = path(context, f"{scene.name}_{list(METHODS).index(method)}_{budget:g}s", 1)
    entry = measure(context, job, 1, ("--seconds", budget), reference, file)
    return pictures.read(file), entry["frames"]


def _compare(context, stem, picture, truth):
    names = stem + "_part.exr", stem + "_reference.exr"
    for name, pixels in zip(names, (picture, truth)):
        pictures.write(name, pixels)
    return context.programs.compare(*names)


def _sheet(context, scene, crop, stem, truth, made):
    """A row for each budget; each begins with the reference."""
    exposure = pictures.good_exposure(truth)
    rows = [[pictures.enlarged(pictures.shown(crop.of(pixels), exposure), LEAST_WIDTH)
             for pixels in [truth, *(made[budget, method][0] for method in METHODS)]]
            for budget in context.options.short_budgets]
    pictures.write(stem + ".png", pictures.sheet(rows))
    seconds = " and ".join(f"{budget:g} s" for budget in context.options.short_budgets)
    return Picture(os.path.basename(stem) + ".png",
                   f"{scene.name}, {crop.name}, after {seconds} (rows): reference, {', '.join(METHODS)}")

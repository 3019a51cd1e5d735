"""Section: what a person sees while the camera walks, a thing moves and a lamp is dimmed, by each method, against the truth of the
moment."""
import os

from report_lib import motion_run, motion_tables, motion_text, motion_truth, pictures, plots
from report_lib.motion_errors import ERRORS, on_screen
from report_lib.motion_scripts import COURSES, PHASES, SHOTS, script
from report_lib.programs import Job
from report_lib.section import Picture, Section


def run(context):
    section = Section("motion", "In motion", list(motion_text.TEXT))
    methods = context.programs.methods()
    made, floors, sheets = {}, {}, []
    for scene in context.scenes:
        if scene.name in COURSES:
            truth = motion_truth.get(context, scene, scene.size(context.options.width), SHOTS, context.options.truth_frames)
            floors[scene.name] = truth.noise
            made[scene.name] = _runs(context, scene, methods, truth)
            sheets.append(_sheet(context, scene, methods, truth))
    if made:
        phases, pace = motion_tables.phases(made), motion_tables.pace(made)
        section.tables += [phases, pace, motion_tables.moments(made)]
        section.text += motion_text.findings(phases.data, pace.data)
        section.pictures += _plots(context, made, floors) + sheets
    return section


def _pattern(context, scene, method, seed):
    return os.path.join(context.folder, "runs", f"{scene.name}_{method}_{seed}", "shot.####.exr")


def _file(pattern, number):
    return pattern.replace("####", f"{number:04d}")


def _runs(context, scene, methods, truth):
    """{method: [Run, one a seed]}. Methods take turns, so that what else the machine does is much the same for all."""
    runs = {method: [] for method in methods}
    for seed in range(1, context.options.seeds + 1):
        for method in methods:
            runs[method].append(_run(context, scene, method, seed, truth))
    return runs


def _run(context, scene, method, seed, truth):
    job = Job(scene, scene.size(context.options.width), ("--method", method))
    pattern = _pattern(context, scene, method, seed)
    times = context.programs.play(job, seed, script(COURSES[scene.name], shots=SHOTS), pattern)
    load = os.getloadavg()[0]
    files = {shot["shot"]: _file(pattern, shot["shot"]) for shot in times["shots"] if not shot["lost"]}
    return motion_run.Run(times, {number: pictures.read(file) for number, file in files.items()}, truth, load)


def _plots(context, made, floors):
    shown = []
    for number, (key, label) in enumerate(ERRORS.items()):
        noise = {scene: [(i / SHOTS, errors[number]) for i, errors in enumerate(series)] for scene, series in floors.items()}
        plots.error_in_motion(os.path.join(context.folder, key + ".png"), motion_tables.over_time(made, "net_" + key), label, PHASES, noise)
        shown.append(Picture(key + ".png", f"{label} of what is on the screen, median of the runs, the truth's noise taken off", plot=True))
    return shown


def _sheet(context, scene, methods, truth):
    """A row for each method, the truth above: the pictures of the first run at each moment, and the signed error of the last."""
    numbers = [round(moment * SHOTS) for moment in motion_tables.MOMENTS]
    exposure = pictures.good_exposure(truth.pictures[0])
    rows = [[pictures.shown(truth.pictures[i], exposure) for i in numbers] + [None]]
    for method in methods:
        seen = [_seen(_pattern(context, scene, method, 1), i, truth) for i in numbers]
        error = None if seen[-1] is None else pictures.signed_error(seen[-1], truth.pictures[numbers[-1]], 0.5)
        rows.append([None if picture is None else pictures.shown(picture, exposure) for picture in seen] + [error])
    name = scene.name + ".png"
    pictures.write(os.path.join(context.folder, name), pictures.sheet(rows))
    moments = ", ".join(f"{moment:g} s" for moment in motion_tables.MOMENTS)
    return Picture(name, f"{scene.name} at {moments}, and the last one's signed error (full colour at 50 %): the truth, {', '.join(methods)}")


def _seen(pattern, number, truth):
    """None of a shot that is lost."""
    file = _file(pattern, number)
    return on_screen(pictures.read(file), *truth.pictures[number].shape[:2]) if os.path.exists(file) else None

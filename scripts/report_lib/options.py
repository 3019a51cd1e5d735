"""The command line of scripts/report."""
import argparse
import os

from report_lib import motion_scripts, scenes

SECTIONS = ("agreement", "speed", "motion", "bidirectional", "photon-map", "selective-photons", "intersection-field", "crops", "interleaving", "randomization",
            "needs")

FULL = dict(budgets="0.5,1,2,4,8,16", short_budgets="1,4", target_seconds=128, reference_seconds=300, runs=8,
            run_seconds=10, seeds=8, frames="1,16", rounds=10, truth_frames=128,
            few="table_room,office")
QUICK = dict(budgets="0.5,1,2", short_budgets="1", target_seconds=2, reference_seconds=10, runs=4, run_seconds=3, seeds=2,
             frames="4", rounds=0, truth_frames=32, few="table_room", scenes="cornell,table_room,egg_room")

DESCRIPTION = """How wrong pictures are after how many seconds, for each scene and method, held against
references by the path tracer, or by the bidirectional method where that hardly finds the light: writes report.html, which opens from disk, and a .csv for each table. References are made once and kept in
out/references; a section that was run before stays in the page until it is run again. The full report takes about two
hours and a half on two cores the first time, nearly half of it for references (5 minutes a scene at most)."""


def parse(words):
    parser = argparse.ArgumentParser(prog="scripts/report", description=DESCRIPTION)
    parser.add_argument("--quick", action="store_true",
                        help="three scenes and short runs: about 10 minutes on two cores; figures are rough")
    parser.add_argument("--sections", default=",".join(SECTIONS),
                        help=f"which to run, of {', '.join(SECTIONS)}; 'none': only write the page again")
    parser.add_argument("--scenes", help="names; default: all that are there")
    parser.add_argument("--few", help="scenes of the sections interleaving and randomization (default table_room,office)")
    parser.add_argument("--folder", default="",
                        help=f"where scenes that are not shipped lie: {', '.join(s[1] for s in scenes.ELSEWHERE)}")
    parser.add_argument("--width", type=int, default=160, help="pixels a row; 4:3, or 7/8 of it square (default 160)")
    parser.add_argument("--budgets", help="seconds of each run of the section speed (default 0.5,1,2,...16)")
    parser.add_argument("--target-seconds", type=float,
                        help=f"how long runs of {', '.join(scenes.TARGETS)} get at most for the smallest errors (default 128)")
    parser.add_argument("--short-budgets", help="seconds of each run of the sections interleaving, crops and bidirectional (default 1,4)")
    parser.add_argument("--runs", type=int, help="runs a scene of the section agreement, at least 2 (default 8)")
    parser.add_argument("--run-seconds", type=float, help="of each of them (default 10)")
    parser.add_argument("--seeds", type=int, help="runs of each kind in the sections motion, interleaving and randomization, at least 2 (default 8)")
    parser.add_argument("--frames", help="frames of each run of the section randomization (default 1,16)")
    parser.add_argument("--truth-frames", type=int,
                        help=f"frames of each picture that the section motion (of {', '.join(motion_scripts.COURSES)}) takes for true, "
                             "twice (default 128)")
    parser.add_argument("--rounds", type=int, help="of timing what unused features cost; 0: do not (default 10)")
    parser.add_argument("--reference-seconds", type=float, help="time for each reference (default 300)")
    parser.add_argument("--reference-error", type=float, default=0.001,
                        help="relative standard error of the image's mean at which a reference is good enough (default 0.001)")
    parser.add_argument("--clients", type=int, default=os.cpu_count(), help="local clients (default: one a core)")
    parser.add_argument("--programs", default=os.path.join(scenes.ROOT, "build/bin"), help="folder (default build/bin)")
    parser.add_argument("--out", help="folder (default out/report, with --quick out/report_quick)")
    parser.add_argument("--references", default=os.path.join(scenes.ROOT, "out/references"), help="folder (default out/references)")
    parser.add_argument("--keep", metavar="FOLDER", help="also write the report as Markdown with small pictures, for docs/report")
    options = parser.parse_args(words)
    _fill_in(parser, options)
    return options


def _fill_in(parser, options):
    for name, value in (QUICK if options.quick else FULL).items():
        if getattr(options, name) is None:
            setattr(options, name, value)
    options.out = options.out or os.path.join(scenes.ROOT, "out/report_quick" if options.quick else "out/report")
    options.sections = [] if options.sections == "none" else options.sections.split(",")
    for name in options.sections:
        if name not in SECTIONS:
            parser.error(f"--sections {name}: must be of {', '.join(SECTIONS)}")
    try:
        options.budgets = [float(x) for x in options.budgets.split(",")]
        options.short_budgets = [float(x) for x in options.short_budgets.split(",")]
        options.frames = [int(x) for x in options.frames.split(",")]
    except ValueError as error:
        parser.error(f"--budgets, --short-budgets, --frames: {error}")
    if options.runs < 2 or options.seeds < 2:
        parser.error("--runs and --seeds: at least 2, or there is no standard error")
    try:
        options.scenes = scenes.chosen((options.scenes or "").split(",") if options.scenes else [], options.folder)
        options.few = scenes.chosen(options.few.split(","), options.folder)
    except KeyError as error:
        parser.error(f"no scene {error}; there are {', '.join(s.name for s in scenes.known(options.folder))}")

"""Tables of the section motion. made: {scene: {method: [Run, one a seed]}}."""
import numpy

from report_lib.motion_errors import ERRORS, of_phase
from report_lib.motion_scripts import AFTER_OBJECT, OBJECT, PHASES
from report_lib.tables import Table, figure

MOMENTS = (2, 4.8, 7)  # of the pictures: in the midst of walk, object and lamp [s]
PACE = {"frames_a_second": "frames/s in motion", "width": "width", "took": "frame [ms]", "latency_p50": "latency p50 [ms]",
        "latency_p95": "p95 [ms]", "age": "age on the screen [ms]", "load": "load"}
FLICKER = {"flicker_object": (OBJECT, "flicker, object moves"), "flicker_rest": (AFTER_OBJECT, "flicker after it")}


def over_runs(values):
    """Mean and standard error of those that have a value; None where there are too few."""
    there = [value for value in values if value is not None]
    error = float(numpy.std(there, ddof=1) / len(there) ** 0.5) if len(there) > 1 else None
    return (float(numpy.mean(there)) if there else None), error


def with_error(mean, error, digits=2):
    return figure(mean, digits) + (f" ± {figure(error, 1)}" if error is not None else "")


def over_time(made, key):
    """{scene: {method: [(seconds, mean of the runs)]}}."""
    return {scene: {method: _mean_series(runs, key) for method, runs in methods.items()} for scene, methods in made.items()}


def _mean_series(runs, key):
    by_time = {}
    for run in runs:
        for time, value in run.column(key):
            by_time.setdefault(time, []).append(value)
    return sorted((time, float(numpy.mean(values))) for time, values in by_time.items())


def phases(made):
    methods = list(next(iter(made.values())))
    table = Table("motion", ["scene", "phase", *(f"{method}: relMSE (trimmed)" for method in methods)])
    for scene, of_methods in made.items():
        for phase in PHASES:
            entries = [_phase_entry(scene, phase, method, runs) for method, runs in of_methods.items()]
            table.data += entries
            table.rows.append([scene, phase.name, *(f"{with_error(e['relmse'], e['relmse_error'])} ({figure(e['trimmed'], 2)})"
                                                    for e in entries)])
    return table


def _phase_entry(scene, phase, method, runs):
    entry = {"scene": scene, "phase": phase.name, "moves": phase.moves, "method": method, "runs": len(runs)}
    for key in ERRORS:
        entry[key], entry[key + "_error"] = over_runs([of_phase(run.column("net_" + key), phase) for run in runs])
    for key in ("flicker", "age"):
        entry[key], _ = over_runs([of_phase(run.column(key), phase) for run in runs])
    return entry


def pace(made):
    table = Table("motion_pace", ["scene", "method", *PACE.values(), "delay of the lamp [ms]", *(text for _, text in FLICKER.values()),
                                  "shots lost"])
    for scene, methods in made.items():
        for method, runs in methods.items():
            entry = {"scene": scene, "method": method, **{key: over_runs([run.pace[key] for run in runs])[0] for key in PACE}}
            entry["delay"], entry["delay_error"] = over_runs([run.pace["delay"] for run in runs])
            for key, (phase, _) in FLICKER.items():
                entry[key], _ = over_runs([of_phase(run.column("flicker"), phase) for run in runs])
            entry["lost"] = sum(run.lost for run in runs)
            table.data.append(entry)
            table.rows.append([scene, method, *(figure(entry[key]) for key in PACE), with_error(entry["delay"], entry["delay_error"]),
                               *(figure(entry[key], 2) for key in FLICKER), str(entry["lost"])])
    return table


def moments(made):
    """Rows: the moments of the pictures; data: all of them."""
    table = Table("motion_over_time", ["scene", "method", *(f"{label} at {m:g} s" for label in ERRORS.values() for m in MOMENTS)])
    series = {key: over_time(made, "net_" + key) for key in ERRORS}
    for scene, methods in made.items():
        for method in methods:
            at = {key: dict(series[key][scene][method]) for key in ERRORS}
            table.data += [{"scene": scene, "method": method, "time": time, **{key: at[key][time] for key in ERRORS}}
                           for time in at[next(iter(ERRORS))]]
            table.rows.append([scene, method, *(figure(at[key].get(m), 2) for key in ERRORS for m in MOMENTS)])
    return table

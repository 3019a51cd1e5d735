"""Tables of the section motion. made: {scene: {method: [Run, one a seed]}}. Of several runs the median counts: where the machine
belonged to others for a second or two, a run's frames were a few pixels wide, and a mean would tell of that alone."""
import statistics

from report_lib.motion_errors import ERRORS, of_phase
from report_lib.motion_scripts import AFTER_OBJECT, OBJECT, PHASES
from report_lib.tables import Table, figure

MOMENTS = (2, 4.8, 7)  # of the pictures: in the midst of walk, object and lamp [s]
PACE = {"frames_a_second": "frames/s in motion", "width": "width", "took": "frame [ms]", "latency_p50": "latency p50 [ms]",
        "latency_p95": "p95 [ms]", "age": "age on the screen [ms]", "load": "load"}
FLICKER = {"flicker_object": (OBJECT, "flicker, object moves"), "flicker_rest": (AFTER_OBJECT, "flicker after it")}


def of_runs(name, values):
    """Median, least and largest of those that have a value, as entries of a row; None if none has."""
    there = [value for value in values if value is not None] or [None]
    if there == [None]:
        return {name: None, name + "_least": None, name + "_largest": None}
    return {name: statistics.median(there), name + "_least": min(there), name + "_largest": max(there)}


def with_range(entry, name):
    return f"{figure(entry[name], 2)} ({figure(entry[name + '_least'], 2)} to {figure(entry[name + '_largest'], 2)})"


def over_time(made, key):
    """{scene: {method: [(seconds, median of the runs)]}}."""
    return {scene: {method: _mean_series(runs, key) for method, runs in methods.items()} for scene, methods in made.items()}


def _mean_series(runs, key):
    by_time = {}
    for run in runs:
        for time, value in run.column(key):
            by_time.setdefault(time, []).append(value)
    return sorted((time, statistics.median(values)) for time, values in by_time.items())


def phases(made):
    methods = list(next(iter(made.values())))
    table = Table("motion", ["scene", "phase", *(f"{method}: relMSE" for method in methods), *(f"{method}: trimmed" for method in methods)])
    for scene, of_methods in made.items():
        for phase in PHASES:
            entries = [_phase_entry(scene, phase, method, runs) for method, runs in of_methods.items()]
            table.data += entries
            table.rows.append([scene, phase.name, *(with_range(entry, key) for key in ERRORS for entry in entries)])
    return table


def _phase_entry(scene, phase, method, runs):
    entry = {"scene": scene, "phase": phase.name, "moves": phase.moves, "method": method, "runs": len(runs)}
    for name, key in [*((name, "net_" + name) for name in ERRORS), ("flicker", "flicker"), ("age", "age")]:
        entry |= of_runs(name, [of_phase(run.column(key), phase) for run in runs])
    return entry


def pace(made):
    table = Table("motion_pace", ["scene", "method", *PACE.values(), "delay of the lamp [ms]", *(text for _, text in FLICKER.values()),
                                  "shots lost"])
    for scene, methods in made.items():
        for method, runs in methods.items():
            entry = {"scene": scene, "method": method, "lost": sum(run.lost for run in runs)}
            for key in (*PACE, "delay"):
                entry |= of_runs(key, [run.pace[key] for run in runs])
            for key, (phase, _) in FLICKER.items():
                entry |= of_runs(key, [of_phase(run.column("flicker"), phase) for run in runs])
            table.data.append(entry)
            table.rows.append([scene, method, *(figure(entry[key]) for key in PACE), with_range(entry, "delay"),
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

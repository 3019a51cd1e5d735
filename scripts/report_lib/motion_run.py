"""One session in real time, measured: each shot against the truth of its moment. Pure."""
import statistics

import numpy

from report_lib import motion_errors, pictures
from report_lib.motion_errors import ERRORS
from report_lib.motion_scripts import LAMP, PHASES, REST, SECONDS, SHOTS


class Run:
    """times: the object of --stats (docs/script.md); shown: {shot's number: picture}; truth: motion_truth.Truth;
    load: the machine's load average of the minute."""

    def __init__(self, times, shown, truth, load):
        self.shots = measured(times["shots"], shown, truth)
        self.lost = sum(shot["lost"] for shot in times["shots"])
        moving = [frame for frame in times["frames"] if frame["moving"]]
        seconds = sum(phase.end - phase.begin for phase in PHASES if phase.moves)
        self.pace = {"frames_a_second": len(moving) / seconds, "latency_p50": times["latency_ms"]["p50"],
                     "latency_p95": times["latency_ms"]["p95"], "width": _median(moving, "width"), "took": _median(moving, "took_ms"),
                     "age": self._age(), "delay": self._delay(), "load": load}

    def column(self, key):
        return [(entry["time"], entry[key]) for entry in self.shots]

    def _age(self):
        """Of what is on the screen while something moves [ms]."""
        ages = [1000 * age for time, age in self.column("age") if any(phase.moves and phase.has(time) for phase in PHASES)]
        return float(numpy.mean(ages)) if ages else None

    def _delay(self):
        """Of the lamp [ms]; needs all shots."""
        return None if self.lost else 1000 * motion_errors.delay(self.column("mean"), self.column("true_mean"), LAMP, SECONDS, REST)


def _median(entries, key):
    return statistics.median(entry[key] for entry in entries) if entries else None


def measured(shots, shown, truth):
    """What each shot is of and how wrong it is; those that are lost are left out. Shot i is due at i/SHOTS, as truth i is."""
    entries = []
    for shot in shots:
        i = shot["shot"]
        if i not in shown:
            continue
        true = truth.pictures[i]
        picture = motion_errors.on_screen(shown[i], *true.shape[:2])
        entry = {"shot": i, "time": i / SHOTS, "age": i / SHOTS - shot["opened"], "frames": shot["frames"], "flicker": None,
                 "mean": float(pictures.luminance(picture).mean()), "true_mean": float(pictures.luminance(true).mean())}
        for key, error, noise in zip(ERRORS, motion_errors.errors(picture, true), truth.noise[i]):
            entry.update({key: error, "net_" + key: error - noise})
        if i - 1 in shown:
            before = motion_errors.on_screen(shown[i - 1], *true.shape[:2])
            entry["flicker"] = motion_errors.flicker(before, picture, truth.pictures[i - 1], true)
        entries.append(entry)
    return entries

"""What the section motion says: how it is measured, and what its figures tell."""
import math

from report_lib.tables import figure

TEXT = [
    "A script in real time (docs/script.md), on the local clients of this machine: the camera walks, a thing moves and rests, a lamp is "
    "dimmed to a quarter and rests. Ten times a second the picture that is on the screen is kept as radiance, whatever frame it is of, and "
    "held against the truth of that moment: so what comes late is wrong. Each run has a seed of its own. Smaller frames are "
    "enlarged as the window does it. Pictures have no last touch and no tone map. Methods take turns; load: that of the machine, whose "
    "own part is about its number of cores. Where it is more, others took time, and frames in motion became smaller: hence medians.",
    "Truth: the same script as stills of many frames by instant radiosity, two series of unlike seeds. Their noise, which adds to each "
    "error, is taken off in tables and plots (scripts/report_lib/motion_errors.py). In motion frames look through the middle of each pixel "
    "while the truth's edges are smooth: all methods are charged for that alike.",
    "relMSE: mean of the shots of each phase, median of the runs (least to largest). Trimmed: without the 0.1 % of pixels "
    "that differ most. Those are the edges of lamps, hundreds of times as bright as the wall beside them: one pixel late, or enlarged, they "
    "outweigh all others. 'At rest' includes the first pictures; 'after' begins while the program still takes the scene as moving (250 ms).",
    "Age: how old what is on the screen is. Delay of the lamp: by how much the picture's mean brightness is behind the truth's, from the "
    "begin of the dimming to the end, whatever constant part is too bright or too dark: latency, and what a method remembers. "
    "Flicker: of pixels whose truth rests, squared step from shot to shot, halved, weighed as relMSE is, so that noise that is new in each "
    "shot has as much of it as of relMSE; what comes after the object includes the step to rest."]
ALIKE = 1.15  # times as much is no difference worth a word


def findings(phases, pace):
    """A paragraph for each scene, and one for all. phases, pace: data of the tables."""
    scenes = dict.fromkeys(e["scene"] for e in phases)
    lines = [f"{scene}, trimmed. " + _of_scene([e for e in phases if e["scene"] == scene], [e for e in pace if e["scene"] == scene])
             for scene in scenes]
    return lines + [line for line in [_overall(phases)] if line]


def _of_scene(phases, pace):
    last = phases[-1]["phase"]
    told = dict.fromkeys(e["phase"] for e in phases if e["moves"] or e["phase"] == last)
    lines = [_ranking(phase, [e for e in phases if e["phase"] == phase]) for phase in told]
    return " ".join(line for line in lines + [_lateness(pace)] if line)


def _ranking(phase, entries):
    """'Walk: a has the least error (0.01), b 1.5 times as much.'"""
    told = sorted((e["trimmed"], e["method"]) for e in entries if e["trimmed"] is not None and e["trimmed"] > 0)
    if len(told) < 2:
        return ""
    least, best = told[0]
    others = [f"{method} {_times(error / least)}" for error, method in told[1:]]
    return f"{phase[0].upper()}{phase[1:]}: {best} has the least error ({figure(least, 2)}), {', '.join(others)}."


def _times(ratio):
    return "about as much" if ratio < ALIKE else f"{figure(ratio, 2)} times as much"


def _lateness(pace):
    told = sorted((e["delay"], e["method"]) for e in pace if e["delay"] is not None)
    return "The lamp is seen " + ", ".join(f"{figure(delay, 2)} ms late by {method}" for delay, method in told) + "." if told else ""


def _overall(phases):
    """Geometric means over scenes and the phases in which something moves."""
    logs = {}
    for e in phases:
        if e["moves"] and e["trimmed"] is not None and e["trimmed"] > 0:
            logs.setdefault(e["method"], []).append(math.log(e["trimmed"]))
    if not logs or len({len(values) for values in logs.values()}) > 1:
        return ""
    told = sorted((math.exp(sum(values) / len(values)), method) for method, values in logs.items())
    text = ", ".join(f"{method} {figure(error, 2)}" for error, method in told)
    return f"While something moves, trimmed, geometric mean of phases and scenes: {text}."

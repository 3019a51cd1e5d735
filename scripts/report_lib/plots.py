"""Plots: error over time, one small log-log plot for each scene; error while things move; virtual lights from above; times of
stages; what is there of a change; bias."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plot  # noqa: E402  the backend comes first
from matplotlib.ticker import NullFormatter  # noqa: E402

from report_lib import pictures  # noqa: E402

COLOURS = ("#1f4e9c", "#c0392b", "#2e8b57", "#8e44ad", "#d68910", "#5d6d7e", "#17a2b8", "#7d5a3c", "#d63384", "#7cb518")


def error_over_time(path, series, label, slope, floors):
    """series: {scene: {method: [(seconds, error)]}}. A grey guide falls with `slope`; dotted: the reference's noise."""
    columns = min(3, len(series))
    rows = math.ceil(len(series) / columns)
    figure, axes = plot.subplots(rows, columns, figsize=(3.6 * columns, 2.9 * rows), squeeze=False,
                                 layout="constrained")
    for axis in axes.flat[len(series):]:
        axis.set_visible(False)
    for axis, (scene, methods) in zip(axes.flat, series.items()):
        _one_scene(axis, scene, methods, label, slope, floors[scene])
    axes.flat[0].legend(fontsize=7)
    _finish(figure, path)


def _one_scene(axis, scene, methods, label, slope, floor):
    for colour, (method, points) in zip(COLOURS, methods.items()):
        seen = [(t, e) for t, e in points if t > 0 and e > 0]
        if seen:
            axis.plot(*zip(*seen), "o-", color=colour, markersize=3, linewidth=1, label=method)
    every = [point for points in methods.values() for point in points if point[0] > 0 and point[1] > 0]
    if every:
        begin, end = min(t for t, _ in every), max(t for t, _ in every)
        top = max(e for t, e in every)
        axis.plot([begin, end], [top, top * (end / begin) ** slope], color="0.7", linewidth=1,
                  label=f"slope {slope:g}")
    if floor > 0:
        axis.axhline(floor, color="0.4", linewidth=0.8, linestyle=":", label="reference's noise")
    axis.set(xscale="log", yscale="log", title=scene, xlabel="seconds", ylabel=label)
    axis.title.set_fontsize(9)
    axis.tick_params(labelsize=7, which="both")
    for scale in (axis.xaxis, axis.yaxis):
        scale.set_major_formatter("{x:g}")
        low, high = scale.get_view_interval()
        scale.set_minor_formatter("{x:g}" if high < 10 * low else NullFormatter())
    axis.grid(True, which="major", color="0.92")


def error_in_motion(path, series, label, phases, floors):
    """series: {scene: {method: [(seconds, error)]}}; grey: phases in which something moves; floors: {scene: [(seconds, noise)]}."""
    figure, axes = plot.subplots(len(series), 1, figsize=(9, 2.8 * len(series)), squeeze=False, sharex=True, layout="constrained")
    for axis, (scene, methods) in zip(axes.flat, series.items()):
        for colour, (method, points) in zip(COLOURS, methods.items()):
            seen = [(t, e) for t, e in points if e > 0]
            if seen:
                axis.plot(*zip(*seen), color=colour, linewidth=1.2, label=method)
        axis.plot(*zip(*floors[scene]), color="0.4", linewidth=0.8, linestyle=":", label="truth's noise")
        axis.set(yscale="log", title=scene, ylabel=label, xlim=(phases[0].begin, phases[-1].end))
        axis.title.set_fontsize(9)
        axis.tick_params(labelsize=7, which="both")
        axis.grid(True, which="major", color="0.92")
        for phase in phases:
            if phase.moves:
                axis.axvspan(phase.begin, phase.end, color="0.94", zorder=0)
                axis.text(phase.begin + 0.03, 0.97, phase.name, fontsize=7, color="0.3", va="top", transform=axis.get_xaxis_transform())
    axes.flat[0].legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5))
    axes.flat[-1].set_xlabel("seconds")
    _finish(figure, path)


FAMILY_COLOURS = {"standard": COLOURS[0], "reverse": COLOURS[1], "lamp": COLOURS[4]}


def plans(path, plans_of, camera):
    """plans_of: {title: virtual lights}, x to the right, z downwards [m]; camera: as --stats has it."""
    figure, axes = plot.subplots(1, len(plans_of), figsize=(4.2 * len(plans_of), 3.9), squeeze=False, sharex=True, sharey=True,
                                 layout="constrained")
    eye, forward = camera["eye"], camera["forward"]
    for axis, (title, lights) in zip(axes.flat, plans_of.items()):
        for family, colour in FAMILY_COLOURS.items():
            at = [light["position"] for light in lights if light["family"] == family]
            axis.plot([p[0] for p in at], [p[2] for p in at], "o", color=colour, markersize=2.5, alpha=0.7, label=f"{family}: {len(at)}")
        axis.plot([eye[0], eye[0] + forward[0]], [eye[2], eye[2] + forward[2]], color="black", linewidth=1)
        axis.set(title=title, aspect="equal", xlabel="x [m]", ylabel="z [m]")
        axis.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=3)
    axes.flat[0].invert_yaxis()
    _finish(figure, path)


STAGE_COLOURS = dict(zip(("shoot", "balance", "build", "update", "estimate", "rest"), COLOURS), total="black",
                     **dict(zip(("shoot, simpler scene", "all", "front", "corners", "both", "asked"),
                                ("#85a5d6", "black", *COLOURS[1:]))))


def times(path, series):
    """series: {title: (label, x, {stage: ms}, x where shooting takes as long as balancing or None)}."""
    figure, axes = plot.subplots(1, len(series), figsize=(3.9 * len(series), 3.4), squeeze=False, layout="constrained")
    for axis, (title, (label, x, stages, meets)) in zip(axes.flat, series.items()):
        for stage, values in stages.items():
            axis.plot(x, values, "o-", color=STAGE_COLOURS[stage], markersize=3, linewidth=1, label=stage)
        if meets:
            axis.axvline(meets, color="0.4", linewidth=0.8, linestyle=":")
        axis.set(xscale="log", yscale="log", title=title, xlabel=label, ylabel="ms")
        axis.set_xticks(x, [f"{value:g}" for value in x])
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.yaxis.set_major_formatter("{x:g}")
        axis.tick_params(labelsize=7)
        axis.title.set_fontsize(9)
        axis.grid(True, which="major", color="0.92")
    axes.flat[-1].legend(fontsize=7, loc="center left", bbox_to_anchor=(1.02, 0.5))
    _finish(figure, path)


def answers(path, responses):
    """responses: {label: what part of a change is there after 0, 1, ... frames}."""
    figure, axis = plot.subplots(figsize=(5.2, 3.4), layout="constrained")
    for colour, (label, response) in zip(COLOURS, responses.items()):
        axis.plot(range(len(response)), response, "o-", color=colour, markersize=3, linewidth=1, label=label)
    last = max(len(response) for response in responses.values()) - 1
    axis.plot([0, last], [0, 1], color="0.7", linewidth=1, label="theory")
    axis.axhline(0.95, color="0.4", linewidth=0.8, linestyle=":")
    axis.set(xlabel="frames after the jump", ylabel="part of the change in mean luminance")
    axis.legend(fontsize=7)
    axis.grid(True, color="0.92")
    _finish(figure, path)


def bias(path, series, slopes):
    """series: {scene: [(paths, bias)]}; slopes: of the line through each, or None."""
    figure, axis = plot.subplots(figsize=(4.6, 3.4), layout="constrained")
    for colour, (scene, points) in zip(COLOURS, series.items()):
        seen = [(x, y) for x, y in points if y > 0]
        text = f"{scene}, slope {slopes[scene]:.2f}" if slopes[scene] is not None else scene
        if seen:
            axis.plot(*zip(*seen), "o-", color=colour, markersize=3, linewidth=1, label=text)
    axis.set(xscale="log", yscale="log", xlabel="paths of the pool", ylabel="relMSE of the mean")
    axis.legend(fontsize=7)
    axis.grid(True, color="0.92")
    _finish(figure, path)


def lines(path, series, across, upwards):
    """series: {label: [(x, y)]}; both axes by powers of ten. What is not above 0 is left out."""
    side_by_side(path, [(series, across)], upwards)


def side_by_side(path, plots, upwards):
    """plots: (series, across) as `lines` has them; they share the axis upwards."""
    figure, axes = plot.subplots(1, len(plots), figsize=(5.6 * len(plots), 3.4), squeeze=False, sharey=True, layout="constrained")
    for axis, (series, across) in zip(axes.flat, plots):
        for colour, (label, points) in zip(COLOURS, series.items()):
            seen = [(x, y) for x, y in points if y > 0]
            if seen:
                axis.plot(*zip(*seen), "o-", color=colour, markersize=3, linewidth=1, label=label)
        axis.set(xscale="log", yscale="log", xlabel=across)
        for scale in (axis.xaxis, axis.yaxis):
            scale.set_major_formatter("{x:g}")
            low, high = scale.get_view_interval()
            scale.set_minor_formatter("{x:g}" if high < 12 * low else NullFormatter())
        axis.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5))
        axis.grid(True, color="0.92")
    axes.flat[0].set_ylabel(upwards)
    _finish(figure, path)


def _finish(figure, path):
    with open(path, "wb") as file:
        file.write(pictures.png_of_plot(figure))
    plot.close(figure)


def shares(path, series):
    """series: {title: {label: [(share of the photons traced, share found)]}}. Dotted: by chance."""
    columns = min(3, len(series))
    rows = math.ceil(len(series) / columns)
    figure, axes = plot.subplots(rows, columns, figsize=(3.6 * columns, 3 * rows), squeeze=False, layout="constrained")
    for axis in axes.flat[len(series):]:
        axis.set_visible(False)
    for axis, (title, lines) in zip(axes.flat, series.items()):
        axis.plot([0, 1], [0, 1], color="0.4", linewidth=0.8, linestyle=":")
        for colour, (label, points) in zip(COLOURS, lines.items()):
            axis.plot(*zip((0, 0), *points), color=colour, linewidth=1.2, label=label)
        axis.set(title=title, xlabel="photons traced", ylabel="found", xlim=(0, 1), ylim=(0, 1))
        axis.title.set_fontsize(9)
        axis.tick_params(labelsize=7)
        axis.grid(True, color="0.92")
    axes.flat[0].legend(fontsize=7, loc="lower right")
    _finish(figure, path)


def paths(path, views, groups):
    """views: {title: (axis across, axis upwards)} of x, y, z; groups: polylines [m] of each."""
    figure, axes = plot.subplots(1, len(views), figsize=(5 * len(views), 4), squeeze=False, layout="constrained")
    for axis, (title, (across, upwards)) in zip(axes.flat, views.items()):
        for colour, lines in zip(COLOURS, groups):
            for line in lines:
                axis.plot([p[across] for p in line], [p[upwards] for p in line], color=colour, linewidth=0.6)
        axis.set(title=title, aspect="equal", xlabel=f"{'xyz'[across]} [m]", ylabel=f"{'xyz'[upwards]} [m]")
        if upwards == 2:
            axis.invert_yaxis()
    _finish(figure, path)

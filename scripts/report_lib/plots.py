"""Log-log plots of error over time, one small plot for each scene."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plot  # noqa: E402  the backend comes first
from matplotlib.ticker import NullFormatter  # noqa: E402

from report_lib import pictures  # noqa: E402

COLOURS = ("#1f4e9c", "#c0392b", "#2e8b57", "#8e44ad")


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
    with open(path, "wb") as file:
        file.write(pictures.png_of_plot(figure))
    plot.close(figure)


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

"""Tables and plots of a benchmark, in out/NAME."""
import datetime
import os
import platform
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plot  # noqa: E402  the backend comes first

from bench_lib.cluster import ROOT  # noqa: E402

COLOURS = ("#1f4e9c", "#c0392b", "#2e8b57", "#8e44ad", "#b7791f", "#555555", "#0e7490")


def folder(name):
    path = os.path.join(ROOT, "out", name)
    os.makedirs(path, exist_ok=True)
    return path


def circumstances():
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True,
                            check=False).stdout.strip()
    model = "?"
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
                break
    load = os.getloadavg()[0]
    return (f"{datetime.date.today()}, commit {commit}, {os.cpu_count()} x {model}, {platform.system()} "
            f"{platform.release()}, load {load:.1f} at the end")


def write_table(name, title, table, notes=()):
    """table: report_lib.tables.Table. Prints the Markdown too."""
    text = f"# {title}\n\n{circumstances()}\n\n{table.markdown()}\n" + "".join(f"{note}\n" for note in notes)
    with open(os.path.join(folder(name), table.name + ".md"), "w", encoding="utf-8") as file:
        file.write(text)
    with open(os.path.join(folder(name), table.name + ".csv"), "w", encoding="utf-8") as file:
        file.write(table.csv())
    print(text, flush=True)


def plot_lines(name, file, series, xlabel, ylabel, title, logx=True, ideal=None):
    """series: {label: [(x, y)]}. Colours that come again have another line."""
    figure, axis = plot.subplots(figsize=(8, 4), layout="constrained")
    styles = [(colour, line) for line in ("o-", "s--", "^:", "v-.") for colour in COLOURS]
    for (colour, line), (label, points) in zip(styles, series.items()):
        axis.plot(*zip(*sorted(points)), line, color=colour, markersize=3, linewidth=1, label=label)
    if ideal is not None:
        axis.axhline(ideal, color="0.6", linewidth=0.8, linestyle=":")
    axis.set(xlabel=xlabel, ylabel=ylabel, title=title, xscale="log" if logx else "linear")
    axis.set_ylim(bottom=0)
    counts = sorted({x for points in series.values() for x, _ in points})
    axis.set_xticks(counts, [f"{x:g}" for x in counts], minor=False)
    axis.minorticks_off()
    axis.grid(True, color="0.92")
    axis.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.01, 1))
    figure.savefig(os.path.join(folder(name), file), dpi=120)
    plot.close(figure)


def plot_bars(name, file, labels, parts, ylabel, title):
    """parts: {label of a part: [a value for each bar]}, stacked in that order."""
    figure, axis = plot.subplots(figsize=(6, 4), layout="constrained")
    floor = [0.0] * len(labels)
    for colour, (part, values) in zip(COLOURS, parts.items()):
        axis.bar(labels, values, bottom=floor, color=colour, label=part)
        floor = [below + value for below, value in zip(floor, values)]
    axis.set(ylabel=ylabel, title=title)
    axis.tick_params(axis="x", labelrotation=20, labelsize=8)
    axis.legend(fontsize=7)
    figure.savefig(os.path.join(folder(name), file), dpi=120)
    plot.close(figure)

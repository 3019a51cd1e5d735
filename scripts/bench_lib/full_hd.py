"""scripts/bench_full_hd: 1920x1080 from many two-core clients that filter their tiles."""
import argparse
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from bench_lib import output  # noqa: E402  the path comes first
from bench_lib.cluster import Cluster, Failure, answer, program, progress, scene_file  # noqa: E402
from report_lib.tables import Table  # noqa: E402

SIZE = "1920x1080"
THREADS = 2  # of a client
RECORDED = 2  # frames
HEAD = ["scene", "clients", "how", "F", "frames/s", "frames/s times F", "of N times one", "interval [ms]", "latency [ms]",
        "bytes/pixel", "Mbit/s", "master busy"]


def parse(words):
    parser = argparse.ArgumentParser(prog="bench_full_hd", description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", nargs="+", default=["table_room:40", "office:55"], metavar="SCENE:CLIENTS")
    parser.add_argument("--slower", type=float, nargs="+", default=[1, 4], metavar="F",
                        help="replayed clients take F times as long, so that they leave the master its cores")
    parser.add_argument("--seconds", type=float, default=15, help="of one measurement, about")
    parser.add_argument("--quick", action="store_true", help="table_room from 8 clients, 5 seconds")
    options = parser.parse_args(words)
    if options.quick:
        options.scenes, options.seconds, options.slower = ["table_room:8"], 5, [1]
    return options


def quantiles(ms):
    return f"{ms['p50']:.0f}, {ms['p95']:.0f}" if ms else "-"


def add(table, scene, clients, how, slower, fps, alone, interval=None, latency=None, more=("-", "-", "-")):
    efficiency = fps * slower / (alone * clients)
    table.data.append({"scene": scene, "clients": clients, "how": how, "slower": slower, "fps": fps,
                       "efficiency": efficiency, "interval_ms": interval, "latency_ms": latency})
    table.rows.append([scene, str(clients), how, f"{slower:g}", f"{fps:.2f}", f"{fps * slower:.1f}",
                       f"{100 * efficiency:.0f} %", quantiles(interval), quantiles(latency), *more])


def replayed(cluster, options, table, scene, clients, flags, recording, alone):
    for slower in options.slower:
        frames = max(8, round(options.seconds * alone * clients / slower))
        progress(f"{scene}: {clients} replay clients, {slower:g} times as slow, {frames} frames")
        s = cluster.replay(scene, [*flags, "--frames", frames], recording, clients, "recorded", slower, THREADS)
        more = (f"{s['bytes_per_pixel']:.1f}", f"{8e-6 * s['bytes_received'] / s['seconds']:.0f}",
                f"{100 * (1 - s['master']['idle_fraction']):.0f} %")
        add(table, scene, clients, "replayed", slower, s["fps"], alone, interval=s["frame_ms"], latency=s["latency_ms"], more=more)


def simulated(table, scene, clients, alone):
    """The scheduler alone, with threads for clients: what is left of N times one if neither master nor line bind."""
    width, height = map(int, SIZE.split("x"))
    sets = answer([program("ninefold-client-benchmark"), scene_file(scene), "--size", "640x480", "--frames", "2",
                   "--level", "0", "--json"])["sets_ms"]
    whole = 1e3 * THREADS / alone  # ms of a thread a frame
    task = (whole - sets) * 1024 / (width * height)
    threads = THREADS * clients
    progress(f"{threads} simulated threads, {task:.1f} ms a task, {sets / 9:.1f} ms a light set")
    s = answer([program("ninefold-simulate-cluster"), "--clients", str(threads), "--frames", "600", "--size", SIZE,
                "--task-ms", f"{task:.3f}", "--set-ms", f"{sets / 9:.3f}"])
    add(table, scene, clients, "simulated", 1, s["fps"], alone, latency=s["latency_ms"])


def measure(cluster, options, table, scene, clients):
    flags = ["--size", SIZE, "--filter-at", "clients", "--wire-level", "0"]
    progress(f"{scene}: one real client, recorded")
    recording, stats = cluster.record(scene, flags, RECORDED, THREADS)
    alone = stats["fps"]
    table.rows.append([scene, "1", "rendering", "1", f"{alone:.2f}", "-", "-", quantiles(stats["frame_ms"]),
                       quantiles(stats["latency_ms"]), f"{stats['bytes_per_pixel']:.1f}", "-", "-"])
    replayed(cluster, options, table, scene, clients, flags, recording, alone)
    simulated(table, scene, clients, alone)


def main(words):
    options = parse(words)
    table = Table("full_hd", HEAD)
    try:
        with Cluster() as cluster:
            for name in options.scenes:
                scene, _, clients = name.partition(":")
                measure(cluster, options, table, scene, int(clients))
    except Failure as failure:
        print(f"bench_full_hd: {failure}", file=sys.stderr)
        return 1
    output.write_table("bench_full_hd", "1920x1080, filtered at the clients", table, (
        f"Clients of {THREADS} threads. \"rendering\": a real one beside the master. \"replayed\": NOT rendering: they answer with what",
        "that client gave, after F times the time that it took, light sets included, on the master's own cores; frames/s times F is what it",
        "would be if the master were F times as fast. \"simulated\": the scheduler under a simulated clock; no master, no line.",
        "Interval: from one complete frame to the next. Latency, with as many frames under way as the scheduler opens: of replayed",
        "clients MEASURED, from a frame's opening to the whole picture in the master; of simulated ones to the last result.",
        "Each as median and 95 %."))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

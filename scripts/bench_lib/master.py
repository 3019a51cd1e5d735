"""scripts/bench_master: what the master can take, with replay clients at full speed."""
import argparse
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from bench_lib import output  # noqa: E402  the path comes first
from bench_lib.cluster import Cluster, Failure, progress  # noqa: E402
from report_lib.tables import Table  # noqa: E402

SIZES = ["640x480", "1280x720", "1920x1080", "3840x2160"]
CLIENTS = [1, 4, 16, 64]
MODES = {"stored": ["--wire-level", "0"], "zstd 1": ["--wire-level", "1"],
         "filtered by clients": ["--filter-at", "clients", "--wire-level", "0"]}
PIXELS = 120e6  # of one measurement: what a run does once (the hash of the picture) is to be lost in it


def parse(words):
    parser = argparse.ArgumentParser(prog="bench_master", description=__doc__.splitlines()[0])
    parser.add_argument("--scene", default="table_room")
    parser.add_argument("--sizes", nargs="+", default=SIZES)
    parser.add_argument("--clients", nargs="+", type=int, default=CLIENTS)
    parser.add_argument("--modes", nargs="+", choices=list(MODES), default=list(MODES))
    parser.add_argument("--pixels", type=float, default=PIXELS, help="of one measurement")
    parser.add_argument("--quick", action="store_true", help="one size, 1 and 16 clients, few pixels")
    options = parser.parse_args(words)
    if options.quick:
        options.sizes, options.clients, options.pixels = ["640x480"], [1, 16], 10e6
    return options


def measure(cluster, options, size, mode):
    width, height = map(int, size.split("x"))
    pixels = width * height
    flags = ["--size", size, *MODES[mode]]
    progress(f"recording {options.scene} {size} {mode}")
    recording, _ = cluster.record(options.scene, flags, 1, os.cpu_count())
    frames = max(4, round(options.pixels / pixels))
    for count in options.clients:
        progress(f"{size} {mode}: {count} clients, {frames} frames")
        stats = cluster.replay(options.scene, [*flags, "--frames", frames], recording, count)
        yield count, pixels, stats
    os.unlink(recording)


def row(size, mode, count, pixels, s):
    master, frame = s["master"], s["frame_ms"]
    data = {"size": size, "mode": mode, "clients": count, "mpixels_per_second": s["pixels_per_second"] / 1e6,
            "p50_ms": frame["p50"], "p95_ms": frame["p95"], "cpu_ns_per_pixel": 1e6 * master["cpu_ms"] / pixels,
            "unpack_ns_per_pixel": 1e6 * master["decode_ms"] / pixels,
            "finish_ns_per_pixel": 1e6 * master["filter_ms"] / pixels,
            "cpu_limit_mpixels": 1e3 * os.cpu_count() * pixels / 1e6 / master["cpu_ms"],
            "tail_fraction": master["tail_ms"]["p50"] / frame["p50"], "bytes_per_pixel": s["bytes_per_pixel"],
            "memory_mb": master["memory_mb"]}
    texts = [size, mode, str(count), f"{data['mpixels_per_second']:.1f}", f"{frame['p50']:.1f}", f"{frame['p95']:.1f}",
             f"{data['cpu_ns_per_pixel']:.1f}", f"{data['unpack_ns_per_pixel']:.1f}",
             f"{data['finish_ns_per_pixel']:.1f}", f"{data['cpu_limit_mpixels']:.1f}",
             f"{100 * data['tail_fraction']:.1f} %", f"{data['bytes_per_pixel']:.1f}", f"{data['memory_mb']:.0f}"]
    return texts, data


def main(words):
    options = parse(words)
    table = Table("master", ["size", "wire", "clients", "Mpixel/s", "p50 [ms]", "p95 [ms]", "CPU [ns/pixel]", "unpack",
                             "finish", "CPU limit [Mpixel/s]", "tail", "bytes/pixel", "MB"])
    series = {}
    try:
        with Cluster() as cluster:
            for size in options.sizes:
                for mode in options.modes:
                    for count, pixels, stats in measure(cluster, options, size, mode):
                        texts, data = row(size, mode, count, pixels, stats)
                        table.rows.append(texts)
                        table.data.append(data)
                        series.setdefault(f"{size}, {mode}", []).append((count, data["cpu_limit_mpixels"]))
    except Failure as failure:
        print(f"bench_master: {failure}", file=sys.stderr)
        return 1
    output.write_table("bench_master", "What the master can take", table, (
        "CPU: of the whole master process, kernel included, per pixel; the replay clients' is not counted. CPU limit:",
        "the cores over that. Mpixel/s: what was reached with the replay clients on the same cores. Tail: from the last",
        "result to the finished frame, as part of the frame time (medians)."))
    output.plot_lines("bench_master", "master.png", series, "replay clients", "Mpixel/s by the master's CPU time",
                      "What the master can take")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

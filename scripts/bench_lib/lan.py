"""scripts/bench_lan: what slow, late, lossy and cut lines cost."""
import argparse
import os
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from bench_lib import links, output  # noqa: E402  the path comes first
from bench_lib.cluster import Cluster, Failure, program, progress  # noqa: E402
from report_lib.tables import Table  # noqa: E402

LINES = [dict(mbit=0), dict(mbit=10000), dict(mbit=1000), dict(mbit=100),
         dict(mbit=1000, delay_ms=0.1), dict(mbit=1000, delay_ms=1), dict(mbit=1000, delay_ms=10),
         dict(mbit=100, delay_ms=1), dict(mbit=1000, delay_ms=0.1, loss=1), dict(mbit=1000, delay_ms=0.1, cut="3:1"),
         dict(mbit=1000, delay_ms=0.1, cut="3:8")]
ADAPTIVE = [dict(mbit=0), dict(mbit=1000), dict(mbit=100), dict(mbit=20)]
QUICK = [dict(mbit=0), dict(mbit=100), dict(mbit=1000, delay_ms=1, loss=1)]
PORT = 4700


def parse(words):
    parser = argparse.ArgumentParser(prog="bench_lan", description=__doc__.splitlines()[0])
    parser.add_argument("--scene", default="table_room")
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--clients", type=int, default=16, help="behind the one line")
    parser.add_argument("--frames", type=int, default=200)
    parser.add_argument("--modes", nargs="+", choices=["master", "clients"], default=["master", "clients"],
                        help="who filters")
    parser.add_argument("--quick", action="store_true", help="few lines, few frames")
    options = parser.parse_args(words)
    options.lines = QUICK if options.quick else LINES
    options.real_frames = 40
    if options.quick:
        options.frames, options.real_frames, options.modes = 20, 20, ["master"]
    return options


def name(mbit=0, delay_ms=0, loss=0, cut=None):
    rate = "unshaped" if not mbit else f"{mbit} Mbit/s" if mbit < 1000 else f"{mbit // 1000} Gbit/s"
    if cut:
        begin, length = cut.split(":")
        cut = f"cut after {begin} s for {length} s"
    return ", ".join([rate, *([f"{delay_ms:g} ms"] if delay_ms else []), *([f"{loss} % lost"] if loss else []),
                      *([cut] if cut else [])])


def run(cluster, options, where, recordings, line):
    """Replay clients repeat what was recorded without compression, or with it: what real ones would have chosen."""
    level = "1" if line["mbit"] == 100 else "0"

    def clients(_):
        return [[*links.within(links.CLIENTS), program("ninefold-replay-client"), "--master",
                 f"{links.ADDRESS}:{PORT}", "--key-file", cluster.key, "--recording", recordings[level], "--clients",
                 str(options.clients), "--pace", "recorded"]]
    with links.line(**line):
        start = time.monotonic()
        s = cluster.run(options.scene, ["--size", options.size, "--filter-at", where, "--frames", options.frames,
                                        "--local-clients", 0, "--wait-clients", options.clients], clients,
                        listen=f"0.0.0.0:{PORT}", prefix=links.within(links.MASTER))
        if "cut" in line and time.monotonic() - start < sum(map(float, line["cut"].split(":"))):
            raise Failure(f"{options.frames} frames were done before the line was cut and whole again; give more --frames")
    return s


def adaptive(cluster, options):
    """Real clients, which choose the level of compression by what their line takes."""
    table = Table("adaptive", ["line", "frames/s", "bytes/pixel", "Mbit/s", "same bytes"])
    first = None
    for line in ADAPTIVE:
        progress(f"real clients, adaptive level: {name(**line)}")

        def clients(_):
            return [[*links.within(links.CLIENTS), program("ninefold-client"), "--master", f"{links.ADDRESS}:{PORT}",
                     "--key-file", cluster.key, "--cache", "none"] for _ in range(2)]
        with links.line(**line):
            s = cluster.run(options.scene, ["--size", options.size, "--frames", options.real_frames, "--local-clients", 0,
                                            "--wait-clients", 2], clients, listen=f"0.0.0.0:{PORT}",
                            prefix=links.within(links.MASTER))
        first = first or s
        mbit = 8e-6 * s["bytes_received"] / s["seconds"]
        table.data.append({"line": name(**line), "fps": s["fps"], "bytes_per_pixel": s["bytes_per_pixel"],
                           "mbit_per_second": mbit, "same": s["image_hash"] == first["image_hash"]})
        table.rows.append([name(**line), f"{s['fps']:.2f}", f"{s['bytes_per_pixel']:.1f}", f"{mbit:.0f}",
                           "yes" if table.data[-1]["same"] else "NO"])
    output.write_table("bench_lan", "The level of compression follows the line", table, (
        f"{options.scene}, {options.size}, two real clients of one thread on this machine, {options.real_frames} frames.",))
    return all(row["same"] for row in table.data)


def main(words):
    options = parse(words)
    table = Table("lan", ["filter at", "line", "frames/s", "of unshaped", "p50 [ms]", "p95 [ms]", "bytes/pixel",
                          "Mbit/s", "reissued", "same bytes"])
    try:
        with Cluster() as cluster:
            for where in options.modes:
                flags = ["--size", options.size, "--filter-at", where]
                recordings = {}
                for level in ("0", "1"):
                    progress(f"recording {options.scene}, filter at {where}, level {level}")
                    recordings[level], _ = cluster.record(options.scene, [*flags, "--wire-level", level], 1, 1)
                first = None
                for line in options.lines:
                    progress(f"{where}: {name(**line)}")
                    s = run(cluster, options, where, recordings, line)
                    first = first or s
                    data = {"filter_at": where, "line": name(**line), "fps": s["fps"],
                            "of_unshaped": s["fps"] / first["fps"], "p50_ms": s["frame_ms"]["p50"],
                            "p95_ms": s["frame_ms"]["p95"], "bytes_per_pixel": s["bytes_per_pixel"],
                            "mbit_per_second": 8e-6 * s["bytes_received"] / s["seconds"],
                            "reissued": s["tasks_reissued"], "same": s["image_hash"] == first["image_hash"]}
                    table.data.append(data)
                    table.rows.append([where, data["line"], f"{s['fps']:.2f}", f"{100 * data['of_unshaped']:.0f} %",
                                       f"{data['p50_ms']:.0f}", f"{data['p95_ms']:.0f}",
                                       f"{data['bytes_per_pixel']:.1f}", f"{data['mbit_per_second']:.0f}",
                                       str(data["reissued"]), "yes" if data["same"] else "NO"])
            same = adaptive(cluster, options)
    except Failure as failure:
        print(f"bench_lan: {failure}", file=sys.stderr)
        return 1
    output.write_table("bench_lan", "Lines between master and clients", table, (
        f"{options.scene}, {options.size}, {options.clients} replay clients behind one line, each paced as one real "
        "client",
        "of one thread was when it was recorded; NOT rendering. Rate by a token bucket (tbf) on a veth pair; with delay, "
        "loss or",
        "cuts by ninefold-link-relay between two TUN devices. 100 Mbit/s: recorded with zstd 1, else without."))
    return 0 if same and all(row["same"] for row in table.data) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""scripts/bench_scalability: the paper's Table 1: scenes by numbers of clients."""
import argparse
import os
import socket
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from bench_lib import output  # noqa: E402  the path comes first
from bench_lib.cluster import Cluster, Failure, progress  # noqa: E402
from bench_lib.hosts import Hosts  # noqa: E402
from report_lib.tables import Table  # noqa: E402

SCENES = ["table_room", "egg_room", "invisible_date", "office", "conference"]
CLIENTS = [1, 2, 4, 8, 16]
RECORDED = 2  # frames


def parse(words):
    parser = argparse.ArgumentParser(prog="bench_scalability", description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--clients", nargs="+", type=int, default=CLIENTS)
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--seconds", type=float, default=15, help="of one measurement, about")
    parser.add_argument("--slower", type=float, default=1, metavar="F",
                        help="replayed clients take F times as long, so that many leave the master its cores")
    parser.add_argument("--hosts", metavar="FILE",
                        help="real clients by ssh: a line for each, HOST [PROGRAM], PROGRAM being its ninefold-client; "
                             "an ssh key must be there, and this machine is reached by its host name")
    parser.add_argument("--address", default=socket.gethostname(), help="of this machine for --hosts")
    parser.add_argument("--port", type=int, default=4700, help="for --hosts")
    parser.add_argument("--quick", action="store_true", help="one scene, 320x240")
    options = parser.parse_args(words)
    if options.quick:
        options.scenes, options.size, options.seconds = options.scenes[:1], "320x240", 5
    return options


def measure(cluster, options, scene, hosts):
    """Yields (count, kind, stats)."""
    size = ["--size", options.size, "--wire-level", "1"]
    progress(f"{scene}: one real client, recorded")
    recording, alone = cluster.record(scene, size, RECORDED, 1)
    for count in options.clients:
        frames = max(3, round(options.seconds * alone["fps"] * count / options.slower))
        flags = [*size, "--frames", frames]
        progress(f"{scene}: {count} clients, {frames} frames")
        if hosts and count <= len(hosts):
            yield count, "ssh", hosts.run(cluster, scene, flags, count)
        elif not hosts and count <= os.cpu_count():
            yield count, "real", cluster.real(scene, flags, count)
        if not hosts:
            yield count, "replayed", cluster.replay(scene, flags, recording, count, "recorded", options.slower)
    os.unlink(recording)


def main(words):
    options = parse(words)
    table = Table("scalability", ["scene", "clients", "kind", "frames/s", "efficiency", "p95 [ms]",
                                  "sets/client and frame", "bytes/pixel", "Mbit/s", "idle"])
    series = {}
    try:
        with Cluster() as cluster:
            hosts = Hosts(options.hosts, f"{options.address}:{options.port}", cluster.key) if options.hosts else None
            for scene in options.scenes:
                base = {}
                for count, kind, s in measure(cluster, options, scene, hosts):
                    base.setdefault(kind, s["fps"] / count)
                    efficiency = s["fps"] / count / base[kind]
                    busy = [c["busy_fraction"] for c in s["clients"]]
                    sets = [c["sets_per_frame"] for c in s["clients"]]
                    data = {"scene": scene, "clients": count, "kind": kind, "fps": s["fps"], "efficiency": efficiency,
                            "p95_ms": s["frame_ms"]["p95"], "sets": sum(sets) / len(sets),
                            "bytes_per_pixel": s["bytes_per_pixel"],
                            "mbit_per_second": 8e-6 * s["bytes_received"] / s["seconds"],
                            "idle": 1 - sum(busy) / len(busy)}
                    table.data.append(data)
                    table.rows.append([scene, str(count), kind, f"{data['fps']:.2f}", f"{100 * efficiency:.1f} %",
                                       f"{data['p95_ms']:.0f}", f"{data['sets']:.2f}",
                                       f"{data['bytes_per_pixel']:.1f}", f"{data['mbit_per_second']:.1f}",
                                       f"{100 * data['idle']:.1f} %"])
                    series.setdefault(f"{scene}, {kind}", []).append((count, 100 * efficiency))
    except Failure as failure:
        print(f"bench_scalability: {failure}", file=sys.stderr)
        return 1
    output.write_table("bench_scalability", "Scenes by numbers of clients", table, (
        f"{options.size}, one thread a client. \"real\" and \"ssh\": clients that render. \"replayed\": NOT rendering:",
        f"they answer with what one real client of this machine gave, after {options.slower:g} times the time that it took, "
        "light sets included.",
        "Efficiency: frames a second for each client over that of the fewest clients of the same kind. Idle: of the",
        "clients' threads. On this machine real clients share the cores with the master."))
    output.plot_lines("bench_scalability", "scalability.png", series, "clients", "efficiency [%]",
                      "Scenes by numbers of clients", ideal=100)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""scripts/simulate_cluster: how well the scheduler uses 1 to 1,000 clients, without having them."""
import argparse
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from bench_lib import output  # noqa: E402  the path comes first
from bench_lib.cluster import Failure, answer, program, progress  # noqa: E402
from report_lib.tables import Table  # noqa: E402

CLIENTS = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000]
STORIES = {"alike": [], "mixed": ["--mixed"], "mixed, one fails every 10 s": ["--mixed", "--fail-every", "10"],
           "mixed, one stands still every 10 s": ["--mixed", "--straggle-every", "10"]}
SIMULATED_SECONDS = 40  # of a run, about


def parse(words):
    parser = argparse.ArgumentParser(prog="simulate_cluster", description=__doc__.splitlines()[0])
    parser.add_argument("--clients", nargs="+", type=int, default=CLIENTS)
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--task-ms", type=float, default=20, help="work of 1,024 pixels for a thread of speed 1")
    parser.add_argument("--set-ms", type=float, default=2, help="work of a light set")
    parser.add_argument("--frames-in-flight", type=int, default=16)
    parser.add_argument("--quick", action="store_true", help="up to 64 clients")
    options = parser.parse_args(words)
    if options.quick:
        options.clients = [count for count in options.clients if count <= 64]
    return options


def power(count, mixed):
    """Threads times speed of that many clients, as ninefold-simulate-cluster makes them."""
    return sum((1 + i * 5 % 8) * 0.25 * (1 << i * 3 % 5) for i in range(count)) if mixed else count


def simulate(options, story, count):
    width, height = map(int, options.size.split("x"))
    work = width * height / 1024 * options.task_ms / 1e3  # seconds of a thread of speed 1, a frame
    frames = max(20, round(SIMULATED_SECONDS * power(count, "--mixed" in STORIES[story]) / work))
    command = [program("ninefold-simulate-cluster"), "--clients", str(count), "--frames", str(frames), "--size",
               options.size, "--task-ms", str(options.task_ms), "--set-ms", str(options.set_ms),
               "--frames-in-flight", str(options.frames_in_flight), *STORIES[story]]
    return answer(command)


def main(words):
    options = parse(words)
    table = Table("simulation", ["clients", "", "frames/s", "efficiency", "latency p50 [ms]", "p95 [ms]",
                                 "sets/client and frame", "reissued", "copies", "of tasks"])
    series = {}
    try:
        for story in STORIES:
            for count in options.clients:
                progress(f"{count} clients, {story}")
                s = simulate(options, story, count)
                latency = s["latency_ms"]
                table.rows.append([str(count), story, f"{s['fps']:.2f}", f"{100 * s['efficiency']:.1f} %",
                                   f"{latency['p50']:.0f}", f"{latency['p95']:.0f}", f"{s['sets_per_frame']:.2f}",
                                   str(s["reissued"]), str(s["duplicated"]), str(s["tasks"])])
                table.data.append({"story": story, **{k: v for k, v in s.items() if k != "latency_ms"},
                                   "p50_ms": latency["p50"], "p95_ms": latency["p95"]})
                series.setdefault(story, []).append((count, 100 * s["efficiency"]))
    except Failure as failure:
        print(f"simulate_cluster: {failure}", file=sys.stderr)
        return 1
    output.write_table("simulate_cluster", "The scheduler and simulated clients", table, (
        f"{options.size}, {options.task_ms:g} ms a task, {options.set_ms:g} ms a light set, {options.frames_in_flight}",
        "frames open at most. Efficiency: useful work over what all clients could have done while they were there."))
    output.plot_lines("simulate_cluster", "simulation.png", series, "clients", "efficiency [%]",
                      "The scheduler and simulated clients", ideal=100)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

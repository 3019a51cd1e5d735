"""scripts/bench_client: the time of a frame's rays alone beside the client's whole time for that frame."""
import argparse
import os
import statistics
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from bench_lib import output  # noqa: E402  the path comes first
from bench_lib.cluster import Failure, answer, program, progress, scene_file  # noqa: E402
from report_lib.scenes import SHIPPED  # noqa: E402
from report_lib.tables import Table  # noqa: E402

WITHOUT, WITH = ("--vpl-roulette", "0"), ()
HEAD = ["scene", "whole [ms]", "light sets", "tiles", "encoding", "the rays alone", "ratio (least to most)",
        "Mrays", "with roulette: whole [ms]", "Mrays", "time kept"]
NOTES = (
    "CPU time of one thread a frame, medians of rounds in which all runs take turns. Whole: light sets, tiles and encoding as a",
    "client on loopback does them. The rays alone: the very same rays once more, in the same calls, and nothing else. Ratio: rays",
    "alone over whole, every virtual light asked. With roulette: whole frames as they are rendered (the default of --vpl-roulette), and what",
    "part of the time without is left.")


def parse(words):
    parser = argparse.ArgumentParser(prog="bench_client", description=__doc__)
    parser.add_argument("--scenes", nargs="+", default=list(SHIPPED))
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--frames", type=int, default=4, help="of each run")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--quick", action="store_true", help="one round of one frame")
    options = parser.parse_args(words)
    if options.quick:
        options.frames, options.rounds = 1, 1
    return options


def run(scene, options, flags):
    command = [program("ninefold-client-benchmark"), scene_file(scene), "--size", options.size, "--frames",
               str(options.frames), "--level", "0", "--json", *flags]
    return answer(command)


def add_row(table, scene, plain, roulette):
    def median(runs, key):
        return statistics.median(run[key] for run in runs)
    ratios = [run["bare_ratio"] for run in plain]
    entry = {"scene": scene, **{key: median(plain, key) for key in plain[0] if key.endswith("_ms")},
             "ratio": statistics.median(ratios), "ratio_least": min(ratios), "ratio_most": max(ratios),
             "mrays": median(plain, "rays_per_frame") / 1e6, "roulette_whole_ms": median(roulette, "whole_ms"),
             "roulette_mrays": median(roulette, "rays_per_frame") / 1e6}
    entry["time_kept"] = statistics.median(b["whole_ms"] / a["whole_ms"] for a, b in zip(plain, roulette))
    table.data.append(entry)
    table.rows.append([scene] + [f"{entry[key]:.0f}" for key in ("whole_ms", "sets_ms", "tiles_ms", "encoding_ms", "bare_ms")]
                      + [f"{entry['ratio']:.2f} ({entry['ratio_least']:.2f} to {entry['ratio_most']:.2f})",
                         f"{entry['mrays']:.2f}", f"{entry['roulette_whole_ms']:.0f}", f"{entry['roulette_mrays']:.2f}",
                         f"{entry['time_kept']:.2f}"])


def main(words):
    options = parse(words)
    table = Table("client", HEAD)
    runs = {(scene, flags): [] for scene in options.scenes for flags in (WITHOUT, WITH)}
    try:
        for number in range(options.rounds):
            for scene, flags in runs:
                progress(f"round {number + 1} of {options.rounds}: {scene} {' '.join(flags)}")
                runs[scene, flags].append(run(scene, options, flags))
    except Failure as failure:
        print(f"bench_client: {failure}", file=sys.stderr)
        return 1
    for scene in options.scenes:
        add_row(table, scene, runs[scene, WITHOUT], runs[scene, WITH])
    output.write_table("bench_client", "The client", table, NOTES)
    parts = {"the rays alone": [entry["bare_ms"] for entry in table.data],
             "encoding": [entry["encoding_ms"] for entry in table.data],
             "all else": [entry["whole_ms"] - entry["bare_ms"] - entry["encoding_ms"] for entry in table.data]}
    output.plot_bars("bench_client", "client.png", [entry["scene"] for entry in table.data], parts,
                     "ms of one thread a frame", "Where a client's time goes, every virtual light asked")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

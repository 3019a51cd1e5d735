"""scripts/bench_viewers: what browsers cost a cluster, and what one sees on a thin line."""
import argparse
import contextlib
import json
import os
import re
import statistics
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from bench_lib import links, output, viewer  # noqa: E402  the path comes first
from bench_lib.cluster import Cluster, Failure, ended, last_line, program, progress, scene_file  # noqa: E402
from report_lib.tables import Table  # noqa: E402

from browser import Viewer, request  # noqa: E402  found by viewer

SCENE, VIEWERS = "table_room", 8
EVENT = 0.05  # seconds between two moves of the pointer


def parse(words):
    parser = argparse.ArgumentParser(prog="bench_viewers", description=__doc__.splitlines()[0])
    parser.add_argument("--clients", type=int, default=16, help="replayed")
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--slower", type=float, default=4, metavar="F",
                        help="replayed clients take F times as long, so that they leave the master and the viewers their cores")
    parser.add_argument("--seconds", type=float, default=20, help="of one measurement")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--mbit", type=float, default=5, help="of the thin line")
    parser.add_argument("--delay-ms", type=float, default=50, help="of the thin line, one way")
    parser.add_argument("--quick", action="store_true", help="one round of 5 seconds")
    options = parser.parse_args(words)
    if options.quick:
        options.seconds, options.rounds = 5, 1
    return options


@contextlib.contextmanager
def serving(cluster, arguments, address, prefix=()):
    """A master; gives (port of its clients, port and token of its page)."""
    log = os.path.join(cluster.folder, "master.log")
    command = [*prefix, program("ninefold-master"), scene_file(SCENE), *map(str, arguments), "--key-file", cluster.key,
               "--serve", address]
    with open(log, "w", encoding="utf-8") as file, \
            ended(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=file)) as master:
        yield said(master, log, r"listening on \S+:(\d+)")[1], *said(master, log, r"serving at \S+:(\d+)/#token=(\S+)").groups()


def said(master, log, pattern):
    end = time.monotonic() + 60
    while time.monotonic() < end and master.poll() is None:
        with open(log, encoding="utf-8") as file:
            found = re.search(pattern, file.read())
        if found:
            return found
        time.sleep(0.02)
    raise Failure(f"the master says no {pattern}: {last_line(log)}")


def looking(host, port, token, seconds, prefix=()):
    return ended(subprocess.Popen([*prefix, sys.executable, viewer.__file__, host, port, token, str(seconds)],
                                  stdout=subprocess.PIPE, text=True))


def frames_of(port, token):
    _, _, body = request("127.0.0.1", int(port), "/metrics", True, Authorization=f"Bearer {token}")
    return float(re.search(r"^ninefold_frames_total (\S+)$", body.decode(), re.M)[1])


def rate(port, token, seconds):
    first, begin = frames_of(port, token), time.monotonic()
    time.sleep(seconds)
    return (frames_of(port, token) - first) / (time.monotonic() - begin)


def cost(cluster, options, table):
    """Rounds in which the cluster is looked at and not, by turns."""
    size = ["--size", options.size, "--wire-level", "1"]
    progress("one real client, recorded")
    recording, _ = cluster.record(SCENE, size, 2, 1)
    rates = {0: [], VIEWERS: []}
    with serving(cluster, [*size, "--local-clients", 0, "--wait-clients", options.clients], "0.0.0.0:0") as (port, site, token):
        command = [program("ninefold-replay-client"), "--master", f"127.0.0.1:{port}", "--key-file", cluster.key, "--recording",
                   recording, "--clients", str(options.clients), "--pace", "recorded", "--slower", str(options.slower)]
        with ended(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)):
            while frames_of(site, token) < 40:  # at rest, and calm
                time.sleep(0.1)
            for number in range(options.rounds):
                for count in rates:
                    progress(f"round {number + 1} of {options.rounds}: {count} viewers")
                    with contextlib.ExitStack() as stack:
                        for _ in range(count):
                            stack.enter_context(looking("127.0.0.1", site, token, options.seconds + 2))
                        time.sleep(1)
                        rates[count].append(rate(site, token, options.seconds))
    alone, watched = (statistics.median(rates[count]) for count in (0, VIEWERS))
    ratios = [b / a for a, b in zip(rates[0], rates[VIEWERS])]
    table.data.append({"clients": options.clients, "slower": options.slower, "fps": alone, "watched_fps": watched,
                       "ratio": statistics.median(ratios)})
    table.rows.append([str(options.clients), f"{options.slower:g}", f"{alone:.2f}", f"{watched:.2f}",
                       f"{100 * (statistics.median(ratios) - 1):+.1f} %", f"{100 * (min(ratios) - 1):+.1f} to {100 * (max(ratios) - 1):+.1f} %"])


def thin_line(cluster, options, table):
    """Two local clients render; somebody on this machine orbits, and tells the time by the exposure."""
    progress(f"a viewer behind {options.mbit:g} Mbit/s and {options.delay_ms:g} ms")
    with links.line(options.mbit, options.delay_ms):
        with serving(cluster, ["--size", options.size], "0.0.0.0:4750", links.within(links.MASTER)) as (_, port, token):
            times = {}
            with looking(links.ADDRESS, port, token, options.seconds + 4, links.within(links.CLIENTS)) as far, \
                    subprocess.Popen([*links.within(links.MASTER), sys.executable, __file__, "--orbit", port, token,
                                      str(options.seconds + 3)], stdout=subprocess.PIPE, text=True) as near:
                for line in near.stdout:
                    entry = json.loads(line)
                    times[entry["exposure"]] = entry["time"]
                shown = [json.loads(line) for line in far.stdout]
    begin = min(times.values()) + 2  # the pace has found the form
    seen = [entry for entry in shown if begin <= entry["time"] <= begin + options.seconds and entry["exposure"] in times]
    if len(seen) < 2:
        raise Failure("the viewer on the thin line saw no pictures")
    ages = sorted(1e3 * (entry["time"] - times[entry["exposure"]]) for entry in seen)
    per_second = (len(seen) - 1) / (seen[-1]["time"] - seen[0]["time"])
    size = statistics.mean(entry["bytes"] for entry in seen)
    table.data.append({"mbit": options.mbit, "delay_ms": options.delay_ms, "pictures_per_second": per_second,
                       "age_p50_ms": ages[len(ages) // 2], "age_p95_ms": ages[int(0.95 * len(ages))], "age_max_ms": ages[-1]})
    table.rows.append([f"{options.mbit:g} Mbit/s, {options.delay_ms:g} ms", f"{per_second:.1f}", f"{ages[len(ages) // 2]:.0f}",
                       f"{ages[int(0.95 * len(ages))]:.0f}", f"{ages[-1]:.0f}", f"{size / 1024:.0f}"])


def orbit(port, token, seconds):
    """In control: moves the camera all along; each move has an exposure of its own, which says when it was."""
    near = Viewer("127.0.0.1", int(port), token, certificate=True)
    near.look_until(lambda head: head.get("control") == head["you"] and "frames" in head)
    near.send("button down right 40 40 -")
    begin = time.monotonic()
    number = 0
    while time.monotonic() < begin + float(seconds):
        number += 1
        exposure = number / 1000
        near.send(f"exposure {exposure}")
        print(json.dumps({"exposure": exposure, "time": time.monotonic()}), flush=True)
        near.send(f"move {40 + number % 40} 40 -")
        while near.wait(EVENT):
            near.look()
            if time.monotonic() > begin + number * EVENT:
                break


def main(words):
    if words[:1] == ["--orbit"]:
        return orbit(*words[1:])
    options = parse(words)
    watched = Table("cost", ["replay clients", "F", "frames/s", f"with {VIEWERS} viewers", "change", "of rounds"])
    thin = Table("thin_line", ["line", "pictures/s", "age p50 [ms]", "p95 [ms]", "max [ms]", "KiB a picture"])
    try:
        with Cluster() as cluster:
            cost(cluster, options, watched)
            thin_line(cluster, options, thin)
    except Failure as failure:
        print(f"bench_viewers: {failure}", file=sys.stderr)
        return 1
    output.write_table("bench_viewers", "A cluster that is looked at", watched, (
        f"{SCENE} {options.size} at rest. Replayed: NOT rendering: clients answer with what one real client gave, after F times the time",
        "that it took. Viewers and clients are on the master's own cores."))
    output.write_table("bench_viewers", "A viewer on a thin line", thin, (
        f"{SCENE} {options.size}, two local clients that render, the camera moving all along. Age: from the moment at which the exposure that",
        "comes with a picture was asked for, on the master's machine, to the moment at which the viewer has it all. The picture itself may be one",
        "frame older."))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""scripts/bench_viewers: what browsers cost a cluster, and what one sees on a thin line."""
import argparse
import contextlib
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from bench_lib import links, output, viewer  # noqa: E402  the path comes first
from bench_lib.cluster import Cluster, Failure, ended, last_line, program, progress, scene_file  # noqa: E402
from bench_lib.processor_time import Meter  # noqa: E402
from report_lib.tables import Table  # noqa: E402

from browser import Viewer, request  # noqa: E402  found by viewer

SCENE, VIEWERS = "table_room", 8
EVENT = 0.05  # seconds between two moves of the pointer
WITHIN = 60  # seconds for whatever is waited for
RECORDED, CALM = 4, 40  # frames of a session: that are recorded; after which its viewers get two pictures a second
SETTLED = 5  # seconds after which a viewer on a good line gets pictures without loss


def parse(words):
    parser = argparse.ArgumentParser(prog="bench_viewers", description=__doc__.splitlines()[0])
    parser.add_argument("--clients", type=int, default=16, help="replayed")
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--slower", type=float, nargs="+", default=[1, 4], metavar="F",
                        help="replayed clients take F times as long, so that they leave the master and the viewers their cores")
    parser.add_argument("--seconds", type=float, default=10, help="of one measurement")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--mbit", type=float, default=5, help="of the thin line")
    parser.add_argument("--delay-ms", type=float, default=50, help="of the thin line, one way")
    parser.add_argument("--quick", action="store_true", help="one round of 5 seconds")
    options = parser.parse_args(words)
    if options.quick:
        options.seconds, options.rounds = 5, 1
    return options


class Session:
    """A master that serves, and what it said."""

    def __init__(self, cluster, arguments, address, prefix=()):
        self.host = address.partition(":")[0]
        self.log = os.path.join(cluster.folder, "master.log")
        command = [*prefix, program("ninefold-master"), scene_file(SCENE), *map(str, arguments), "--key-file", cluster.key,
                   "--serve", address]
        with open(self.log, "w", encoding="utf-8") as file:
            self.master = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=file)

    def __enter__(self):
        try:
            self.port = self.said(r"listening on \S+:(\d+)")[1]
            self.site, self.token = self.said(r"serving at \S+:(\d+)/#token=(\S+)").groups()
        except Failure:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        with ended(self.master):
            pass

    def said(self, pattern):
        return until(lambda: re.search(pattern, pathlib.Path(self.log).read_text(encoding="utf-8")),
                     lambda: f"the master says no {pattern}: {last_line(self.log)}", self.master)

    def frames(self):
        _, _, body = request("127.0.0.1", int(self.site), "/metrics", Authorization=f"Bearer {self.token}")
        return float(re.search(r"^ninefold_frames_total (\S+)$", body.decode(), re.M)[1])

    def reach(self, frames, *others):
        until(lambda: self.frames() >= frames, lambda: f"no {frames} frames: {last_line(self.log)}", self.master, *others)

    def rate(self, seconds):
        first, begin = self.frames(), time.monotonic()
        time.sleep(seconds)
        return (self.frames() - first) / (time.monotonic() - begin)

    def meter(self, viewers):
        return Meter({"master": [self.master], "viewers": viewers}, {"browsers"})


def until(found, why, *processes):
    """What `found` gives once it is something; a Failure if that takes too long or one of the processes ends."""
    end = time.monotonic() + WITHIN
    while time.monotonic() < end and all(process.poll() is None for process in processes):
        if result := found():
            return result
        time.sleep(0.05)
    raise Failure(why())


def looking(host, port, token, seconds, prefix=(), stdout=subprocess.DEVNULL):
    return ended(subprocess.Popen([*prefix, sys.executable, viewer.__file__, host, port, token, str(seconds)], stdout=stdout,
                                  text=True))


def orbiting(port, token, seconds):
    return ended(subprocess.Popen([*links.within(links.MASTER), sys.executable, __file__, "--orbit", port, token, str(seconds)],
                                  stdout=subprocess.PIPE, text=True))


def started(name, session, cluster, *options):
    """A program that is no master, at the session's."""
    command = [program(name), "--master", f"127.0.0.1:{session.port}", "--key-file", cluster.key, *map(str, options)]
    return ended(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))


def record(cluster, size):
    """A session asks for more than a picture without anybody: its first frame says what is where."""
    progress("one real client in a session, recorded")
    file = os.path.join(cluster.folder, "session.recording")
    with Session(cluster, [*size, "--local-clients", 0], "127.0.0.1:0") as session, \
            started("ninefold-client", session, cluster, "--threads", 1, "--cache", "none", "--record", file) as client:
        session.reach(RECORDED, client)
        session.master.terminate()
        client.wait(WITHIN)
    return file


def cost(cluster, options, table):
    """Rounds in which the cluster is looked at and not, by turns."""
    size = ["--size", options.size, "--wire-level", "1"]
    recording = record(cluster, size)
    for slower in options.slower:
        with Session(cluster, [*size, "--local-clients", 0, "--wait-clients", options.clients], "127.0.0.1:0") as session, \
                started("ninefold-replay-client", session, cluster, "--recording", recording, "--clients", options.clients,
                        "--pace", "recorded", "--slower", slower) as replay:
            session.reach(CALM, replay)
            add(table, options, slower, *rounds(session, options, slower))


def rounds(session, options, slower):
    """Frames a second, and what they cost with viewers: lists, one entry a round."""
    rates, costs = {0: [], VIEWERS: []}, []
    for number in range(options.rounds):
        for count in rates:
            progress(f"{slower:g} times as slow, round {number + 1} of {options.rounds}: {count} viewers")
            with contextlib.ExitStack() as stack:
                viewers = [stack.enter_context(looking("127.0.0.1", session.site, session.token, options.seconds + WITHIN))
                           for _ in range(count)]
                time.sleep(SETTLED)
                meter = session.meter(viewers)
                rates[count].append(session.rate(options.seconds))
                if count:
                    costs.append(meter.share())
    return rates, costs


def add(table, options, slower, rates, costs):
    ratios = [b / a for a, b in zip(rates[0], rates[VIEWERS])]
    cost = {name: statistics.median(each[name] for each in costs) for name in costs[0]}
    table.data.append({"clients": options.clients, "slower": slower, "processor": cost, "fps": statistics.median(rates[0]),
                       "watched_fps": statistics.median(rates[VIEWERS]), "ratio": statistics.median(ratios)})
    table.rows.append([str(options.clients), f"{slower:g}", *(f"{statistics.median(r):.2f}" for r in rates.values()),
                       f"{100 * (statistics.median(ratios) - 1):+.1f} %",
                       f"{100 * (min(ratios) - 1):+.1f} to {100 * (max(ratios) - 1):+.1f} %",
                       *(f"{100 * cost[name]:.1f} %" for name in ("browsers", "viewers"))])


def thin_line(cluster, options, table):
    """Two local clients render; somebody on this machine orbits, and tells the time by the exposure."""
    progress(f"a viewer behind {options.mbit:g} Mbit/s and {options.delay_ms:g} ms")
    with links.line(options.mbit, options.delay_ms):
        with Session(cluster, ["--size", options.size], "0.0.0.0:4750", links.within(links.MASTER)) as session:
            at = session.site, session.token
            with orbiting(*at, options.seconds + 3) as near:  # who comes first is in control
                first = near.stdout.readline()
                with looking(links.ADDRESS, *at, options.seconds + 1, links.within(links.CLIENTS), subprocess.PIPE) as far:
                    times = {entry["exposure"]: entry["time"] for entry in map(json.loads, filter(str.strip, [first, *near.stdout]))}
                    shown = list(map(json.loads, far.stdout))
    if not times:
        raise Failure("nobody could orbit")
    begin = min(entry["time"] for entry in shown) + 1 if shown else 0  # then the pace has found the form
    seen = [entry for entry in shown if begin <= entry["time"] and entry["exposure"] in times]
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
    near = Viewer(links.ADDRESS, int(port), token, certificate=True)
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
    watched = Table("cost", ["replay clients", "F", "frames/s", f"with {VIEWERS} viewers", "change", "of rounds",
                             "master's thread for browsers", "viewers' programs"])
    thin = Table("thin_line", ["line", "pictures/s", "age p50 [ms]", "p95 [ms]", "max [ms]", "KiB a picture"])
    try:
        with Cluster() as cluster:
            cost(cluster, options, watched)
            thin_line(cluster, options, thin)
    except Failure as failure:
        print(f"bench_viewers: {failure}", file=sys.stderr)
        return 1
    output.write_table("bench_viewers", "A cluster that is looked at", watched, (
        f"{SCENE} {options.size} at rest. Replayed: NOT rendering: clients answer with what one real client gave, after F",
        "times the time that it took. Viewers and clients are on the master's own cores; the last two columns are processor time",
        "with viewers, in parts of one core: what the master does for them, and what they do themselves, elsewhere in a real cluster."))
    output.write_table("bench_viewers", "A viewer on a thin line", thin, (
        f"{SCENE} {options.size}, two local clients that render, the camera moving all along. Age: from the moment at which",
        "the exposure that comes with a picture was asked for, on the master's machine, to the moment at which the viewer has it",
        "all. The picture itself may be one frame older."))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Two network namespaces with a shaped line between them. Needs root; leaves nothing behind."""
import contextlib
import subprocess

from bench_lib.cluster import Failure, ended, program

MASTER, CLIENTS = "ninefold-bench-m", "ninefold-bench-c"
ADDRESS = "10.77.0.1"  # the master's
BURST = {20: "64kb", 100: "64kb", 1000: "256kb", 10000: "2mb"}  # tbf needs at least a timer tick's worth


def sh(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Failure(f"{' '.join(words)}: {done.stderr.strip()}")


def within(space):
    return ["ip", "netns", "exec", space]


@contextlib.contextmanager
def namespaces():
    with contextlib.ExitStack() as stack:
        for space in (MASTER, CLIENTS):
            sh("ip", "netns", "add", space)
            stack.callback(sh, "ip", "netns", "del", space)
            sh(*within(space), "ip", "link", "set", "lo", "up")
        yield


@contextlib.contextmanager
def line(mbit, delay_ms=0, loss=0, cut=None):
    """mbit: 0 = as fast as it goes. A token bucket on a veth pair, or the relay where packets must wait or get lost."""
    with namespaces():
        if delay_ms or loss or cut:
            with relay(mbit, delay_ms, loss, cut):
                yield
        else:
            veth(mbit)
            yield


def up(space, device, address):
    sh(*within(space), "ip", "address", "add", address + "/24", "dev", device)
    sh(*within(space), "ip", "link", "set", device, "up")


def veth(mbit):
    sh("ip", "link", "add", "nfm", "netns", MASTER, "type", "veth", "peer", "name", "nfc", "netns", CLIENTS)
    up(MASTER, "nfm", ADDRESS)
    up(CLIENTS, "nfc", "10.77.0.2")
    for space, device in ((MASTER, "nfm"), (CLIENTS, "nfc")):
        if mbit:
            sh(*within(space), "tc", "qdisc", "add", "dev", device, "root", "tbf", "rate", f"{mbit}mbit", "burst",
               BURST.get(mbit, "2mb"), "latency", "50ms")


@contextlib.contextmanager
def relay(mbit, delay_ms, loss, cut):
    command = [program("ninefold-link-relay"), MASTER, CLIENTS, "--mbit", str(mbit), "--delay-ms", str(delay_ms),
               "--loss", str(loss), *(["--cut", cut] if cut else [])]
    with ended(subprocess.Popen(command, stdout=subprocess.PIPE, text=True)) as process:
        if process.stdout.readline().strip() != "ready":
            raise Failure(f"{' '.join(command)} failed")
        up(MASTER, "nfrelay", ADDRESS)
        up(CLIENTS, "nfrelay", "10.77.0.2")
        yield

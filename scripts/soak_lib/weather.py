"""Clients of a master, and what befalls them."""
import os
import signal
import time

from programs import BIN
from soak_lib.line import Line

GUESTS = 3  # the first of them is left in peace, so that something moves at every moment


class Guest:
    def __init__(self, place, port):
        self.place = place
        self.line = Line(port)
        self.program = None
        self.thaws = None  # when it is to go on
        self.join()

    def join(self):
        if self.program:
            self.place.forget(self.program)
        self.program = self.place.start(BIN / "ninefold-client", "--master", self.line.address, "--key-file", "cluster.key",
                                        "--threads", 1, "--cache", "none")

    def signal(self, what):
        if self.program.process.poll() is None:
            os.kill(self.program.process.pid, what)

    def thaw(self):
        if self.thaws:
            self.signal(signal.SIGCONT)
        self.thaws = None


class Weather:
    """`place`: starts programs in the session's folder. `port`: the master's."""

    def __init__(self, place, port, random):
        self.place, self.port, self.random = place, port, random
        self.guests = [Guest(place, port) for _ in range(GUESTS)]
        self.strangers = []  # (program, what it must say)
        self.faults = []
        self.counts = {}
        self.next = 0.0  # when the next misfortune comes

    def gust(self):
        """A misfortune if it is time for one."""
        if time.monotonic() < self.next:
            return
        self.step()
        self.next = time.monotonic() + self.random.uniform(0.2, 1)

    def wait_for_gust(self):
        time.sleep(max(0, self.next - time.monotonic()))
        self.gust()

    def step(self):
        """One misfortune, and the end of those that are over."""
        now = time.monotonic()
        for guest in self.guests:
            if guest.thaws and now >= guest.thaws:
                guest.thaw()
            if guest.program.process.poll() is not None:
                guest.join()
        self.look_at_strangers()
        what = self.random.choice([self.kill, self.freeze, self.cut, self.slow, self.hasten, self.other_release, self.wrong_key])
        what(self.random.choice(self.guests[1:]))
        self.counts[what.__name__] = self.counts.get(what.__name__, 0) + 1

    def kill(self, guest):
        guest.thaw()
        guest.signal(signal.SIGKILL)

    def freeze(self, guest):
        guest.signal(signal.SIGSTOP)
        guest.thaws = time.monotonic() + self.random.uniform(0.2, 8)  # the master gives up after 3

    def cut(self, guest):
        guest.line.cut()

    def slow(self, guest):
        guest.line.pause = self.random.uniform(0.01, 0.3)

    def hasten(self, guest):
        guest.line.pause = 0

    def other_release(self, _):
        self.stranger(self.place.other_client, "cluster.key", "runs Ninefold")

    def wrong_key(self, _):
        self.stranger(BIN / "ninefold-client", "wrong.key", "does not accept this key")

    def stranger(self, program, key, says):
        self.strangers.append((self.place.start(program, "--master", f"127.0.0.1:{self.port}", "--key-file", key, "--threads", 1,
                                                "--cache", "none"), says))

    def look_at_strangers(self):
        """Those that have ended were told why. Who came while no master was there still waits for one."""
        for program, says in [s for s in self.strangers if s[0].process.poll() is not None]:
            if program.ends() != 1 or says not in program.text:
                self.faults.append(f"a stranger was to be told {says!r}: status {program.ends()}, {program.text!r}")
            self.strangers.remove((program, says))
            self.place.forget(program)

    def clear_up(self):
        for guest in self.guests:
            guest.thaw()
            guest.line.pause = 0
        for program, _ in self.strangers:
            program.ends()  # a master is there, which tells them
        self.look_at_strangers()

    def end(self):
        for guest in self.guests:
            guest.program.process.terminate()
        for guest in self.guests:
            guest.program.ends()
            guest.line.close()

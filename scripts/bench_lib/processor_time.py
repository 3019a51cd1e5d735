"""How much processor time programs take, and threads of them."""
import os
import pathlib
import time

TICK = os.sysconf("SC_CLK_TCK")


def read(stat):
    """(name, seconds) of what a stat file of /proc tells."""
    head, _, rest = pathlib.Path(stat).read_text(encoding="utf-8").rpartition(")")
    fields = rest.split()
    return head.partition("(")[2], (int(fields[11]) + int(fields[12])) / TICK


class Meter:
    """From its making on. `programs`: name -> processes; `threads`: names of threads, in any of them, that are told apart, too."""

    def __init__(self, programs, threads=()):
        self.programs, self.threads = programs, threads
        self.begin, self.before = time.monotonic(), self._seconds()

    def _seconds(self):
        seconds = dict.fromkeys(self.threads, 0)
        for name, processes in self.programs.items():
            seconds[name] = sum(read(f"/proc/{process.pid}/stat")[1] for process in processes)
            for process in processes:
                for task in pathlib.Path(f"/proc/{process.pid}/task").iterdir():
                    thread, taken = read(task / "stat")
                    if thread in self.threads:
                        seconds[thread] += taken
        return seconds

    def share(self):
        """Of one core, in the mean since the meter was made."""
        past = time.monotonic() - self.begin
        return {name: (seconds - self.before[name]) / past for name, seconds in self._seconds().items()}

"""What must not grow and must not stay: memory, processes, files."""
import pathlib
import time

from programs import own_memory


class Memory:
    """Samples of some processes, a second apart."""
    SETTLED = 10  # seconds of a process's life in which pools fill

    def __init__(self):
        self.samples = {}  # (name, pid) -> list of (time, bytes)

    def look(self, processes):
        for name, pid in processes:
            seen = self.samples.setdefault((name, pid), [])
            memory = own_memory(pid)
            if memory and (not seen or time.monotonic() - seen[-1][0] >= 1):
                seen.append((time.monotonic(), memory))

    def growths(self):
        """(name, seconds looked at, first settled bytes, growth) of each process that lived long enough to tell."""
        for (name, _), seen in self.samples.items():
            settled = [memory for moment, memory in seen if moment >= seen[0][0] + self.SETTLED]
            if len(settled) < 16:
                continue
            quarter = len(settled) // 4
            yield name, len(settled), settled[0], max(settled[-quarter:]) - max(settled[:2 * quarter])


def processes_of(folder):
    """Command lines of all processes whose home is the folder."""
    found = []
    for place in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if f"HOME={folder}".encode() in (place / "environ").read_bytes().split(b"\0"):
                found.append((place / "cmdline").read_bytes().replace(b"\0", b" ").decode())
        except OSError:
            continue  # ended, or another's
    return found


def files_of(folder):
    return {str(path.relative_to(folder)) for path in pathlib.Path(folder).rglob("*") if path.is_file()}

"""Debian systems in folders: made by debootstrap once for each release, entered by chroot, or booted."""
import contextlib
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CACHE = ROOT / "build/systems"


class Failure(Exception):
    pass


def run(*words, **more):
    """Its standard output; a Failure with all that it said if it fails."""
    done = subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          stdin=subprocess.DEVNULL, check=False, **more)
    if done.returncode != 0:
        raise Failure(f"{' '.join(map(str, words))}: status {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


class System:
    """One that is not booted."""

    def __init__(self, folder):
        self.folder = folder

    def run(self, command, compiled=None, **more):
        """`compiled`: a folder where ccache keeps what it has compiled."""
        # Mounts go with the command.
        mounts = 'mount --bind /proc "$0/proc"; mount --bind /dev "$0/dev"; '
        if compiled:
            mounts += f'mkdir -p "$0/root/.cache/ccache"; mount --bind "{compiled}" "$0/root/.cache/ccache"; '
        mounts += 'exec chroot "$0" "$@"'
        return run("unshare", "--mount", "sh", "-ec", mounts, self.folder, "env", "-i", "HOME=/root", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL=C",
                   "DEBIAN_FRONTEND=noninteractive", "sh", "-c", f"cd /root && {command}", **more)

    def install(self, *packages):
        self.run("apt-get update -qq && apt-get install -y -qq --no-install-recommends " + " ".join(packages))

    def path(self, inside):
        return self.folder / inside.lstrip("/")

    def has(self, package):
        return f"{package}/" in self.run("apt list --installed 2> /dev/null")


def empty(release):
    """The tar of a system with nothing but what every Debian has."""
    tar = CACHE / f"{release}.tar"
    if not tar.exists():
        CACHE.mkdir(parents=True, exist_ok=True)
        with folder(CACHE) as place:
            run("debootstrap", "--variant=minbase", release, place / "root", "http://deb.debian.org/debian")
            run("tar", "-C", place / "root", "-cf", place / "tar", ".")
            (place / "tar").rename(tar)
    return tar


@contextlib.contextmanager
def folder(parent):
    place = pathlib.Path(tempfile.mkdtemp(prefix="system-", dir=parent))
    try:
        yield place
    finally:
        shutil.rmtree(place)


@contextlib.contextmanager
def system(release, files=None):
    """With the files of the folder `files`, if any, at their places."""
    tar = empty(release)
    with folder(CACHE) as place:
        place.chmod(0o755)
        run("tar", "-C", place, "-xf", tar)
        shutil.copy("/etc/resolv.conf", place / "etc/resolv.conf")
        if files:
            shutil.copytree(files, place, dirs_exist_ok=True)
        # Nothing here must outlive a power cut.
        (place / "etc/dpkg/dpkg.cfg.d/unsafe-io").write_text("force-unsafe-io\n")
        yield System(place)


class Machine:
    """A system that has booted systemd, with a network of its own that has loopback only."""

    def __init__(self, process):
        self.process = process
        self.leader = self._find_leader()

    def _find_leader(self):
        children = pathlib.Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children")
        for _ in range(600):
            if self.process.poll() is not None:
                raise Failure("systemd-nspawn ended")
            for pid in children.read_text().split():
                if pathlib.Path(f"/proc/{pid}/comm").read_text().strip() == "systemd":
                    return pid
            time.sleep(0.1)
        raise Failure("systemd does not come up")

    def words(self, command):
        return ["nsenter", "-t", self.leader, "-m", "-u", "-i", "-n", "-p", "env", "-i", "HOME=/root",
                "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL=C", "sh", "-ec", f"cd /root; {command}"]

    def run(self, command, **more):
        return run(*self.words(command), timeout=180, **more)

    def start(self, command):
        return subprocess.Popen(self.words(command), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                stdin=subprocess.DEVNULL, text=True)

    def until(self, command):
        for _ in range(600):
            with contextlib.suppress(Failure):
                return self.run(command)
            time.sleep(0.1)
        return self.run(command)  # says why


@contextlib.contextmanager
def booted(place):
    with open(CACHE / "boot.log", "w", encoding="utf-8") as log:
        process = subprocess.Popen(["systemd-nspawn", "--quiet", "--register=no", "--keep-unit", "--private-network",
                                    "--console=pipe", "-D", str(place.folder), "--boot"], stdin=subprocess.DEVNULL,
                                   stdout=log, stderr=subprocess.STDOUT)
    try:
        machine = Machine(process)
        machine.until("systemctl is-system-running --wait | grep -Ex 'running|degraded'")
        try:
            yield machine
        finally:
            os.kill(int(machine.leader), signal.SIGKILL)  # all of it: nobody writes into the folder any more
            process.wait(60)
    finally:
        process.kill()
        process.wait()

"""slurm_cluster.py: a real Slurm on this machine: munged, slurmctld and a slurmd for each node, each node with a network
namespace and a host name of its own, joined by a bridge."""
import os
import pathlib
import shutil
import subprocess
import unittest

from programs import eventually

PROGRAMS = ["munged", "slurmctld", "slurmd", "srun", "sbatch", "scontrol", "ip", "nsenter", "unshare"]
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"
NETWORK = "10.78.0."


def ip(*words):
    subprocess.run(["ip", *map(str, words)], check=True, capture_output=True)


class WithSlurm(unittest.TestCase):
    """Starts it with `NODES` nodes n1, n2, ...; the machine head has slurmctld."""
    NODES = 3

    def setUp(self):
        super().setUp()
        missing = [name for name in PROGRAMS if not shutil.which(name, path=PATH)]
        if missing or os.geteuid() != 0:
            self.skipTest(f"needs root and: {' '.join(missing)} (scripts/install_packages launchers)")
        self.slurm = self.folder / "slurm"
        self.slurm.mkdir()
        self.hosts = ["head"] + [f"n{i}" for i in range(1, self.NODES + 1)]
        self.spaces = {host: f"nfs{os.getpid()}{host}" for host in self.hosts}
        self.join_hosts()
        self.configure()
        self.start_daemons()

    def join_hosts(self):
        """A bridge in a namespace of its own, so that nothing of this machine's network changes."""
        switch = f"nfs{os.getpid()}"
        for space in [switch, *self.spaces.values()]:
            try:
                ip("netns", "add", space)
            except subprocess.CalledProcessError as error:
                self.skipTest(f"no network namespaces here: {error.stderr.decode().strip()}")
            self.addCleanup(subprocess.run, ["ip", "netns", "del", space], capture_output=True)
        ip("-n", switch, "link", "add", "bridge", "type", "bridge")
        ip("-n", switch, "link", "set", "bridge", "up")
        for number, (host, space) in enumerate(self.spaces.items()):
            ip("-n", switch, "link", "add", host, "type", "veth", "peer", "name", "lan", "netns", space)
            ip("-n", switch, "link", "set", host, "master", "bridge", "up")
            ip("-n", space, "addr", "add", f"{NETWORK}{10 + number}/24", "dev", "lan")
            ip("-n", space, "link", "set", "lan", "up")
            ip("-n", space, "link", "set", "lo", "up")

    def configure(self):
        nodes = f"n[1-{self.NODES}]"
        (self.slurm / "state").mkdir()
        (self.slurm / "slurm.conf").write_text(f"""
ClusterName=ninefold
SlurmctldHost=head({NETWORK}10)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={self.slurm}/munge.socket
CredType=cred/munge
StateSaveLocation={self.slurm}/state
SlurmdSpoolDir={self.slurm}/spool.%n
SlurmctldPidFile={self.slurm}/slurmctld.pid
SlurmdPidFile={self.slurm}/slurmd.%n.pid
SlurmctldLogFile={self.slurm}/slurmctld.log
SlurmdLogFile={self.slurm}/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/linear
SchedulerParameters=defer_batch,batch_sched_delay=0
ReturnToService=2
SlurmdParameters=config_overrides
NodeName={nodes} NodeAddr={NETWORK}[11-{10 + self.NODES}] CPUs=2 State=UNKNOWN
PartitionName=all Nodes={nodes} Default=YES MaxTime=10 State=UP
""")

        # Slurm looks for control groups even where it is to use none.
        is_old = pathlib.Path("/sys/fs/cgroup/memory").exists()
        (self.slurm / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n" if is_old else "IgnoreSystemd=yes\n")

    def on(self, host):
        """The words before a command that runs on that host."""
        return ["nsenter", f"--net=/run/netns/{self.spaces[host]}", "unshare", "--uts", "sh", "-c",
                f'hostname {host}; exec "$0" "$@"', "env", f"PATH={PATH}", f"SLURM_CONF={self.slurm}/slurm.conf"]

    def start_daemons(self):
        key = self.slurm / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        self.start(shutil.which("munged", path=PATH), "--foreground", "--force", f"--key-file={key}",
                   f"--socket={self.slurm}/munge.socket", f"--pid-file={self.slurm}/munge.pid",
                   f"--log-file={self.slurm}/munge.log", f"--seed-file={self.slurm}/munge.seed")
        eventually(lambda: (self.slurm / "munge.socket").exists(), "munged listens")
        self.start(*self.on("head"), "slurmctld", "-D")
        for host in self.hosts[1:]:
            self.start(*self.on(host), "slurmd", "-D")
        eventually(lambda: self.nodes_in("idle") == self.NODES, "all nodes are idle")

    def nodes_in(self, state):
        said = subprocess.run([*self.on("head"), "sinfo", "-h", "-N", "-t", state, "-o", "%N"], capture_output=True, text=True)
        return len(said.stdout.split())

    def log_of(self, name):
        path = self.slurm / f"{name}.log"
        return path.read_text(errors="replace") if path.exists() else ""



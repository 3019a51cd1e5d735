"""scripts/bench_scalability --hosts: clients that ssh starts, here on this machine through an sshd of the test's own.

The picture is the one that local clients make, and no key file stays behind.
"""
import getpass
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from bench_lib.cluster import Cluster, ended, program  # noqa: E402  the path comes first
from bench_lib.hosts import Hosts  # noqa: E402

SSHD = shutil.which("sshd", path=os.environ["PATH"] + ":/usr/sbin:/sbin")
JOB = ["--size", "96x64", "--frames", 2]


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


@unittest.skipUnless(SSHD, "no sshd on this machine (package openssh-server)")
class OverSsh(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ninefold-ssh-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("host", "user"):
            subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", self.folder / name], check=True)
        self.port = free_port()
        self.start_sshd()
        self.put_ssh_first()

    def start_sshd(self):
        (self.folder / "sshd_config").write_text(
            f"Port {self.port}\nListenAddress 127.0.0.1\nHostKey {self.folder}/host\n"
            f"AuthorizedKeysFile {self.folder}/user.pub\nPidFile none\nStrictModes no\nUsePAM no\n"
            f"PasswordAuthentication no\nSetEnv TMPDIR={self.folder}/remote\n")
        (self.folder / "remote").mkdir()
        sshd = subprocess.Popen([SSHD, "-D", "-e", "-f", self.folder / "sshd_config"], stderr=subprocess.PIPE, text=True)
        stop = ended(sshd)
        stop.__enter__()
        self.addCleanup(stop.__exit__, None, None, None)
        self.addCleanup(sshd.stderr.close)
        line = sshd.stderr.readline()
        self.assertIn("listening", line, "sshd does not start")

    def put_ssh_first(self):
        """An ssh that knows the test's host and key."""
        known = (self.folder / "host.pub").read_text().split()[:2]
        (self.folder / "known").write_text(f"[127.0.0.1]:{self.port} {' '.join(known)}\n")
        (self.folder / "ssh_config").write_text(
            f"Host elsewhere\n HostName 127.0.0.1\n Port {self.port}\n User {getpass.getuser()}\n"
            f" IdentityFile {self.folder}/user\n IdentitiesOnly yes\n UserKnownHostsFile {self.folder}/known\n")
        (self.folder / "bin").mkdir()
        ssh = self.folder / "bin" / "ssh"
        ssh.write_text(f'#!/bin/sh\nexec {shutil.which("ssh")} -F {self.folder}/ssh_config "$@"\n')
        ssh.chmod(0o755)
        before = os.environ["PATH"]
        os.environ["PATH"] = f"{ssh.parent}:{before}"
        self.addCleanup(os.environ.__setitem__, "PATH", before)

    def test_clients_on_other_hosts(self):
        hosts = self.folder / "hosts"
        hosts.write_text("# two clients\n" + 2 * f"elsewhere {program('ninefold-client')}\n")
        with Cluster() as cluster:
            far = Hosts(hosts, f"127.0.0.1:{free_port()}", cluster.key)
            self.assertEqual(len(far), 2)
            stats = far.run(cluster, "cornell", JOB, 2)
            near = cluster.real("cornell", JOB, 1)
        self.assertEqual(len(stats["clients"]), 2)
        self.assertEqual(stats["image_hash"], near["image_hash"])
        self.assertEqual([f.name for f in (self.folder / "remote").iterdir()], [], "the key stayed there")


if __name__ == "__main__":
    unittest.main()

"""sshd.py: an ssh server of a test's own on this machine, and an ssh that knows it as the host "elsewhere"."""
import getpass
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import unittest

SSHD = shutil.which("sshd", path=os.environ["PATH"] + ":/usr/sbin:/sbin")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class WithSshServer(unittest.TestCase):
    """`self.keys` has the server's files; what the remote side writes as temporary goes to `self.remote`."""

    def setUp(self):
        super().setUp()
        if not SSHD:
            self.skipTest("no sshd on this machine (scripts/install_packages launchers)")
        folder = tempfile.TemporaryDirectory(prefix="ninefold-ssh-")
        self.addCleanup(folder.cleanup)
        self.keys = pathlib.Path(folder.name)
        self.remote = self.keys / "remote"
        self.remote.mkdir()
        for name in ("host", "user"):
            subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", self.keys / name], check=True)
        self.ssh_port = free_port()
        self.start_sshd()
        self.put_ssh_first()

    def start_sshd(self):
        pathlib.Path("/run/sshd").mkdir(exist_ok=True)  # of privilege separation; gone after a start of the machine
        (self.keys / "sshd_config").write_text(
            f"Port {self.ssh_port}\nListenAddress 127.0.0.1\nHostKey {self.keys}/host\n"
            f"AuthorizedKeysFile {self.keys}/user.pub\nPidFile none\nStrictModes no\nUsePAM no\n"
            f"PasswordAuthentication no\nSetEnv TMPDIR={self.remote}\n")
        self.sshd = subprocess.Popen([SSHD, "-D", "-e", "-f", self.keys / "sshd_config"], stderr=subprocess.PIPE,
                                     text=True)
        self.addCleanup(self.stop_sshd)
        self.assertIn("listening", self.sshd.stderr.readline(), "sshd does not start")

    def stop_sshd(self):
        self.sshd.terminate()
        self.sshd.wait()
        self.sshd.stderr.close()

    def put_ssh_first(self):
        known = (self.keys / "host.pub").read_text().split()[:2]
        (self.keys / "known").write_text(f"[127.0.0.1]:{self.ssh_port} {' '.join(known)}\n")
        (self.keys / "ssh_config").write_text(
            f"Host elsewhere\n HostName 127.0.0.1\n Port {self.ssh_port}\n User {getpass.getuser()}\n"
            f" IdentityFile {self.keys}/user\n IdentitiesOnly yes\n UserKnownHostsFile {self.keys}/known\n")
        (self.keys / "bin").mkdir()
        ssh = self.keys / "bin" / "ssh"
        ssh.write_text(f'#!/bin/sh\nexec {shutil.which("ssh")} -F {self.keys}/ssh_config "$@"\n')
        ssh.chmod(0o755)
        before = os.environ["PATH"]
        os.environ["PATH"] = f"{ssh.parent}:{before}"
        self.addCleanup(os.environ.__setitem__, "PATH", before)

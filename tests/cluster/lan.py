"""lan.py: two hosts of their own: network namespaces joined by a virtual cable."""
import os
import shutil
import subprocess
import unittest

from programs import ClusterTest


def ip(*arguments):
    subprocess.run(["ip", *arguments], check=True, capture_output=True)


@unittest.skipUnless(os.geteuid() == 0 and shutil.which("ip"), "needs root and ip(8)")
class LanTest(ClusterTest):
    """Host 0 is 10.77.0.1 and host 1 10.77.0.2."""

    def setUp(self):
        super().setUp()
        self.hosts = [f"nf{os.getpid()}{side}" for side in "ab"]
        try:
            for host in self.hosts:
                ip("netns", "add", host)
                self.addCleanup(subprocess.run, ["ip", "netns", "del", host], capture_output=True)
            a, b = self.hosts
            ip("-n", a, "link", "add", "lan", "type", "veth", "peer", "lan", "netns", b)
            for number, host in enumerate(self.hosts, 1):
                ip("-n", host, "addr", "add", f"10.77.0.{number}/24", "dev", "lan")
                ip("-n", host, "link", "set", "lan", "up")
                ip("-n", host, "link", "set", "lo", "up")
        except subprocess.CalledProcessError as error:
            self.skipTest(f"no network namespaces here: {error.stderr.decode().strip()}")

    def on(self, host):
        return ["ip", "netns", "exec", self.hosts[host]]


__all__ = ["LanTest", "ip"]

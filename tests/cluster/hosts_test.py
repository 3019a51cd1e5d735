"""Clients that ssh starts, here on this machine through an sshd of the test's own: ninefold-master --hosts, and
scripts/bench_scalability --hosts.

The picture is the one that local clients make, and no key file stays behind.
"""
import os
import pathlib
import signal
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from bench_lib.cluster import Cluster, program  # noqa: E402  the path comes first
from bench_lib.hosts import Hosts  # noqa: E402
from programs import BIN, ClusterTest, eventually, is_running  # noqa: E402
from sshd import WithSshServer, free_port  # noqa: E402

JOB = ["--size", "96x64", "--frames", 2]


class Benchmark(WithSshServer):
    def test_clients_on_other_hosts(self):
        hosts = self.keys / "hosts"
        hosts.write_text("# two clients\n" + 2 * f"elsewhere {program('ninefold-client')}\n")
        with Cluster() as cluster:
            far = Hosts(hosts, f"127.0.0.1:{free_port()}", cluster.key)
            self.assertEqual(len(far), 2)
            stats = far.run(cluster, "cornell", JOB, 2)
            near = cluster.real("cornell", JOB, 1)
        self.assertEqual(len(stats["clients"]), 2)
        self.assertEqual(stats["image_hash"], near["image_hash"])
        self.assertEqual([f.name for f in self.remote.iterdir()], [], "the key stayed there")


def remote_clients():
    """Process ids of clients that ssh has started."""
    found = []
    for line in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = line.read_bytes().split(b"\0")
        except OSError:
            continue  # ended meanwhile
        if words[0].endswith(b"/ninefold-client") and words[0].startswith(os.fsencode(BIN)) and b"--name=elsewhere" in words:
            found.append(int(line.parent.name))
    return sorted(found)


class Master(WithSshServer, ClusterTest):
    def setUp(self):
        super().setUp()
        self.new_key()
        (self.folder / "hosts").write_text(f"# the lab\nelsewhere {BIN}/ninefold-client  # one\n")

    def start_master(self, *options, **more):
        return self.master("--local-clients", 0, "--listen", "0.0.0.0:0", "--key-file", "cluster.key", "--hosts", "hosts",
                           *options, **more)

    def test_clients_on_hosts_render_and_end_with_the_master(self):
        near = self.render("--local-clients", 1)
        (self.folder / "hosts").write_text(2 * f"elsewhere {BIN}/ninefold-client\n")
        stats = self.finish(self.start_master("--wait-clients", 2))
        self.assertEqual([c["name"] for c in stats["clients"]], ["elsewhere", "elsewhere"])
        self.assertEqual(stats["image_hash"], near["image_hash"])
        eventually(lambda: not remote_clients(), "no client is left")
        self.assertEqual([f.name for f in self.remote.iterdir()], [], "no key file was there")

    def test_a_client_that_dies_is_started_again_and_the_picture_is_the_same(self):
        near = self.render("--local-clients", 1)
        master = self.start_master("--wait-clients", 2)  # so that nothing is rendered before another one comes
        master.waits_for(r"client 1 is ready")
        (first,) = remote_clients()
        self.send(first, signal.SIGKILL)
        master.waits_for(r"the client on elsewhere ended with .*; starting it again in 1\.0 s")
        master.waits_for(r"client 2 is ready")
        other = self.client(self.address_of(master).replace("0.0.0.0", "127.0.0.1"))
        stats = self.finish(master)
        self.assertEqual(other.ends(), 0, other.text)
        self.assertEqual(stats["image_hash"], near["image_hash"])
        self.assertEqual([c["name"] for c in stats["clients"]].count("elsewhere"), 2)

    def test_a_killed_master_leaves_no_client_on_a_host(self):
        master = self.start_master("--seconds", 1000, frames=None)
        master.waits_for(r"client 1 is ready")
        (client,) = remote_clients()
        self.send(master.process.pid, signal.SIGKILL)
        master.ends()
        eventually(lambda: not is_running(client), "the client on the host has ended")

    def test_a_host_that_refuses_is_asked_again_and_holds_nobody_up(self):
        (self.folder / "hosts").write_text("elsewhere /nowhere/ninefold-client\n")
        master = self.master("--local-clients", 1, "--listen", "0.0.0.0:0", "--key-file", "cluster.key", "--hosts", "hosts",
                             "--seconds", 1000, frames=None)
        master.waits_for(r"the client on elsewhere ended with exit status 127; starting it again")
        master.waits_for(r"progress: \d+% frame [1-9]")
        self.send(master.process.pid, signal.SIGTERM)
        self.assertEqual(master.ends(), 143)

    def test_a_list_that_cannot_be_read_ends_the_master_before_anything_else(self):
        (self.folder / "hosts").write_text("elsewhere\n-oProxyCommand=touch$IFS$HOME/x\n")
        master = self.start_master()
        self.assertEqual(master.ends(), 1)
        self.assertIn("hosts:2", master.lines[-1])
        self.assertFalse(master.picture.exists())


if __name__ == "__main__":
    unittest.main()

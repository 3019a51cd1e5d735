"""Clients that come over the network: late, with the wrong key, or not clients at all."""
import os
import random
import socket
import subprocess
import threading
import time
import unittest

from lan import LanTest, ip
from programs import BIN, ClusterTest, signal


class UnevenLine:
    """A port that passes bytes on to another one and back, each piece after a random pause."""

    def __init__(self, address, seed):
        self.random = random.Random(seed)
        host, _, port = address.rpartition(":")
        self.target = (host, int(port))
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.address = f"127.0.0.1:{self.listener.getsockname()[1]}"
        self.thread = threading.Thread(target=self._serve)
        self.thread.start()

    def _serve(self):
        try:
            near, _ = self.listener.accept()
        except OSError:
            return  # nobody came
        with near, socket.create_connection(self.target) as far:
            back = threading.Thread(target=self._pump, args=(far, near))
            back.start()
            self._pump(near, far)
            back.join()

    def _pump(self, source, sink):
        try:
            while piece := source.recv(1 << 14):
                time.sleep(self.random.uniform(0, 0.02))
                sink.sendall(piece)
            sink.shutdown(socket.SHUT_WR)
        except OSError:
            pass  # the other side is gone

    def close(self):
        self.listener.shutdown(socket.SHUT_RDWR)
        self.thread.join()
        self.listener.close()


class Network(ClusterTest):
    LONG = 60

    def test_a_client_that_joins_late_renders_its_share(self):
        self.new_key()
        alone = self.render("--local-clients", 1, frames=self.LONG)
        master = self.master("--local-clients", 1, "--key-file", "cluster.key", frames=self.LONG)
        address = self.address_of(master)
        master.waits_for(r"client 1 is ready")
        early = master.children()[0]
        self.send(early, signal.SIGSTOP)  # so that the run cannot end without the late one
        late = self.client(address)
        master.waits_for(r"client 2 is ready")
        self.send(early, signal.SIGCONT)
        stats = self.finish(master)
        self.assertEqual(late.ends(), 0, late.text)
        self.assertEqual(stats["image_hash"], alone["image_hash"])
        shares = [c["tasks"] for c in stats["clients"] if not c["name"].startswith("local")]
        self.assertTrue(shares and shares[0] > 0, stats["clients"])

    def test_a_wrong_key_is_refused_in_one_clear_line_on_both_sides(self):
        self.new_key("right.key")
        self.new_key("wrong.key")
        master = self.master("--local-clients", 0, "--key-file", "right.key", frames=2)
        address = self.address_of(master)
        intruder = self.client(address, key="wrong.key")
        self.assertEqual(intruder.ends(), 1, intruder.text)
        self.assertEqual(len([l for l in intruder.lines if "key" in l]), 1, intruder.text)
        master.waits_for("key")
        friend = self.client(address, key="right.key")
        self.finish(master)
        self.assertEqual(friend.ends(), 0, friend.text)
        for program in (master, intruder, friend):
            for name in ("right.key", "wrong.key"):
                key = (self.folder / name).read_bytes()
                self.assertNotIn(key.hex(), program.text.lower())

    def test_random_bytes_at_the_port_harm_nothing(self):
        alone = self.render("--local-clients", 1, frames=self.LONG)
        master = self.master("--local-clients", 1, frames=self.LONG)
        host, _, port = self.address_of(master).rpartition(":")
        for size in (0, 1, 16, 5000):
            with socket.create_connection((host, int(port)), timeout=10) as stranger:
                stranger.sendall(os.urandom(size))
        stats = self.finish(master)
        self.assertEqual(stats["image_hash"], alone["image_hash"])
        self.assertEqual(len(stats["clients"]), 1)

    def test_results_delayed_and_out_of_order_do_not_show(self):
        alone = self.render("--local-clients", 1, frames=12)
        self.new_key()
        master = self.master("--local-clients", 1, "--key-file", "cluster.key", "--wait-clients", 3,
                             frames=12)
        address = self.address_of(master)
        clients = []
        for seed in (1, 2):
            line = UnevenLine(address, seed)
            self.addCleanup(line.close)
            clients.append(self.client(line.address))
        stats = self.finish(master)
        self.assertEqual(stats["image_hash"], alone["image_hash"])
        for client in clients:
            self.assertEqual(client.ends(), 0, client.text)

    def test_a_client_waits_for_a_restarted_master(self):
        self.new_key()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            address = f"127.0.0.1:{free.getsockname()[1]}"
        options = ["--local-clients", 0, "--key-file", "cluster.key", "--listen", address]
        first = self.master(*options, "--seconds", 1000, frames=None)
        first.waits_for("listening on")
        client = self.client(address)
        first.waits_for(r"progress: \d+% frame [1-9]")
        self.send(first.process.pid, signal.SIGKILL)
        first.ends()
        client.waits_for("trying again")
        second = self.master(*options, frames=2)
        self.finish(second)
        self.assertEqual(client.ends(), 0, client.text)

    def test_ipv6_works_too(self):
        if not socket.has_ipv6 or not os.path.exists("/proc/net/if_inet6"):
            self.skipTest("no IPv6 here")
        stats = self.render("--local-clients", 1, "--listen", "[::1]:0", frames=1)
        self.assertEqual(stats["frames"], 1)

    def test_the_master_says_what_to_type_elsewhere(self):
        self.new_key()
        master = self.master("--local-clients", 0, "--key-file", "cluster.key", frames=2)
        command = master.waits_for(r"(ninefold-client --master \S+ --key-file \S+)").group(1)
        program, *arguments = command.split()
        client = self.start(BIN / program, *arguments, "--cache", "cache")
        self.finish(master)
        self.assertEqual(client.ends(), 0, client.text)
        self.assertTrue(any((self.folder / "cache").iterdir()))


class Lines(LanTest):
    def test_an_empty_client_on_another_host_gets_the_scene_and_renders(self):
        here = self.render("--local-clients", 1, scene="table_room", frames=4)
        self.new_key()
        for attempt in ("empty cache", "full cache"):
            master = self.master("--local-clients", 0, "--listen", "0.0.0.0:4700", "--key-file",
                                 "cluster.key", scene="table_room", frames=4, prefix=self.on(0))
            typed = master.waits_for(r"--master (\S+) --key-file").group(1)
            self.assertEqual(typed, "10.77.0.1:4700")
            client = self.client(typed, prefix=self.on(1), cache="cache")
            stats = self.finish(master)
            self.assertEqual(client.ends(), 0, client.text)
            self.assertEqual(stats["image_hash"], here["image_hash"], attempt)
            self.assertTrue(any((self.folder / "cache").iterdir()))

    def test_a_host_without_an_interface_says_that_nobody_can_come(self):
        ip("-n", self.hosts[0], "link", "set", "lan", "down")
        self.new_key()
        master = self.master("--local-clients", 1, "--listen", "0.0.0.0:4700", "--key-file", "cluster.key", frames=1,
                             prefix=self.on(0))
        self.finish(master)
        self.assertIn("no network interface is up", master.text)

    def test_a_slow_line_carries_fewer_bytes_and_the_same_picture(self):
        self.new_key()
        stats = {}
        for line in ("fast", "slow"):
            if line == "slow":
                for host in self.hosts:
                    shaped = subprocess.run(["ip", "netns", "exec", host, "tc", "qdisc", "add", "dev", "lan", "root",
                                             "tbf", "rate", "4mbit", "burst", "16kb", "latency", "50ms"],
                                            capture_output=True)
                    if shaped.returncode != 0:
                        self.skipTest(f"no token bucket here: {shaped.stderr.decode().strip()}")
            master = self.master("--local-clients", 0, "--listen", "0.0.0.0:4700", "--key-file",
                                 "cluster.key", frames=30, prefix=self.on(0))
            master.waits_for("listening on")
            client = self.client("10.77.0.1:4700", prefix=self.on(1))
            stats[line] = self.finish(master)
            self.assertEqual(client.ends(), 0, client.text)
        self.assertEqual(stats["slow"]["image_hash"], stats["fast"]["image_hash"])
        self.assertLess(stats["slow"]["bytes_received"], 0.9 * stats["fast"]["bytes_received"])

    def test_a_cut_cable_loses_the_client_and_not_the_run(self):
        here = self.render("--local-clients", 1, frames=60)
        self.new_key()
        master = self.master("--local-clients", 1, "--listen", "0.0.0.0:4700", "--key-file",
                             "cluster.key", "--wait-clients", 2, frames=60, prefix=self.on(0))
        master.waits_for("listening on")
        client = self.client("10.77.0.1:4700", prefix=self.on(1))
        master.waits_for(r"is ready(.|\n)*is ready")
        ip("-n", self.hosts[1], "link", "set", "lan", "down")
        stats = self.finish(master)
        self.assertEqual(stats["image_hash"], here["image_hash"])
        client.close()


if __name__ == "__main__":
    unittest.main()

"""Masters that announce themselves on a LAN, and clients that look for them: real D-Bus and Avahi daemons on two hosts."""
import shutil
import socket
import subprocess
import unittest

from lan import LanTest
from programs import BIN, eventually

BUS = """<busconfig><type>system</type><listen>unix:path={socket}</listen><auth>EXTERNAL</auth>
<policy context="default"><allow send_destination="*" eavesdrop="true"/><allow eavesdrop="true"/><allow own="*"/><allow user="*"/></policy></busconfig>
"""
AVAHI = """[server]
host-name=host{host}
use-ipv6=no
allow-interfaces=lan
[wide-area]
enable-wide-area=no
[publish]
[reflector]
[rlimits]
"""


@unittest.skipUnless(shutil.which("avahi-daemon") and shutil.which("dbus-daemon"), "needs avahi-daemon and dbus-daemon")
class Discovery(LanTest):
    def setUp(self):
        super().setUp()
        self.new_key()
        self.avahi = [self.start_daemons(host) for host in (0, 1)]

    def bus(self, host):
        return f"unix:path={self.folder}/bus{host}"

    def start_daemons(self, host):
        """Host `host` gets a system bus of its own; returns its Avahi daemon."""
        (self.folder / f"bus{host}.conf").write_text(BUS.format(socket=self.folder / f"bus{host}"))
        (self.folder / f"avahi{host}.conf").write_text(AVAHI.format(host=host))
        self.start("dbus-daemon", f"--config-file={self.folder}/bus{host}.conf", "--nofork", "--nopidfile")
        eventually((self.folder / f"bus{host}").exists, "a bus")
        return self.start_avahi(host)

    def start_avahi(self, host):
        # The daemon's own folder below /run is this host's alone.
        command = ("mount -t tmpfs tmpfs /run && mkdir /run/avahi-daemon && "
                   f"exec avahi-daemon -f {self.folder}/avahi{host}.conf --no-drop-root --no-chroot --no-rlimits")
        daemon = self.start(*self.on(host), "env", f"DBUS_SYSTEM_BUS_ADDRESS={self.bus(host)}", "sh", "-c", command)
        daemon.waits_for("Server startup complete")
        return daemon

    def at(self, host):
        return [*self.on(host), "env", f"DBUS_SYSTEM_BUS_ADDRESS={self.bus(host)}"]

    def announced(self, port=4700, host=0, listen="0.0.0.0"):
        master = self.master("--local-clients", 0, "--listen", f"{listen}:{port}", "--key-file", "cluster.key",
                             "--announce", prefix=self.at(host))
        master.waits_for("announced on this network as")
        return master

    def seeker(self, *options, host=1):
        return self.start(*self.at(host), BIN / "ninefold-client", "--key-file", "cluster.key", "--threads", 1,
                          "--cache", "none", *options)

    def test_a_client_finds_the_only_master_and_renders(self):
        here = self.render("--local-clients", 1)
        for listen in ("0.0.0.0", "10.77.0.1"):
            master = self.announced(listen=listen)
            client = self.seeker()
            found = client.waits_for(r"found master (\S+) at (\S+), release (\S+)")
            release = subprocess.run([BIN / "ninefold-client", "--version"], capture_output=True, text=True, check=True)
            self.assertEqual(found.groups(), (socket.gethostname(), "10.77.0.1:4700", release.stdout.split()[1]))
            self.assertEqual(self.finish(master)["image_hash"], here["image_hash"])
            self.assertEqual(client.ends(), 0, client.text)

    def test_only_name_address_and_release_are_told(self):
        self.announced()
        said = subprocess.run([*self.at(1), "avahi-browse", "-rpt", "_ninefold._tcp"], capture_output=True, text=True)\
            if shutil.which("avahi-browse") else None
        if said is None:
            self.skipTest("needs avahi-browse")
        texts = [line.split(";")[9] for line in said.stdout.splitlines() if line.startswith("=")]
        self.assertTrue(texts and all(text.startswith('"release=') and text.count('"') == 2 for text in texts), texts)

    def test_of_two_none_is_taken(self):
        masters = [self.announced(), self.announced(port=4701)]  # of one name: Avahi finds another
        client = self.seeker()
        self.assertEqual(client.ends(), 1, client.text)
        for port in (4700, 4701):
            self.assertIn(f"at 10.77.0.1:{port}", client.text)
        self.assertIn("2 masters announce themselves on this network; choose one with --master", client.lines[-1])
        chosen = self.seeker("--master", "10.77.0.1:4701")
        self.finish(masters[1])
        self.assertEqual(chosen.ends(), 0, chosen.text)
        masters[0].close()

    def test_the_key_stays_needed(self):
        master = self.announced()
        stranger = self.start(*self.at(1), BIN / "ninefold-client", "--key-file", self.new_key("wrong.key"))
        self.assertEqual(stranger.ends(), 1, stranger.text)
        self.assertIn("does not accept this key", stranger.text)
        master.close()

    def test_without_masters_or_avahi_there_is_one_line(self):
        client = self.seeker()
        self.assertEqual(client.ends(), 1, client.text)
        self.assertRegex(client.lines[-1], "no master announces itself on this network; .*--master ADDR:PORT")
        silent = self.master("--local-clients", 0, "--listen", "0.0.0.0:4700", "--key-file", "cluster.key",
                             prefix=self.at(0))
        silent.waits_for("listening on")
        self.assertEqual(self.seeker().ends(), 1, "only who says --announce is found")
        silent.close()
        self.avahi[1].close()
        client = self.seeker()
        self.assertEqual(client.ends(), 1, client.text)
        self.assertRegex(client.lines[-1], "avahi-daemon .*--master ADDR:PORT")

    def test_a_master_goes_on_without_avahi_and_is_found_when_it_comes(self):
        self.avahi[0].close()
        master = self.master("--local-clients", 0, "--listen", "0.0.0.0:4700", "--key-file", "cluster.key",
                             "--announce", prefix=self.at(0))
        master.waits_for("not announced on this network: .*avahi-daemon")
        for _ in range(2):
            daemon = self.start_avahi(0)
            eventually(lambda: "found master" in self.found_once().text, "a client that finds it")
            daemon.close()
        self.start_avahi(0)
        client = self.seeker()
        self.finish(master)
        self.assertEqual(client.ends(), 0, client.text)

    def found_once(self):
        """A client with a wrong key, which looks and is refused."""
        if not (self.folder / "other.key").exists():
            self.new_key("other.key")
        client = self.start(*self.at(1), BIN / "ninefold-client", "--key-file", "other.key")
        client.ends()
        return client


if __name__ == "__main__":
    unittest.main()

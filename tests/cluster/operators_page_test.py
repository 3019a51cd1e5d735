"""The commands of docs/cluster.md that need no installation, run as they stand there: with a smaller picture, which the
environment asks for, and a free port."""
import pathlib
import re
import shutil
import subprocess
import unittest

from programs import BIN, SCENES, ClusterTest, eventually, signal

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = dict(re.findall(r"^```sh (\S+)\n(.*?)^```$", (ROOT / "docs/cluster.md").read_text(), re.MULTILINE | re.DOTALL))


class OperatorsPage(ClusterTest):
    SIZE = "48x36"

    def here(self, command, **variables):
        """The command as this machine has it, for a shell that becomes its program."""
        given = " ".join(f"NINEFOLD_{k.upper()}={v}" for k, v in variables.items())
        command = command.strip().replace("/usr/share/ninefold/scenes", str(SCENES)).replace("127.0.0.1:8080", "127.0.0.1:0")
        return ["sh", "-c", f"export PATH={BIN}:$PATH NINEFOLD_SIZE={self.SIZE} {given}; exec {command}"]

    def carry_out(self, command, **variables):
        program = self.start(*self.here(command, **variables))
        self.assertEqual(program.ends(), 0, program.text)
        self.assertTrue((self.folder / "cornell.exr").exists())
        return program

    def test_a_run_that_is_kept_goes_on_by_the_same_command(self):
        self.carry_out(PAGE["keep"], local_clients=1)
        again = self.carry_out(PAGE["keep"], local_clients=1)
        self.assertIn("goes on behind 64 frame(s) of cornell.checkpoint", again.text)
        self.assertIn("ninefold_picture_frames 64\n", (self.folder / "cornell.prom").read_text())

    def test_a_run_that_is_verified(self):
        self.carry_out(PAGE["verify"], local_clients=3)

    @unittest.skipUnless(shutil.which("curl"), "there is no curl here")
    def test_metrics_of_a_run_that_is_served(self):
        master = self.start(*self.here(PAGE["serve"], local_clients=1))
        log = self.folder / "master.log"
        at = eventually(lambda: log.exists() and re.search(r"serving at http://(\S+?)/#token=.*\n", log.read_text()),
                        "it says where it serves").group(1)
        command = PAGE["metrics"].replace("127.0.0.1:8080", at)

        def numbers():
            done = subprocess.run(["sh", "-c", command], cwd=self.folder, text=True, capture_output=True, check=True)
            return "# TYPE ninefold_frames_total counter\n" in done.stdout
        eventually(numbers, "there are metrics")  # some time after the address is printed
        self.assertEqual((self.folder / "ninefold.token").stat().st_mode & 0o777, 0o600)
        self.send(master.process.pid, signal.SIGINT)
        self.assertEqual(master.ends(), 130)


if __name__ == "__main__":
    unittest.main()

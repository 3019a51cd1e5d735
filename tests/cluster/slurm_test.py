"""scripts/slurm on a real Slurm: three nodes on one machine."""
import json
import pathlib
import re
import subprocess
import unittest

from programs import BIN, DEADLINE, SCENES, ClusterTest, eventually
from slurm_cluster import WithSlurm

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts/slurm"
PAGE = dict(re.findall(r"^```sh (\S+)\n(.*?)^```$", (ROOT / "docs/cluster.md").read_text(), re.MULTILINE | re.DOTALL))


class Slurm(WithSlurm, ClusterTest):
    def submit(self, *options, scene="cornell", nodes=3, stop=("--frames", 20)):
        """sbatch --wait: the job's exit status; what it said is in self.text."""
        done = subprocess.run(
            [*self.on("head"), "env", f"PATH={BIN}:/usr/bin:/bin", "sbatch", "--wait", "-N", str(nodes),
             "--ntasks-per-node=1", "-o", "job.log", SCRIPT, SCENES / f"{scene}.glb", "--size", self.SIZE, *map(str, stop),
             "--output", "job.exr", "--stats", "stats.json", *options],
            cwd=self.folder, capture_output=True, text=True, timeout=DEADLINE)
        log = self.folder / "job.log"
        self.text = done.stdout + done.stderr + (log.read_text() if log.exists() else "")
        return done.returncode

    def left_behind(self):
        return [path.name for path in self.folder.glob(".ninefold*")]

    def test_the_first_task_is_the_master_and_the_others_are_its_clients(self):
        near = self.render("--local-clients", 1, frames=20)
        self.assertEqual(self.submit("--wait-clients", "3"), 0, self.text)
        stats = self.statistics()
        self.assertEqual(stats["image_hash"], near["image_hash"])
        self.assertEqual(sorted(c["name"] for c in stats["clients"]), ["local1", "n2", "n3"])
        self.assertEqual(self.left_behind(), [])

    def test_the_line_of_the_page_for_operators_works(self):
        line = PAGE["slurm"].replace("/usr/share/ninefold/slurm", str(SCRIPT)).replace("/usr/share/ninefold/scenes", str(SCENES))
        done = subprocess.run([*self.on("head"), "env", f"PATH={BIN}:/usr/bin:/bin", f"NINEFOLD_SIZE={self.SIZE}",
                               "SBATCH_WAIT=1", "sh", "-c", line], cwd=self.folder, capture_output=True, text=True,
                              timeout=DEADLINE)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.folder / "cornell.exr").exists())

    def test_one_node_renders_alone(self):
        self.assertEqual(self.submit(nodes=1), 0, self.text)
        self.assertEqual([c["name"] for c in self.statistics()["clients"]], ["local1"])

    def test_a_failure_of_the_master_is_the_jobs(self):
        self.assertEqual(self.submit("--colour", "red"), 2, self.text)
        self.assertIn("--colour", self.text)
        self.assertEqual(self.left_behind(), [])

    def test_the_jobs_files_are_private_while_it_runs(self):
        job = self.start(*self.on("head"), "env", f"PATH={BIN}:/usr/bin:/bin", "sbatch", "--wait", "-N", 2,
                         "--ntasks-per-node=1", "-o", "job.log", SCRIPT, SCENES / "cornell.glb", "--seconds", 1000,
                         "--output", "job.exr")
        (address,) = eventually(lambda: list(self.folder.glob(".ninefold-*/address")), "the master tells its address")
        for path in (address, address.parent / "key"):
            self.assertEqual(path.stat().st_mode & 0o777, 0o600)
        self.assertEqual(address.parent.stat().st_mode & 0o777, 0o700)
        self.assertRegex(address.read_text(), r"^10\.78\.0\.1\d:\d+\n$")
        eventually(lambda: "is ready: n2" in (self.folder / "job.log").read_text(), "the other node has joined")
        subprocess.run([*self.on("head"), "scancel", "--full", address.parent.name.partition("-")[2]], check=True)
        self.assertNotEqual(job.ends(), 0)
        eventually(lambda: self.left_behind() == [], "the job's folder is gone")

    def statistics(self):
        return json.loads((self.folder / "stats.json").read_text())


if __name__ == "__main__":
    unittest.main()

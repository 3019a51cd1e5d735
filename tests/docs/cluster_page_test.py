"""docs/cluster.md: the programs, flags and files that it names exist, and each of its command blocks is run by a test:
all but Slurm's by scripts/test_packages, Slurm's by tests/cluster/slurm_test.py."""
import os
import pathlib
import re
import subprocess
import unittest

TREE = pathlib.Path(os.environ["NINEFOLD_SOURCE"])
BIN = pathlib.Path(os.environ["NINEFOLD_BIN"])
PAGE = (TREE / "docs/cluster.md").read_text(encoding="utf-8")
BLOCKS = dict(re.findall(r"^```sh (\S+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL))


def flags_of(program):
    said = subprocess.run([BIN / program, "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"--[a-z-]+", said))


class ClusterPage(unittest.TestCase):
    def test_every_block_of_commands_has_a_name_and_a_test_that_runs_it(self):
        self.assertEqual(len(BLOCKS), PAGE.count("\n```") // 2, "a block has no name, or one twice")
        runs = ((TREE / "scripts/package_lib/test.py").read_text() + (TREE / "tests/cluster/slurm_test.py").read_text())
        for name in BLOCKS:
            self.assertRegex(runs, rf"PAGE\[\"{name}\"\]|machine, \"{name}\"", f"nothing runs the block {name}")

    def test_programs_take_the_flags_that_the_page_gives_them(self):
        lines = [line for block in BLOCKS.values() for line in block.splitlines()]
        for program in ("ninefold-master", "ninefold-client", "ninefold-doctor"):
            mine = [line for line in lines if line.startswith(program + " ")]
            self.assertTrue(mine, program)
            for flag in re.findall(r" (--[a-z-]+)", " ".join(mine)):
                self.assertIn(flag, flags_of(program))

    def test_flags_and_files_in_its_prose_exist(self):
        known = set().union(*map(flags_of, ("ninefold-master", "ninefold-client", "ninefold-doctor"))) | {"--prefix", "--install"}
        prose = re.sub(r"^```.*?^```$", "", PAGE, flags=re.MULTILINE | re.DOTALL)
        for code in re.findall(r"`([^`\n]+)`", prose):
            for flag in re.findall(r"(?<!\S)--[a-z-]+", code):
                self.assertIn(flag, known)
        for path in re.findall(r"`((?:scripts|docs|packaging)/[^` ]+)`", prose):
            self.assertTrue((TREE / path).exists(), path)


if __name__ == "__main__":
    unittest.main()

"""docs/cluster.md: the programs, flags, files and messages that it names exist, and each of its command blocks is run by a
test: scripts/test_packages has those that install, tests/cluster/operators_page_test.py and slurm_test.py the others."""
import os
import pathlib
import re
import subprocess
import unittest

TREE = pathlib.Path(os.environ["NINEFOLD_SOURCE"])
BIN = pathlib.Path(os.environ["NINEFOLD_BIN"])
PAGE = (TREE / "docs/cluster.md").read_text(encoding="utf-8")
BLOCKS = dict(re.findall(r"^```sh (\S+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL))
YAML = dict(re.findall(r"^```yaml (\S+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL))
RUNNERS = ("scripts/package_lib/test.py", "tests/cluster/slurm_test.py", "tests/cluster/operators_page_test.py")
INSTALLED = re.findall(r"docs/[a-z-]+\.md", (TREE / "cmake/install.cmake").read_text(encoding="utf-8"))
# What the programs' help says of a signal, and a word that the page's line must have.
SIGNALS = {"USR1": ("the picture so far", "picture"), "USR2": ("what is under way", "state: ")}


def help_of(program):
    return subprocess.run([BIN / program, "--help"], capture_output=True, text=True, check=True).stdout


def flags_of(program):
    return set(re.findall(r"--[a-z-]+", help_of(program)))


def strings_of(*folders):
    """All string literals of the sources below, those that a compiler joins as one."""
    texts = [file.read_text(encoding="utf-8") for folder in folders for file in (TREE / folder).rglob("*.cpp")]
    return "\n".join(re.sub(r'"\s*"', "", text) for text in texts)


class ClusterPage(unittest.TestCase):
    def test_every_block_of_commands_has_a_name_and_a_test_that_runs_it(self):
        self.assertEqual(len(BLOCKS) + len(YAML), PAGE.count("\n```") // 2, "a block has no name, or one twice")
        runs = "".join((TREE / runner).read_text() for runner in RUNNERS)
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

    def test_pages_that_are_named_where_programs_are_installed_are_installed_too(self):
        texts = [PAGE] + [help_of(program) for program in ("ninefold-master", "ninefold-client", "ninefold-doctor")]
        for path in re.findall(r"docs/[a-z-]+\.md", "".join(texts)):
            self.assertIn(path, INSTALLED)

    def test_a_signal_does_what_the_page_says(self):
        said = " ".join(help_of("ninefold-master").split())
        for name, (meaning, word) in SIGNALS.items():
            self.assertRegex(said, f"SIG{name} asks (for )?{meaning}")
            lines = [line for line in PAGE.splitlines() if f"kill -{name}" in line]
            self.assertTrue(lines, name)
            for line in lines:
                self.assertIn(word, line)

    def test_lines_that_it_quotes_are_in_the_sources(self):
        table = PAGE.split("| line | remedy |")[1].split("\n\n")[0]
        quoted = re.findall(r"^\| ([^|]+) \| ", table, re.MULTILINE)
        self.assertGreater(len(quoted), 4)
        said = strings_of("client", "master", "proto")
        for line in quoted:
            for piece in re.sub(r"\b[XYN]\b", "{}", line).split("..."):
                self.assertIn(piece.strip(" :"), said, f"no program says {line!r}")

    def test_prometheus_gets_the_file_that_the_commands_make(self):
        (made,) = re.findall(r"> (\S+)$", BLOCKS["metrics"], re.MULTILINE)
        self.assertRegex(YAML["prometheus"], rf"credentials_file: \S+/{re.escape(made)}\n")


if __name__ == "__main__":
    unittest.main()

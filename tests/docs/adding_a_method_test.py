"""docs/adding-a-method.md fits the tree that it lies in: its patch applies, what it names is there. That what it makes
compiles and renders is shown by tests/nightly/adding_a_method_test.py.
"""
import re
import shutil
import subprocess
import unittest

import page

REMEDY = f"bring {page.PAGE} up to date"


class Page(unittest.TestCase):
    def patch(self, *options):
        done = subprocess.run(["git", "apply", *options], cwd=page.TREE, input=page.DIFF, text=True, capture_output=True,
                              env=page.environment())
        self.assertEqual(done.returncode, 0, f"{done.stderr}{REMEDY}")
        return done.stdout

    @unittest.skipUnless(shutil.which("git"), "there is no git here")
    def test_its_patch_applies(self):
        self.patch("--check")
        files = {line.split("\t")[2] for line in self.patch("--numstat").splitlines()}
        self.assertEqual(files, page.WRITTEN)

    def test_the_command_on_it_finds_the_whole_patch(self):
        extract, apply = page.COMMANDS[0].rsplit(" | ", 1)
        self.assertEqual(apply, "git apply")
        done = subprocess.run(["bash", "-c", extract], cwd=page.TREE, text=True, capture_output=True, check=True)
        self.assertEqual(done.stdout, page.DIFF)

    def test_each_step_has_its_files(self):
        for path in page.CHANGED:
            self.assertTrue((page.TREE / path).is_file(), f"{path} is changed but not there; {REMEDY}")
        for path in page.NEW:
            self.assertFalse((page.TREE / path).exists(), f"{path} is there already; {REMEDY}")
        steps = re.findall(r"^\| (\d+) \| (.*?) \|", page.PROSE, re.MULTILINE)
        named = [path for _, cell in steps for path in re.findall(r"`([^`]+)`", cell)]
        self.assertEqual(len(steps), len(re.findall(r"^## Step \d+", page.PROSE, re.MULTILINE)))
        for path in page.WRITTEN:
            self.assertTrue(any(path.startswith(name) for name in named), f"no step names {path}; {REMEDY}")
        for name in named:
            self.assertTrue(any(path.startswith(name) for path in page.WRITTEN), f"{name} is in no diff; {REMEDY}")

    def test_what_it_names_is_there(self):
        paths = re.findall(r"`((?:common|docs|scripts|tests|scenes)/[^`\s]*)`", page.PROSE)
        self.assertGreater(len(paths), 10)
        for path in paths:
            made = any(new.startswith(path) for new in page.NEW)
            self.assertTrue(made or (page.TREE / path).exists(), f"{path} is not there; {REMEDY}")

    def test_suites_that_it_runs_are_there(self):
        self.assertGreater(len(page.SUITES), 1)
        for folder, suites in page.SUITES.items():
            files = page.TREE.glob(f"tests/{folder}/*_test.cpp")
            texts = [path.read_text(encoding="utf-8") for path in files] + [page.DIFF]
            for suite in suites:
                self.assertTrue(any(page.has_suite(text, suite) for text in texts), f"no suite {suite}; {REMEDY}")


if __name__ == "__main__":
    unittest.main()

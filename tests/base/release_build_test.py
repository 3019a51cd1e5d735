"""What cmake/release.cmake calls a tree: by commit, by what differs from it, or by its files."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(os.environ["NINEFOLD_SOURCE"]) / "cmake/release.cmake"
CMAKE = os.environ["NINEFOLD_CMAKE"]
GIT = shutil.which("git")
CLEAN = {k: v for k, v in os.environ.items() if not k.startswith("GIT_")}


@unittest.skipUnless(GIT, "there is no git here")
class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ninefold-release-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.tree = self.folder / "tree"
        (self.tree / "common").mkdir(parents=True)
        (self.tree / "docs").mkdir()
        self.write("common/a.cpp", "int a;\n")
        self.write("docs/a.md", "text\n")
        (self.folder / "name.in").write_text("@RELEASE@")
        self.output = self.folder / "name"

    def write(self, path, text):
        (self.tree / path).write_text(text)

    def git(self, *arguments, tree=None):
        who = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false"]
        done = subprocess.run([GIT, *who, *arguments], cwd=tree or self.tree, env=CLEAN, check=True, text=True,
                              capture_output=True)
        return done.stdout.strip()

    def commit(self, tree=None):
        if not ((tree or self.tree) / ".git").exists():
            self.git("init", "-q", tree=tree)
        self.git("add", ".", tree=tree)
        self.git("commit", "-qm", "work", tree=tree)
        return self.git("rev-parse", "HEAD", tree=tree)

    def release(self, git=GIT, **variables):
        done = subprocess.run([CMAKE, f"-DSOURCE={self.tree}", "-DVERSION=1.2.3", f"-DTEMPLATE={self.folder}/name.in",
                               f"-DOUTPUT={self.output}", f"-DGIT={git}", "-P", SCRIPT], env=CLEAN | variables,
                              cwd=self.folder, text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))
        return self.output.read_text().rstrip()

    def test_a_tree_without_git_is_named_by_its_files(self):
        files = self.release()
        self.assertRegex(files, r"^1\.2\.3\+files\.[0-9a-f]{12}$")
        self.commit(self.folder)  # a tarball unpacked inside another project
        self.assertEqual(self.release(), files)
        self.git("init", "-q")
        self.assertEqual(self.release(), files, "no commit yet")
        self.commit()
        for git in ("", "GIT-NOTFOUND", "/no/such/git"):
            self.assertEqual(self.release(git), files)

    def test_unlike_trees_without_git_have_unlike_names(self):
        names = [self.release("")]
        for path, text in (("common/a.cpp", "int b;\n"), ("common/b.cpp", "int a;\n"), ("CMakeLists.txt", "# new\n")):
            self.write(path, text)
            names.append(self.release(""))
        self.assertEqual(len(set(names)), len(names), names)
        self.write("docs/a.md", "other\n")
        self.assertEqual(self.release(""), names[-1], "no program is built from it")
        shutil.copytree(self.tree, self.folder / "copy")
        self.tree = self.folder / "copy"
        self.assertEqual(self.release(""), names[-1], "wherever it lies")

    def test_a_commit_is_named_whatever_tags_and_hooks_there_are(self):
        expected = "1.2.3+" + self.commit()[:12]
        self.assertEqual(self.release(), expected)
        self.git("tag", "v9")
        self.assertEqual(self.release(GIT_DIR=str(self.folder / "elsewhere")), expected)
        self.write("docs/a.md", "other\n")
        self.write("docs/b.md", "new\n")
        self.assertEqual(self.release(), expected, "no program is built from it")

    def test_another_owner_of_the_tree_is_no_obstacle(self):
        expected = "1.2.3+" + self.commit()[:12]
        self.assertEqual(self.release(GIT_TEST_ASSUME_DIFFERENT_OWNER="1", HOME=str(self.folder)), expected)

    def test_what_differs_is_digested(self):
        clean = "1.2.3+" + self.commit()[:12]
        names = []
        for path, text in (("common/a.cpp", "int b;\n"), ("common/a.cpp", "int c;\n"), ("common/b.cpp", "int d;\n"),
                           ("common/b.cpp", "int e;\n"), ("CMakeLists.txt", "# new\n")):
            self.write(path, text)
            names.append(self.release())
            self.assertRegex(names[-1], "^" + re.escape(clean) + r"-dirty\.[0-9a-f]{8}$")
            self.assertEqual(self.release(), names[-1])
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(self.release(), names[-1])
        self.assertEqual("1.2.3+" + self.commit()[:12], self.release())

    def test_the_file_is_written_only_if_the_name_changes(self):
        self.commit()
        self.release()
        os.utime(self.output, (1, 1))
        self.release()
        self.assertEqual(self.output.stat().st_mtime, 1)
        self.write("common/a.cpp", "int b;\n")
        self.release()
        self.assertNotEqual(self.output.stat().st_mtime, 1)


if __name__ == "__main__":
    unittest.main()

"""page.py: what docs/adding-a-method.md asks of its reader, as text and commands."""
import os
import pathlib
import re

TREE = pathlib.Path(os.environ["NINEFOLD_SOURCE"])
PAGE = "docs/adding-a-method.md"
TEXT = (TREE / PAGE).read_text(encoding="utf-8")


def blocks(kind):
    return re.findall(rf"^```{kind}\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)


DIFF = "".join(blocks("diff"))
COMMANDS = "".join(blocks("sh")).splitlines()
PROSE = re.sub(r"^```.*?^```$", "", TEXT, flags=re.MULTILINE | re.DOTALL)

CHANGED = set(re.findall(r"^--- a/(\S+)$", DIFF, re.MULTILINE))
WRITTEN = set(re.findall(r"^\+\+\+ b/(\S+)$", DIFF, re.MULTILINE))
NEW = WRITTEN - CHANGED

# Test programs are asked for these suites of theirs.
SUITES = [suite for names in re.findall(r"--gtest_filter='([^']+)'", TEXT) for suite in re.findall(r"(\w+)\.\*", names)]


def environment(**more):
    """That of a reader whose tree is no part of another repository."""
    plain = {k: v for k, v in os.environ.items() if not k.startswith(("GIT_", "NINEFOLD_"))}
    return plain | more

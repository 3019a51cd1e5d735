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

# Folder of tests: the suites that its program is asked for.
SUITES = {folder: re.findall(r"(\w+)\.\*", names)
          for folder, names in re.findall(r"(\w+)_test --gtest_filter='([^']+)'", TEXT)}


def has_suite(text, suite):
    return f"TEST({suite}, " in text


def environment(**more):
    """That of a reader whose tree is no part of another repository."""
    plain = {k: v for k, v in os.environ.items() if not k.startswith(("GIT_", "NINEFOLD_"))}
    return plain | more

"""docs/script.md: what it shows runs as it stands there, but for size, frames and number of clients."""
import json
import pathlib
import re
import shlex
import shutil
import unittest

import png
from programs import BIN, SCENES, ClusterTest

DOCUMENT = (SCENES.parent / "docs" / "script.md").read_text()
BLOCKS = re.findall(r"```(json|sh)\n(.*?)```", DOCUMENT, re.S)
SMALL = ["--size", "64x48", "--local-clients", "1", "--isa", "avx2", "--frame-time", "30"]


class Document(ClusterTest):
    def commands(self):
        """Each command line, with the script that stands before it."""
        script = None
        for kind, text in BLOCKS:
            if kind == "json":
                script = text
                continue
            for line in text.strip().splitlines():
                words = shlex.split(line)
                if "--window" not in words:  # it is the same script
                    yield words, script

    def run_as_shown(self, words, script):
        self.assertEqual(words[0], "build/bin/ninefold-master")
        if "--script" in words:
            (self.folder / words[words.index("--script") + 1]).write_text(script.replace('"frames": 8', '"frames": 2'))
        words = ["1" if words[i - 1] == "--frames" else word for i, word in enumerate(words)]
        scene = SCENES.parent / words[1]
        program = self.start(BIN / "ninefold-master", scene, *words[2:], *SMALL)
        self.assertEqual(program.ends(), 0, program.text)

    def pictures(self, pattern):
        return [png.read(p) for p in sorted(self.folder.glob(pattern))]

    def test_what_it_shows_runs(self):
        count = 0
        for words, script in self.commands():
            with self.subTest(" ".join(words)):
                if words[-1].endswith(".mp4") and not shutil.which("ffmpeg"):
                    self.skipTest("no ffmpeg here: apt-get install ffmpeg")
                self.run_as_shown(words, script)
            count += 1
        self.assertEqual(count, 5)
        with self.subTest("seconds times rate, and one"):
            self.assertEqual(len(self.pictures("ball.*.png")), 4 * 2 + 1)
            self.assertEqual(len(self.pictures("round.*.png")), 4 * 5 + 1)
            self.assertTrue((self.folder / "last.png").exists())
            shots = json.loads((self.folder / "times.json").read_text())["shots"]
            self.assertEqual(len(shots), 2 * 10 + 1)
            self.assertEqual(len(list(self.folder.glob("seen.*.exr"))), sum(not shot["lost"] for shot in shots))
        with self.subTest("the animation goes round"):
            round_ = self.pictures("round.*.png")
            self.assertTrue(round_[0] == round_[-1], "it ends where it began")
            self.assertFalse(round_[0] == round_[10], "and was elsewhere between")

    def test_every_field_of_the_table_is_shown(self):
        fields = re.findall(r"^\| `(\w+)`", DOCUMENT, re.M)
        self.assertGreater(len(fields), 8)
        shown = "".join(text for kind, text in BLOCKS if kind == "json")
        missing = [f for f in fields if f'"{f}"' not in shown and f != "light"]  # a light is not in its scene
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()

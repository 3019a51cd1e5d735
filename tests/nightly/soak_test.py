"""A minute of scripts/soak; the whole, half an hour, is for people to run."""
import os
import pathlib
import subprocess
import unittest

SOAK = pathlib.Path(os.environ["NINEFOLD_SOURCE"]) / "scripts/soak"


class Soak(unittest.TestCase):
    def test_the_cluster_holds_in_bad_weather(self):
        done = subprocess.run([SOAK, "--minutes", "1"], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=1200)
        print(done.stderr)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "the cluster holds\n")


if __name__ == "__main__":
    unittest.main()

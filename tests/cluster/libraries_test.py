"""Which shared libraries programs load: a client none for reading scenes or for the window, which bring hundreds more."""
import re
import subprocess
import unittest

from programs import BIN


def libraries(program):
    said = subprocess.run(["readelf", "-d", BIN / program], capture_output=True, text=True, check=True).stdout
    return re.findall(r"\(NEEDED\).*\[(lib[^.\]]+)", said)


class Libraries(unittest.TestCase):
    def test_a_client_needs_no_reader_and_no_window(self):
        found = libraries("ninefold-client")
        self.assertTrue(any(name.startswith("libembree") for name in found), found)
        for name in ("libOpenImageIO", "libOpenImageIO_Util", "libtinygltf", "libglfw", "libGL", "libOpenGL", "libX11"):
            self.assertNotIn(name, found)

    def test_the_master_has_them(self):
        found = libraries("ninefold-master")
        for name in ("libOpenImageIO", "libtinygltf", "libglfw"):
            self.assertIn(name, found)


if __name__ == "__main__":
    unittest.main()

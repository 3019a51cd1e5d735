"""One browser's looks at a session, as JSON lines: python3 viewer.py HOST PORT TOKEN SECONDS

{"time": monotonic seconds, "exposure": of the picture, "bytes": its size}
"""
import json
import os
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
os.environ.setdefault("NINEFOLD_BIN", str(ROOT / "build/bin"))
os.environ.setdefault("NINEFOLD_SCENES", str(ROOT / "scenes"))
sys.path.insert(0, str(ROOT / "tests/cluster"))

from browser import Viewer  # noqa: E402  the path comes first


def main(host, port, token, seconds):
    certificate = None if host == "127.0.0.1" else True  # beyond loopback the master serves by TLS
    viewer = Viewer(host, int(port), token, certificate=certificate)
    end = time.monotonic() + float(seconds)
    while time.monotonic() < end:
        viewer.picture = b""
        head = viewer.look()
        if viewer.picture:
            print(json.dumps({"time": time.monotonic(), "exposure": round(head["exposure"], 3), "bytes": len(viewer.picture)}), flush=True)
    viewer.close()


if __name__ == "__main__":
    main(*sys.argv[1:])

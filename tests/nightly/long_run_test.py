"""Ten thousand small frames: neither master nor client grows.

Looked at is memory that no file stands behind, from frame 2,000 on, when pools and caches are full. What a run keeps of
each frame is its time, 8 bytes; 100 bytes a frame that nobody gives back would be 0.8 MB.
"""
import pathlib
import re
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cluster"))

from programs import ClusterTest, is_running, own_memory  # noqa: E402

FRAMES, SETTLED = 10000, 2000
GROWTH = 0.8e6  # bytes


class LongRun(ClusterTest):
    SIZE = "24x18"

    def test_memory_stays_flat(self):
        for scene in ("cornell", "table_room"):
            master = self.master("--local-clients", 1, "--direct-vpls", 1, "--indirect-vpls", 2, "--photons", 20,
                                 scene=scene, frames=FRAMES)
            master.waits_for(r"client 1 is ready")
            processes = {"master": master.process.pid, "client": master.children()[0]}
            seen = {name: [] for name in processes}
            while is_running(master.process.pid):
                frames = [int(frame) for frame in re.findall(r"progress: \d+% frame (\d+)", master.text)]
                for name, pid in processes.items():
                    memory = own_memory(pid)
                    if memory and frames:
                        seen[name].append((frames[-1], memory))
                time.sleep(0.2)
            self.assertEqual(self.finish(master)["frames"], FRAMES)
            for name, samples in seen.items():
                settled = [memory for frame, memory in samples if frame >= SETTLED]
                self.assertGreater(len(settled), 8, f"{scene}, {name}: too few samples")
                quarter = len(settled) // 4
                growth = max(settled[-quarter:]) - max(settled[:quarter])
                print(f"{scene}, {name}: {settled[0] / 1e6:.1f} MB, grew by {growth / 1e6:+.2f} MB", flush=True)
                self.assertLess(growth, GROWTH, f"{scene}, {name}: {settled}")


if __name__ == "__main__":
    unittest.main()

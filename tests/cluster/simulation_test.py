"""The simulated cluster counts what a real one of the same size counts."""
import json
import subprocess
import unittest

from programs import BIN, ClusterTest

FRAMES = 6


class Simulation(ClusterTest):
    SIZE = "320x240"

    def simulate(self, clients):
        done = subprocess.run([BIN / "ninefold-simulate-cluster", "--clients", str(clients), "--frames", str(FRAMES),
                               "--size", self.SIZE], check=True, capture_output=True, text=True)
        return json.loads(done.stdout)

    def test_tasks_and_light_sets(self):
        for clients in (1, 2, 3):
            with self.subTest(clients=clients):
                real = self.render("--local-clients", clients, "--wait-clients", clients, frames=FRAMES)
                simulated = self.simulate(clients)
                self.assertEqual(simulated["frames"], real["frames"])
                # Results that counted: every task of every frame once, on both sides.
                self.assertEqual(simulated["tasks"], sum(c["tasks"] for c in real["clients"]))
                # Nine sets, shared. The simulation goes on to open frames at the end, with a set or two of each.
                sets = [c["sets_per_frame"] for c in real["clients"] if c["tasks"]]
                for value in [simulated["sets_per_frame"], sum(sets) / len(sets)]:
                    self.assertGreaterEqual(value * clients, 9 * FRAMES / (FRAMES + 3))
                    self.assertLessEqual(value, 9 + 1e-9)
                if clients == 1:
                    self.assertEqual(sets[0], 9)
                self.assertEqual((simulated["reissued"], real["tasks_reissued"]), (0, 0))

    def test_a_lost_client_is_seen_by_both(self):
        done = subprocess.run([BIN / "ninefold-simulate-cluster", "--clients", "3", "--frames", "200", "--size",
                               self.SIZE, "--fail-every", "1"], check=True, capture_output=True, text=True)
        self.assertGreater(json.loads(done.stdout)["reissued"], 0)


if __name__ == "__main__":
    unittest.main()

"""The same job gives the same bytes by every method, whatever the number of clients and threads."""
import unittest

from programs import ClusterTest, methods


class MethodsSameBytes(ClusterTest):
    def test_any_number_of_clients_and_threads(self):
        for method in methods():
            self.same_by(method, [(1, 1), (2, 1), (5, 1), (1, 2), (2, 2)], frames=2)

    def test_filtered_by_clients_any_number_of_them(self):
        for method in methods():
            self.same_by(method, [(1, 1), (3, 1), (1, 2)], "--filter-at", "clients", frames=2)


if __name__ == "__main__":
    unittest.main()

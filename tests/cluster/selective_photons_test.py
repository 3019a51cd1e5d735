"""Selective photons in a cluster of real programs: whoever dies and joins, in a run at rest or in the middle of an edit,
the pictures are those of a run in peace.
"""
import unittest

from state_test import State


class SelectivePhotons(State):
    METHOD = ("--method", "selective-photons", "--photon-pool", 4608)
    UNITS = 288 + 288 // 16
    LONG = 12
    LATE = 250

    # Its sums are nobody's to overflow.
    test_a_sum_that_overflows_ends_the_run_and_says_which = None


del State  # its own tests run elsewhere

if __name__ == "__main__":
    unittest.main()

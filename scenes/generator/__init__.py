"""Makes the test scenes of Ninefold as glTF 2.0 binaries. Python's standard library only."""

"""The benchmark: simulated scenes, what the detector finds in them, and a report."""

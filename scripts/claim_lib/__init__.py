"""The claim that the mismatch test makes poses more trustworthy, on scenes of prone and of control parts."""

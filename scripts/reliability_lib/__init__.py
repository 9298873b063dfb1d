"""Fits the probability that a pose is right; see scripts/fit_reliability."""

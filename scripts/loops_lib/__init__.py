"""Closed loops of the simulated cell, many of them, for the share of wrong picks."""

"""What each step of the detector brings."""

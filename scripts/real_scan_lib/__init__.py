"""Looks for a part in real scans, as they are and changed a little; see scripts/real_scan."""

"""What is measured: parts, fill levels, sensors, seeds, and the variants of the detector."""

from dataclasses import dataclass
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2]
FILLS = (8, 16, 32)
PRESETS = ("clean", "industrial", "low_cost")
SEED = 1  # of the scenes and of the closed loop; settings are chosen on others
LOOP_COUNT = 8  # parts in the bin of the closed loop
LOOP_PRESET = "industrial"
QUICK_PARTS = ("bolt", "bracket", "tee")
QUICK_FILLS = (8, 16)
QUICK_PRESETS = ("industrial",)
QUICK_LOOP_COUNT = 3

# Each variant of the detector with the settings that differ from the defaults.
VARIANTS = {
    "default": {},
    "original": {"clustering": "greedy", "mismatch_test": False},
    "coverage": {"mismatch_test": False},
    "spread": {
        "poses_per_cluster": 1,
        "max_slide_share": 1.0,
        "max_outline_broken": 1.0,
        "max_pierced": 1.0,
        "min_margin": -1.0,
        "min_reliability": 0,
    },
}
VARIANT_TEXTS = {
    "default": "all of the detector",
    "original": "the original method: greedy clustering, no mismatch test",
    "coverage": "the score alone decides: no mismatch test",
    "spread": "the mismatch test by the cluster's spread alone, one pose a cluster",
}


@dataclass(frozen=True)
class Scene:
    """One shot of one pile."""

    part: str
    count: int
    preset: str
    seed: int

    @property
    def name(self):
        """As simulate_scene names the folder."""
        return f"{self.preset}-{self.count}-{self.seed}"


def all_parts():
    """Names of the package's parts."""
    return sorted(path.stem for path in (PACKAGE / "config/parts").glob("*.yaml"))


def scene_set(parts, fills, presets):
    """The scenes, part by part."""
    return [
        Scene(part, count, preset, SEED) for part in parts for count in fills for preset in presets
    ]

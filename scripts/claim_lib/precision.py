"""Precision at a given recall, and how sure it is."""

from dataclasses import dataclass

import numpy as np

REPEATS = 2000  # of the bootstrap
SEED = 1  # of the bootstrap
SHARE = 0.95  # of the bootstrap's values within an interval


@dataclass
class Ranking:
    """Poses of many scenes, the most trusted first. Poses on parts too hidden to be targets are left out."""

    scene: np.ndarray  # index of the scene of each pose
    right: np.ndarray  # 1 right, 0 wrong or a second one on the same part
    targets: np.ndarray  # of each scene

    @classmethod
    def of(cls, scenes):
        """scenes: of each one its targets and its poses, each a sort key (larger: more trusted) and right or not."""
        rows = [
            (*key, index, right) for index, (_, poses) in enumerate(scenes) for key, right in poses
        ]
        rows.sort(key=lambda row: row[:-2], reverse=True)  # stable: equal keys as they came
        return cls(
            np.array([row[-2] for row in rows], dtype=int),
            np.array([row[-1] for row in rows], dtype=float),
            np.array([targets for targets, _ in scenes], dtype=float),
        )

    def precision_at(self, recalls, times=None):
        """Of the shortest beginning of the list that reaches each recall; NaN where none does.

        times: how often each scene counts; once each if not given.
        """
        times = np.ones(len(self.targets)) if times is None else times
        weight = times[self.scene]
        right = np.cumsum(weight * self.right)
        found = np.cumsum(weight)
        needed = np.asarray(recalls) * np.sum(times * self.targets)
        if len(right) == 0:
            return np.full(len(needed), np.nan)
        place = np.searchsorted(right, needed - 1e-9)
        inside = np.minimum(place, len(right) - 1)
        return np.where(place < len(right), right[inside] / found[inside], np.nan)


def bootstrap(first, second, recalls):
    """Interval of the second's precision less the first's, both on the same scenes drawn with replacement.

    Returns lower and upper end for each recall; NaN where one of them misses it in more than 5 % of the draws.
    """
    scenes = len(first.targets)
    generator = np.random.default_rng(SEED)
    differences = []
    for _ in range(REPEATS):
        times = np.bincount(generator.integers(scenes, size=scenes), minlength=scenes)
        differences.append(second.precision_at(recalls, times) - first.precision_at(recalls, times))
    differences = np.array(differences)
    ends = np.full((2, len(recalls)), np.nan)
    for column, values in enumerate(differences.T):
        values = values[~np.isnan(values)]
        if len(values) >= SHARE * REPEATS:
            ends[:, column] = np.quantile(values, [(1 - SHARE) / 2, (1 + SHARE) / 2])
    return ends

"""Logistic regression with weighted samples and weights of a given sign, and how well it predicts."""

from dataclasses import dataclass

import numpy as np
from scipy import optimize, special

from benchmark_lib.programs import BenchmarkError

# Of the ranges of a reliability diagram. What is picked lies in the last tenth: it is cut finer.
EDGES = (0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 1)
PENALTY = 1.0  # on half the squared weights of the standardised terms


@dataclass(frozen=True)
class Model:
    """The logit is intercept + terms @ weights, in the terms' own units."""

    intercept: float
    weights: np.ndarray

    def predict(self, terms):
        """Probability of each row."""
        return special.expit(self.intercept + terms @ self.weights)


def fit(terms, labels, sample_weights, signs):
    """The most likely model under the penalty of which no weight has the opposite of its sign (Cox 1958; L-BFGS-B).

    terms: a row each; labels: 1 right, 0 wrong; signs: 1 or -1 for each column.
    """
    mean = np.average(terms, axis=0, weights=sample_weights)
    deviation = np.sqrt(np.average((terms - mean) ** 2, axis=0, weights=sample_weights))
    deviation[deviation < 1e-9] = 1  # a constant column gets no weight from the penalty
    columns = np.c_[np.ones(len(terms)), (terms - mean) / deviation]
    total = np.sum(sample_weights)

    def loss(weights):
        logit = columns @ weights
        slopes = np.r_[0, weights[1:]]
        value = sample_weights @ (np.logaddexp(0, logit) - labels * logit)
        gradient = columns.T @ (sample_weights * (special.expit(logit) - labels))
        value += PENALTY / 2 * slopes @ slopes
        return value / total, (gradient + PENALTY * slopes) / total

    bounds = [(None, None)] + [(0, None) if sign > 0 else (None, 0) for sign in signs]
    options = {"ftol": 1e-13, "gtol": 1e-8, "maxiter": 2000}
    start = np.zeros(columns.shape[1])
    found = optimize.minimize(
        loss, start, jac=True, method="L-BFGS-B", bounds=bounds, options=options
    )
    if not found.success or not np.isfinite(found.x).all():
        raise BenchmarkError(f"The fit did not converge: {found.message}")
    weights = found.x[1:] / deviation
    return Model(float(found.x[0] - weights @ mean), weights)


def kept_and_precision(predicted, labels, threshold):
    """Of the right ones the share with at least this probability, and of those with it the right share; NaN: of none."""
    passed = predicted >= threshold
    right = labels > 0.5
    hits = np.sum(passed & right)
    kept = hits / right.sum() if right.any() else np.nan
    return kept, hits / passed.sum() if passed.any() else np.nan


@dataclass(frozen=True)
class Bin:
    """The poses of one range of predicted probability."""

    low: float
    high: float
    count: int
    predicted: float  # mean; NaN of none
    observed: float  # share of right ones; NaN of none


def reliability_bins(predicted, labels, sample_weights):
    """The reliability diagram: shares of right ones in ranges of probability (DeGroot and Fienberg 1983)."""
    places = np.searchsorted(EDGES[1:-1], predicted, side="right")
    diagram = []
    for k, (low, high) in enumerate(zip(EDGES, EDGES[1:])):
        inside = places == k
        weights = sample_weights[inside]
        means = [
            np.average(values[inside], weights=weights) if inside.any() else np.nan
            for values in (predicted, labels)
        ]
        diagram.append(Bin(low, high, int(inside.sum()), *map(float, means)))
    return diagram

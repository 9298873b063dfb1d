"""What a scene shows behind all its parts alike is not held against a pose: setUsualShares of src/core/reliability.cpp.

Which poses show what is usual depends on the fit, and the fit on what is usual: they are found in turn.
"""

import numpy as np

from . import regression
from .terms import TERMS

LOOKED_THROUGH = [term.name for term in TERMS].index("looked_through")
# As in src/core/reliability.cpp.
TRUSTED = 0.7
UNTOUCHED = 5
MOST_USUAL = 0.15
MAX_ROUNDS = 20
SAME_WEIGHT = 1e-3  # of a weight: no further round


def usual_shares(shares, trusted):
    """Of each pose of a scene the median share of the other trusted ones and of so many untouched ones.

    shares: looked through, of each pose; trusted: whether each counts.
    """
    usual = np.empty(len(shares))
    for i in range(len(shares)):
        others = trusted & (np.arange(len(shares)) != i)
        known = np.sort(np.r_[shares[others], np.zeros(UNTOUCHED)])
        usual[i] = known[(len(known) - 1) // 2]
    return usual


def without_usual(model, terms, scenes):
    """The terms with what is looked through beyond what is usual. scenes: number of each row's."""
    result = terms.copy()
    trusted = model.predict(terms) >= TRUSTED
    for scene in np.unique(scenes):
        rows = scenes == scene
        shares = terms[rows, LOOKED_THROUGH]
        usual = np.minimum(usual_shares(shares, trusted[rows]), MOST_USUAL)
        result[rows, LOOKED_THROUGH] = np.maximum(shares - usual, 0)
    return result


def fit(terms, labels, sample_weights, scenes, signs):
    """regression.fit of the terms without what is usual by the same model."""
    model = regression.fit(terms, labels, sample_weights, signs)
    for _ in range(MAX_ROUNDS):
        before = model
        beyond = without_usual(model, terms, scenes)
        model = regression.fit(beyond, labels, sample_weights, signs)
        if np.allclose(model.weights, before.weights, rtol=SAME_WEIGHT):
            break
    return model


def predict_left_out(terms, labels, sample_weights, groups, scenes, signs):
    """Probability of each row by the model of all groups but its own."""
    predicted = np.zeros(len(labels))
    for group in sorted(set(groups)):
        own = groups == group
        others = (terms[~own], labels[~own], sample_weights[~own], scenes[~own])
        model = fit(*others, signs)
        predicted[own] = model.predict(without_usual(model, terms[own], scenes[own]))
    return predicted

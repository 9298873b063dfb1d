"""What a scene shows behind all its parts alike is not held against a pose: setUsualShares of src/core/reliability.cpp.

Which poses show what is usual depends on the fit, and the fit on what is usual: they are found in turn.
"""

import numpy as np
import yaml

from benchmark_lib.cases import PACKAGE

from . import regression
from .terms import TERMS

LOOKED_THROUGH = [term.name for term in TERMS].index("looked_through")
# As in reliability.hpp and reliability.cpp.
SHOWS_USUAL = 0.8
ZEROS = 5
MOST_USUAL = 0.1
SETTINGS = yaml.safe_load((PACKAGE / "config/detector.yaml").read_text())
MAX_ROUNDS = 20
SAME_WEIGHT = 1e-3  # of a weight: no further round


def passes_gates(pose):
    """Whether a pose of a result passes all gates but the reliability's while nothing is usual: pose_verdict.cpp."""
    limit = SETTINGS
    slides = pose["slide_share"] > limit["max_slide_share"] and pose["hold"] < limit["firm_hold"]
    return (
        pose["spread"] <= limit["max_spread_rel"]
        and not slides
        and pose["outline_broken"] <= limit["max_outline_broken"]
        and pose["pierced"] <= limit["max_pierced"]
        and pose["margin"] >= limit["min_margin"]
        and pose["score"] >= limit["min_score"]
        and pose["visible_fraction"] >= limit["min_visible_share"]
        and pose["confirmed_px"] >= limit["min_confirmed_px"]
    )


def usual_shares(shares, shows):
    """Of each pose of a scene the median share of the others that show what is usual and of some zeros.

    shares: looked through, of each pose; shows: whether each counts.
    """
    usual = np.empty(len(shares))
    for i in range(len(shares)):
        others = shows & (np.arange(len(shares)) != i)
        known = np.sort(np.r_[shares[others], np.zeros(ZEROS)])
        usual[i] = min(known[(len(known) - 1) // 2], MOST_USUAL)
    return usual


def without_usual(model, terms, gates, scenes):
    """The terms with what is looked through beyond what is usual. gates: whether each row's pose passes them; scenes: numbers."""
    result = terms.copy()
    shows = gates & (model.predict(terms) >= SHOWS_USUAL)
    for scene in np.unique(scenes):
        rows = scenes == scene
        shares = terms[rows, LOOKED_THROUGH]
        beyond = shares - usual_shares(shares, shows[rows])
        result[rows, LOOKED_THROUGH] = np.maximum(beyond, 0)
    return result


def fit(terms, labels, sample_weights, gates, scenes, signs):
    """regression.fit of the terms without what is usual by the same model."""
    model = regression.fit(terms, labels, sample_weights, signs)
    for _ in range(MAX_ROUNDS):
        before = model
        beyond = without_usual(model, terms, gates, scenes)
        model = regression.fit(beyond, labels, sample_weights, signs)
        if np.allclose(model.weights, before.weights, rtol=SAME_WEIGHT):
            break
    return model


def predict_left_out(terms, labels, sample_weights, groups, gates, scenes, signs):
    """Probability of each row by the model of all groups but its own."""
    predicted = np.zeros(len(labels))
    for group in sorted(set(groups)):
        own = groups == group
        rest = ~own
        model = fit(
            terms[rest], labels[rest], sample_weights[rest], gates[rest], scenes[rest], signs
        )
        beyond = without_usual(model, terms[own], gates[own], scenes[own])
        predicted[own] = model.predict(beyond)
    return predicted

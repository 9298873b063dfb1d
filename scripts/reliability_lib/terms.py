"""What the probability is made of: the terms of src/core/reliability.cpp, in the same order."""

import math
from dataclasses import dataclass
from typing import Callable

import numpy as np

from benchmark_lib.programs import BenchmarkError


@dataclass(frozen=True)
class Term:
    """One summand of the logit."""

    name: str  # of the pose's value in the results of detect_poses
    value: Callable  # of the term, from the pose's value
    text: str  # the same in words
    sign: int  # of the weight: what speaks for a pose must not be turned against it by chance
    code: str  # the same in C++
    doubt: str  # its name in C++, see ReliabilityTerm


def clamp(value, low, high):
    return min(max(value, low), high)


def score_logit(score):
    score = clamp(score, 0.2, 0.98)
    return math.log(score / (1 - score))


TERMS = (
    Term(
        "score",
        score_logit,
        "logit of the score, within 0.2 and 0.98",
        1,
        "std::log(score / (1 - score))",
        "kScore",
    ),
    Term(
        "margin",
        lambda margin: clamp(margin, -0.2, 0.5),
        "lead over the best other pose there, within -0.2 and 0.5",
        1,
        "std::clamp(pose.margin, -0.2, 0.5)",
        "kMargin",
    ),
    Term(
        "hold",
        lambda hold: math.log10(max(hold, 0.001)),
        "log10 of the hold, at least 0.001",
        1,
        "std::log10(std::max(pose.hold, 0.001))",
        "kHold",
    ),
    Term(
        "slide_share",
        float,
        "of the outline that would stop the worst slide, the broken share",
        -1,
        "pose.slide_share",
        "kSlideShare",
    ),
    Term(
        "spread",
        lambda spread: min(spread, 2),
        "spread of its cluster in diameters, at most 2",
        -1,
        "std::min(pose.spread, 2.0)",
        "kSpread",
    ),
    Term(
        "looked_through",
        float,
        "share of the expected surface that the cloud lies behind, beyond what is usual in the scene (`usual.py`)",
        -1,
        "std::max(pose.looked_through - pose.usual_looked_through, 0.0)",
        "kLookedThrough",
    ),
    Term(
        "goes_on",
        float,
        "share of its edges in sight beyond which the surface goes on, held poses' surfaces aside",
        -1,
        "pose.goes_on",
        "kGoesOn",
    ),
    Term(
        "claimed",
        float,
        "share of the expected surface that better poses explain",
        -1,
        "pose.claimed",
        "kClaimed",
    ),
    Term(
        "confirmed_px",
        lambda pixels: math.log10(max(pixels, 30)),
        "log10 of the pixels that confirm it, at least 30",
        1,
        "std::log10(std::max(pose.confirmed_px, 30))",
        "kConfirmed",
    ),
    Term(
        "visible_fraction",
        lambda share: min(share, 1),
        "share of its surface that is in sight",
        1,
        "std::min(pose.visible_fraction, 1.0)",
        "kVisible",
    ),
)
SIGNS = tuple(term.sign for term in TERMS)


def terms_of(poses, place):
    """A row of terms for each pose of a result. place: the result, for the error."""
    missing = [term.name for pose in poses for term in TERMS if pose.get(term.name) is None]
    if missing:
        raise BenchmarkError(f"{place} has a pose without {missing[0]}: build the package.")
    rows = [[term.value(pose[term.name]) for term in TERMS] for pose in poses]
    return np.array(rows, float).reshape(len(poses), len(TERMS))


def code_of(fitted):
    """The lines of src/core/reliability.cpp that hold the fits.

    fitted: pairs of a model and the means of the terms over right poses: within a region, in the whole cloud.
    """
    (region, region_means), (whole, whole_means) = fitted
    columns = (region.weights, region_means, whole.weights, whole_means)
    rows = [
        f"      {{{term.code}, ReliabilityTerm::{term.doubt}, {{{a:.3f}, {b:.3f}}}, {{{c:.3f}, {d:.3f}}}}},\n"
        for term, a, b, c, d in zip(TERMS, *columns)
    ]
    return (
        f"constexpr double kInterceptInRegion = {region.intercept:.3f};\n"
        f"constexpr double kInterceptInWholeCloud = {whole.intercept:.3f};\n\n" + "".join(rows)
    )

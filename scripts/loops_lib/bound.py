"""How many of many picks may be wrong."""

from scipy.stats import beta


def upper_bound(wrong, picks, confidence=0.95):
    """One-sided upper bound of a share, of which `wrong` in `picks` were seen (Clopper and Pearson 1934)."""
    if not 0 <= wrong <= picks:
        raise ValueError(f"{wrong} of {picks} is no share")
    return 1.0 if wrong == picks else float(beta.ppf(confidence, wrong + 1, picks - wrong))

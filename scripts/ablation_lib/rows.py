"""What is changed, one setting at a time, and what was decided."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A change of the settings, and what follows from its figures."""

    name: str
    settings: dict
    decision: str = ""  # none: not taken yet


ROWS = (
    Row("default", {}, "the detector as it is"),
    Row("original", {"clustering": "greedy", "mismatch_test": False}),
    Row("greedy", {"clustering": "greedy"}),
    Row("one-a-cluster", {"poses_per_cluster": 1}),
    Row("no-tests", {"mismatch_test": False}),
    Row("no-spread", {"max_spread_rel": 100.0}),
    Row("no-slide", {"max_slide_share": 1.0}),
    Row("slide-of-all", {"firm_hold": 100.0}),
    Row("no-outline-gate", {"max_outline_broken": 1.0}),
    Row("no-pierced-gate", {"max_pierced": 1.0}),
    Row("no-margin", {"min_margin": -1.0}),
    Row("margin-0.1", {"min_margin": 0.1}),
    Row("no-reliability", {"min_reliability": 0}),
    Row("reliability-0.95", {"min_reliability": 0.95}),
    Row("score-0.4", {"min_score": 0.4}),
    Row("no-icp", {"icp_iterations": 0}),
    Row("icp-4", {"icp_iterations": 4}),
    Row("icp-24", {"icp_iterations": 24}),
    Row("no-quick-fit", {"min_sparse_balance": -2}),
    Row("quick-fit-0", {"min_sparse_balance": 0}),
    Row("candidates-100", {"max_candidates": 100}),
    Row("candidates-600", {"max_candidates": 600}),
    Row("one-peak", {"peaks_per_reference": 1}),
    Row("references-0.05", {"reference_share": 0.05}),
    Row("references-0.2", {"reference_share": 0.2}),
    Row("lambda-0.5", {"lambda": 0.5}),
    Row("step-0.05", {"step_rel": 0.05}),
    Row("pixels-70", {"pixels_per_diameter": 70}),
    Row("pixels-140", {"pixels_per_diameter": 140}),
    Row("normals-3", {"normal_radius_px": 3}),
    Row("gate-0.01", {"depth_gate_rel": 0.01}),
    Row("gate-0.03", {"depth_gate_rel": 0.03}),
)

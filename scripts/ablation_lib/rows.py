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
    Row(
        "original",
        {"clustering": "greedy", "mismatch_test": False},
        "the paper's peers: six in a hundred returned poses are wrong, and 36 pass where no part lies",
    ),
    Row(
        "greedy",
        {"clustering": "greedy"},
        "as good where the reliability judges; kept as a choice, as it knows no spread to show",
    ),
    Row(
        "one-a-cluster",
        {"poses_per_cluster": 1},
        "the paper's mode: a sixth quicker, loses poses of clusters that chain",
    ),
    Row(
        "no-tests",
        {"mismatch_test": False},
        "the tests and the reliability are what trust rests on",
    ),
    Row(
        "no-spread",
        {"max_spread_rel": 100.0},
        "nothing passes that the reliability does not catch; kept as the reason an operator understands",
    ),
    Row(
        "no-slide",
        {"max_slide_share": 1.0},
        "kept for pins on longer cylinders, which these scenes hardly have",
    ),
    Row(
        "slide-of-all",
        {"firm_hold": 100.0},
        "not taken: a firmly held part may touch others all around",
    ),
    Row(
        "no-outline-gate",
        {"max_outline_broken": 1.0},
        "nothing here reaches it; kept for scans without noise",
    ),
    Row(
        "no-pierced-gate",
        {"max_pierced": 1.0},
        "kept: without it a pose passes in the real scan's motors",
    ),
    Row(
        "no-margin",
        {"min_margin": -1.0},
        "kept: of the wrong poses it lets pass most are mirror images",
    ),
    Row(
        "margin-0.1",
        {"min_margin": 0.1},
        "not taken: costs parts and brings nothing",
    ),
    Row(
        "no-reliability",
        {"min_reliability": 0},
        "the largest single step after the tests; what shiny pins it costs shows how far simulation is from them",
    ),
    Row(
        "reliability-0.95",
        {"min_reliability": 0.95},
        "not taken: a choice for cells where a wrong pose costs more than parts left behind",
    ),
    Row(
        "score-0.4",
        {"min_score": 0.4},
        "0.5 is kept for wrong units (docs/decisions.md)",
    ),
    Row(
        "no-icp",
        {"icp_iterations": 0},
        "poses as voted are too coarse to be judged",
    ),
    Row(
        "icp-4",
        {"icp_iterations": 4},
        "open: saves a third of the time for a hundredth of the recall, and more AP on data/bins",
    ),
    Row(
        "icp-24",
        {"icp_iterations": 24},
        "not taken: more steps bring nothing",
    ),
    Row(
        "no-quick-fit",
        {"min_sparse_balance": -2},
        "drops nothing that is right; kept for the time",
    ),
    Row(
        "quick-fit-0",
        {"min_sparse_balance": 0},
        "open: saves two fifths of the time, but costs half of the shiny pins; config/fast.yaml goes half of the way",
    ),
    Row(
        "candidates-100",
        {"max_candidates": 100},
        "not taken: data/bins loses AP .025",
    ),
    Row(
        "no-look",
        {"min_look_balance": -2},
        "drops next to nothing that is right; kept for the time",
    ),
    Row("look-0", {"min_look_balance": 0}),
    Row("no-climb", {"climb": False}),
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

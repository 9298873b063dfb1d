"""What is changed, one setting at a time, and what was decided."""

from dataclasses import dataclass, field


# What decides the content of a trained model, see ModelParameters in detector_config.hpp.
MODEL_SETTINGS = {"step_rel", "n_angle"}


@dataclass(frozen=True)
class Row:
    """A change of the settings or of the core's sources, and what follows from its figures."""

    name: str
    settings: dict = field(default_factory=dict)
    decision: str = ""  # none: not taken yet
    what: str = ""  # is changed; none: the settings say it
    edits: tuple = ()  # of the core's sources, see edited_core.py

    @property
    def trains(self):
        """Whether it needs models of its own."""
        return bool(self.edits) or not MODEL_SETTINGS.isdisjoint(self.settings)


ROWS = (
    Row("default", {}, "the detector as it is"),
    Row(
        "original",
        {"clustering": "greedy", "mismatch_test": False},
        "the paper's peers: six in a hundred returned poses are wrong, and 61 pass where no part lies",
    ),
    Row(
        "greedy",
        {"clustering": "greedy"},
        "as good on simulated scenes, but one of 19 pins is suspicious; kept as a choice, as it knows no spread to show",
    ),
    Row(
        "one-a-cluster",
        {"poses_per_cluster": 1},
        "the paper's mode: an eighth quicker, loses poses of clusters that chain, two pins among them",
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
        "kept for pins on longer cylinders, which these scenes hardly have; here the reliability catches all that it would",
    ),
    Row(
        "slide-of-all",
        {"firm_hold": 100.0},
        "not taken: changes nothing here, and a firmly held part may touch others all around",
    ),
    Row(
        "no-outline-gate",
        {"max_outline_broken": 1.0},
        "nothing here reaches it; kept for scans without noise",
    ),
    Row(
        "no-pierced-gate",
        {"max_pierced": 1.0},
        "kept, though it costs recall here: on other simulated scenes one of three wrong poses would pass without (docs/decisions.md)",
    ),
    Row(
        "no-margin",
        {"min_margin": -1.0},
        "kept: of the wrong poses it lets pass most are mirror images, and without it the first pick of one of the 27 scenes of data/bins is wrong",
    ),
    Row(
        "margin-0.1",
        {"min_margin": 0.1},
        "not taken: costs a hundredth of the parts, for a precision of .996 instead of .994 here and nothing on other parts",
    ),
    Row(
        "no-reliability",
        {"min_reliability": 0},
        "the largest single step after the tests: without it four times as many poses are wrong, nine times as many on other parts, and one pin in the mean",
    ),
    Row(
        "reliability-0.95",
        {"min_reliability": 0.95},
        "not taken: a choice for cells where a wrong pose costs more than parts left behind",
    ),
    Row(
        "score-0.5",
        {"min_score": 0.5},
        "not taken: costs parts that are seen in strips (docs/decisions.md)",
    ),
    Row(
        "no-icp",
        {"icp_iterations": 0},
        "poses as voted are too coarse to be judged",
    ),
    Row(
        "icp-4",
        {"icp_iterations": 4},
        "not taken: saves a fifth of the time, for AP .014 on other parts and a third of the shiny pins",
    ),
    Row(
        "icp-24",
        {"icp_iterations": 24},
        "not taken: more steps bring nothing, and three pins fewer",
    ),
    Row(
        "no-quick-fit",
        {"min_sparse_balance": -2},
        "drops nothing that is right; kept for the time",
    ),
    Row(
        "quick-fit-0",
        {"min_sparse_balance": 0},
        "not taken: saves a quarter of the time, but costs nearly all shiny pins; config/fast.yaml goes half of the way",
    ),
    Row(
        "candidates-100",
        {"max_candidates": 100},
        "not taken: data/bins loses AP .026, and a pin is suspicious",
    ),
    Row(
        "no-look",
        {"min_look_balance": -2},
        "drops next to nothing that is right; kept for the time",
    ),
    Row(
        "look-0",
        {"min_look_balance": 0},
        "not taken: nothing on simulated scenes, but four of 18 shiny pins; config/fast.yaml has it",
    ),
    Row(
        "no-climb",
        {"climb": False},
        "kept: three of 18 shiny pins, four of 15 in the mean; config/fast.yaml goes without",
    ),
    Row(
        "candidates-600",
        {"max_candidates": 600},
        "not taken: a quarter more time brings nothing",
    ),
    Row(
        "one-peak",
        {"peaks_per_reference": 1},
        "not taken: AP .003 less, and .008 on other parts",
    ),
    Row(
        "references-0.05",
        {"reference_share": 0.05},
        "not taken: AP .014 less on other parts",
    ),
    Row(
        "references-0.2",
        {"reference_share": 0.2},
        "not taken: a tenth more time for a pin, and AP .020 less on other parts",
    ),
    Row(
        "lambda-0.5",
        {"lambda": 0.5},
        "not taken: brings next to nothing where edges vote as well",
    ),
    Row(
        "step-0.05",
        {"step_rel": 0.05},
        "not taken: brings nothing but two wrong poses fewer of a thousand, and a suspicious pin",
    ),
    Row(
        "pixels-70",
        {"pixels_per_diameter": 70},
        "open: saves much of the time, for a hundredth of the AP and two of the recall on other parts",
    ),
    Row(
        "pixels-140",
        {"pixels_per_diameter": 140},
        "not taken: a fifth more time for half a hundredth of the recall",
    ),
    Row(
        "normals-3",
        {"normal_radius_px": 3},
        "not taken: rougher normals, one in a hundred wrong on other parts, and a suspicious pin",
    ),
    Row(
        "gate-0.01",
        {"depth_gate_rel": 0.01},
        "not taken: loses a tenth of the other parts and nearly all shiny pins",
    ),
    Row(
        "gate-0.025",
        {"depth_gate_rel": 0.025},
        "not taken: four pins more in the mean, one in thirty of all not right (docs/decisions.md)",
    ),
    Row(
        "gate-0.03",
        {"depth_gate_rel": 0.03},
        "not taken: four of its 25 pins are suspicious",
    ),
)

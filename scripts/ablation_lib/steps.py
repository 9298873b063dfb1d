"""Steps of the detector that no setting turns off, and how the core's sources are edited to go without."""

from .edited_core import Edit
from .rows import Row


def without(name, what, decision, *edits):
    """A row of edits, each: file, old text, new text. decision: empty until its figures are known."""
    return Row(name, what=what, decision=decision, edits=tuple(Edit(*edit) for edit in edits))


STEPS = (
    without(
        "no-noise",
        "the noise is not measured: gates, windows and falls are those of a sensor without",
        "kept: recall .016 on other parts, all of it of the coarse sensor; the scenes of data/bins have too little noise to need it",
        (
            "depth_noise.cpp",
            "return percentile(magnitudes, 0.5) /",
            "return 0 * percentile(magnitudes, 0.5) /",
        ),
    ),
    without(
        "no-boundary-votes",
        "pairs of boundary points do not vote; the places of their candidates go to those of the surface pairs",
        "the largest step: without it data/bins loses AP .083, other parts .044, the pins three",
        (
            "candidate_search.cpp",
            "worthRefining(boundaryPoses(image, model, config, deadline, distribution), most, place_m);",
            "{};\n  (void)boundaryPoses;",
        ),
        ("candidate_search.cpp", "(config.max_candidates + 1) / 2;", "(config.max_candidates);"),
    ),
    without(
        "no-place-cap",
        "any number of candidates at one place",
        "open: the cap saves no time here and costs AP .002; to be left out when the core is next changed and the reliability fitted anew",
        ("candidate_search.cpp", "kMaxPerPlace = 6;", "kMaxPerPlace = 1000000;"),
    ),
    without(
        "normals-mixed",
        "a sampling cell gives one point, whatever the normals in it, of the scene as of the part",
        "kept: AP .010 on data/bins and .013 on other parts",
        (
            "surface_sampling.cpp",
            "d.first.dot(normal) > kSameDirection",
            "d.first.dot(normal) > -2.0F",
        ),
    ),
    without(
        "no-outline-pull",
        "surfaces alone draw poses in the refinement, no edges",
        "kept: AP .007 on data/bins and .012 on other parts, and six of 18 pins",
        (
            "pose_refinement.cpp",
            "addOutline(image, part, pose, center, lever_m, last_gate_m, reach_px, equations);",
            "(void)addOutline, (void)reach_px;",
        ),
    ),
    without(
        "wide-first-gate",
        "the refinement begins with the wide gate everywhere",
        "kept: AP .004 on data/bins and .011 on other parts",
        ("pose_refinement.cpp", "kNearShare = 0.85F;", "kNearShare = 2.0F;"),
    ),
    without(
        "no-settling",
        "reliable poses do not settle",
        "brings no smaller error here; kept so that two starts on one part end alike (docs/decisions.md)",
        ("pose_refinement.cpp", "kSettlingSteps = 8;", "kSettlingSteps = 0;"),
    ),
    without(
        "looked-through-neutral",
        "a cloud behind the part's surface speaks for nothing in the verification, nor in the reliability",
        "kept: two of 20 pins are not right without",
        (
            "verification.cpp",
            "evidence_.looked_through += doubt(column, row, weight);",
            "evidence_.looked_through += 0;",
        ),
    ),
    without(
        "wrong-normals-neutral",
        "a surface turned otherwise speaks for nothing in the verification",
        "kept: AP .003 on data/bins, for which 15.2 instead of 16.1 pins pass in the mean",
        (
            "verification.cpp",
            "evidence_.wrong_normal += doubt(column, row, weight);",
            "evidence_.wrong_normal += 0;",
        ),
    ),
    without(
        "missing-neutral",
        "missing measurements speak for nothing in the verification",
        "kept: AP .019 on data/bins and .005 on other parts",
        ("verification.cpp", "kMissingWeight = 0.4;", "kMissingWeight = 0.0;"),
        ("verification.cpp", "kMissingBalance = 0.56;", "kMissingBalance = 0.0;"),
    ),
    without(
        "missing-in-full",
        "missing measurements contradict as much as a cloud behind the surface",
        "not taken: AP .007 less, and .015 on other parts",
        ("verification.cpp", "kMissingWeight = 0.4;", "kMissingWeight = 1.0;"),
        ("verification.cpp", "kMissingBalance = 0.56;", "kMissingBalance = 3.0;"),
    ),
    without(
        "edges-neutral",
        "edges count neither in the score nor in the balance of evidence",
        "kept: recall .022 on data/bins and .025 on other parts, and more than half of the pins",
        ("verification.cpp", "kEdgeWeight = 4.0;", "kEdgeWeight = 0.0;"),
        (
            "verification.cpp",
            "10.0 * (evidence.outline_broken + evidence.pierced) + 3.0 * evidence.outline_held",
            "0.0",
        ),
    ),
    without(
        "pierced-neutral",
        "a surface that passes through the part's edges speaks for nothing",
        "kept: without it four poses pass where no part lies",
        (
            "verification.cpp",
            "if (beside_surface) ++(passes ? evidence_.pierced : evidence_.stepped);",
            "if (beside_surface && !passes) ++evidence_.stepped;",
        ),
    ),
    without(
        "by-share",
        "poses compete by their score, a share, not by the balance of evidence in pixels",
        "kept: AP .009 on data/bins and .008 on other parts",
        (
            "selection.cpp",
            "evidenceBalance(*candidates[i], candidates[i]->confirmed_weight)",
            "poseScore(*candidates[i], candidates[i]->confirmed_weight)",
        ),
        (
            "selection.cpp",
            "evidenceBalance(evidence, confirmed), best",
            "poseScore(evidence, confirmed), best",
        ),
    ),
    without(
        "no-look-alikes",
        "turned copies of standing poses are not looked at",
        "kept: without them a third more poses are wrong, twice as many on other parts",
        (
            "candidate_verification.cpp",
            "turned;\n  for (const SelectedPose& standing : selected)",
            "turned;\n  for (const SelectedPose& standing : std::vector<SelectedPose>(0 * selected.size()))",
        ),
    ),
    without(
        "neighbours-hold-nothing",
        "a neighbour that is held itself does not stop a slide",
        "kept: recall .004 on data/bins and .003 on other parts, and a pin where the image is noisy or the region is not exact",
        (
            "ambiguity.cpp",
            "const bool stops = owner >= 0 &&",
            "const bool stops = owner > (1 << 30) &&",
        ),
    ),
    without(
        "outline-holds-nothing",
        "surfaces alone count in `hold`, no edges",
        "not taken: from one viewpoint surfaces alone hardly ever hold a part, so that more than half of the parts and all pins are lost",
        ("pose_information.cpp", "matrix = surface + outline;", "matrix = surface;"),
    ),
    without(
        "weights-of-the-whole-cloud",
        "the reliability has the weights of searches without a region",
        "not taken: recall .014 on data/bins and .019 on other parts, and nearly all pins",
        ("range_image.cpp", "whole_cloud = !roi;", "whole_cloud = true;"),
    ),
    without(
        "nothing-usual",
        "what the trusted poses of a scene have in common is held against each of them",
        "kept: nine of 18 pins; elsewhere next to nothing, as it is shiny parts that have lost flanks in common",
        ("reliability.cpp", "kMostUsual = 0.1;", "kMostUsual = 0.0;"),
    ),
)

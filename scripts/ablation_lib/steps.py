"""Steps of the detector that no setting turns off, and how the core's sources are edited to go without."""

from .edited_core import Edit
from .rows import Row

STEPS = (
    Row(
        "no-boundary-votes",
        what="pairs of boundary points do not vote; the places of their candidates go to those of the surface pairs",
        edits=(
            Edit(
                "candidate_search.cpp",
                "worthRefining(boundaryPoses(image, model, config, deadline, distribution), most, place_m);",
                "{};\n  (void)boundaryPoses;",
            ),
            Edit(
                "candidate_search.cpp",
                "(config.max_candidates + 1) / 2;",
                "(config.max_candidates);",
            ),
        ),
    ),
    Row(
        "no-place-cap",
        what="any number of candidates at one place",
        edits=(Edit("candidate_search.cpp", "kMaxPerPlace = 6;", "kMaxPerPlace = 1000000;"),),
    ),
    Row(
        "normals-mixed",
        what="a sampling cell gives one point, whatever the normals in it, of the scene as of the part",
        edits=(
            Edit(
                "surface_sampling.cpp",
                "d.first.dot(normal) > kSameDirection",
                "d.first.dot(normal) > -2.0F",
            ),
        ),
    ),
    Row(
        "no-outline-pull",
        what="surfaces alone draw poses in the refinement, no edges",
        edits=(
            Edit(
                "pose_refinement.cpp",
                "addOutline(image, part, pose, center, lever_m, last_gate_m, reach_px, equations);",
                "(void)addOutline, (void)reach_px;",
            ),
        ),
    ),
    Row(
        "wide-first-gate",
        what="the refinement begins with the wide gate everywhere",
        edits=(Edit("pose_refinement.cpp", "kNearShare = 0.85F;", "kNearShare = 2.0F;"),),
    ),
    Row(
        "no-settling",
        what="reliable poses do not settle",
        edits=(Edit("pose_refinement.cpp", "kSettlingSteps = 8;", "kSettlingSteps = 0;"),),
    ),
    Row(
        "looked-through-neutral",
        what="a cloud behind the part's surface speaks for nothing in the verification, nor in the reliability",
        edits=(
            Edit(
                "verification.cpp",
                "evidence_.looked_through += doubt(column, row, weight);",
                "evidence_.looked_through += 0;",
            ),
        ),
    ),
    Row(
        "wrong-normals-neutral",
        what="a surface turned otherwise speaks for nothing in the verification",
        edits=(
            Edit(
                "verification.cpp",
                "evidence_.wrong_normal += doubt(column, row, weight);",
                "evidence_.wrong_normal += 0;",
            ),
        ),
    ),
    Row(
        "missing-neutral",
        what="missing measurements speak for nothing in the verification",
        edits=(
            Edit("verification.cpp", "kMissingWeight = 0.4;", "kMissingWeight = 0.0;"),
            Edit("verification.cpp", "kMissingBalance = 0.56;", "kMissingBalance = 0.0;"),
        ),
    ),
    Row(
        "missing-in-full",
        what="missing measurements contradict as much as a cloud behind the surface",
        edits=(
            Edit("verification.cpp", "kMissingWeight = 0.4;", "kMissingWeight = 1.0;"),
            Edit("verification.cpp", "kMissingBalance = 0.56;", "kMissingBalance = 3.0;"),
        ),
    ),
    Row(
        "edges-neutral",
        what="edges count neither in the score nor in the balance of evidence",
        edits=(
            Edit("verification.cpp", "kEdgeWeight = 4.0;", "kEdgeWeight = 0.0;"),
            Edit(
                "verification.cpp",
                "10.0 * (evidence.outline_broken + evidence.pierced) + 3.0 * evidence.outline_held",
                "0.0",
            ),
        ),
    ),
    Row(
        "pierced-neutral",
        what="a surface that passes through the part's edges speaks for nothing",
        edits=(
            Edit(
                "verification.cpp",
                "if (beside_surface) ++(passes ? evidence_.pierced : evidence_.stepped);",
                "if (beside_surface && !passes) ++evidence_.stepped;",
            ),
        ),
    ),
    Row(
        "by-share",
        what="poses compete by their score, a share, not by the balance of evidence in pixels",
        edits=(
            Edit(
                "selection.cpp",
                "evidenceBalance(*candidates[i], candidates[i]->confirmed_weight)",
                "poseScore(*candidates[i], candidates[i]->confirmed_weight)",
            ),
            Edit(
                "selection.cpp",
                "evidenceBalance(evidence, confirmed), best",
                "poseScore(evidence, confirmed), best",
            ),
        ),
    ),
    Row(
        "no-look-alikes",
        what="turned copies of standing poses are not looked at",
        edits=(
            Edit(
                "candidate_verification.cpp",
                "turned;\n  for (const SelectedPose& standing : selected)",
                "turned;\n  for (const SelectedPose& standing : std::vector<SelectedPose>(0 * selected.size()))",
            ),
        ),
    ),
    Row(
        "neighbours-hold-nothing",
        what="a neighbour that is held itself does not stop a slide",
        edits=(
            Edit(
                "ambiguity.cpp",
                "const bool stops = owner >= 0 &&",
                "const bool stops = owner > (1 << 30) &&",
            ),
        ),
    ),
    Row(
        "nothing-usual",
        what="what the trusted poses of a scene have in common is held against each of them",
        edits=(Edit("reliability.cpp", "kMostUsual = 0.1;", "kMostUsual = 0.0;"),),
    ),
)

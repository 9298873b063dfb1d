/// @file An evaluation as a table for people and as JSON for programs.
#pragma once

#include "evaluation_summary.hpp"
#include "pose_judgement.hpp"

#include <string>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
/// Everything that is known about one part's scenes.
struct PartEvaluation
{
  std::string name;
  std::vector<JudgedScene> scenes;
};

/// A name with its figures: the parts in the given order, then `ALL`.
using NamedSummaries = std::vector<std::pair<std::string, Summary>>;

/// Sums up each part, and all.
NamedSummaries summariseParts(const std::vector<PartEvaluation>& parts);

/// What the columns of the table mean, for --help.
std::string columnHelp();

/// One line a part; `nan` where there is nothing to take a share or a median of.
std::string tableText(const NamedSummaries& summaries);

/// The text of a JSON file with the rules, the summaries, the precision-recall curves, and scene by
/// scene what became of each pose. A number that does not exist is null.
std::string evaluationJson(const std::vector<PartEvaluation>& parts,
                           const NamedSummaries& summaries, const JudgementRules& rules);
}  // namespace ppf_bin_picking

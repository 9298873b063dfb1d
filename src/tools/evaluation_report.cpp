#include "evaluation_report.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>

namespace ppf_bin_picking
{
namespace
{
using nlohmann::json;
constexpr double kMillimetres = 1000.0;
constexpr double kDegrees = 180.0 / M_PI;

json toJson(const Summary& s)
{
  return {{"scenes", s.scenes},
          {"targets", s.targets},
          {"AP", s.average_precision},
          {"precision", s.precision},
          {"recall", s.recall},
          {"AP_rel", s.average_precision_reliable},
          {"first", s.first},
          {"flag_precision", s.flag_precision},
          {"flag_recall", s.flag_recall},
          {"lost", s.lost},
          {"t_mm", s.translation_mm},
          {"r_deg", s.rotation_deg},
          {"nees", s.nees},
          {"right", s.right},
          {"wrong", s.wrong},
          {"ms", s.median_ms},
          {"max_ms", s.largest_ms},
          {"AR_vsd", s.recall_vsd},
          {"AR_mssd", s.recall_mssd},
          {"AR_mspd", s.recall_mspd}};
}

json toJson(const std::vector<CurvePoint>& curve)
{
  json points = json::array();
  for (const CurvePoint& point : curve)
    points.push_back({point.score, point.precision, point.recall});
  return points;
}

json toJson(const JudgedPose& pose)
{
  return {{"index", pose.index},
          {"score", pose.score},
          {"reliable", pose.reliable},
          {"verdict", toString(pose.verdict)},
          {"object", pose.object},
          {"mssd_rel", pose.mssd_rel},
          {"t_mm", pose.translation_m * kMillimetres},
          {"r_deg", pose.rotation_rad * kDegrees},
          {"nees", pose.nees}};
}

json toJson(const JudgedScene& scene)
{
  json poses = json::array();
  for (const JudgedPose& pose : scene.poses)
    poses.push_back(toJson(pose));
  return {
      {"scene", scene.name},
      {"targets", scene.targets},
      {"time_ms", scene.time_ms},
      {"recalled",
       {{"vsd", scene.recalled.vsd}, {"mssd", scene.recalled.mssd}, {"mspd", scene.recalled.mspd}}},
      {"poses", poses}};
}
}  // namespace

NamedSummaries summariseParts(const std::vector<PartEvaluation>& parts)
{
  NamedSummaries summaries;
  std::vector<JudgedScene> all;
  for (const PartEvaluation& part : parts)
  {
    summaries.emplace_back(part.name, summarise(part.scenes));
    all.insert(all.end(), part.scenes.begin(), part.scenes.end());
  }
  summaries.emplace_back("ALL", summarise(all));
  return summaries;
}

std::string columnHelp()
{
  return "Columns, one line a part and one for all:\n"
         "  targets     objects visible enough to be found\n"
         "  AP          area under the precision-recall curve of all poses, reliable or not\n"
         "  P, R        precision and recall of the reliable poses\n"
         "  AP_rel      as AP, of the reliable poses alone\n"
         "  first       share of scenes whose best reliable pose is right\n"
         "  flagP       of the unreliable poses, how many are wrong\n"
         "  flagR       of the wrong poses, how many are unreliable\n"
         "  lost        of the right poses, how many are unreliable\n"
         "  t mm, r deg median errors of the right reliable poses\n"
         "  VSD, MSSD, MSPD  average recall of the reliable poses as in the BOP challenge\n"
         "  ms, max     median and largest detection time, as the results state it\n";
}

std::string tableText(const NamedSummaries& summaries)
{
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(),
                "%-12s %7s %6s | %6s %6s %6s %6s | %6s %6s %6s | %6s %6s | %6s %6s %6s | %7s %7s\n",
                "part", "targets", "AP", "P", "R", "AP_rel", "first", "flagP", "flagR", "lost",
                "t mm", "r deg", "VSD", "MSSD", "MSPD", "ms", "max");
  std::string text = line.data();
  for (const auto& [name, s] : summaries)
  {
    std::snprintf(line.data(), line.size(),
                  "%-12s %7zu %6.3f | %6.3f %6.3f %6.3f %6.2f | %6.2f %6.2f %6.3f | %6.2f %6.2f | "
                  "%6.3f %6.3f %6.3f | %7.0f %7.0f\n",
                  name.c_str(), s.targets, s.average_precision, s.precision, s.recall,
                  s.average_precision_reliable, s.first, s.flag_precision, s.flag_recall, s.lost,
                  s.translation_mm, s.rotation_deg, s.recall_vsd, s.recall_mssd, s.recall_mspd,
                  s.median_ms, s.largest_ms);
    text += line.data();
  }
  return text;
}

std::string evaluationJson(const std::vector<PartEvaluation>& parts,
                           const NamedSummaries& summaries, const JudgementRules& rules)
{
  json root = {{"threshold", rules.threshold_rel},
               {"min_visibility", rules.min_visibility},
               {"summary", json::object()},
               {"curves", json::object()},
               {"scenes", json::object()}};
  for (const auto& [name, summary] : summaries)
  {
    root["summary"][name] = toJson(summary);
    root["curves"][name] = toJson(summary.curve);
  }
  for (const PartEvaluation& part : parts)
  {
    json& scenes = root["scenes"][part.name] = json::array();
    for (const JudgedScene& scene : part.scenes)
      scenes.push_back(toJson(scene));
  }
  return root.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}
}  // namespace ppf_bin_picking

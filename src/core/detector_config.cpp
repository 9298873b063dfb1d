#include "ppf_bin_picking/core/detector_config.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
/// Collects one sentence for each value outside its range.
class RangeCheck
{
public:
  template <class Value>
  void within(const char* name, Value value, Value low, Value high)
  {
    if (value >= low && value <= high) return;  // false for NaN, too
    std::ostringstream text;
    text << name << " is " << value << ": give a value from " << low << " to " << high;
    problems_.push_back(text.str());
  }

  std::vector<std::string> take() { return std::move(problems_); }

private:
  std::vector<std::string> problems_;
};

constexpr double kTiny = 1e-6;
constexpr double kHuge = 1e6;
constexpr int kMany = 100000000;
}  // namespace

std::vector<std::string> DetectorConfig::problems() const
{
  RangeCheck check;
  check.within("step_rel", model.step_rel, 0.01, 0.2);
  check.within("n_angle", model.n_angle, 8, 120);
  check.within("max_points", max_points, 1, kMany);
  check.within("pixels_per_diameter", pixels_per_diameter, 20.0, kHuge);
  check.within("normal_radius_px", normal_radius_px, 1, 10);
  check.within("reference_share", reference_share, kTiny, 1.0);
  check.within("lambda", lambda, 0.0, 1.0);
  check.within("v_min", v_min, kTiny, 1.0);
  check.within("peaks_per_reference", peaks_per_reference, 1, 10);
  check.within("peak_ratio", peak_ratio, kTiny, 1.0);
  check.within("min_votes_rel", min_votes_rel, 0.0, 1.0);
  check.within("eps_rel", eps_rel, 0.0, kHuge);
  check.within("minpts", minpts, 0, kMany);
  check.within("group_distance_rel", group_distance_rel, kTiny, kHuge);
  check.within("group_angle_rad", group_angle_rad, kTiny, M_PI);
  check.within("poses_per_cluster", poses_per_cluster, 0, kMany);
  check.within("max_spread_rel", max_spread_rel, kTiny, kHuge);
  check.within("max_candidates", max_candidates, 1, kMany);
  check.within("min_sparse_balance", min_sparse_balance, -2.0, 1.0);
  check.within("min_look_balance", min_look_balance, -2.0, 1.0);
  check.within("icp_iterations", icp_iterations, 0, 100);
  check.within("depth_gate_rel", depth_gate_rel, kTiny, kHuge);
  check.within("normal_gate_rad", normal_gate_rad, kTiny, M_PI_2);
  check.within("min_score", min_score, kLeastScore, 1.0);
  check.within("max_slide_share", max_slide_share, 0.0, 1.0);
  check.within("firm_hold", firm_hold, 0.0, kHuge);
  check.within("max_outline_broken", max_outline_broken, 0.0, 1.0);
  check.within("max_pierced", max_pierced, 0.0, 1.0);
  check.within("min_margin", min_margin, -1.0, 1.0);
  check.within("min_reliability", min_reliability, 0.0, 1.0);
  check.within("min_visible_share", min_visible_share, 0.0, 1.0);
  check.within("min_confirmed_px", min_confirmed_px, 1, kMany);
  check.within("threads", threads, 0, 1024);
  check.within("time_limit_s", time_limit_s, 0.0, kHuge);
  return check.take();
}

const char* toString(Clustering clustering)
{
  return clustering == Clustering::kDbscan ? "dbscan" : "greedy";
}

Clustering clusteringFromString(const std::string& word)
{
  for (const Clustering value : {Clustering::kDbscan, Clustering::kGreedy})
    if (word == toString(value)) return value;
  throw std::invalid_argument("clustering is '" + word + "': give dbscan or greedy");
}
}  // namespace ppf_bin_picking

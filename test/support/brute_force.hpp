/// @file Slow and obvious twins of what the core does fast.
#pragma once

#include "ppf_bin_picking/core/dbscan.hpp"
#include "ppf_bin_picking/core/ppf.hpp"
#include "ppf_bin_picking/core/ppf_matcher.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
/// Angle between two vectors in double precision [rad]; 0 if one has no length.
inline double slowAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The table of a model: key to the sorted entries under it.
inline std::map<std::uint32_t, std::vector<std::uint32_t>> slowTable(const PpfModelData& data)
{
  const FeatureQuantizer quantizer(data.parameters, data.diameter_m);
  std::map<std::uint32_t, std::vector<std::uint32_t>> table;
  for (std::size_t i = 0; i < data.points.size(); ++i)
    for (std::size_t j = 0; j < data.points.size(); ++j)
    {
      if (i == j) continue;
      const PairFeature feature =
          pairFeature(data.points[i], data.normals[i], data.points[j], data.normals[j]);
      if (feature.distance_m > data.diameter_m) continue;
      const std::uint32_t alpha =
          pairAlpha(rotationToX(data.normals[i]), data.points[i], data.points[j]);
      table[quantizer.key(feature)].push_back(static_cast<std::uint32_t>(i) * kAlphaTurn + alpha);
    }
  for (auto& [key, entries] : table)
    std::sort(entries.begin(), entries.end());
  return table;
}

/// The most votes of any (model point, alpha step) for one scene point as the reference; 0 without
/// votes.
inline float slowBestVotes(const OrientedPoints& scene, std::size_t reference,
                           const PpfModelData& data,
                           const std::map<std::uint32_t, std::vector<std::uint32_t>>& table,
                           const DetectorConfig& config)
{
  const FeatureQuantizer quantizer(data.parameters, data.diameter_m);
  const Eigen::Matrix3f rotation = rotationToX(scene.normals[reference]);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> votes;
  for (std::size_t j = 0; j < scene.size(); ++j)
  {
    if (j == reference) continue;
    const PairFeature feature = pairFeature(scene.points[reference], scene.normals[reference],
                                            scene.points[j], scene.normals[j]);
    if (feature.distance_m > data.diameter_m) continue;
    const auto entries = table.find(quantizer.key(feature));
    if (entries == table.end()) continue;
    const std::uint32_t alpha_scene = pairAlpha(rotation, scene.points[reference], scene.points[j]);
    for (const std::uint32_t entry : entries->second)
    {
      const std::uint32_t turn = (entry % kAlphaTurn + kAlphaTurn - alpha_scene) % kAlphaTurn;
      const std::uint32_t bin =
          turn * static_cast<std::uint32_t>(data.parameters.n_angle) / kAlphaTurn;
      votes[{entry / kAlphaTurn, bin}] +=
          voteWeight(scene.normals[reference], scene.normals[j], config.lambda, config.v_min);
    }
  }
  std::uint32_t most = 0;
  for (const auto& [cell, sum] : votes)
    most = std::max(most, sum);
  return static_cast<float>(most) / kVoteUnit;
}

/// Indices of the points at most radius_m away.
inline std::vector<std::uint32_t> slowWithin(const std::vector<Eigen::Vector3f>& points,
                                             const Eigen::Vector3f& query, float radius_m)
{
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if ((points[i] - query).squaredNorm() <= radius_m * radius_m) near.push_back(i);
  return near;
}

/// DBSCAN by its definition: core points within eps of each other are connected; a cluster is a
/// connected part, numbered by its first core point; other points join the first cluster with a
/// core point within eps.
inline std::vector<std::int32_t> slowDbscan(const std::vector<Eigen::Vector3f>& points, float eps_m,
                                            std::size_t minpts)
{
  std::vector<std::vector<std::uint32_t>> near;
  for (const Eigen::Vector3f& point : points)
    near.push_back(slowWithin(points, point, eps_m));
  const auto is_core = [&](std::size_t i) { return near[i].size() >= minpts; };

  // The label of a core point is the smallest index it is connected with, spread until all agree.
  std::vector<std::uint32_t> root(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    root[i] = i;
  for (bool changed = true; changed;)
  {
    changed = false;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (const std::uint32_t j : near[i])
        if (is_core(i) && is_core(j) && root[j] < root[i])
        {
          root[i] = root[j];
          changed = true;
        }
  }
  std::map<std::uint32_t, std::int32_t> number;  // ascending roots: clusters by first core point
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_core(i)) number.emplace(root[i], 0);
  std::int32_t next = 0;
  for (auto& [first, cluster] : number)
    cluster = next++;

  std::vector<std::int32_t> labels(points.size(), kNoise);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const std::uint32_t j : near[i])
      if (is_core(j) && (!is_core(i) || j == i))
        labels[i] = labels[i] == kNoise ? number[root[j]] : std::min(labels[i], number[root[j]]);
  return labels;
}
}  // namespace ppf_bin_picking

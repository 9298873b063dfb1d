/// @file Detections as JSON, the format of `detect_poses`.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"

#include <string>

namespace ppf_bin_picking
{
/// A detection with what a reader of the file needs beside it.
struct ResultFile
{
  std::string frame_id;      ///< The cloud's frame; empty where the cloud names none.
  std::string model_id;      ///< Of the part; empty where the file names none.
  double train_seconds = 0;  ///< 0 where the model came from a file.
  DetectionResult result;
};

/// `OK`, `NO_PICKABLE_POSE`, `ROI_EMPTY`, `TIME_LIMIT`, `BAD_CLOUD`.
const char* toString(DetectionStatus status);

/// The text of a result file: status, poses, regions, times [ms]. The same detection gives the same
/// text, times aside. The distribution, the clusters and the scene are left out.
std::string toJson(const ResultFile& file);

/// Reads what toJson() wrote.
/// @throw InputError if the file is not JSON, or a pose is missing, not rigid or not a number.
ResultFile loadResult(const std::string& path);
}  // namespace ppf_bin_picking

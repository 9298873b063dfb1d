/// @file The trained parts, loaded in the background.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include "ppf_bin_picking/ros/detection_view.hpp"
#include "ppf_bin_picking/ros/params.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace ppf_bin_picking_ros
{
/// A part ready to be found. Immutable.
struct LoadedPart
{
  PartView view;
  ppf_bin_picking::DetectorConfig config;  ///< The node's settings with those of the part file.
  ppf_bin_picking::PpfModel model;
};
using LoadedPartPtr = std::shared_ptr<const LoadedPart>;

/// Loads the parts of the node's parameters one after another in a thread of its own, so that the
/// node starts at once. A part that cannot be loaded leaves the others usable. Thread safe.
class PartStore
{
public:
  /// Starts loading. Problems are logged at ERROR, oddities of a mesh at WARN.
  explicit PartStore(const ServerParams& params);

  /// Waits for the part that is being loaded; those after it are left.
  ~PartStore();

  PartStore(const PartStore&) = delete;
  PartStore& operator=(const PartStore&) = delete;

  /// The part with this id, or all parts for an empty one.
  /// @throw RequestFailed: NOT_READY while it is being loaded (an empty id waits for all),
  ///        UNKNOWN_MODEL if there is none, or it could not be loaded.
  std::vector<LoadedPartPtr> select(const std::string& model_id) const;

  /// One sentence for each part that could not be loaded.
  std::vector<std::string> failures() const;

  /// Ids of the loaded parts, in the order of the parameter.
  std::vector<std::string> loadedIds() const;

  /// True once every part is loaded or has failed.
  bool finished() const;

private:
  void loadAll(const ServerParams& params);
  void load(const std::string& file, const ServerParams& params);
  void add(LoadedPart part, const std::string& file);
  std::string failureOf(const std::string& model_id) const;

  mutable std::mutex mutex_;
  std::vector<LoadedPartPtr> loaded_;
  struct Failure
  {
    std::string model_id;  ///< Empty if the part file could not be read.
    std::string sentence;
  };
  std::vector<Failure> failures_;
  bool finished_ = false;
  std::atomic<bool> stop_{false};
  std::thread thread_;  ///< Last, so that it starts when all else is there.
};
}  // namespace ppf_bin_picking_ros

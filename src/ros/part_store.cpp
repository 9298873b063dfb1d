#include "ppf_bin_picking/ros/part_store.hpp"

#include "ppf_bin_picking/core/detector.hpp"

#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/key_check.hpp"
#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/mesh_simplification.hpp"
#include "ppf_bin_picking/io/model_io.hpp"
#include "ppf_bin_picking/io/part_training.hpp"
#include "ppf_bin_picking/ros/request_failed.hpp"

#include <ros/console.h>

#include <algorithm>
#include <utility>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::DetectorConfig;
using ppf_bin_picking::InputError;
using ppf_bin_picking::PartDescription;
using ppf_bin_picking::PpfModel;

constexpr std::size_t kMaxDrawnTriangles = 2000;

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Loads the trained model that the part file names, or trains one.
PpfModel modelOf(const PartDescription& part, const DetectorConfig& config)
{
  const ppf_bin_picking::LoadedMesh loaded = ppf_bin_picking::loadMesh(part.mesh_file, part.unit);
  for (const std::string& warning : loaded.warnings)
    ROS_WARN_STREAM(warning);
  if (part.model_file.empty())
  {
    ppf_bin_picking::TrainedPart trained =
        ppf_bin_picking::trainPart(part, loaded.mesh, config.model);
    for (const std::string& note : trained.notes)
      ROS_INFO_STREAM("Part '" << part.model_id << "': " << note);
    for (const std::string& warning : trained.warnings)
      ROS_WARN_STREAM(warning);
    return std::move(trained.model);
  }
  ppf_bin_picking::ModelFile file = ppf_bin_picking::loadModel(part.model_file);
  ppf_bin_picking::requireFit(file, part, ppf_bin_picking::meshChecksum(loaded.mesh));
  return std::move(file.model);
}

LoadedPart loadedPart(const PartDescription& part, const ServerParams& params)
{
  const DetectorConfig config = part.adapted(params.detector);
  LoadedPart loaded{{part.model_id, {}, {}}, config, modelOf(part, config)};
  std::optional<ppf_bin_picking::RegionOfInterest> roi;
  if (params.region_of_interest) roi = params.region_of_interest->region;
  const std::string problem = ppf_bin_picking::modelProblem(loaded.model, config, roi);
  if (!problem.empty()) throw InputError(part.source + ": " + problem);
  for (const ppf_bin_picking::Pick& pick : part.picks)
    loaded.view.T_model_picks.push_back(pick.T_model_pick);
  loaded.view.mesh_to_draw =
      ppf_bin_picking::decimated(loaded.model.data().mesh, kMaxDrawnTriangles);
  return loaded;
}
}  // namespace

PartStore::PartStore(const ServerParams& params) : thread_([this, params] { loadAll(params); }) {}

PartStore::~PartStore()
{
  stop_ = true;
  thread_.join();
}

void PartStore::loadAll(const ServerParams& params)
{
  for (const std::string& file : params.parts)
  {
    if (stop_) break;
    load(file, params);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  finished_ = true;
}

void PartStore::load(const std::string& file, const ServerParams& params)
{
  Failure failure;
  try
  {
    const PartDescription part = ppf_bin_picking::loadPart(file);
    failure.model_id = part.model_id;
    add(loadedPart(part, params), file);
    ROS_INFO_STREAM("Part '" << part.model_id << "' is ready");
    return;
  }
  catch (const std::exception& error)
  {
    failure.sentence = error.what();
  }
  ROS_ERROR_STREAM("Part file " << file << " is not loaded: " << failure.sentence);
  const std::lock_guard<std::mutex> lock(mutex_);
  failures_.push_back(failure);
}

void PartStore::add(LoadedPart part, const std::string& file)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const LoadedPartPtr& other : loaded_)
    if (other->view.id == part.view.id)
      throw InputError(file + ": model_id '" + part.view.id +
                       "' is that of another part: give it a model_id of its own");
  loaded_.push_back(std::make_shared<const LoadedPart>(std::move(part)));
}

std::vector<LoadedPartPtr> PartStore::select(const std::string& model_id) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const LoadedPartPtr& part : loaded_)
    if (part->view.id == model_id) return {part};
  if (!finished_)
    throw RequestFailed(Response::NOT_READY,
                        (model_id.empty() ? "Parts are" : "Part '" + model_id + "' is") +
                            std::string(" not loaded yet: ask again in a few seconds"));
  if (model_id.empty() && !loaded_.empty()) return loaded_;
  if (model_id.empty())
    throw RequestFailed(Response::UNKNOWN_MODEL, "No part is loaded: correct the part files");
  throw RequestFailed(Response::UNKNOWN_MODEL, failureOf(model_id));
}

/// The caller holds the mutex.
std::string PartStore::failureOf(const std::string& model_id) const
{
  for (const Failure& failure : failures_)
    if (failure.model_id == model_id)
      return "Part '" + model_id + "' could not be loaded: correct its part file";
  std::vector<std::string> ids;
  for (const LoadedPartPtr& part : loaded_)
    ids.push_back(part->view.id);
  if (ids.empty()) return "Part '" + model_id + "' is unknown, as no part is loaded";
  const std::string similar = ppf_bin_picking::similarName(model_id, ids);
  return "Part '" + model_id + "' is unknown: " +
         (similar.empty() ? "ask for a loaded one"
                          : "the nearest loaded part is '" + similar + "'") +
         " (loaded: " + joined(ids) + ")";
}

std::vector<std::string> PartStore::failures() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> sentences;
  for (const Failure& failure : failures_)
    sentences.push_back(failure.sentence);
  return sentences;
}

std::vector<std::string> PartStore::loadedIds() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> ids;
  for (const LoadedPartPtr& part : loaded_)
    ids.push_back(part->view.id);
  return ids;
}

bool PartStore::finished() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return finished_;
}
}  // namespace ppf_bin_picking_ros

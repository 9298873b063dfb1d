#include "peers.hpp"

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <pcl/pcl_config.h>

#include <chrono>
#include <ctime>
#include <sstream>
#include <thread>

namespace ppf_bin_picking
{
namespace
{
/// The value after a key of OpenCV's build information.
std::string opencvFact(const std::string& key)
{
  std::istringstream lines(cv::getBuildInformation());
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t at = line.find(key + ":");
    if (at == std::string::npos) continue;
    const std::size_t value = line.find_first_not_of(' ', at + key.size() + 1);
    return value == std::string::npos ? "" : line.substr(value);
  }
  return "unknown";
}
}  // namespace

PeerPart peerPart(const ToolPart& part)
{
  PeerPart made;
  made.diameter_m = meshDiameter(part.mesh);
  TriangleMesh mesh = part.mesh;
  made.surface = sampleVisibleSurface(mesh, static_cast<float>(kVoxelRel * made.diameter_m));
  return made;
}

void timeStage(const char* name, const std::function<void()>& stage, PeerResult& peer)
{
  const std::clock_t processor_start = std::clock();
  const auto start = std::chrono::steady_clock::now();
  stage();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double processor_s = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  const double before_s = peer.result.seconds;
  peer.result.stages.push_back({name, seconds});
  peer.result.seconds += seconds;
  peer.cores = (peer.cores * before_s + processor_s) / peer.result.seconds;
}

std::string buildFacts()
{
  const nlohmann::json facts = {{"build_type", BUILD_TYPE},
                                {"flags", BUILD_FLAGS},
                                {"compiler", BUILD_COMPILER},
                                {"cores", std::thread::hardware_concurrency()},
                                {"pcl", PCL_VERSION_PRETTY},
                                {"opencv", CV_VERSION},
                                {"opencv_build_type", opencvFact("Configuration")},
                                {"opencv_flags", opencvFact("C++ flags (Release)")}};
  return facts.dump(1);
}
}  // namespace ppf_bin_picking

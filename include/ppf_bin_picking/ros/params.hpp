/// @file ROS parameters of the node. They are read by the functions that read the YAML files of the
/// command line, so that both mean the same.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"

#include "ppf_bin_picking/io/config_io.hpp"

#include <XmlRpcValue.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace ppf_bin_picking_ros
{
/// The private parameters of the node, checked. config/cell.yaml explains each.
struct ServerParams
{
  ppf_bin_picking::DetectorConfig detector;  ///< `detector/...`
  std::vector<std::string> parts;            ///< Part files; at least one.
  std::string output_frame;                  ///< Empty: the cloud's own frame.
  std::optional<ppf_bin_picking::FramedRegion> region_of_interest;  ///< None: everywhere.
  double timeout_s = 5.0;     ///< Longest wait for the next cloud (steady clock). In (0, 3600].
  double tf_timeout_s = 0.5;  ///< Longest wait for a transform (steady clock). In [0, 3600].
  int max_poses = 0;          ///< Poses in an answer at most. 0: all. >= 0.
};

/// Wrong parameters: one sentence for each problem.
class ParamError : public std::runtime_error
{
public:
  explicit ParamError(std::vector<std::string> problems);
  const std::vector<std::string>& problems() const { return problems_; }

private:
  std::vector<std::string> problems_;
};

/// Reads all private parameters.
/// @param tree   What the parameter server holds below the node's name: a struct, or invalid if it
///               holds nothing.
/// @param where  The node's name; begins every message.
/// @throw ParamError naming each unknown key with a similar known name, each value of a wrong
///        type or out of range, and missing parts.
ServerParams readServerParams(const XmlRpc::XmlRpcValue& tree, const std::string& where);

/// The same tree as YAML. A text stays a text, even one that looks like a number.
YAML::Node toYaml(const XmlRpc::XmlRpcValue& value);
}  // namespace ppf_bin_picking_ros

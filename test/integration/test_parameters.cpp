// The same YAML through rosparam and through the reader of the command line.
#include "ppf_bin_picking/io/config_io.hpp"
#include "ppf_bin_picking/ros/params.hpp"

#include <gtest/gtest.h>

#include <ros/ros.h>

namespace ppf_bin_picking_ros
{
namespace
{
std::string package_folder;

ServerParams paramsOf(const std::string& node)
{
  XmlRpc::XmlRpcValue tree;
  EXPECT_TRUE(ros::param::get(node, tree));
  return readServerParams(tree, node);
}

TEST(DetectorYaml, meansTheSameToRosparamAndToTheCommandLine)
{
  const auto from_file = ppf_bin_picking::loadDetectorConfig(
      package_folder + "/test/integration/changed_detector.yaml");
  EXPECT_EQ(toYaml(paramsOf("/changed").detector), toYaml(from_file));
  EXPECT_NE(toYaml(from_file), toYaml(ppf_bin_picking::DetectorConfig()));
}

TEST(DetectorYaml, asShippedHoldsTheDefaults)
{
  EXPECT_EQ(toYaml(paramsOf("/shipped").detector), toYaml(ppf_bin_picking::DetectorConfig()));
}

TEST(DetectorYaml, asShippedHoldsEveryKey)
{
  XmlRpc::XmlRpcValue settings;
  ASSERT_TRUE(ros::param::get("/shipped/detector", settings));
  for (const std::string& key : ppf_bin_picking::detectorConfigKeys())
    EXPECT_TRUE(settings.hasMember(key)) << key;
}

TEST(CellYaml, isATemplateThatHoldsTheDefaults)
{
  const ServerParams cell = paramsOf("/template");
  const ServerParams defaults;
  EXPECT_EQ(cell.timeout_s, defaults.timeout_s);
  EXPECT_EQ(cell.tf_timeout_s, defaults.tf_timeout_s);
  EXPECT_EQ(cell.max_poses, defaults.max_poses);
  EXPECT_EQ(cell.output_frame, defaults.output_frame);
  ASSERT_EQ(cell.parts.size(), 1U);
  EXPECT_EQ(cell.parts[0], package_folder + "/config/parts/bracket.yaml");
}
}  // namespace
}  // namespace ppf_bin_picking_ros

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "parameters_test");
  ros::start();
  ppf_bin_picking_ros::package_folder = argv[1];
  return RUN_ALL_TESTS();
}

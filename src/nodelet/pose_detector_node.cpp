// The stand-alone node: loads the nodelet, so that there is one way of working.
#include <nodelet/loader.h>
#include <ros/ros.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "pose_detector");
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  nodelet::Loader loader(false);
  if (!loader.load(ros::this_node::getName(), "ppf_bin_picking/PoseDetector",
                   ros::names::getRemappings(), arguments))
  {
    ROS_FATAL("The pose detector could not be started; the reason stands above");
    return 1;
  }
  ros::spin();
  return 0;
}

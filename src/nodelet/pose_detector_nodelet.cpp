// The nodelet: takes the handles, owns the server.
#include "ppf_bin_picking/ros/pose_server.hpp"

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

namespace ppf_bin_picking_ros
{
class PoseDetectorNodelet : public nodelet::Nodelet
{
private:
  /// @throw whatever PoseServer throws, after it is logged: the loader tells nobody.
  void onInit() override
  {
    try
    {
      server_ = std::make_unique<PoseServer>(getNodeHandle(), getPrivateNodeHandle());
    }
    catch (const ParamError& error)
    {
      for (const std::string& problem : error.problems())
        NODELET_ERROR_STREAM(problem);
      throw;
    }
    catch (const std::exception& error)
    {
      NODELET_ERROR_STREAM("The pose detector cannot start: " << error.what());
      throw;
    }
  }

  std::unique_ptr<PoseServer> server_;
};
}  // namespace ppf_bin_picking_ros

PLUGINLIB_EXPORT_CLASS(ppf_bin_picking_ros::PoseDetectorNodelet, nodelet::Nodelet)

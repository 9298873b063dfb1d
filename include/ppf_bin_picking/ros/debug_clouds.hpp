/// @file Clouds that show a person how a detection came about.
#pragma once

#include "ppf_bin_picking/ros/detection_view.hpp"

#include <sensor_msgs/PointCloud2.h>

namespace ppf_bin_picking_ros
{
/// The centres of all hypotheses in the target frame [m], coloured by cluster; noise is grey.
/// Fields x y z rgb.
sensor_msgs::PointCloud2 distributionCloud(const DetectionView& view);

/// The orientations of all hypotheses in the target frame as axis * angle / pi: points of the unit
/// ball about the frame's origin, in the colours of distributionCloud(). Fields x y z rgb.
sensor_msgs::PointCloud2 orientationCloud(const DetectionView& view);

/// The sampled scene in the target frame [m], grey. Fields x y z rgb.
sensor_msgs::PointCloud2 sceneCloud(const DetectionView& view);
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/ros/markers.hpp"

#include "support/detection_views.hpp"

#include <gtest/gtest.h>

#include <tf2_eigen/tf2_eigen.h>

#include <map>
#include <set>

namespace ppf_bin_picking_ros
{
namespace
{
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

std::map<std::string, std::vector<Marker>> byNamespace(const MarkerArray& array)
{
  std::map<std::string, std::vector<Marker>> markers;
  for (const Marker& marker : array.markers)
    if (marker.action == Marker::ADD) markers[marker.ns].push_back(marker);
  return markers;
}

bool isGreen(const Marker& marker)
{
  return marker.color.g > 0.6F && marker.color.r < 0.3F && marker.color.b < 0.3F;
}

bool isRed(const Marker& marker)
{
  return marker.color.r > 0.8F && marker.color.g < 0.2F && marker.color.b < 0.2F;
}

Eigen::Isometry3d poseOf(const Marker& marker)
{
  Eigen::Isometry3d pose;
  tf2::fromMsg(marker.pose, pose);
  return pose;
}

TEST(ToMarkers, deletesWhatWasDrawnBeforeItDraws)
{
  const MarkerArray array = toMarkers(exampleView());
  ASSERT_GT(array.markers.size(), 1U);
  EXPECT_EQ(array.markers[0].action, Marker::DELETEALL);
  for (std::size_t i = 1; i < array.markers.size(); ++i)
    EXPECT_EQ(array.markers[i].action, Marker::ADD);
}

TEST(ToMarkers, useTheHeaderNumbersOfTheirOwnAndValuesThatRvizTakes)
{
  std::set<int> ids;
  for (const Marker& marker : toMarkers(exampleView()).markers)
  {
    EXPECT_EQ(marker.header.frame_id, "base_link");
    EXPECT_EQ(marker.header.stamp, ros::Time(5, 6));
    EXPECT_TRUE(ids.insert(marker.id).second);
    EXPECT_GT(marker.color.a, 0.0F);
    EXPECT_GT(marker.scale.x, 0.0);
    if (marker.type == Marker::CUBE)
    {
      EXPECT_GT(marker.scale.y, 0.0);
      EXPECT_GT(marker.scale.z, 0.0);
    }
    EXPECT_EQ(marker.lifetime, ros::Duration(0));
  }
}

TEST(ToMarkers, haveTheNamespacesTypesAndColoursPromised)
{
  auto markers = byNamespace(toMarkers(exampleView()));
  ASSERT_EQ(markers.size(), 6U);
  ASSERT_EQ(markers["pickable"].size(), 2U);
  for (const Marker& marker : markers["pickable"])
  {
    EXPECT_EQ(marker.type, Marker::TRIANGLE_LIST);
    EXPECT_TRUE(isGreen(marker));
    EXPECT_EQ(marker.points.size(), 3U);
  }
  ASSERT_EQ(markers["mismatching_regions"].size(), 1U);
  EXPECT_EQ(markers["mismatching_regions"][0].type, Marker::CUBE);
  EXPECT_TRUE(isRed(markers["mismatching_regions"][0]));
  ASSERT_EQ(markers["mismatching_poses"].size(), 1U);
  EXPECT_EQ(markers["mismatching_poses"][0].type, Marker::TRIANGLE_LIST);
  EXPECT_TRUE(isRed(markers["mismatching_poses"][0]));
  EXPECT_EQ(markers["clusters"].size(), 1U);
  EXPECT_EQ(markers["noise"].size(), 1U);
  EXPECT_EQ(markers["roi"].size(), 1U);
}

TEST(ToMarkers, standWhereTheDetectionSays)
{
  auto markers = byNamespace(toMarkers(exampleView()));
  EXPECT_TRUE(
      poseOf(markers["pickable"][0]).isApprox(exampleTransform() * shift(0, 0, 0.5), 1e-12));
  const Marker& region = markers["mismatching_regions"][0];
  EXPECT_TRUE(poseOf(region).isApprox(exampleTransform() * shift(0, 0.1, 0.5), 1e-12));
  EXPECT_EQ(region.scale.x, 0.2);
  EXPECT_EQ(region.scale.y, 0.1);
  EXPECT_TRUE(poseOf(markers["mismatching_poses"][0])
                  .isApprox(exampleTransform() * shift(0, 0.1, 0.6), 1e-12));
}

TEST(ToMarkers, drawBoxesByTheirTwelveEdges)
{
  auto markers = byNamespace(toMarkers(exampleView()));
  const Marker& roi = markers["roi"][0];
  ASSERT_EQ(roi.points.size(), 24U);
  double length = 0;
  for (std::size_t i = 0; i < roi.points.size(); i += 2)
  {
    Eigen::Vector3d from, to;
    tf2::fromMsg(roi.points[i], from);
    tf2::fromMsg(roi.points[i + 1], to);
    length += (to - from).norm();
  }
  EXPECT_DOUBLE_EQ(length, 4 * (1.0 + 2.0 + 3.0));
}

TEST(ToMarkers, crossOnlyTheNoise)
{
  auto markers = byNamespace(toMarkers(exampleView()));
  const Marker& noise = markers["noise"][0];
  ASSERT_EQ(noise.points.size(), 6U);  // three strokes
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& end : noise.points)
    sum += Eigen::Vector3d(end.x, end.y, end.z);
  EXPECT_TRUE((sum / 6).isApprox(Eigen::Vector3d(0.4, 0.5, 0.6), 1e-6));
}

TEST(ToMarkers, ofAnEmptyDetectionOnlyDelete)
{
  DetectionView view;
  view.header.frame_id = "base_link";
  const MarkerArray array = toMarkers(view);
  ASSERT_EQ(array.markers.size(), 1U);
  EXPECT_EQ(array.markers[0].action, Marker::DELETEALL);
}

TEST(NoMarkers, deleteOnly)
{
  std_msgs::Header header;
  header.frame_id = "base_link";
  const MarkerArray array = noMarkers(header);
  ASSERT_EQ(array.markers.size(), 1U);
  EXPECT_EQ(array.markers[0].action, Marker::DELETEALL);
  EXPECT_EQ(array.markers[0].header.frame_id, "base_link");
}
}  // namespace
}  // namespace ppf_bin_picking_ros

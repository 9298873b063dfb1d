#include "ppf_bin_picking/ros/frame_lookup.hpp"
#include "ppf_bin_picking/ros/messages.hpp"
#include "ppf_bin_picking/ros/request_failed.hpp"

#include <gtest/gtest.h>

#include <tf2_eigen/tf2_eigen.h>

#include <future>

namespace ppf_bin_picking_ros
{
namespace
{
constexpr double kLong_s = 30.0;  // ends only a test that fails

void setTransform(tf2::BufferCore& buffer, const Eigen::Isometry3d& T_base_camera,
                  const double stamp_s)
{
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_base_camera);
  transform.header.frame_id = "base";
  transform.child_frame_id = "camera";
  transform.header.stamp = ros::Time(stamp_s);
  buffer.setTransform(transform, "test");
}

/// The message of the failure.
std::string failureOf(const tf2::BufferCore& buffer, const FrameQuery& query)
{
  const std::atomic<bool> stop{false};
  try
  {
    waitForTransform(buffer, query, steadyDeadline(0.02), stop);
  }
  catch (const RequestFailed& failure)
  {
    EXPECT_EQ(failure.status(), +Response::TF_FAILED);
    return failure.what();
  }
  return {};
}

TEST(WaitForTransform, mapsFromSourceToTarget)
{
  tf2::BufferCore buffer;
  const Eigen::Isometry3d T_base_camera(Eigen::Translation3d(1, 2, 3));
  setTransform(buffer, T_base_camera, 10);
  const std::atomic<bool> stop{false};
  const Eigen::Isometry3d T =
      waitForTransform(buffer, {"base", "camera", ros::Time(10)}, steadyDeadline(kLong_s), stop);
  EXPECT_TRUE(T.isApprox(T_base_camera, 1e-12));
}

TEST(WaitForTransform, asksNobodyWhereTheFramesAreTheSame)
{
  const tf2::BufferCore buffer;
  const std::atomic<bool> stop{false};
  EXPECT_TRUE(waitForTransform(buffer, {"camera", "camera", ros::Time(1)}, steadyDeadline(0), stop)
                  .isApprox(Eigen::Isometry3d::Identity()));
}

TEST(WaitForTransform, waitsUntilItComes)
{
  tf2::BufferCore buffer;
  const std::atomic<bool> stop{false};
  auto lookup = std::async(std::launch::async,
                           [&]
                           {
                             return waitForTransform(buffer, {"base", "camera", ros::Time(10)},
                                                     steadyDeadline(kLong_s), stop);
                           });
  setTransform(buffer, Eigen::Isometry3d::Identity(), 9);
  setTransform(buffer, Eigen::Isometry3d::Identity(), 11);
  EXPECT_TRUE(lookup.get().isApprox(Eigen::Isometry3d::Identity()));
}

TEST(WaitForTransform, neverGuesses)
{
  tf2::BufferCore buffer;
  EXPECT_NE(failureOf(buffer, {"base", "camera", ros::Time(10)}), "");
  setTransform(buffer, Eigen::Isometry3d::Identity(), 10);
  EXPECT_NE(failureOf(buffer, {"base", "camera", ros::Time(12)}), "");  // extrapolation
  EXPECT_NE(failureOf(buffer, {"/base", "camera", ros::Time(10)}), "");
}

TEST(WaitForTransform, namesFramesAndRemedyWhenItFails)
{
  const tf2::BufferCore buffer;
  const std::string failure = failureOf(buffer, {"base", "camera", ros::Time(10)});
  EXPECT_NE(failure.find("from frame 'camera' to frame 'base' at 10.0"), std::string::npos);
  EXPECT_NE(failure.find("check the frame names"), std::string::npos);
}

TEST(WaitForTransform, endsAtOnceWhenStopped)
{
  const tf2::BufferCore buffer;
  const std::atomic<bool> stop{true};
  const auto start = SteadyClock::now();
  EXPECT_THROW(
      waitForTransform(buffer, {"base", "camera", ros::Time(10)}, steadyDeadline(kLong_s), stop),
      RequestFailed);
  EXPECT_LT(SteadyClock::now(), start + std::chrono::seconds(20));
}
}  // namespace
}  // namespace ppf_bin_picking_ros

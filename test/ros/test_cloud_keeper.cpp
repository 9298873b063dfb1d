#include "ppf_bin_picking/ros/clock_watch.hpp"
#include "ppf_bin_picking/ros/cloud_keeper.hpp"

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include <future>

namespace ppf_bin_picking_ros
{
namespace
{
constexpr double kLong_s = 30.0;  // ends only a test that fails

sensor_msgs::PointCloud2ConstPtr cloudAt(const double stamp_s)
{
  const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  cloud->header.stamp = ros::Time(stamp_s);
  return cloud;
}

/// Starts a wait in a thread of its own.
std::future<sensor_msgs::PointCloud2ConstPtr> waitFor(const CloudKeeper& keeper,
                                                      const double after_s)
{
  return std::async(std::launch::async, [&keeper, after_s]
                    { return keeper.waitForNext(ros::Time(after_s), steadyDeadline(kLong_s)); });
}

/// The result of a wait that `feed` is called for again and again, as it may not have begun yet.
template <class Feed>
sensor_msgs::PointCloud2ConstPtr fed(std::future<sensor_msgs::PointCloud2ConstPtr> wait,
                                     const Feed& feed)
{
  while (wait.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready)
    feed();
  return wait.get();
}

TEST(CloudKeeper, givesTheNewestReceived)
{
  CloudKeeper keeper;
  EXPECT_FALSE(keeper.newest());
  EXPECT_FALSE(keeper.secondsSinceLast());
  keeper.keep(cloudAt(2));
  keeper.keep(cloudAt(1));
  EXPECT_EQ(keeper.newest()->header.stamp, ros::Time(1));
  EXPECT_EQ(keeper.received(), 2U);
  EXPECT_LT(*keeper.secondsSinceLast(), kLong_s);
}

TEST(CloudKeeper, waitsForALaterStamp)
{
  CloudKeeper keeper;
  const auto next = fed(waitFor(keeper, 5),
                        [&]
                        {
                          keeper.keep(cloudAt(4));
                          keeper.keep(cloudAt(5));
                          keeper.keep(cloudAt(6));
                        });
  ASSERT_TRUE(next);
  EXPECT_EQ(next->header.stamp, ros::Time(6));
}

TEST(CloudKeeper, doesNotTakeACloudForTheNextThatWasThereBefore)
{
  CloudKeeper keeper;
  keeper.keep(cloudAt(7));  // of a camera whose clock is fast
  EXPECT_FALSE(keeper.waitForNext(ros::Time(5), steadyDeadline(0.01)));
}

TEST(CloudKeeper, givesUpAtTheDeadline)
{
  CloudKeeper keeper;
  keeper.keep(cloudAt(5));
  EXPECT_FALSE(keeper.waitForNext(ros::Time(5), steadyDeadline(0.01)));
}

TEST(CloudKeeper, takesAnyCloudAfterTheClockJumpedBack)
{
  CloudKeeper keeper;
  const auto next = fed(waitFor(keeper, 100),
                        [&]
                        {
                          keeper.drop();
                          keeper.keep(cloudAt(1));
                        });
  ASSERT_TRUE(next);
  EXPECT_EQ(next->header.stamp, ros::Time(1));
}

TEST(CloudKeeper, forgetsTheCloudWhenDropped)
{
  CloudKeeper keeper;
  keeper.keep(cloudAt(1));
  keeper.drop();
  EXPECT_FALSE(keeper.newest());
}

TEST(CloudKeeper, endsAllWaitsWhenStopped)
{
  CloudKeeper keeper;
  auto first = waitFor(keeper, 0);
  auto second = waitFor(keeper, 0);
  keeper.stop();
  EXPECT_FALSE(first.get());
  EXPECT_FALSE(second.get());
  keeper.keep(cloudAt(9));
  EXPECT_FALSE(keeper.waitForNext(ros::Time(1), steadyDeadline(kLong_s)));
}

TEST(ClockWatch, tellsEachJumpBackOnce)
{
  ClockWatch watch;
  const auto jumpsAt = [&](const double now_s)
  { return watch.jumpedBack([&] { return ros::Time(now_s); }); };
  EXPECT_FALSE(jumpsAt(10));
  EXPECT_FALSE(jumpsAt(11));
  EXPECT_FALSE(jumpsAt(10.95));  // a correction of the clock
  EXPECT_TRUE(jumpsAt(2));
  EXPECT_FALSE(jumpsAt(2));
  EXPECT_FALSE(jumpsAt(3));
}
}  // namespace
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/ros/request_failed.hpp"
#include "ppf_bin_picking/ros/request_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace ppf_bin_picking_ros
{
namespace
{
/// Status of the failure; OK if there was none.
template <class Step>
std::int16_t statusOf(const Step& step)
{
  try
  {
    step();
  }
  catch (const RequestFailed& failure)
  {
    EXPECT_GT(std::string(failure.what()).size(), 20U);
    return failure.status();
  }
  return Response::OK;
}

TEST(CheckRequest, refusesWhatIsOutOfRange)
{
  Request request;
  EXPECT_EQ(statusOf([&] { checkRequest(request); }), +Response::OK);
  request.acquisition = 2;
  EXPECT_EQ(statusOf([&] { checkRequest(request); }), +Response::BAD_REQUEST);
  request = {};
  request.timeout = ros::Duration(-0.1);
  EXPECT_EQ(statusOf([&] { checkRequest(request); }), +Response::BAD_REQUEST);
  request.timeout = ros::Duration(0, 1);  // what rosservice makes of 1
  EXPECT_EQ(statusOf([&] { checkRequest(request); }), +Response::BAD_REQUEST);
  request.timeout = ros::Duration(0.001);
  EXPECT_EQ(statusOf([&] { checkRequest(request); }), +Response::OK);
  request = {};
  request.max_age = ros::Duration(-1.0);
  EXPECT_EQ(statusOf([&] { checkRequest(request); }), +Response::BAD_REQUEST);
}

TEST(CheckAge, countsOnTheRosClock)
{
  Request request;
  const ros::Time now(100);
  const auto status = [&](const ros::Time& stamp)
  { return statusOf([&] { checkAge(request, stamp, now); }); };
  EXPECT_EQ(status(ros::Time(1)), +Response::OK);  // no limit
  request.max_age = ros::Duration(5.0);
  EXPECT_EQ(status(ros::Time(95)), +Response::OK);
  EXPECT_EQ(status(ros::Time(94.9)), +Response::CLOUD_TOO_OLD);
  EXPECT_EQ(status(ros::Time(100.09)), +Response::OK);
  EXPECT_EQ(status(ros::Time(100.2)), +Response::CLOUD_TOO_OLD);  // its clock is ahead
  EXPECT_EQ(status(ros::Time()), +Response::CLOUD_TOO_OLD);       // no stamp
}

TEST(CheckNotAhead, allowsForClocksThatDifferALittle)
{
  const auto status = [&](const ros::Time& stamp)
  { return statusOf([&] { checkNotAhead(stamp, ros::Time(100)); }); };
  EXPECT_EQ(status(ros::Time()), +Response::OK);
  EXPECT_EQ(status(ros::Time(100.09)), +Response::OK);
  EXPECT_EQ(status(ros::Time(100.11)), +Response::CLOUD_TOO_OLD);
  EXPECT_EQ(status(ros::Time(0xFFFFFFFF, 0)), +Response::CLOUD_TOO_OLD);
}

TEST(LimitedDifference, standsAnyStamp)
{
  const ros::Time late(0xFFFFFFFF, 0);
  EXPECT_EQ(limitedDifference(ros::Time(5.5), ros::Time(3.0)), ros::Duration(2.5));
  EXPECT_EQ(limitedDifference(late, ros::Time()), ros::Duration(2e9));
  EXPECT_EQ(limitedDifference(ros::Time(), late), ros::Duration(-2e9));
}

TEST(RemainingLimit, neverTurnsIntoNoLimit)
{
  EXPECT_EQ(remainingLimit_s(2.0, 0.5), 1.5);
  EXPECT_GT(remainingLimit_s(2.0, 2.0), 0);
  EXPECT_LT(remainingLimit_s(2.0, 7.0), 1e-6);
  EXPECT_GT(remainingLimit_s(2.0, 7.0), 0);
  EXPECT_EQ(remainingLimit_s(0, 7.0), 0);
}

TEST(ToStatus, hasAConstantForEachEnd)
{
  using ppf_bin_picking::DetectionStatus;
  EXPECT_EQ(toStatus(DetectionStatus::kOk), +Response::OK);
  EXPECT_EQ(toStatus(DetectionStatus::kNoPickablePose), +Response::NO_PICKABLE_POSE);
  EXPECT_EQ(toStatus(DetectionStatus::kRoiEmpty), +Response::ROI_EMPTY);
  EXPECT_EQ(toStatus(DetectionStatus::kTimeLimit), +Response::TIME_LIMIT);
  EXPECT_EQ(toStatus(DetectionStatus::kBadCloud), +Response::BAD_CLOUD);
}
}  // namespace
}  // namespace ppf_bin_picking_ros

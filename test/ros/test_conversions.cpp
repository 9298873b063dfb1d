#include "ppf_bin_picking/ros/conversions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::DetectorConfig;
using ppf_bin_picking::PointCloud;
using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr std::uint32_t kFloatSize = 4;

PointField floatField(const std::string& name, const std::uint32_t offset)
{
  PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = PointField::FLOAT32;
  field.count = 1;
  return field;
}

/// 4 x 3 points in the plainest layout; point i is (i, 10 i, 1).
PointCloud2 plainCloud()
{
  PointCloud2 cloud;
  cloud.header.frame_id = "camera";
  cloud.width = 4;
  cloud.height = 3;
  cloud.point_step = 3 * kFloatSize;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.fields = {floatField("x", 0), floatField("y", 4), floatField("z", 8)};
  cloud.data.resize(cloud.row_step * cloud.height);
  for (std::size_t i = 0; i < 12; ++i)
  {
    const float number = static_cast<float>(i);
    const float point[] = {number, 10 * number, 1.0F};
    std::memcpy(&cloud.data[i * cloud.point_step], point, sizeof(point));
  }
  return cloud;
}

/// A cloud with its fields in random order, with gaps, row padding and fields of no interest.
struct RandomCloud
{
  explicit RandomCloud(std::mt19937& rng)
  {
    std::uniform_int_distribution<std::uint32_t> small(1, 9);
    std::uniform_int_distribution<std::uint32_t> gap(0, 5);
    std::vector<std::string> names = {"x", "y", "z", "normal_x", "normal_y", "normal_z", "rgb"};
    std::shuffle(names.begin(), names.end(), rng);
    message.header.frame_id = "camera";
    message.width = small(rng);
    message.height = small(rng);
    std::uint32_t end = 0;
    for (const std::string& name : names)
    {
      message.fields.push_back(floatField(name, end + gap(rng)));
      end = message.fields.back().offset + kFloatSize;
    }
    message.point_step = end + gap(rng);
    message.row_step = message.width * message.point_step + gap(rng);
    message.data.resize(std::size_t{message.row_step} * message.height);
    for (auto& byte : message.data)
      byte = static_cast<std::uint8_t>(rng());
    fill(rng);
  }

  void fill(std::mt19937& rng)
  {
    std::uniform_real_distribution<float> coordinate(-1.0F, 1.0F);
    for (std::uint32_t row = 0; row < message.height; ++row)
      for (std::uint32_t column = 0; column < message.width; ++column)
      {
        const std::size_t start = row * message.row_step + column * message.point_step;
        const auto random = [&]
        { return Eigen::Vector3f(coordinate(rng), coordinate(rng), coordinate(rng)); };
        points.push_back(random());
        normals.push_back(random().normalized());
        for (const PointField& field : message.fields)
        {
          if (field.name == "rgb") continue;
          const int axis = field.name.back() - 'x';
          const auto& vector = field.name.size() == 1 ? points.back() : normals.back();
          std::memcpy(&message.data[start + field.offset], &vector[axis], kFloatSize);
        }
      }
  }

  PointCloud2 message;
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
};

TEST(ToPointCloud, readsFieldsInAnyOrderAndWithAnyPadding)
{
  std::mt19937 rng(11);
  for (int trial = 0; trial < 300; ++trial)
  {
    SCOPED_TRACE(trial);
    const RandomCloud random(rng);
    DetectorConfig config;
    config.use_cloud_normals = trial % 2 == 0;
    const PointCloud cloud = toPointCloud(random.message, config);
    EXPECT_EQ(cloud.width, random.message.width);
    EXPECT_EQ(cloud.height, random.message.height);
    ASSERT_EQ(cloud.points.size(), random.points.size());
    EXPECT_TRUE(std::equal(cloud.points.begin(), cloud.points.end(), random.points.begin()));
    ASSERT_EQ(cloud.normals.size(), config.use_cloud_normals ? random.points.size() : 0U);
    for (std::size_t i = 0; i < cloud.normals.size(); ++i)
      EXPECT_LT((cloud.normals[i] - random.normals[i]).norm(), 1e-6F);
  }
}

TEST(ToPointCloud, keepsPointsWithoutMeasurementAndDropsSenselessNormals)
{
  PointCloud2 cloud = plainCloud();
  for (std::uint32_t i = 0; i < 3; ++i)
    cloud.fields.push_back(floatField(std::string("normal_") + "xyz"[i], 0));  // those of x
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&cloud.data[cloud.point_step], &nan, kFloatSize);
  DetectorConfig config;
  config.use_cloud_normals = true;
  const PointCloud read = toPointCloud(cloud, config);
  EXPECT_TRUE(std::isnan(read.points[1].x()));
  EXPECT_FLOAT_EQ(read.points[1].y(), 10.0F);
  EXPECT_EQ(read.normals[0], Eigen::Vector3f(0, 0, 0));  // of no length
  EXPECT_EQ(read.normals[1], Eigen::Vector3f(0, 0, 0));  // not a number
  EXPECT_NEAR(read.normals[2].norm(), 1.0F, 1e-6F);
}

TEST(ToPointCloud, acceptsTheCountOfZeroThatSomeDriversLeave)
{
  PointCloud2 cloud = plainCloud();
  for (PointField& field : cloud.fields)
    field.count = 0;
  EXPECT_EQ(toPointCloud(cloud, {}).points[5], Eigen::Vector3f(5, 50, 1));
}

TEST(ToPointCloud, leavesItToTheDetectorThatThereAreNoPoints)
{
  PointCloud2 cloud = plainCloud();
  cloud.width = cloud.row_step = 0;
  cloud.data.clear();
  EXPECT_EQ(toPointCloud(cloud, {}).size(), 0U);
  cloud = plainCloud();
  cloud.height = 0;
  cloud.data.clear();
  EXPECT_EQ(toPointCloud(cloud, {}).size(), 0U);
}

struct BadCloud
{
  const char* name;
  std::function<void(PointCloud2&)> spoil;
  const char* sentence;
};

void PrintTo(const BadCloud& bad, std::ostream* stream)
{
  *stream << bad.name;
}

class MessageProblem : public testing::TestWithParam<BadCloud>
{
};

TEST_P(MessageProblem, isOneSentenceThatNamesTheThingAndTheRemedy)
{
  PointCloud2 cloud = plainCloud();
  ASSERT_EQ(messageProblem(cloud, {}), "");
  GetParam().spoil(cloud);
  DetectorConfig config;
  config.use_cloud_normals = true;
  EXPECT_EQ(messageProblem(cloud, config), GetParam().sentence);
  EXPECT_THROW(toPointCloud(cloud, config), std::invalid_argument);
}

const BadCloud kBadClouds[] = {
    {"noFrame", [](PointCloud2& c) { c.header.frame_id.clear(); },
     "The cloud has no frame: set header.frame_id in the camera's driver"},
    {"bigEndian", [](PointCloud2& c) { c.is_bigendian = true; },
     "The cloud is big-endian (is_bigendian is true): publish it little-endian"},
    {"noY", [](PointCloud2& c) { c.fields.erase(c.fields.begin() + 1); },
     "The cloud's field y is missing: publish x, y and z as FLOAT32"},
    {"noFields", [](PointCloud2& c) { c.fields.clear(); },
     "The cloud's field x is missing: publish x, y and z as FLOAT32"},
    {"twoX", [](PointCloud2& c) { c.fields.push_back(c.fields[0]); },
     "The cloud's field x is listed more than once: publish it once"},
    {"doubles", [](PointCloud2& c) { c.fields[2].datatype = PointField::FLOAT64; },
     "The cloud's field z has datatype 8: publish it as FLOAT32 (7), in metres"},
    {"threeInOne", [](PointCloud2& c) { c.fields[0].count = 3; },
     "The cloud's field x has count 3: publish it with count 1"},
    {"offsetBehindPoint", [](PointCloud2& c) { c.fields[1].offset = 9; },
     "The cloud's field y ends at byte 13, behind point_step 12: correct its offset or point_step"},
    {"offsetThatWraps", [](PointCloud2& c) { c.fields[1].offset = 0xFFFFFFFF; },
     "The cloud's field y ends at byte 4294967299, behind point_step 12: correct its offset or "
     "point_step"},
    {"normalMissing", [](PointCloud2& c) { c.fields.push_back(floatField("normal_y", 0)); },
     "The cloud's field normal_x is missing: publish normal_x, normal_y and normal_z as FLOAT32, "
     "or set detector/use_cloud_normals to false"},
    {"tooManyForItsData", [](PointCloud2& c) { c.width = c.height = 0xFFFFFFFF; },
     "The cloud's row_step is 48, less than width 4294967295 times point_step 12: correct "
     "row_step"},
    {"shortRows", [](PointCloud2& c) { c.row_step = 40; },
     "The cloud's row_step is 40, less than width 4 times point_step 12: correct row_step"},
    {"longRows", [](PointCloud2& c) { c.row_step = 0xFFFFFFFF; },
     "The cloud's data has 144 bytes where row_step times height is 12884901885: send whole rows, "
     "or correct row_step and height"},
    {"shortData", [](PointCloud2& c) { c.data.pop_back(); },
     "The cloud's data has 143 bytes where row_step times height is 144: send whole rows, or "
     "correct row_step and height"},
    {"noData", [](PointCloud2& c) { c.data.clear(); },
     "The cloud's data has 0 bytes where row_step times height is 144: send whole rows, or correct "
     "row_step and height"},
};

INSTANTIATE_TEST_SUITE_P(Each, MessageProblem, testing::ValuesIn(kBadClouds),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(ToPointCloud, eitherReadsAHostileMessageWholeOrRefusesIt)
{
  std::mt19937 rng(5);
  const std::uint32_t wild[] = {0, 1, 3, 4, 12, 13, 47, 1 << 20, 0x7FFFFFFF, 0xFFFFFFFF};
  const auto anyWild = [&] { return wild[rng() % std::size(wild)]; };
  int refused = 0;
  for (int trial = 0; trial < 3000; ++trial)
  {
    SCOPED_TRACE(trial);
    PointCloud2 cloud = RandomCloud(rng).message;
    PointField& field = cloud.fields[rng() % cloud.fields.size()];
    const std::vector<std::function<void()>> damages = {
        [&] { cloud.width = anyWild(); },
        [&] { cloud.height = anyWild(); },
        [&] { cloud.point_step = anyWild(); },
        [&] { cloud.row_step = anyWild(); },
        [&] { field.offset = anyWild(); },
        [&] { field.count = anyWild(); },
        [&] { field.datatype = static_cast<std::uint8_t>(anyWild()); },
        [&] { cloud.data.resize(cloud.data.size() / 2); }};
    for (int i = 0; i < 1 + trial % 3; ++i)
      damages[rng() % damages.size()]();
    DetectorConfig config;
    config.use_cloud_normals = true;
    try
    {
      const PointCloud read = toPointCloud(cloud, config);
      EXPECT_EQ(read.size(), std::size_t{cloud.width} * cloud.height);
    }
    catch (const std::invalid_argument&)
    {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 3000);
}
}  // namespace
}  // namespace ppf_bin_picking_ros

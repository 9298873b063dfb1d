#include "ppf_bin_picking/core/detector.hpp"

#include "support/bracket_and_angle.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
class DetectorRefusals : public BracketAndAngle
{
};

TEST_F(DetectorRefusals, saysThatTheRegionIsEmpty)
{
  roi_.min.z() = 0.09;
  const DetectionResult result = detect(coarseConfig());
  EXPECT_EQ(result.status, DetectionStatus::kRoiEmpty);
  EXPECT_EQ(result.roi_points, 0U);
  EXPECT_TRUE(result.poses.empty());
  EXPECT_NE(result.message.find("the bin is empty"), std::string::npos) << result.message;
  EXPECT_EQ(result.message.find("unit"), std::string::npos) << result.message;
  roi_.T_cloud_box.translation() *= 10;
  const DetectionResult far = detect(coarseConfig());
  EXPECT_EQ(far.status, DetectionStatus::kRoiEmpty);
  EXPECT_NE(far.message.find("unit"), std::string::npos) << far.message;
}

TEST_F(DetectorRefusals, refusesACloudWithoutMeasurements)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  PointCloud nothing = cloud();
  for (const Eigen::Vector3f& point : {Eigen::Vector3f(kNan, kNan, kNan), Eigen::Vector3f(0, 0, 0),
                                       Eigen::Vector3f(0.1F, 0.1F, -1)})
  {
    nothing.points.assign(nothing.points.size(), point);
    for (const bool with_roi : {false, true})
    {
      const auto roi = with_roi ? std::optional<RegionOfInterest>(roi_) : std::nullopt;
      const DetectionResult result = Detector(coarseConfig()).detect(nothing, bracket_, roi);
      EXPECT_EQ(result.status, DetectionStatus::kBadCloud);
      EXPECT_NE(result.message.find("check the camera"), std::string::npos) << result.message;
      EXPECT_TRUE(result.poses.empty());
    }
  }
}

TEST_F(DetectorRefusals, refusesCloudsThatContradictThemselves)
{
  DetectorConfig config = coarseConfig();
  const auto expectRefused = [&](const PointCloud& bad, const std::string& word)
  {
    const DetectionResult result = Detector(config).detect(bad, bracket_, roi_);
    EXPECT_EQ(result.status, DetectionStatus::kBadCloud);
    EXPECT_NE(result.message.find(word), std::string::npos) << result.message;
    EXPECT_TRUE(result.poses.empty());
  };
  expectRefused(PointCloud(), "no points");
  PointCloud bad = cloud();
  --bad.width;
  expectRefused(bad, "width and height");
  bad = cloud();
  bad.normals.resize(3, Eigen::Vector3f::UnitZ());
  expectRefused(bad, "normals");
  config.use_cloud_normals = true;
  expectRefused(cloud(), "use_cloud_normals");
  config.use_cloud_normals = false;
  config.max_points = 1000;
  expectRefused(cloud(), "max_points");
}

TEST_F(DetectorRefusals, refusesCloudsThatCannotShowThePart)
{
  const auto expectBad = [&](const PointCloud& seen, const std::string& word)
  {
    const DetectionResult result = Detector(coarseConfig()).detect(seen, bracket_);
    EXPECT_EQ(result.status, DetectionStatus::kBadCloud);
    EXPECT_NE(result.message.find(word), std::string::npos) << result.message;
    EXPECT_TRUE(result.poses.empty());
  };
  PointCloud coarse;  // every 16th pixel of each row and column
  coarse.width = 20;
  coarse.height = 15;
  for (std::size_t v = 0; v < coarse.height; ++v)
    for (std::size_t u = 0; u < coarse.width; ++u)
      coarse.points.push_back(cloud().points[16 * v * 320 + 16 * u]);
  expectBad(coarse, "pixels across");
  PointCloud millimetres = cloud();
  for (Eigen::Vector3f& point : millimetres.points)
    point *= 1000;
  expectBad(millimetres, "if the cloud is not in metres");
  PointCloud tiny = cloud();
  for (Eigen::Vector3f& point : tiny.points)
    point *= 0.02F;
  expectBad(tiny, "unit");
}

TEST_F(DetectorRefusals, refusesModelsThatDoNotFit)
{
  const auto expectRefused =
      [&](const Detector& detector, const RegionOfInterest& roi, const std::string& word)
  {
    try
    {
      detector.detect(cloud(), bracket_, roi);
      FAIL() << "not refused";
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  DetectorConfig config = coarseConfig();
  config.model.step_rel = 0.09;
  expectRefused(Detector(config), roi_, "step_rel");
  config = coarseConfig();
  config.model.n_angle = 31;
  expectRefused(Detector(config), roi_, "n_angle");
  expectRefused(Detector(coarseConfig()), {T_camera_table_, {0, 0, 0}, {0.02, 0.02, 0.02}}, "unit");
  EXPECT_THROW(Detector(coarseConfig()).detect(cloud(), std::vector<const PpfModel*>()),
               std::invalid_argument);
}

TEST(Detector, refusesAnUnusableConfiguration)
{
  DetectorConfig config;
  config.lambda = 2;
  config.v_min = 0;
  try
  {
    Detector detector(config);
    FAIL() << "not refused";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find("lambda"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("v_min"), std::string::npos);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

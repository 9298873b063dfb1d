#include "pose_drawing.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr int kWantedSide_px = 1200;
constexpr int kMaxEnlargement = 6;
constexpr float kEdgeCosine = 0.8F;  // faces that differ more meet in an edge
constexpr float kStepPixels = 4;     // a step in depth by more pixels than this is an edge
constexpr double kTint = 0.25;       // share of the colour inside the part
const cv::Vec3b kGreen(60, 220, 60);
const cv::Vec3b kRed(60, 60, 255);

/// Darker with distance and with slant.
cv::Mat relief(const RangeImage& image)
{
  std::vector<float> depths;
  for (const float z : image.depth)
    if (z > 0) depths.push_back(z);
  cv::Mat picture(image.camera.height, image.camera.width, CV_8UC3, cv::Scalar::all(0));
  if (depths.empty()) return picture;
  std::sort(depths.begin(), depths.end());
  const float nearest = depths[depths.size() / 50];
  const float span = std::max(depths[depths.size() - 1 - depths.size() / 50] - nearest, 1e-4F);
  for (int v = 0; v < picture.rows; ++v)
  {
    for (int u = 0; u < picture.cols; ++u)
    {
      const float z = image.depth[image.index(u, v)];
      if (z == 0) continue;
      const float depth = std::clamp((z - nearest) / span, 0.0F, 1.0F);
      const float facing = std::abs(image.normals[image.index(u, v)].z());
      const float grey = (230 - 130 * depth) * (0.35F + 0.65F * facing);
      picture.at<cv::Vec3b>(v, u) = cv::Vec3b::all(static_cast<unsigned char>(grey));
    }
  }
  return picture;
}

PinholeCamera enlarged(const PinholeCamera& camera, int factor)
{
  const auto f = static_cast<float>(factor);
  return {camera.width * factor, camera.height * factor,        camera.fx * f,
          camera.fy * f,         (camera.cx + 0.5F) * f - 0.5F, (camera.cy + 0.5F) * f - 0.5F};
}

/// True if two neighbouring pixels of a rendered part belong to faces that meet in an edge, or one
/// of them to no face.
bool isEdge(const RenderedPart& view, std::size_t a, std::size_t b, float pixel_m)
{
  if (view.depth[a] == 0 || view.depth[b] == 0) return view.depth[a] != view.depth[b];
  if (std::abs(view.depth[a] - view.depth[b]) > kStepPixels * pixel_m) return true;
  return std::abs(view.normals[view.triangle[a]].dot(view.normals[view.triangle[b]])) < kEdgeCosine;
}

void paint(const RenderedPart& view, const cv::Vec3b& color, float focal, cv::Mat& picture)
{
  const auto width = static_cast<std::size_t>(view.width);
  for (int row = 0; row < view.height; ++row)
  {
    for (int column = 0; column < view.width; ++column)
    {
      const std::size_t here = static_cast<std::size_t>(row) * width + column;
      if (view.depth[here] == 0) continue;
      const float pixel_m = view.depth[here] / focal;
      const bool border =
          column == 0 || row == 0 || column + 1 == view.width || row + 1 == view.height;
      const bool edge = border || isEdge(view, here, here - 1, pixel_m) ||
                        isEdge(view, here, here + 1, pixel_m) ||
                        isEdge(view, here, here - width, pixel_m) ||
                        isEdge(view, here, here + width, pixel_m);
      cv::Vec3b& pixel = picture.at<cv::Vec3b>(view.top + row, view.left + column);
      const double share = edge ? 1.0 : kTint;
      for (int k = 0; k < 3; ++k)
        pixel[k] = static_cast<unsigned char>(share * color[k] + (1 - share) * pixel[k]);
    }
  }
}

void label(const DrawnPose& pose, const RenderedPart& view, cv::Mat& picture)
{
  const cv::Point at(view.left + view.width / 2 - 8, view.top + view.height / 2 + 8);
  const double size = 0.8;
  cv::putText(picture, pose.label, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(0), 5,
              cv::LINE_AA);
  cv::putText(picture, pose.label, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(255), 2,
              cv::LINE_AA);
}
}  // namespace

cv::Mat drawPoses(const RangeImage& image, const RenderableMesh& part,
                  const std::vector<DrawnPose>& poses)
{
  const int longer = std::max({image.camera.width, image.camera.height, 1});
  const int factor = std::clamp(kWantedSide_px / longer, 1, kMaxEnlargement);
  const PinholeCamera camera = enlarged(image.camera, factor);
  cv::Mat plain;
  cv::resize(relief(image), plain, {}, factor, factor, cv::INTER_NEAREST);
  cv::Mat drawn = plain.clone();
  std::vector<RenderedPart> views(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    renderPart(part, poses[i].T_camera_model, camera, views[i]);
    paint(views[i], poses[i].reliable ? kGreen : kRed, camera.fx, drawn);
  }
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (views[i].width > 0) label(poses[i], views[i], drawn);
  cv::Mat both;
  if (plain.cols > plain.rows)
    cv::vconcat(plain, drawn, both);
  else
    cv::hconcat(plain, drawn, both);
  return both;
}
}  // namespace ppf_bin_picking

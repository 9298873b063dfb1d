#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/model_io.hpp"

#include "support/files.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <chrono>
#include <cmath>
#include <cstring>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kHeaderBytes = 24;
constexpr std::uint32_t kMeshChecksum = 0x1234abcd;

/// A box of 40 x 20 x 10 mm.
TriangleMesh box()
{
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(0.04F * static_cast<float>(k & 1),
                               0.02F * static_cast<float>(k >> 1 & 1),
                               0.01F * static_cast<float>(k >> 2));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

SymmetryGroup halfTurn()
{
  return SymmetryGroup({{{Eigen::Vector3d::UnitZ(), {0.02, 0.01, 0}}, M_PI}}, {});
}

class ModelFileTest : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    model_ = std::make_unique<PpfModel>(PpfModel::train(box(), halfTurn(), ModelParameters()));
  }
  static void TearDownTestSuite() { model_.reset(); }

  void SetUp() override
  {
    saveModel(path_, *model_, kMeshChecksum);
    bytes_ = contentOf(path_);
  }
  std::string error(const std::string& bytes) const
  {
    folder_.write("part.ppf", bytes);
    return inputError([&] { loadModel(path_); });
  }
  /// Bytes with the checksum that belongs to them, as somebody who means harm would write.
  static std::string signedAnew(std::string bytes)
  {
    const auto* payload = reinterpret_cast<const Bytef*>(bytes.data()) + kHeaderBytes;
    const std::uint64_t size = bytes.size() - kHeaderBytes;
    const auto sum = static_cast<std::uint32_t>(crc32_z(0, payload, size));
    std::memcpy(&bytes[12], &sum, sizeof sum);
    std::memcpy(&bytes[16], &size, sizeof size);
    return bytes;
  }

  static std::unique_ptr<PpfModel> model_;
  TemporaryFolder folder_;
  const std::string path_ = folder_.file("part.ppf");
  std::string bytes_;
};
std::unique_ptr<PpfModel> ModelFileTest::model_;

TEST_F(ModelFileTest, isReadBackAsWritten)
{
  const ModelFile file = loadModel(path_);
  EXPECT_EQ(file.mesh_checksum, kMeshChecksum);
  EXPECT_EQ(file.path, path_);
  const PpfModelData& read = file.model.data();
  const PpfModelData& written = model_->data();
  EXPECT_TRUE(read.parameters == written.parameters);
  EXPECT_EQ(meshChecksum(read.mesh), meshChecksum(written.mesh));
  EXPECT_EQ(file.model.symmetries().motions().size(), 2U);
  EXPECT_EQ(read.center, written.center);
  EXPECT_EQ(read.diameter_m, written.diameter_m);
  EXPECT_EQ(read.points, written.points);
  EXPECT_EQ(read.normals, written.normals);
  EXPECT_EQ(read.offsets, written.offsets);
  EXPECT_EQ(read.entries, written.entries);
  saveModel(folder_.file("again.ppf"), file.model, file.mesh_checksum);
  EXPECT_EQ(contentOf(folder_.file("again.ppf")), bytes_);
}

TEST_F(ModelFileTest, isReadInWellUnderASecond)
{
  const auto start = std::chrono::steady_clock::now();
  loadModel(path_);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(500));
}

TEST_F(ModelFileTest, isRefusedIfForeign)
{
  expectHolds(error(""), "part.ppf is no model file: train the model again");
  expectHolds(error("solid\n"), "is no model file");
  std::string other = bytes_;
  other[0] = 'Q';
  expectHolds(error(other), "is no model file");
}

TEST_F(ModelFileTest, isRefusedIfOfAnotherVersion)
{
  std::string other = bytes_;
  other[8] = static_cast<char>(kModelFileVersion + 1);
  expectHolds(error(other), "has the format version " + std::to_string(kModelFileVersion + 1) +
                                ", not " + std::to_string(kModelFileVersion));
}

TEST_F(ModelFileTest, isRefusedIfCutOffOrTooLong)
{
  for (const std::size_t size : {std::size_t{7}, std::size_t{23}})
    expectHolds(error(bytes_.substr(0, size)), "is no model file");
  for (const std::size_t size :
       {kHeaderBytes, kHeaderBytes + 1, bytes_.size() / 2, bytes_.size() - 1})
    expectHolds(error(bytes_.substr(0, size)), "is cut off");
  expectHolds(error(bytes_ + '\0'), "has bytes after its end");
}

TEST_F(ModelFileTest, isRefusedIfAnyByteOfItsHeaderIsWrong)
{
  for (std::size_t at = 0; at < kHeaderBytes; ++at)
  {
    SCOPED_TRACE(at);
    std::string damaged = bytes_;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x81);
    expectHolds(error(damaged), "part.ppf ");
  }
}

TEST_F(ModelFileTest, isRefusedIfAByteOfItsContentIsWrong)
{
  for (std::size_t at = kHeaderBytes; at < bytes_.size(); at += bytes_.size() / 97)
  {
    SCOPED_TRACE(at);
    std::string damaged = bytes_;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    expectHolds(error(damaged), "is damaged: its checksum is wrong");
  }
}

TEST_F(ModelFileTest, isRefusedIfWellSignedButAbsurd)
{
  // Offsets of the payload: checksum 0, step_rel 4, n_angle 12, number of vertices 16.
  const auto with = [&](std::size_t at, std::uint64_t value, std::size_t size)
  {
    std::string bytes = bytes_;
    std::memcpy(&bytes[kHeaderBytes + at], &value, size);
    return signedAnew(bytes);
  };
  expectHolds(error(with(16, std::uint64_t{1} << 60U, 8)), "a list in it is too long");
  expectHolds(error(with(16, ~std::uint64_t{0}, 8)), "a list in it is too long");
  expectHolds(error(with(16, 0, 8)), "is damaged (");
  expectHolds(error(with(12, 1000000, 4)), "n_angle is 1000000");
  expectHolds(error(with(4, 0x7ff8000000000000U, 8)), "step_rel is nan");
  expectHolds(error(signedAnew(bytes_.substr(0, bytes_.size() - 4))), "a list in it is too long");
  expectHolds(error(signedAnew(bytes_ + std::string(4, '\0'))), "its content ends too late");
  expectHolds(error(signedAnew(bytes_.substr(0, kHeaderBytes + 6))), "its content ends too early");
}

TEST_F(ModelFileTest, isRefusedIfATriangleOrAnEntryPointsNowhere)
{
  const std::size_t first_triangle = kHeaderBytes + 16 + 8 + 8 * 12 + 8;
  std::string bytes = bytes_;
  bytes[first_triangle] = 8;
  expectHolds(error(signedAnew(bytes)), "a triangle names a vertex that does not exist");
  bytes = bytes_;
  bytes[bytes.size() - 1] = '\xff';
  expectHolds(error(signedAnew(bytes)),
              "an entry of the boundary table names a point that does not exist");
}

TEST_F(ModelFileTest, isCheckedAgainstThePart)
{
  const ModelFile file = loadModel(path_);
  PartDescription part;
  part.source = "part.yaml";
  part.mesh_file = "model.stl";
  EXPECT_NO_THROW(requireFit(file, part, kMeshChecksum));  // states none: the model's hold
  part.states_symmetries = true;
  part.symmetries_discrete = halfTurn().generators();
  EXPECT_NO_THROW(requireFit(file, part, kMeshChecksum));
  EXPECT_EQ(inputError([&] { requireFit(file, part, kMeshChecksum + 1); }),
            path_ +
                " was trained from another mesh than model.stl, or in another unit: train the "
                "model again");
  part.symmetries_discrete.clear();
  EXPECT_EQ(inputError([&] { requireFit(file, part, kMeshChecksum); }),
            path_ +
                " was trained with other symmetries than part.yaml states: train the model "
                "again");
}

TEST_F(ModelFileTest, isNotWrittenByHalves)
{
  expectHolds(inputError([&] { saveModel(folder_.file("none/part.ppf"), *model_, 0); }),
              "check that its folder exists and has room");
  std::filesystem::create_directory(folder_.file("folder.ppf"));
  folder_.write("folder.ppf/x", "");
  expectHolds(inputError([&] { saveModel(folder_.file("folder.ppf"), *model_, 0); }),
              "cannot be written");
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(path_).parent_path()))
    ++files;
  EXPECT_EQ(files, 2U);  // the model and the folder
}
}  // namespace
}  // namespace ppf_bin_picking

// A Laplacian that was written and read gives every algorithm the bits that the one in memory gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "../support/algorithms.h"
#include "temporary_dir.h"
#include "tufted/io/results.h"

namespace folder_algorithms_test {
namespace {

using tufted::Format;
using tufted::Laplacian;
using tufted::Points;

/// Noisy points of two spheres of unlike size, the finer one first; one is nowhere, and one a copy.
Points noisySpheres() {
  constexpr int fine = 1500, coarse = 500;
  std::mt19937_64 generator(4);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  Points points(fine + coarse, 3);
  for (int i = 0; i < fine + coarse; ++i) {
    const double z = 2 * uniform() - 1, angle = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
    double noise = 0;  // nearly normal
    for (int k = 0; k < 12; ++k) noise += uniform() - 0.5;
    points.row(i) << r * std::cos(angle), r * std::sin(angle), z;
    points.row(i) *= 1 + 0.02 * noise;
    if (i >= fine) points.row(i) = 20 * points.row(i) + Eigen::RowVector3d(50, 0, 0);
  }
  points.row(70) = points.row(5);
  points.row(71).setConstant(NAN);
  return points;
}

void expectSame(const Laplacian& one, const Laplacian& other, const Points& points, const std::string& name) {
  for (const tufted::support::Algorithm& algorithm : tufted::support::algorithms()) {
    const Eigen::MatrixXd a = algorithm.run(one, points), b = algorithm.run(other, points);
    ASSERT_EQ(a.rows(), b.rows()) << name << ", " << algorithm.name;
    EXPECT_EQ(std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)), 0)
        << name << ", " << algorithm.name << ": " << (a - b).cwiseAbs().maxCoeff();
  }
}

TEST(LaplacianOfAFolder, GivesEveryAlgorithmTheSameBits) {
  tufted::Geometry geometry;
  geometry.points = noisySpheres();
  geometry.width = static_cast<std::uint32_t>(geometry.points.rows());
  const Laplacian built = tufted::pointCloudLaplacian(geometry.points);
  ASSERT_GT(built.report.noise, 0);
  ASSERT_EQ(built.report.components, 2);
  const TemporaryDir dir;
  const std::vector<Format> formats = {Format::npz, Format::cover};
  tufted::writeLaplacian(dir.path(), built, geometry, {.formats = formats, .sign = tufted::Sign::igl, .dummy = true});
  const Laplacian read = tufted::readLaplacian(dir.path());
  expectSame(built, read, geometry.points, "all");
  const Laplacian part = tufted::restrictedTo(built, {0});
  expectSame(part, tufted::restrictedTo(read, {0}), geometry.points, "restricted");
  tufted::writeLaplacian(dir.path(), part, geometry, {.formats = formats});
  expectSame(part, tufted::readLaplacian(dir.path()), geometry.points, "restricted before it was written");
}

TEST(LaplacianOfAFolder, OfAnOlderVersionHasTheEdgesOfTheWhole) {
  tufted::Geometry geometry;
  geometry.points = noisySpheres();
  geometry.width = static_cast<std::uint32_t>(geometry.points.rows());
  Laplacian built = tufted::pointCloudLaplacian(geometry.points);
  const TemporaryDir dir;
  tufted::writeLaplacian(dir.path(), built, geometry);
  // As versions before 'component_edges.npy' and 'noise.npy' were written.
  std::ostringstream text;
  text << std::ifstream(dir / "report.json").rdbuf();
  std::string report = text.str();
  for (const std::string name : {"\"component_edges.npy\",", "\"noise.npy\","}) {
    ASSERT_NE(report.find(name), std::string::npos);
    report.erase(report.find(name), name.size());
  }
  dir.write("report.json", report);
  const Laplacian read = tufted::readLaplacian(dir.path());
  ASSERT_EQ(read.component_edges.size(), 2u);
  for (const tufted::ComponentEdges& edges : read.component_edges)
    EXPECT_EQ(edges.mean_square, built.report.mean_squared_edge);
  EXPECT_EQ(read.noise.size(), 0);
}

}  // namespace
}  // namespace folder_algorithms_test

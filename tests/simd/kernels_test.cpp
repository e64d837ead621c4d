#include "simd/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "base/buffer.h"
#include "cover/geometry.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "stars/offsets.h"
#include "stars/quadratic_fit.h"
#include "stars/tangent_frame.h"
#include "tufted/laplacian.h"
#include "tufted/scan_structure.h"

namespace tufted::kernels_test {
namespace {

TEST(Kernels, HaveTheSameBitsOnAnyProcessor) {
  const Points points = shapes::withNoise(shapes::sphere(65), 0.3).points;
  Buffer<Neighbor> neighbors;
  for (int q = 1; q < 65; ++q) neighbors.push_back({0, q});
  for (const std::size_t count : {1, 7, 8, 9, 30, 64}) {
    OffsetBuffer buffer;
    buffer.take(points, 0, std::span(neighbors).first(count));
    const Offsets offsets = buffer.view();
    EXPECT_EQ(kernels().extent(offsets), portableKernels().extent(offsets));
    const int all = static_cast<int>(count), ends[] = {all / 3, all / 2, all};
    std::array<OffsetSums, 3> sums, portable_sums;
    kernels().sumOffsets(offsets, 0.25, ends, 3, sums.data());
    portableKernels().sumOffsets(offsets, 0.25, ends, 3, portable_sums.data());
    for (int set = 0; set < 3; ++set) {
      const double* const sum = &sums[set].x;
      EXPECT_TRUE(std::equal(sum, sum + sizeof(OffsetSums) / sizeof(double), &portable_sums[set].x));
      OffsetBuffer first;
      first.take(points, 0, std::span(neighbors).first(ends[set]));
      OffsetSums alone;
      kernels().sumOffsets(first.view(), 0.25, &ends[set], 1, &alone);
      EXPECT_TRUE(std::equal(sum, sum + sizeof(OffsetSums) / sizeof(double), &alone.x)) << ends[set];
    }
    const Eigen::Matrix3d axes{{0.6, -0.8, 0.1}, {0.8, 0.6, 0.3}, {0.1, 0.2, -0.7}};
    HeightSums heights{}, portable_heights{};
    kernels().sumHeights(offsets, axes.data(), heights);
    portableKernels().sumHeights(offsets, axes.data(), portable_heights);
    EXPECT_TRUE(std::equal(&heights.u, &heights.u + HeightSystems::numbers, &portable_heights.u));
    const double weight = kernels().sumWeightedHeights(offsets, axes.data(), heights);
    EXPECT_EQ(weight, portableKernels().sumWeightedHeights(offsets, axes.data(), portable_heights));
    EXPECT_TRUE(std::equal(&heights.u, &heights.u + HeightSystems::numbers, &portable_heights.u));
    const Eigen::Vector3d x(0.6, 0.8, 0.1), y(-0.8, 0.6, 0.2);
    PlanarOffsets planar, portable;
    kernels().project(offsets, 0.25, x.data(), y.data(), planar);
    portableKernels().project(offsets, 0.25, x.data(), y.data(), portable);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(planar.u[i], portable.u[i]);
      EXPECT_EQ(planar.v[i], portable.v[i]);
    }
  }
}

TEST(Kernels, KeepWhatIsReachedInItsOrder) {
  const Points points = shapes::withNoise(shapes::sphere(65), 0.3).points;
  Buffer<Neighbor> neighbors;
  for (int q = 1; q < 65; ++q) neighbors.push_back({0, q});
  for (const Kernels* kernel : {&kernels(), &portableKernels()}) {
    for (const std::size_t count : {1, 7, 8, 9, 30, 64}) {
      OffsetBuffer offsets;
      offsets.take(points, 0, std::span(neighbors).first(count));
      const Offsets all = offsets.view();
      std::vector<double> heights(toPackets(static_cast<int>(count)));
      std::array<std::vector<double>, 3> expected;
      const Eigen::Vector3d normal(0, 0, 1);
      const HeightRange range = kernel->connectedHeights(all, normal.data(), 0.02, heights.data());
      for (int i = 0; i < all.count; ++i) {
        if (heights[i] < range.lowest || heights[i] > range.highest) continue;
        expected[0].push_back(all.x[i]);
        expected[1].push_back(all.y[i]);
        expected[2].push_back(all.z[i]);
      }
      std::array<std::vector<double>, 3> kept;
      for (auto& axis : kept) axis.assign(heights.size(), NAN);
      const int size =
          kernel->keepConnected(all, heights.data(), range, kept[0].data(), kept[1].data(), kept[2].data());
      ASSERT_EQ(size, std::ssize(expected[0]));
      for (int c = 0; c < 3; ++c) {
        expected[c].resize(toPackets(size));
        EXPECT_TRUE(std::equal(expected[c].begin(), expected[c].end(), kept[c].begin()));
      }
      OffsetBuffer in_place = offsets;
      chooseKernels(kernel);
      in_place.takeConnected(in_place.view(), heights.data(), range);
      chooseKernels(nullptr);
      ASSERT_EQ(in_place.count(), size);
      EXPECT_TRUE(std::equal(expected[2].begin(), expected[2].end(), in_place.view().z));
    }
  }
}

TEST(Kernels, RankEachValueByHowManyAreLess) {
  shapes::Random random(8);
  for (const Kernels* kernel : {&kernels(), &portableKernels()}) {
    for (int count = kernel_packet; count <= 160; count += kernel_packet) {
      std::vector<double> values(count);
      for (double& value : values) value = std::floor(count * random.uniform()) / 2;  // some are equal
      std::vector<float> rounded(count + 2 * kernel_packet, -1);
      std::vector<int> rank(count + 2 * kernel_packet, -1);
      kernel->rankValues(values.data(), count, rounded.data(), rank.data());
      for (int i = 0; i < count; ++i)
        ASSERT_EQ(rank[i], std::ranges::count_if(values, [&](double other) { return other < values[i]; })) << count;
    }
  }
}

TEST(Kernels, FindAxesOfEachMatrixAsIfItWereAlone) {
  shapes::Random random(5);
  std::vector<Covariance> covariances;
  Buffer<Neighbor> neighbors;
  for (int q = 1; q < 31; ++q) neighbors.push_back({0, q});
  OffsetBuffer offsets;
  for (int i = 0; i < 21; ++i) {  // flat, round, on a line, in one place
    Points points(31, 3);
    for (double& x : points.reshaped()) x = random.normal();
    points.col(2) *= std::array{0.01, 1.0, 0.3}[i % 3];
    points.rightCols(2) *= i == 7 ? 0 : 1;
    points *= i == 11 ? 0 : 1;
    offsets.take(points, 0, neighbors);
    covariances.push_back(covarianceOf(offsets.view()));
  }
  const auto axesOf = [](std::span<const Covariance> some) {
    std::vector<PrincipalAxes> axes(some.size());
    principalAxes(some, axes);
    return axes;
  };
  const std::vector<PrincipalAxes> together = axesOf(covariances);
  chooseKernels(&portableKernels());
  const std::vector<PrincipalAxes> portable = axesOf(covariances);
  chooseKernels(nullptr);
  for (std::size_t i = 0; i < covariances.size(); ++i) {
    const PrincipalAxes alone = axesOf({&covariances[i], 1}).front();
    for (const PrincipalAxes& axes : {together[i], portable[i]}) {
      EXPECT_EQ(axes.normal, alone.normal) << i;
      EXPECT_EQ(axes.variance, alone.variance) << i;
      EXPECT_EQ(axes.extent, alone.extent) << i;
    }
  }
}

TEST(Kernels, FitHeightsOfEachAsIfItWereAlone) {
  shapes::Random random(7);
  Buffer<Neighbor> neighbors;
  for (int q = 1; q < 31; ++q) neighbors.push_back({0, q});
  OffsetBuffer offsets;
  std::vector<HeightMoments> moments;
  for (int i = 0; i < 21; ++i) {  // curved, on one line, in one place, too few, without a size
    Points points(31, 3);
    for (double& x : points.reshaped()) x = random.normal();
    points.rightCols(2) *= i == 5 ? 0 : 1;
    points *= i == 8 ? 0 : 1;
    offsets.take(points, 0, std::span(neighbors).first(i == 12 ? 7 : 30));
    moments.push_back(heightMoments(offsets.view(), Eigen::Vector3d(1, 2, 2) / 3, i == 15 ? 0 : 2.5));
  }
  const auto fitsOf = [](std::span<const HeightMoments> some) {
    std::vector<HeightFit> fits(some.size());
    fitHeights(some, fits);
    return fits;
  };
  const std::vector<HeightFit> together = fitsOf(moments);
  chooseKernels(&portableKernels());
  const std::vector<HeightFit> portable = fitsOf(moments);
  chooseKernels(nullptr);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const HeightFit alone = fitsOf({&moments[i], 1}).front();
    EXPECT_EQ(alone.is_valid, i != 5 && i != 8 && i != 12 && i != 15) << i;
    for (const HeightFit& fit : {together[i], portable[i]}) {
      EXPECT_EQ(fit.is_valid, alone.is_valid) << i;
      EXPECT_EQ(fit.height, alone.height) << i;
      EXPECT_EQ(fit.variance, alone.variance) << i;
    }
  }
}

/// Climbs from 0 upwards, by sorting, as long as the next height is at most `gap` away.
double climb(std::vector<double> heights, double gap) {
  std::sort(heights.begin(), heights.end());
  double reached = 0;
  for (const double height : heights)
    if (height > reached && height - reached <= gap) reached = height;
  return reached;
}

TEST(Kernels, ReachHeightsOverGapsThatAreNotTooWide) {
  shapes::Random random(8);
  const Eigen::Vector3d normal = Eigen::Vector3d(2, -1, 2) / 3;
  int ends = 0;
  for (int count = 0; count < 120; ++count) {
    Points points(count, 3);
    for (double& x : points.reshaped()) x = random.normal();
    const int room = toPackets(count);
    Buffer<double> x(room), y(room), z(room), height(room);
    std::vector<double> up, down;
    for (int i = 0; i < count; ++i) {
      x[i] = points(i, 0), y[i] = points(i, 1), z[i] = points(i, 2);
      up.push_back(x[i] * normal[0] + (y[i] * normal[1] + z[i] * normal[2]));
      down.push_back(-up.back());
    }
    const double gap = 4.0 / (count + 1);
    for (const Kernels* kernel : {&portableKernels(), &kernels()}) {
      const HeightRange range =
          kernel->connectedHeights({count, x.data(), y.data(), z.data()}, normal.data(), gap, height.data());
      EXPECT_EQ(range.highest, climb(up, gap)) << count;
      EXPECT_EQ(range.lowest, -climb(down, gap)) << count;
      EXPECT_EQ(range.top, std::max(0.0, count > 0 ? *std::max_element(up.begin(), up.end()) : 0)) << count;
      EXPECT_EQ(range.bottom, -std::max(0.0, count > 0 ? *std::max_element(down.begin(), down.end()) : 0)) << count;
      EXPECT_TRUE(std::equal(up.begin(), up.end(), height.begin()));
      ends += range.highest < range.top && range.lowest > range.bottom ? 1 : 0;
    }
  }
  EXPECT_GT(ends, 20);  // gaps on both sides
}

TEST(Kernels, ReachAlongEachNormalWhatIsReachedAlongItAlone) {
  shapes::Random random(8);
  int ends = 0;
  for (int count = 0; count < 120; ++count) {
    const int room = toPackets(count);
    Buffer<double> x(room), y(room), z(room), height(room), along(static_cast<std::size_t>(kernel_packet) * count);
    for (int i = 0; i < count; ++i) x[i] = random.normal(), y[i] = random.normal(), z[i] = random.normal();
    const Offsets offsets{count, x.data(), y.data(), z.data()};
    Normals normals{};  // one is zero
    for (int j = 0; j + 1 < kernel_packet; ++j) {
      const Eigen::Vector3d normal = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      normals.x[j] = normal.x(), normals.y[j] = normal.y(), normals.z[j] = normal.z();
    }
    const double gap = 4.0 / (count + 1);
    for (const Kernels* kernel : {&portableKernels(), &kernels()}) {
      std::array<HeightRange, kernel_packet> range;
      kernel->connectedHeightsAlong(offsets, normals, gap, along.data(), range.data());
      for (int j = 0; j < kernel_packet; ++j) {
        const std::array<double, 3> normal = {normals.x[j], normals.y[j], normals.z[j]};
        const HeightRange alone = portableKernels().connectedHeights(offsets, normal.data(), gap, height.data());
        EXPECT_EQ(range[j].highest, alone.highest) << count;
        EXPECT_EQ(range[j].lowest, alone.lowest) << count;
        EXPECT_EQ(range[j].top, alone.top) << count;
        EXPECT_EQ(range[j].bottom, alone.bottom) << count;
        for (int i = 0; i < count; ++i) ASSERT_EQ(along[kernel_packet * i + j], height[i]);
        ends += alone.highest < alone.top && alone.lowest > alone.bottom ? 1 : 0;
      }
    }
  }
  EXPECT_GT(ends, 100);  // gaps on both sides
}

TEST(Kernels, MeasureTrianglesByTheFormulasOfGeometry) {
  constexpr int count = 37;
  constexpr std::size_t room = 64;
  shapes::Random random(6);
  std::array<std::vector<double>, 6> given, found, portable;
  for (auto& values : given) {
    values.resize(room);
    for (double& x : values) x = random.normal();
  }
  for (int axis = 0; axis < 3; ++axis) {
    given[axis][4] = given[axis][3];  // a triangle of no area
    for (int i = 0; i < count; ++i) given[3 + axis][i] = given[axis][i + 1] - given[axis][i];
  }
  const auto measure = [&](const Kernels& kernel, auto& result) {
    for (auto& values : result) values.assign(room, 0);
    kernel.measureTriangleFans({count, given[0].data(), given[1].data(), given[2].data(), given[3].data(),
                                given[4].data(), given[5].data(), result[0].data(), result[1].data(), result[2].data(),
                                result[3].data(), result[4].data(), result[5].data()});
  };
  measure(kernels(), found);
  measure(portableKernels(), portable);
  for (int i = 0; i < count; ++i) {
    const auto length = [&](int from, int at) {
      const double x = given[from][at], y = given[from + 1][at], z = given[from + 2][at];
      return std::sqrt(x * x + y * y + z * z);
    };
    const double own = length(0, i), next = length(0, i + 1), rim = length(3, i), area = triangleArea(own, next, rim);
    EXPECT_EQ(found[0][i], own);
    EXPECT_EQ(found[1][i], rim);
    EXPECT_EQ(found[2][i], area);
    EXPECT_EQ(found[3][i], triangleSlack(own, next, rim));
    EXPECT_EQ(area == 0, i == 3);
    for (int r = 0; r < 4; ++r) EXPECT_EQ(found[r][i], portable[r][i]) << r << " " << i;
    if (area == 0) continue;  // NaN
    EXPECT_EQ(found[4][i], cotanNumerator(own, next, rim) * (1 / (4 * area)));
    EXPECT_EQ(found[5][i], cotanNumerator(next, own, rim) * (1 / (4 * area)));
    for (int r = 4; r < 6; ++r) EXPECT_EQ(found[r][i], portable[r][i]) << r << " " << i;
  }
}

void expectTheSameOnAnyProcessor(const Points& points, const CloudOptions& options) {
  const Laplacian expected = pointCloudLaplacian(points, options);
  chooseKernels(&portableKernels());
  const Laplacian portable = pointCloudLaplacian(points, options);
  chooseKernels(nullptr);
  ASSERT_EQ(portable.L.nonZeros(), expected.L.nonZeros());
  EXPECT_EQ((portable.L - expected.L).norm(), 0);
  EXPECT_EQ(portable.M, expected.M);
}

TEST(Kernels, GiveTheSameLaplacianOnAnyProcessor) {
  for (const auto& cloud : {shapes::withNoise(shapes::sphere(3000), 0.01), shapes::squareLattice(40)})
    expectTheSameOnAnyProcessor(cloud.points, {});
}

TEST(Kernels, GiveTheSameLaplacianOfADepthImageOnAnyProcessor) {
  constexpr int side = 64;
  shapes::Random random(12);
  Points points(side * side, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const double u = (i % side - side / 2) / 100.0, v = (i / side - side / 2) / 100.0;
    const double inverse = (i % side > 50 ? 0.7 : 1) + 0.3 * u - 0.5 * v + u * v + 2e-3 * random.normal();
    points.row(i) = Eigen::RowVector3d(u, v, 1) / inverse;
  }
  const ScanStructure structure = imageStructure(side, side);
  CloudOptions options;
  options.structure = &structure;
  expectTheSameOnAnyProcessor(points, options);
}

}  // namespace
}  // namespace tufted::kernels_test

// Which pixels of an image are of one surface, many at once.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "depth_image/image_tile.h"
#include "depth_image/surface_windows.h"
#include "shapes/random.h"
#include "simd/kernels.h"

namespace tufted::pixel_joins_test {
namespace {

constexpr int columns = 80, rows = 7, first = 3 * columns + 5;

/// Points at random, at ranges from 1 to 1.2.
struct Rows {
  std::vector<double> x, y, z, range;

  explicit Rows(int seed) {
    shapes::Random random(seed);
    for (int i = 0; i < rows * columns; ++i) {
      x.push_back(0.1 * random.normal());
      y.push_back(0.1 * random.normal());
      z.push_back(1 + 0.2 * random.uniform());
      range.push_back(std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]));
    }
  }
  PixelPoints at(int pixel) const { return {&x[pixel], &y[pixel], &z[pixel], &range[pixel]}; }
  double squaredStep(int a, int b) const {
    const double dx = x[b] - x[a], dy = y[b] - y[a], dz = z[b] - z[a];
    return dx * dx + dy * dy + dz * dz;
  }
};

TEST(PixelJoins, AreThoseOfTheTestForTwoPoints) {
  const Rows image(11);
  const std::array steps = {PixelStep{0, 1}, PixelStep{1, -2}, PixelStep{3, 3}, PixelStep{2, 0}};
  std::array<int, steps.size()> shift;
  std::array<double, steps.size()> most;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    shift[s] = steps[s].row * columns + steps[s].column;
    most[s] = JumpTest::steepestOf(steps[s]) / 100;  // some fail
  }
  for (const RangeNoise& noise : {RangeNoise{0, 0}, {0.01, 0}, {0, 0.01}, {0.004, 0.006}}) {
    const JumpTest test = JumpTest::of(noise);
    for (const Kernels* kernel : {&kernels(), &portableKernels()}) {
      std::array<std::uint64_t, steps.size()> joined;
      const PixelSteps all{steps.size(), shift.data(), most.data()};
      kernel->joinPixels(image.at(first), all, test.tolerance.of_inverse, test.tolerance.of_depth, joined.data());
      for (std::size_t s = 0; s < steps.size(); ++s) {
        EXPECT_NE(joined[s], 0U);
        EXPECT_NE(~joined[s], 0U);
        for (int i = 0; i < pixels_in_word; ++i) {
          const int a = first + i, b = a + shift[s];
          EXPECT_EQ(joined[s] >> i & 1,
                    test.joins(image.squaredStep(a, b), image.range[a], image.range[b], most[s]) ? 1U : 0U);
        }
      }
    }
  }
}

TEST(PixelJoins, GiveSpacingsOfTheChosenPixels) {
  const Rows image(12);
  std::array<int, pixels_beside> shift;
  for (int i = 0; i < pixels_beside; ++i) shift[i] = window_pixels.step[i].row * columns + window_pixels.step[i].column;
  std::array<unsigned char, pixels_beside> beside = {0x01, 0x83, 0x10, 0xFE, 0x04, 0x80, 0x22, 0x00};
  for (auto& lanes : beside) lanes = static_cast<unsigned char>(lanes & ~0x08);  // lane 3 has none
  for (const Kernels* kernel : {&kernels(), &portableKernels()}) {
    std::array<double, kernel_packet> inverse, squared;
    for (int lane = 0; lane < kernel_packet; ++lane) inverse[lane] = 1.5 / image.range[first + lane];
    kernel->spacingsOf(image.at(first), inverse.data(), shift.data(), beside.data(), squared.data());
    EXPECT_EQ(squared[3], 0);
    for (int lane = 0; lane < kernel_packet; ++lane) {
      if (lane == 3) continue;
      double sum = 0, count = 0;
      const int a = first + lane;
      for (int i = 0; i < pixels_beside; ++i) {
        if ((beside[i] >> lane & 1) == 0) continue;
        const int b = a + shift[i];
        // What lies across the line of sight, as ranges of points near each other differ.
        sum += image.squaredStep(a, b) - std::pow(image.range[a] - image.range[b], 2);
        ++count;
      }
      EXPECT_NEAR(squared[lane], sum / count * std::pow(1.5 / image.range[a] / image.range[a], 2), 1e-15) << lane;
    }
  }
}

TEST(PixelJoins, TransposeBits) {
  std::array<std::uint64_t, 64> words, transposed;
  shapes::Random random(13);
  for (std::uint64_t& word : words) word = static_cast<std::uint64_t>(random.uniform() * 0x1p63) << 1;
  transposed = words;
  transposeBits(transposed);
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) EXPECT_EQ(transposed[i] >> j & 1, words[j] >> i & 1) << i << ' ' << j;
}

}  // namespace
}  // namespace tufted::pixel_joins_test

// Quadratics over squares of pixels, eight pixels at once.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "depth_image/window_pixels.h"
#include "shapes/random.h"
#include "simd/kernels.h"

namespace tufted::square_fit_test {
namespace {

TEST(SquareFit, OfPixelsNextToEachOtherOrApart) {
  constexpr int columns = 40, rows = 21, middle = 10 * columns + 10;
  shapes::Random random(9);
  std::vector<double> image(rows * columns);
  for (double& value : image) value = 1 + 0.1 * random.normal();
  for (const int stride : {1, 3}) {
    const PixelRows around{image.data() + middle, stride * columns, stride};
    for (const int reach : {2, 3}) {
      const auto fit = [&](const Kernels& kernel, SquareFits& fits) {
        (reach == 2 ? kernel.fitSquares5 : kernel.fitSquares7)(around, fits);
      };
      SquareFits fits, portable;
      fit(kernels(), fits);
      fit(portableKernels(), portable);
      for (int lane = 0; lane < kernel_packet; ++lane) {
        const int count = (2 * reach + 1) * (2 * reach + 1);
        Eigen::MatrixXd base(count, 6);
        Eigen::VectorXd values(count);
        for (int i = -reach, at = 0; i <= reach; ++i) {
          for (int j = -reach; j <= reach; ++j, ++at) {
            base.row(at) << 1, i, j, i * i, i * j, j * j;
            values[at] = image[middle + lane + stride * (i * columns + j)];
          }
        }
        const Eigen::VectorXd quadratic = base.householderQr().solve(values);
        EXPECT_NEAR(fits.value[lane], quadratic[0], 1e-13);
        EXPECT_NEAR(fits.variance[lane], (base * quadratic - values).squaredNorm() / (count - 6), 1e-13);
        EXPECT_EQ(fits.value[lane], portable.value[lane]);
        EXPECT_EQ(fits.variance[lane], portable.variance[lane]);
      }
    }
  }
}

TEST(SquareFit, SeesWhichValuesStayWithinASlope) {
  constexpr int columns = 40, middle = 3 * columns + 10;
  std::vector<double> image(7 * columns);
  for (int i = 0; i < std::ssize(image); ++i) image[i] = 0.1 * (i % columns) + 0.2 * (i / columns);
  const std::array slope = {0.31, 0.29, 0.31, 0.31, 0.31, 0.31, 0.31, 0.31};  // .3 from corner to corner
  std::array<std::ptrdiff_t, pixels_of_window> shift;
  for (int i = 0; i < pixels_of_window; ++i)
    shift[i] = window_pixels.step[i].row * columns + window_pixels.step[i].column;
  for (const Kernels* kernel : {&kernels(), &portableKernels()}) {
    std::array<unsigned char, pixels_of_window> within;
    std::array<double, kernel_packet> tolerance;
    const auto whole = [&](double of_all) {
      within.fill(0x55);
      tolerance.fill(of_all);
      return kernel->squaresWithin(&image[middle], shift.data(), slope.data(), tolerance.data(), 0xFF, within.data());
    };
    const auto expectEachWithin = [&] {
      for (int i = 0; i < pixels_of_window; ++i) {
        for (int lane = 0; lane < kernel_packet; ++lane) {
          const double difference = std::abs(image[middle + lane + shift[i]] - image[middle + lane]);
          const bool is_within = difference <= slope[lane] * window_pixels.step[i].ring() + tolerance[lane];
          EXPECT_EQ(within[i] >> lane & 1, is_within ? 1 : 0) << i << ' ' << lane;
        }
      }
    };
    EXPECT_EQ(whole(1e-9), 0xFDU);
    expectEachWithin();
    tolerance[1] = 0.1;  // each lane has its own
    EXPECT_EQ(kernel->squaresWithin(&image[middle], shift.data(), slope.data(), tolerance.data(), 0xFF, within.data()),
              0xFFU);
    EXPECT_EQ(whole(0.1), 0xFFU);
    EXPECT_EQ(within[0], 0x55);     // all are whole, so there is nothing to tell
    image[6 * columns + 20] = NAN;  // in the windows of pixels 17 to 23
    EXPECT_EQ(whole(0.1), 0x7FU);
    expectEachWithin();
    image[6 * columns + 20] = 0.1 * 20 + 0.2 * 6;
    image[middle] = NAN;  // a middle, and in the windows of the next three
    EXPECT_EQ(whole(0.1), 0xF0U);
    expectEachWithin();
    image[middle] = 0.1 * 10 + 0.2 * 3;
  }
}

}  // namespace
}  // namespace tufted::square_fit_test

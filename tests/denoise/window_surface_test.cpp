#include "denoise/window_surface.h"

#include <gtest/gtest.h>

#include "shapes/random.h"
#include "simd/kernels.h"
#include "stars/offsets.h"

namespace tufted::window_surface_test {
namespace {

TEST(WindowSurface, KernelsMoveOntoItAlongItsNormal) {
  shapes::Random random(9);
  Windows windows;
  windows.resize(1, 1);
  windows.normal.row(0) = Eigen::RowVector3d(2, -1, 2) / 3;
  windows.radius[0] = 0.7;
  WindowFit& fit = windows.fits[0][0] = {};
  for (double& c : fit.coefficient) c = 0.2 * random.normal();
  OffsetBuffer buffer;
  for (const int count : {1, 8, 9, 33}) {
    buffer.fill(count, [&](int) { return Eigen::RowVector3d(random.normal(), random.normal(), random.normal()); });
    const Offsets offsets = buffer.view();
    const auto waysBy = [&](const Kernels& kernel) {
      Eigen::ArrayX4d ways(toPackets(count), 4);
      kernel.moveOnto(offsets, quadraticOf(windows, 0, 0), 0.125, ways.col(0).data(), ways.col(1).data(),
                      ways.col(2).data(), ways.col(3).data());
      return Eigen::ArrayX4d(ways.topRows(count));
    };
    const Eigen::ArrayX4d ways = waysBy(kernels());
    EXPECT_TRUE((ways == waysBy(portableKernels())).all());
    for (int i = 0; i < count; ++i) {
      const WindowSurface surface = surfaceAt(windows, 0, 0, {offsets.x[i], offsets.y[i], offsets.z[i]});
      EXPECT_NEAR(ways(i, 0), surface.height, 1e-14);
      const Eigen::Vector3d way = (0.125 - surface.height) * surface.normal;
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(ways(i, 1 + axis), way[axis], 1e-14);
    }
  }
}

}  // namespace
}  // namespace tufted::window_surface_test

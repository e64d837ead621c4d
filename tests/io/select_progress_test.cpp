#include <gtest/gtest.h>

#include "tufted/errors.h"
#include "tufted/io/select.h"

namespace select_progress_test {
namespace {

TEST(Selection, StopsWhenProgressSaysSo) {
  tufted::Geometry geometry;
  geometry.points = tufted::Points::Random(100000, 3);
  const tufted::Geometry before = geometry;
  for (const tufted::Selection& selection :
       {tufted::Selection{.where = {"x>0"}}, tufted::Selection{.thin = 0.01},
        tufted::Selection{.crop = Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones())}}) {
    int calls = 0;
    const auto countAll = [&](std::string_view, double) { return ++calls > 0; };
    tufted::Geometry whole = before;
    tufted::select(whole, selection, countAll);
    EXPECT_GE(calls, 2);
    for (int stop = calls; stop > 0; --stop) {
      int left = stop;
      EXPECT_THROW(tufted::select(geometry, selection, [&](std::string_view, double) { return --left > 0; }),
                   tufted::Cancelled);
      EXPECT_EQ(geometry.points, before.points);
    }
  }
}

}  // namespace
}  // namespace select_progress_test

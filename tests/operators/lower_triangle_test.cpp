// What the factorisations of validate and smooth take.
#include "operators/lower_triangle.h"

#include <gtest/gtest.h>

#include <limits>

namespace tufted::lower_triangle_test {
namespace {

TEST(LowerTriangle, HoldsTheEntriesOfThePointsSelected) {
  Eigen::MatrixXd dense(4, 4);
  dense << 1, 2, 3, 4, 2, 5, 6, 7, 3, 6, 8, 9, 4, 7, 9, 10;
  const SparseMatrix L = dense.sparseView();
  NumberedPoints selection(4);
  for (const int i : {0, 2, 3}) selection.add(i);
  const Eigen::MatrixXd lower =
      lowerTriangle(L, selection, [](int i, int j, double value) { return 100 * value + 10 * i + j; });
  Eigen::MatrixXd expected(3, 3);
  expected << 100, 0, 0, 320, 822, 0, 430, 932, 1033;
  EXPECT_EQ(lower, expected);
}

TEST(LowerTriangle, LeavesRoomForFactorsOfMoreEntriesThanAnInt) {
  using Matrix = decltype(lowerTriangle(SparseMatrix(), NumberedPoints(0), [](int, int, double) { return 0.0; }));
  EXPECT_GT(std::numeric_limits<Matrix::StorageIndex>::max(), std::numeric_limits<int>::max());
}

}  // namespace
}  // namespace tufted::lower_triangle_test

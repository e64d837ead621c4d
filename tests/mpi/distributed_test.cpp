// L and M on several processes, to be run by mpirun.
#include "distributed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tufted/components.h"
#include "tufted/errors.h"
#include "tufted/laplacian.h"

namespace tufted {
namespace {

void expectRowsOf(const Laplacian& whole, const DistributedLaplacian& laplacian) {
  const std::vector<double> row_of = everywhere(laplacian.row.get());
  std::map<PetscInt, int> point_of;
  for (std::size_t p = 0; p < row_of.size(); ++p) {
    EXPECT_EQ(row_of[p] >= 0, whole.status[p] == PointStatus::active) << p;
    if (row_of[p] >= 0) point_of[static_cast<PetscInt>(row_of[p])] = static_cast<int>(p);
  }
  EXPECT_EQ(laplacian.report.active, whole.report.active);
  EXPECT_EQ(laplacian.report.nonzeros, whole.report.nonzeros);
  EXPECT_GE(laplacian.report.margin, 0);
  EXPECT_NEAR(laplacian.report.area, whole.M.sum(), 1e-12 * whole.M.sum());
  PetscInt first = 0, last = 0;
  MatGetOwnershipRange(laplacian.L.get(), &first, &last);
  const VectorXd diagonal = whole.L.diagonal();
  const PetscScalar* masses = nullptr;
  VecGetArrayRead(laplacian.M.get(), &masses);
  for (PetscInt row = first; row < last; ++row) {
    const int p = point_of.at(row);
    ASSERT_EQ(laplacian.point[row - first], p);
    EXPECT_EQ(laplacian.boundary[row - first], whole.boundary[p]);
    EXPECT_NEAR(std::abs(laplacian.normals.row(row - first).dot(whole.frames.normals.row(p))), 1, 1e-12);
    EXPECT_NEAR(masses[row - first], whole.M[p], 1e-12 * whole.M[p]);
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    MatGetRow(laplacian.L.get(), row, &count, &columns, &values);
    for (PetscInt e = 0; e < count; ++e) {
      const int q = point_of.at(columns[e]);
      EXPECT_NEAR(values[e], whole.L.coeff(p, q), 1e-12 * std::max(diagonal[p], diagonal[q])) << p << ' ' << q;
    }
    MatRestoreRow(laplacian.L.get(), row, &count, &columns, &values);
  }
  VecRestoreArrayRead(laplacian.M.get(), &masses);
}

TEST(DistributedLaplacian, HasTheRowsOfTheWhole) {
  for (const Points& points : {sphere(4000, 101), sphere(4000, 103, {0, 0, 0}, .02), oddTerrain(6000)}) {
    const Laplacian whole = pointCloudLaplacian(points, clean());
    for (const int tiles : {0, 5}) expectRowsOf(whole, build(spread(points).own, tiles));
  }
}

TEST(DistributedLaplacian, IsTheSameWhicheverProcessHasThePoints) {
  const Points points = oddTerrain(3000);
  const Points none(0, 3);
  expectRowsOf(pointCloudLaplacian(points, clean()), build(processNumber() == processCount() - 1 ? points : none));
}

TEST(DistributedLaplacian, OfFewOrNoPointsHasFewOrNoRows) {
  for (const int n : {0, 1, 7}) {
    const Points points = sphere(n, 101);
    expectRowsOf(pointCloudLaplacian(points, clean()), build(spread(points).own));
  }
}

TEST(DistributedLaplacian, HasTheComponentsOfTheWhole) {
  Points points(7000, 3);
  points << sphere(1000, 101, {5, 0, 0}), sphere(4000, 102), .5 * sphere(2000, 103, {0, 20, 0});
  const Laplacian whole = pointCloudLaplacian(points, clean());
  const DistributedLaplacian laplacian = build(spread(points).own);
  EXPECT_EQ(laplacian.components, whole.report.components);
  const Eigen::VectorXd component = byPoint(laplacian, byRow(laplacian, [&, i = 0](std::int64_t) mutable {
                                              return static_cast<double>(laplacian.component[i++]);
                                            }));
  // Larger areas first: two of radius 1, which differ little, then one of radius 1/2.
  EXPECT_EQ(component[6000], laplacian.components - 1);
  std::map<int, double> name;
  for (int p = 0; p < 7000; ++p) EXPECT_EQ(name.emplace(whole.component[p], component[p]).first->second, component[p]);
}

TEST(DistributedLaplacian, OfMorePointsThanPetscCountsIsRefused) {
  if (sizeof(PetscInt) > 4) GTEST_SKIP() << "indices have 64 bits";
  const PointSource large = {std::int64_t{1} << 31, [](const auto&) { FAIL() << "nothing is to be read"; }};
  TileOptions options;
  options.cloud = clean();
  EXPECT_EQ(refusal([&] { distributedLaplacian(PETSC_COMM_WORLD, large, options); }),
            "distributedLaplacian: 2147483648 points, must be at most 2147483647: PETSc with 64-bit indices takes more "
            "(libpetsc64-real-dev, libslepc64-real3.18-dev)");
}

}  // namespace
}  // namespace tufted

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (SlepcInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  // Process 0 alone says what it has done; the others say what fails.
  testing::GTEST_FLAG(color) = "no";
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (tufted::processNumber() != 0) delete listeners.Release(listeners.default_result_printer());
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  const int failed = RUN_ALL_TESTS();
  SlepcFinalize();
  return failed;
}

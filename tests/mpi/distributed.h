#pragma once

#include <slepc.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "../support/refusal.h"
#include "tufted/mpi/distributed_laplacian.h"

// Clouds and values of tests that mpirun runs on several processes: each makes the whole cloud and builds its L and M
// alone, as what the processes share must be.

namespace tufted {

using support::refusal;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline int processNumber() {
  int number = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &number);
  return number;
}
inline int processCount() {
  int count = 0;
  MPI_Comm_size(PETSC_COMM_WORLD, &count);
  return count;
}

inline CloudOptions clean() {
  CloudOptions options = cloudOptions(Preset::clean);
  options.threads = 1;
  return options;
}

inline Points sphere(int n, int seed, const Eigen::RowVector3d& center = {0, 0, 0}, double noise = 0) {
  std::mt19937_64 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  Points points(n, 3);
  for (int i = 0; i < n; ++i) {
    Eigen::RowVector3d direction;
    for (double& value : direction) value = normal(random);
    points.row(i) = center + direction.normalized() * (1 + noise * normal(random));
  }
  return points;
}

/// A wavy sheet in rows of unequal spacing, a cluster of few points far away, copies and points that are not finite.
inline Points oddTerrain(int n) {
  std::mt19937_64 random(102);
  std::uniform_real_distribution<double> uniform(0, 1);
  Points points(n, 3);
  for (int i = 0; i < n; ++i) {
    const double x = 10 * uniform(random), y = std::round(40 * uniform(random)) / 4;
    points.row(i) << x, y, .3 * std::sin(x) * std::cos(y);
  }
  for (int i = 0; i < 12; ++i) points.row(17 * i + 3) << 200 + uniform(random), 300 + uniform(random), 50;
  for (int i = 0; i < 40; ++i) points.row(n - 1 - 7 * i) = points.row(31 * i);
  points(5, 1) = nan;
  points(n / 2, 0) = std::numeric_limits<double>::infinity();
  return points;
}

/// All points, and those of this process.
struct Cloud {
  Points all, own;
};

inline Cloud spread(const Points& points) {
  const Eigen::Index first = points.rows() * processNumber() / processCount();
  const Eigen::Index last = points.rows() * (processNumber() + 1) / processCount();
  return {points, points.middleRows(first, last - first)};
}

inline DistributedLaplacian build(const Points& own, int tiles = 0, bool faces = false) {
  TileOptions options;
  options.cloud = clean();
  options.faces = faces;
  options.tiles = tiles;
  return distributedLaplacian(PETSC_COMM_WORLD, sourceOf(PETSC_COMM_WORLD, own), options);
}

/// A vector's values by point of the source, all of them in every process.
inline std::vector<double> everywhere(Vec by_point) {
  Vec all = nullptr;
  VecScatter scatter = nullptr;
  VecScatterCreateToAll(by_point, &scatter, &all);
  VecScatterBegin(scatter, by_point, all, INSERT_VALUES, SCATTER_FORWARD);
  VecScatterEnd(scatter, by_point, all, INSERT_VALUES, SCATTER_FORWARD);
  PetscInt size = 0;
  const PetscScalar* values = nullptr;
  VecGetSize(all, &size);
  VecGetArrayRead(all, &values);
  std::vector<double> result(values, values + size);
  VecRestoreArrayRead(all, &values);
  VecScatterDestroy(&scatter);
  VecDestroy(&all);
  return result;
}

inline Eigen::VectorXd byPoint(const DistributedLaplacian& laplacian, const PetscVector& values) {
  const std::vector<double> all = everywhere(valuesByPoint(laplacian, values.get()).get());
  return Eigen::Map<const Eigen::VectorXd>(all.data(), std::ssize(all));
}

/// One value per row, by a function of the point.
template <class Value>
PetscVector byRow(const DistributedLaplacian& laplacian, Value value) {
  PetscVector result;
  VecDuplicate(laplacian.M.get(), result.make());
  PetscScalar* values = nullptr;
  VecGetArray(result.get(), &values);
  for (std::size_t i = 0; i < laplacian.point.size(); ++i) values[i] = value(laplacian.point[i]);
  VecRestoreArray(result.get(), &values);
  return result;
}

}  // namespace tufted

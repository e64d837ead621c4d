// Geodesic distance by the heat method (Crane, Weischedel, Wardetzky 2013, 2017) on several processes, as
// src/algorithms/heat_distance.cpp finds it on one.
#include "tufted/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "base/infinity.h"
#include "cover/face_scale.h"
#include "mpi/ghosts.h"
#include "mpi/heat_spread.h"
#include "mpi/linear_solve.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"
#include "mpi/rows.h"
#include "operators/surface_faces.h"
#include "tufted/mpi/solves.h"

namespace tufted {
namespace {

/// A face around a row of this process.
struct FaceOfRow {
  int row;
  SurfaceFace face;  ///< with corners by Ghosts

  /// How many corners are the row: more than one only after flips.
  int copies() const { return static_cast<int>(std::count(face.corners.begin(), face.corners.end(), row)); }
};

class HeatMethod {
 public:
  HeatMethod(const DistributedLaplacian& laplacian, std::vector<std::uint8_t> is_source)
      : laplacian_(laplacian), rows_(laplacian, reachOf(laplacian)), is_source_(std::move(is_source)) {
    double longest = 0;
    for (const TileFace& face : laplacian.faces)
      longest = std::max(longest, *std::max_element(face.opposite.begin(), face.opposite.end()));
    MPI_Allreduce(MPI_IN_PLACE, &longest, 1, MPI_DOUBLE, MPI_MAX, commOf(laplacian));
    exponent_ = longest > 0 ? std::ilogb(longest) : 0;
    for (int row = 0; row < rows_.own(); ++row)
      for (std::size_t f = laplacian.face_begin[row]; f < laplacian.face_begin[row + 1]; ++f)
        add(row, laplacian.faces[f]);
  }

  /// The integrated divergence of the direction away from the sources.
  std::vector<double> divergences() const {
    std::vector<double> is_source(is_source_.begin(), is_source_.end());
    is_source.resize(static_cast<std::size_t>(rows_.size()));
    rows_.update(is_source);
    const std::vector<double> log_u = logHeat();
    std::vector<double> sums(is_source_.size());
    for (const FaceOfRow& around : faces_) {
      const auto& [a, b, c] = around.face.corners;
      const bool has_direction = is_source[a] == 0 || is_source[b] == 0 || is_source[c] == 0;
      if (!has_direction || std::min({log_u[a], log_u[b], log_u[c]}) == -infinity) continue;
      const auto outflow = divergence(around.face, -gradientDirection(around.face, log_u[a], log_u[b], log_u[c]));
      for (int k = 0; k < 3; ++k)
        if (around.face.corners[k] == around.row) sums[around.row] += outflow[k];
    }
    return sums;
  }

  /// Lengths are in units of two to this power.
  int exponent() const { return exponent_; }

 private:
  /// All rows that are corners of faces, or columns of L, in the rows of this process.
  static std::vector<std::int64_t> reachOf(const DistributedLaplacian& laplacian) {
    std::vector<std::int64_t> reached;
    for (const TileFace& face : laplacian.faces)
      reached.insert(reached.end(), face.corners.begin(), face.corners.end());
    PetscInt first = 0, last = 0;
    check(MatGetOwnershipRange(laplacian.L.get(), &first, &last));
    for (PetscInt row = first; row < last; ++row) {
      PetscInt count = 0;
      const PetscInt* columns = nullptr;
      check(MatGetRow(laplacian.L.get(), row, &count, &columns, nullptr));
      reached.insert(reached.end(), columns, columns + count);
      check(MatRestoreRow(laplacian.L.get(), row, &count, &columns, nullptr));
    }
    return reached;
  }

  void add(int row, const TileFace& given) {
    DistinctFace face;
    for (int k = 0; k < 3; ++k) face.corners[k] = rows_.numberOf(given.corners[k]);
    face.opposite = given.opposite;
    FaceOfRow around{row, {}};
    if (layOut(face, faceScale(Kind::cloud) * given.copies, exponent_, around.face)) faces_.push_back(around);
  }

  /// The diagonal of M / t, M being the lumped areas of the faces and t of each component by its mean squared side.
  std::vector<double> massesOverTime() const {
    std::vector<double> areas(is_source_.size()), weights = areas, squares = areas;
    for (const FaceOfRow& around : faces_) {
      const SurfaceFace& face = around.face;
      areas[around.row] += around.copies() * face.weight * face.base * face.height / 6;
      weights[around.row] += around.copies() * face.weight;
      squares[around.row] += around.copies() * face.weight * squaredSides(face) / 3;
    }
    const std::vector<double> all = sumsOf(laplacian_, weights), sums = sumsOf(laplacian_, squares);
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const PetscInt c = laplacian_.component[i];
      areas[i] = sums[c] > 0 ? areas[i] / (DistanceOptions{}.time_step * sums[c] / all[c]) : 1;
    }
    return areas;
  }

  /// ln of heat: the mean of that which cannot leave across the boundary and that which is lost there.
  std::vector<double> logHeat() const {
    const std::vector<double> masses = massesOverTime();
    std::vector<std::uint8_t> is_cold(is_source_.size(), 0);
    std::vector<double> log_u = logOfHeat(laplacian_, rows_, masses, is_source_, is_cold);
    for (std::size_t i = 0; i < is_cold.size(); ++i) is_cold[i] = laplacian_.boundary[i] != Boundary::none ? 1 : 0;
    int ends = std::count(is_cold.begin(), is_cold.end(), 1) > 0 ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &ends, 1, MPI_INT, MPI_MAX, commOf(laplacian_));
    if (ends == 0) return log_u;
    const std::vector<double> lost = logOfHeat(laplacian_, rows_, masses, is_source_, is_cold);
    for (std::size_t i = 0; i < log_u.size(); ++i)
      if (log_u[i] > -infinity) log_u[i] += std::log1p(std::exp(lost[i] - log_u[i]));  // the factor 2 does not matter
    return log_u;
  }

  const DistributedLaplacian& laplacian_;
  const Ghosts rows_;
  const std::vector<std::uint8_t> is_source_;
  int exponent_ = 0;
  std::vector<FaceOfRow> faces_;
};

/// By component, the greatest magnitude of values; 1 where all are 0.
std::vector<double> unitsOf(const DistributedLaplacian& laplacian, const std::vector<double>& values) {
  std::vector<int> rows(values.size());
  std::iota(rows.begin(), rows.end(), 0);
  std::vector<double> magnitudes;
  for (const double value : values) magnitudes.push_back(std::abs(value));
  std::vector<double> units = greatestOfComponents(laplacian, rows, magnitudes, 0);
  std::replace(units.begin(), units.end(), 0., 1.);
  return units;
}

/// Shifts a function that is known up to a constant per component so that its mean at the sources is 0.
void shift(const DistributedLaplacian& laplacian, const std::vector<std::uint8_t>& is_source,
           std::vector<double>& values) {
  std::vector<double> excess(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) excess[i] = is_source[i] * values[i];
  const std::vector<double> sums = sumsOf(laplacian, excess);
  const std::vector<double> counts = sumsOf(laplacian, {is_source.begin(), is_source.end()});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const PetscInt c = laplacian.component[i];
    const double above = counts[c] > 0 ? std::max(0., values[i] - sums[c] / counts[c]) : infinity;
    values[i] = is_source[i] != 0 ? 0 : above;
  }
}

/// Which rows of this process are sources, whichever process has given them.
std::vector<std::uint8_t> sourcesOf(const DistributedLaplacian& laplacian, const std::vector<PetscInt>& sources) {
  PetscInt size = 0;
  check(VecGetSize(laplacian.M.get(), &size));
  if (std::ssize(laplacian.face_begin) != std::ssize(laplacian.point) + 1)
    throw InvalidInput("distance: laplacian has no faces, must be built with TileOptions::faces");
  for (const PetscInt row : sources)
    if (row < 0 || row >= size)
      throw InvalidInput("distance: row " + std::to_string(row) + ", must be in [0, " + std::to_string(size) + ")");
  const PetscVector marks = like(laplacian.M.get());
  check(VecSet(marks.get(), 0));
  setAt(marks.get(), {sources.begin(), sources.end()}, std::vector<double>(sources.size(), 1));
  if (greatestOf(marks.get()) == 0) throw InvalidInput("distance: no row is a source, must be at least one");
  const std::vector<double> own = localOf(marks.get());
  return {own.begin(), own.end()};
}

}  // namespace

PetscVector distance(const DistributedLaplacian& laplacian, const std::vector<PetscInt>& sources,
                     DistributedSolve* report) {
  const std::vector<std::uint8_t> is_source = sourcesOf(laplacian, sources);
  const HeatMethod method(laplacian, is_source);
  std::vector<double> right = method.divergences();
  const std::vector<double> sums = sumsOf(laplacian, right);
  const std::vector<double> counts = sumsOf(laplacian, std::vector<double>(right.size(), 1));
  for (std::size_t i = 0; i < right.size(); ++i)  // rounding, and faces with different diagonals in two tiles
    right[i] -= sums[laplacian.component[i]] / counts[laplacian.component[i]];
  // One residual judges all components, so each is solved for in its own unit.
  const std::vector<double> unit = unitsOf(laplacian, right);
  for (std::size_t i = 0; i < right.size(); ++i) right[i] /= unit[laplacian.component[i]];
  PetscVector b = like(laplacian.M.get()), u = like(laplacian.M.get());
  setLocal(b.get(), right);
  check(VecSet(u.get(), 0));
  if (report != nullptr) *report = {};
  solveLaplacian("distance", laplacian, b.get(), u.get(), report);
  std::vector<double> values = localOf(u.get());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= unit[laplacian.component[i]];
  shift(laplacian, is_source, values);
  for (double& value : values) value = std::ldexp(value, method.exponent());
  setLocal(u.get(), values);
  return u;
}

}  // namespace tufted

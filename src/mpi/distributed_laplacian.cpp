#include "tufted/mpi/distributed_laplacian.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "base/sort_unique.h"
#include "mpi/components.h"
#include "mpi/exchange.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"

namespace tufted {
namespace {

/// The last rows that tiles of this process gave of each point, in the order in which they were first given.
class BuiltRows {
 public:
  void add(TileRows rows) { parts_.push_back(std::move(rows)); }

  /// Leaves the last row of each point. To be called once, when all are there.
  void finish() {
    std::vector<Place> all;
    for (std::size_t part = 0; part < parts_.size(); ++part)
      for (std::size_t row = 0; row < parts_[part].point.size(); ++row)
        all.push_back({parts_[part].point[row], static_cast<int>(part), static_cast<int>(row)});
    std::vector<Place> by_point = all;
    std::sort(by_point.begin(), by_point.end(), [](const Place& a, const Place& b) {
      return std::tie(a.point, b.part) < std::tie(b.point, a.part);  // the last part first
    });
    by_point.erase(std::unique(by_point.begin(), by_point.end(),
                               [](const Place& a, const Place& b) { return a.point == b.point; }),
                   by_point.end());
    std::sort(by_point.begin(), by_point.end(),
              [](const Place& a, const Place& b) { return std::tie(a.part, a.row) < std::tie(b.part, b.row); });
    places_ = std::move(by_point);
  }

  /// Calls visit(rows, row) for each row.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (const Place& place : places_) visit(parts_[static_cast<std::size_t>(place.part)], place.row);
  }

 private:
  struct Place {
    std::int64_t point;
    int part, row;
  };
  std::vector<TileRows> parts_;
  std::vector<Place> places_;
};

std::int64_t sumOf(MPI_Comm comm, std::int64_t value) {
  std::int64_t sum = 0;
  MPI_Allreduce(&value, &sum, 1, MPI_INT64_T, MPI_SUM, comm);
  return sum;
}

/// The counts of all processes together.
TileReport reportOfAll(MPI_Comm comm, TileReport report) {
  for (std::int64_t* count : {&report.active, &report.coincident, &report.isolated, &report.nonzeros})
    *count = sumOf(comm, *count);
  report.builds = static_cast<int>(sumOf(comm, report.builds));
  MPI_Allreduce(MPI_IN_PLACE, &report.area, 1, MPI_DOUBLE, MPI_SUM, comm);
  report.margin += 1;
  MPI_Allreduce(MPI_IN_PLACE, &report.margin, 1, MPI_DOUBLE, MPI_SUM, comm);
  report.margin -= 1;
  MPI_Allreduce(MPI_IN_PLACE, &report.most_points, 1, MPI_INT64_T, MPI_MAX, comm);
  return report;
}

void checkCount(std::int64_t points) {
  if (points > std::numeric_limits<PetscInt>::max())
    throw InvalidInput("distributedLaplacian: " + std::to_string(points) + " points, must be at most " +
                       std::to_string(std::numeric_limits<PetscInt>::max()) +
                       ": PETSc with 64-bit indices takes more (libpetsc64-real-dev, libslepc64-real3.18-dev)");
}

/// Numbers the active points of this process, from `first` on.
void numberRows(MPI_Comm comm, const BuiltRows& built, std::int64_t points, DistributedLaplacian& result) {
  std::vector<Eigen::RowVector3d> normals;
  built.forEach([&](const TileRows& rows, int row) {
    const std::int64_t point = rows.point[row];
    if (rows.status[row] == PointStatus::coincident) result.coincident.emplace_back(point, rows.representative[row]);
    if (rows.status[row] != PointStatus::active) return;
    result.point.push_back(point);
    result.boundary.push_back(rows.boundary[row]);
    normals.emplace_back(rows.normals.row(row));
  });
  result.normals.resize(std::ssize(normals), 3);
  for (std::size_t i = 0; i < normals.size(); ++i) result.normals.row(static_cast<Eigen::Index>(i)) = normals[i];

  const auto size = static_cast<PetscInt>(result.point.size());
  check(VecCreateMPI(comm, size, PETSC_DETERMINE, result.M.make()));
  PetscInt first = 0;
  check(VecGetOwnershipRange(result.M.get(), &first, nullptr));
  check(VecCreateMPI(comm, PETSC_DECIDE, static_cast<PetscInt>(points), result.row.make()));
  check(VecSet(result.row.get(), -1));
  std::vector<double> numbers(result.point.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(first) + static_cast<double>(i);
  setAt(result.row.get(), result.point, numbers);
}

/// The rows of L with columns by row of L.
struct NumberedRows {
  std::vector<std::size_t> begin = {0};
  std::vector<PetscInt> column;
  std::vector<double> value;
};

/// The rows of points in the reach of this process.
class RowNumbers {
 public:
  RowNumbers(Vec row, std::vector<std::int64_t> points) : points_(std::move(points)) {
    sortUnique(points_);
    rows_ = valuesAt(row, points_);
  }
  PetscInt of(std::int64_t point) const {
    return static_cast<PetscInt>(rows_[std::lower_bound(points_.begin(), points_.end(), point) - points_.begin()]);
  }

 private:
  std::vector<std::int64_t> points_;
  std::vector<double> rows_;
};

NumberedRows numberColumns(const BuiltRows& built, const DistributedLaplacian& result) {
  std::vector<std::int64_t> points;
  built.forEach([&](const TileRows& rows, int row) {
    points.insert(points.end(), rows.column.begin() + rows.begin[row], rows.column.begin() + rows.begin[row + 1]);
  });
  const RowNumbers numbers(result.row.get(), std::move(points));
  NumberedRows numbered;
  built.forEach([&](const TileRows& rows, int row) {
    if (rows.status[row] != PointStatus::active) return;
    for (std::int64_t e = rows.begin[row]; e < rows.begin[row + 1]; ++e) {
      numbered.column.push_back(numbers.of(rows.column[e]));
      numbered.value.push_back(rows.value[e]);
    }
    numbered.begin.push_back(numbered.column.size());
  });
  return numbered;
}

/// Keeps the faces around the rows, with corners by row of L.
void numberFaces(const BuiltRows& built, DistributedLaplacian& result) {
  result.face_begin.push_back(0);
  std::vector<std::int64_t> points;
  built.forEach([&](const TileRows& rows, int row) {
    if (rows.status[row] != PointStatus::active) return;
    for (std::int64_t f = rows.face_begin[row]; f < rows.face_begin[row + 1]; ++f) {
      result.faces.push_back(rows.faces[f]);
      points.insert(points.end(), rows.faces[f].corners.begin(), rows.faces[f].corners.end());
    }
    result.face_begin.push_back(result.faces.size());
  });
  const RowNumbers numbers(result.row.get(), std::move(points));
  for (TileFace& face : result.faces)
    for (std::int64_t& corner : face.corners) corner = numbers.of(corner);
}

void assemble(MPI_Comm comm, const NumberedRows& rows, DistributedLaplacian& result) {
  PetscInt first = 0, last = 0;
  check(VecGetOwnershipRange(result.M.get(), &first, &last));
  const auto size = static_cast<std::size_t>(last - first);
  std::vector<PetscInt> inside(size), outside(size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e)
      ++(first <= rows.column[e] && rows.column[e] < last ? inside : outside)[i];
  check(MatCreateAIJ(comm, last - first, last - first, PETSC_DETERMINE, PETSC_DETERMINE, 0, inside.data(), 0,
                     outside.data(), result.L.make()));
  const Mat L = result.L.get();
  for (std::size_t i = 0; i < size; ++i) {
    const PetscInt row = first + static_cast<PetscInt>(i);
    const auto count = static_cast<PetscInt>(rows.begin[i + 1] - rows.begin[i]);
    check(MatSetValues(L, 1, &row, count, rows.column.data() + rows.begin[i], rows.value.data() + rows.begin[i],
                       INSERT_VALUES));
  }
  check(MatAssemblyBegin(L, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(L, MAT_FINAL_ASSEMBLY));
}

/// Gives coincident points the values of their representatives. @param by_point one value per point of the source
void copyToCoincident(const DistributedLaplacian& laplacian, Vec by_point) {
  std::vector<std::int64_t> copies, originals;
  for (const auto& [point, representative] : laplacian.coincident) {
    copies.push_back(point);
    originals.push_back(representative);
  }
  setAt(by_point, copies, valuesAt(by_point, originals));
}

}  // namespace

PointSource sourceOf(MPI_Comm comm, const PointsRef& points) {
  return {sumOf(comm, points.rows()), [comm, points](const std::function<void(const PointsRef& batch)>& take) {
            constexpr Eigen::Index most = 32768;
            int processes = 0, own = 0;
            MPI_Comm_size(comm, &processes);
            MPI_Comm_rank(comm, &own);
            for (int process = 0; process < processes; ++process) {
              std::int64_t rows = points.rows();
              MPI_Bcast(&rows, 1, MPI_INT64_T, process, comm);
              for (Eigen::Index first = 0; first < rows; first += most) {
                Points batch(std::min<Eigen::Index>(most, rows - first), 3);
                if (process == own) batch = points.middleRows(first, batch.rows());
                MPI_Bcast(batch.data(), static_cast<int>(batch.size()), MPI_DOUBLE, process, comm);
                take(batch);
              }
            }
          }};
}

DistributedLaplacian distributedLaplacian(MPI_Comm comm, const PointSource& source, const TileOptions& options) {
  checkCount(source.size);
  TileOptions used = options;
  MPI_Comm_rank(comm, &used.processes.number);
  MPI_Comm_size(comm, &used.processes.count);
  used.processes.share = [comm](const std::vector<std::pair<int, int>>& pairs) { return gatherAll(comm, pairs); };
  DistributedLaplacian result;
  BuiltRows built;
  const TileReport own = laplacianByTiles(source, used, [&](const TileRows& rows) { built.add(rows); });
  built.finish();
  result.report = reportOfAll(comm, own);

  numberRows(comm, built, source.size, result);
  std::vector<double> areas;
  built.forEach([&](const TileRows& rows, int row) {
    if (rows.status[row] == PointStatus::active) areas.push_back(rows.M[row]);
  });
  setLocal(result.M.get(), areas);
  NumberedRows rows = numberColumns(built, result);
  if (options.faces) numberFaces(built, result);
  built = {};
  findComponents(comm, rows.begin, rows.column, rows.value, result);
  assemble(comm, rows, result);
  return result;
}

PetscVector valuesByPoint(const DistributedLaplacian& laplacian, Vec values, double absent) {
  PetscVector result;
  check(VecDuplicate(laplacian.row.get(), result.make()));
  check(VecSet(result.get(), absent));
  setAt(result.get(), laplacian.point, localOf(values));
  copyToCoincident(laplacian, result.get());
  return result;
}

PetscVector valuesByRow(const DistributedLaplacian& laplacian, Vec by_point) {
  PetscVector result;
  check(VecDuplicate(laplacian.M.get(), result.make()));
  setLocal(result.get(), valuesAt(by_point, laplacian.point));
  return result;
}

std::vector<PetscInt> rowsOf(const DistributedLaplacian& laplacian, const std::vector<std::int64_t>& points) {
  for (const std::int64_t point : points)
    if (point < 0 || point >= laplacian.report.points)
      throw InvalidInput("rowsOf: point " + std::to_string(point) + ", must be in [0, " +
                         std::to_string(laplacian.report.points) + ")");
  PetscVector rows;
  check(VecDuplicate(laplacian.row.get(), rows.make()));
  check(VecCopy(laplacian.row.get(), rows.get()));
  copyToCoincident(laplacian, rows.get());
  const std::vector<double> found = valuesAt(rows.get(), points);
  return {found.begin(), found.end()};
}

}  // namespace tufted

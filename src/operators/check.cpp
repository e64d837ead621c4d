#include "tufted/check.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "cover/components.h"
#include "operators/check_surface.h"
#include "operators/lower_triangle.h"
#include "operators/promise.h"

namespace tufted {
namespace {

using Eigen::Index;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Part of each diagonal that is added to it, so that a semidefinite matrix is definite in doubles. It hides no error
/// of significance.
constexpr double shift = 1e-12;

bool isActive(const Laplacian& laplacian, Index i) {
  return laplacian.status[i] == PointStatus::active;
}

/// Checks that the columns are stored one after another; otherwise they cannot be iterated.
void checkColumns(const SparseMatrix& L, Promise& storage) {
  if (!L.isCompressed()) return storage.brokenBy("L is not compressed");
  const int* start = L.outerIndexPtr();
  if (start[0] != 0) storage.brokenBy("column 0 starts at ", start[0]);
  for (Index j = 0; j < L.cols(); ++j) {
    if (start[j + 1] < start[j]) storage.brokenBy("column ", j, " starts at ", start[j], " and ends at ", start[j + 1]);
  }
  const Index stored = L.data().size();
  if (start[L.cols()] != stored) storage.brokenBy("the columns end at ", start[L.cols()], " of ", stored, " entries");
}

/// Checks sizes, indices and codes. False if nothing else can be checked.
bool checkShape(const Laplacian& laplacian, std::vector<std::string>& faults) {
  Promise size("size"), storage("storage"), status("status"), boundary("boundary");
  const SparseMatrix& L = laplacian.L;
  const Index n = std::ssize(laplacian.status);
  const auto expect = [&](const char* what, Index found) {
    if (found != n) size.brokenBy(found, " ", what, " for ", n, " points");
  };
  expect("rows of L", L.rows());
  expect("columns of L", L.cols());
  expect("entries of M", laplacian.M.size());
  expect("representatives", std::ssize(laplacian.representative));
  expect("marks of the boundary", std::ssize(laplacian.boundary));
  if (laplacian.kind == Kind::cloud || laplacian.frames.normals.rows() + laplacian.frames.tangents.rows() > 0) {
    expect("normals", laplacian.frames.normals.rows());
    expect("tangents", laplacian.frames.tangents.rows());
  }
  if (laplacian.positions.rows() > 0) expect("positions", laplacian.positions.rows());
  checkColumns(L, storage);
  for (Index j = 0; j < L.cols() && storage.count() == 0; ++j) {
    Index previous = -1;
    for (SparseMatrix::InnerIterator it(L, j); it; ++it) {
      if (it.row() >= L.rows()) storage.brokenBy("column ", j, " has the row ", it.row());
      if (it.row() <= previous) storage.brokenBy("in column ", j, " the row ", it.row(), " follows ", previous);
      previous = it.row();
    }
  }
  for (Index i = 0; i < n; ++i) {
    const int code = static_cast<int>(laplacian.status[i]);
    if (code > static_cast<int>(PointStatus::isolated)) status.brokenBy("that of point ", i, " is ", code);
  }
  for (Index i = 0; i < n && size.count() == 0; ++i) {
    const int code = static_cast<int>(laplacian.boundary[i]);
    if (code > static_cast<int>(Boundary::lost)) boundary.brokenBy("that of point ", i, " is ", code);
    const bool has_surface = isActive(laplacian, i) || laplacian.status[i] == PointStatus::coincident;
    if (code != 0 && !has_surface) boundary.brokenBy("that of point ", i, ", which is not active, is ", code);
  }
  for (const Promise* promise : {&size, &storage, &status, &boundary}) promise->addTo(faults);
  return faults.empty();
}

/// Checks each entry: that it is finite, has the right sign, and is 0 at points that are not active.
void checkEntries(const Laplacian& laplacian, const VectorXd& diagonal, LaplacianCheck& check) {
  const SparseMatrix& L = laplacian.L;
  Promise finite("finite"), sign("off-diagonal sign"), positive("positive diagonal");
  Promise mass("mass"), inactive("inactive is zero");
  for (Index j = 0; j < L.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(L, j); it; ++it) {
      const Index i = it.row();
      const double value = it.value();
      if (!std::isfinite(value)) finite.brokenBy("L(", i, ", ", j, ") = ", value);
      if (i != j && value > 0) sign.brokenBy("L(", i, ", ", j, ") = ", value);
      if (value != 0 && !(isActive(laplacian, i) && isActive(laplacian, j)))
        inactive.brokenBy("L(", i, ", ", j, ") = ", value);
    }
    if (isActive(laplacian, j) && !(diagonal[j] > 0)) positive.brokenBy("L(", j, ", ", j, ") = ", diagonal[j]);
  }
  for (Index i = 0; i < laplacian.M.size(); ++i) {
    const double m = laplacian.M[i];
    if (!std::isfinite(m)) finite.brokenBy("M(", i, ") = ", m);
    if (m < 0) mass.brokenBy("M(", i, ") = ", m);
    check.zero_masses += m == 0 && isActive(laplacian, i) ? 1 : 0;
    if (m != 0 && !isActive(laplacian, i)) inactive.brokenBy("M(", i, ") = ", m);
  }
  check.positive_off_diagonals = sign.count();
  check.not_finite = finite.count();
  check.not_positive_diagonals = positive.count();
  check.negative_masses = mass.count();
  check.inactive_not_zero = inactive.count();
  for (const Promise* promise : {&finite, &sign, &positive, &mass, &inactive}) promise->addTo(check.faults);
}

/// Compares rows with columns. An entry that is stored on one side only counts as zero on the other.
void checkRows(const Laplacian& laplacian, const VectorXd& diagonal, LaplacianCheck& check) {
  const SparseMatrix& L = laplacian.L;
  const SparseMatrix transposed = L.transpose();
  Promise symmetry("symmetry"), row_sum("row sum");
  for (Index j = 0; j < L.cols(); ++j) {
    SparseMatrix::InnerIterator down(L, j), across(transposed, j);
    double off_diagonal = 0;
    Index entries = 0;
    while (down || across) {
      const Index i = std::min(down ? down.row() : L.rows(), across ? across.row() : L.rows());
      double below = 0, beside = 0;  // L(i, j) and L(j, i)
      if (down && down.row() == i) below = down.value(), ++down;
      if (across && across.row() == i) beside = across.value(), ++across, ++entries;
      if (i != j) off_diagonal += beside;
      if (i < j || below == beside) continue;  // each pair is compared once
      symmetry.brokenBy("L(", i, ", ", j, ") = ", below, ", L(", j, ", ", i, ") = ", beside);
      raise(check.symmetry_error, std::abs(below - beside) / std::max(diagonal[i], diagonal[j]));
    }
    if (!isActive(laplacian, j)) continue;
    // The diagonal is the same sum, of terms of one sign, in another order.
    const double error = std::abs(off_diagonal + diagonal[j]) / diagonal[j];
    if (!(error <= static_cast<double>(entries) * epsilon))
      row_sum.brokenBy("row ", j, " sums to ", off_diagonal + diagonal[j], " beside a diagonal of ", diagonal[j]);
    raise(check.row_sum_error, error);
  }
  symmetry.addTo(check.faults);
  row_sum.addTo(check.faults);
}

/// The lower triangle of D^-1/2 L D^-1/2 + shift of the active points, D = diag(L). The scaling changes no sign of a
/// pivot and avoids underflow and overflow.
LongMatrix scaledLower(const Laplacian& laplacian, const VectorXd& diagonal) {
  NumberedPoints active(laplacian.status.size());
  for (int i = 0; i < static_cast<int>(laplacian.status.size()); ++i) {
    if (isActive(laplacian, i)) active.add(i);
  }
  return lowerTriangle(laplacian.L, active, [&](int i, int j, double value) {
    return i == j ? 1 + shift : value / std::sqrt(diagonal[i]) / std::sqrt(diagonal[j]);
  });
}

void checkDefinite(const Laplacian& laplacian, const VectorXd& diagonal, const Workers& workers,
                   LaplacianCheck& check) {
  if (check.not_finite + check.not_positive_diagonals > 0) {
    check.faults.emplace_back("definite: not with entries that are not finite or diagonals that are not positive");
    return;
  }
  Eigen::SimplicialLLT<LongMatrix, Eigen::Lower> factor;
  const LongMatrix lower = scaledLower(laplacian, diagonal);
  if (lower.rows() > 0) {
    workers.report("check", 0.1);
    factor.analyzePattern(lower);
    workers.report("check", 0.2);
    factor.factorize(lower);
  }
  check.definite = lower.rows() == 0 || factor.info() == Eigen::Success;
  if (!check.definite) check.faults.emplace_back("definite: L + 1e-12 diag(L) has no Cholesky factor");
}

void checkCover(const Laplacian& laplacian, const Workers& workers, LaplacianCheck& check) {
  if (!laplacian.hasCover()) {
    check.not_checked.emplace_back("surface: L and M were not compared with the cover, which is not kept");
    return;
  }
  const IntrinsicTriangulation& cover = laplacian.cover();
  workers.report("check", 0.85);
  Promise numbering("cover");
  if (cover.vertices != laplacian.L.cols())
    numbering.brokenBy("it has ", cover.vertices, " vertices for ", laplacian.L.cols(), " points");
  if (cover.size() != 2 * laplacian.report.triangles)
    numbering.brokenBy("it has ", cover.size(), " faces over ", laplacian.report.triangles, " triangles");
  for (std::int64_t f = 0; f < cover.size(); ++f) {
    for (const int corner : cover.faces[f])
      if (corner < 0 || corner >= cover.vertices) numbering.brokenBy("face ", f, " has the corner ", corner);
  }
  numbering.addTo(check.faults);
  check.cover = validate(cover);
  const auto expectNone = [&](std::int64_t count, const char* what) {
    if (count > 0) check.faults.push_back("cover: " + std::to_string(count) + " " + what);
  };
  expectNone(check.cover->not_closed, "sides are glued to nothing");
  expectNone(check.cover->not_edge_manifold, "sides are not the mates of their mates");
  expectNone(check.cover->not_oriented, "sides do not run against their mates");
  expectNone(check.cover->unequal_lengths, "sides have another length than their mates");
  expectNone(check.cover->triangle_inequality, "faces have lengths that no triangle has");
  expectNone(check.cover->not_delaunay, "edges are not Delaunay");
  if (numbering.count() > 0 || check.cover->not_closed > 0) {
    check.not_checked.emplace_back("surface: L and M were not compared with the cover, which is not whole");
    return;
  }
  workers.report("check", 0.9);
  check.surface = checkSurface(laplacian, check.faults);
  if (!check.surface->masses_compared) {
    check.not_checked.emplace_back(
        "mass: M was not compared where the surface ends, since the stars that these masses were measured in are not "
        "kept");
  }
}

/// Checks that coincident points name an earlier point and all others themselves, that frames of active points are
/// orthonormal, and that their positions are finite.
void checkPoints(const Laplacian& laplacian, LaplacianCheck& check) {
  Promise representative("representative"), frame("frame"), position("position");
  const Frames& frames = laplacian.frames;
  for (Index i = 0; i < std::ssize(laplacian.status); ++i) {
    const int same = laplacian.representative[i];
    const bool coincident = laplacian.status[i] == PointStatus::coincident;
    if (coincident ? !(same >= 0 && same < i && laplacian.representative[same] == same) : same != i)
      representative.brokenBy("point ", i, coincident ? " coincides with " : " is no copy but names ", same);
    if (!isActive(laplacian, i)) continue;
    if (laplacian.positions.rows() > 0 && !laplacian.positions.row(i).allFinite())
      position.brokenBy("that of point ", i, " is not finite");
    if (frames.normals.rows() == 0) continue;
    const auto normal = frames.normals.row(i), tangent = frames.tangents.row(i);
    const double error =
        std::max({std::abs(normal.norm() - 1), std::abs(tangent.norm() - 1), std::abs(normal.dot(tangent))});
    if (!(error <= 1e-9)) frame.brokenBy("that of point ", i, " is off by ", error);
  }
  representative.addTo(check.faults);
  frame.addTo(check.faults);
  position.addTo(check.faults);
}

/// Checks the failures that only the report holds, and its counts.
void checkReport(const Laplacian& laplacian, LaplacianCheck& check) {
  const Report& report = laplacian.report;
  Promise failures("failures"), counts("counts");
  if (report.clamped_large > 0)
    failures.brokenBy(report.clamped_large, " negative weights up to ", report.largest_clamped,
                      " of the diagonal were set to 0");
  if (report.flip_failures > 0) failures.brokenBy(report.flip_failures, " edges were given up");
  const auto expect = [&](const char* what, std::int64_t told, std::int64_t found) {
    if (told != found) counts.brokenBy("the report has ", told, " ", what, ", there are ", found);
  };
  expect("points", report.points, std::ssize(laplacian.status));
  expect("active points", report.active, check.status[0]);
  expect("points that are not finite", report.not_finite, check.status[1]);
  expect("coincident points", report.coincident, check.status[2]);
  expect("isolated points", report.isolated, check.status[3]);
  expect("entries of L", report.nonzeros, laplacian.L.nonZeros());
  expect("components", report.components, check.components);
  failures.addTo(check.faults);
  counts.addTo(check.faults);
}

}  // namespace

LaplacianCheck validate(const Laplacian& laplacian, const Progress& progress) {
  const Workers workers(1, progress);
  const auto begin = [&workers](double fraction) { workers.report("check", fraction); };
  LaplacianCheck check;
  begin(0);
  if (!checkShape(laplacian, check.faults)) return check;
  for (const PointStatus status : laplacian.status) ++check.status[static_cast<std::size_t>(status)];
  check.components = countComponents(laplacian.L);
  check.nonzeros_per_row =
      static_cast<double>(laplacian.L.nonZeros()) / static_cast<double>(std::max<std::int64_t>(check.status[0], 1));
  const VectorXd diagonal = laplacian.L.diagonal();
  begin(0.05);
  checkEntries(laplacian, diagonal, check);
  checkRows(laplacian, diagonal, check);
  checkDefinite(laplacian, diagonal, workers, check);
  begin(0.8);
  checkCover(laplacian, workers, check);
  checkPoints(laplacian, check);
  checkReport(laplacian, check);
  return check;
}

}  // namespace tufted

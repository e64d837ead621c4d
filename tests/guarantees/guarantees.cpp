#include "guarantees/guarantees.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace tufted::guarantees {
namespace {

/// Large enough to exceed the rounding of a factorisation, small enough to leave every honest eigenvalue alone.
constexpr double diagonal_shift = 1e-12;

/// Larger matrices are not factorised, which takes longer than their build.
constexpr Eigen::Index most_factorised = 50000;

/// How often one promise is broken, and where first.
class Breach {
 public:
  explicit Breach(std::string name) : name_(std::move(name)) {}

  template <class... Place>
  void at(const Place&... place) {
    if (count_++ == 0) ((first_ << ' ' << place), ...);
  }
  void addTo(std::vector<std::string>& broken) const {
    if (count_ > 0) broken.push_back(name_ + ": " + std::to_string(count_) + ", first" + first_.str());
  }

 private:
  std::string name_;
  std::int64_t count_ = 0;
  std::ostringstream first_;
};

bool isActive(const Laplacian& laplacian, Eigen::Index i) {
  return laplacian.status[i] == PointStatus::active;
}

/// False when the rest cannot be looked at.
bool checkSizes(const Laplacian& laplacian, Eigen::Index n, std::vector<std::string>& broken) {
  Breach size("size");
  const auto expect = [&](const char* what, Eigen::Index found, Eigen::Index wanted) {
    if (found != wanted) size.at(what, "is", found, "instead of", wanted);
  };
  expect("L.rows", laplacian.L.rows(), n);
  expect("L.cols", laplacian.L.cols(), n);
  expect("M", laplacian.M.size(), n);
  expect("status", std::ssize(laplacian.status), n);
  expect("representative", std::ssize(laplacian.representative), n);
  expect("boundary", std::ssize(laplacian.boundary), n);
  if (laplacian.kind == Kind::cloud) {
    expect("normals", laplacian.frames.normals.rows(), n);
    expect("tangents", laplacian.frames.tangents.rows(), n);
  }
  size.addTo(broken);
  return broken.empty();
}

/// False when L cannot be walked along.
bool checkColumns(const SparseMatrix& L, std::vector<std::string>& broken) {
  Breach storage("storage");
  if (!L.isCompressed()) storage.at("not compressed");
  const int *begin = L.outerIndexPtr(), *end = begin + L.cols();
  if (*begin != 0 || *end != L.data().size() || !std::is_sorted(begin, end + 1)) storage.at("columns");
  storage.addTo(broken);
  return broken.empty();
}

void checkEntries(const Laplacian& laplacian, std::vector<std::string>& broken) {
  const SparseMatrix& L = laplacian.L;
  Breach storage("storage"), finite("finite"), sign("off-diagonal sign"), row_sum("row sum");
  Breach diagonal_sign("positive diagonal"), inactive("inactive is zero");
  for (Eigen::Index j = 0; j < L.cols(); ++j) {
    double diagonal = 0, off_diagonal = 0;
    Eigen::Index entries = 0, previous = -1;
    for (SparseMatrix::InnerIterator it(L, j); it; ++it, ++entries) {
      const Eigen::Index i = it.row();
      const double value = it.value();
      if (i <= previous) storage.at("rows not ascending in column", j);
      previous = i;
      if (!std::isfinite(value)) finite.at("L", i, j, value);
      if (value != 0 && !(isActive(laplacian, i) && isActive(laplacian, j))) inactive.at("L", i, j, value);
      if (i != j && value > 0) sign.at("L", i, j, value);
      (i == j ? diagonal : off_diagonal) += value;
    }
    // Two sums of at most `entries` terms of one sign in different orders: each is off by no more than
    // entries - 1 roundings of half an epsilon of the whole.
    const double rounding = static_cast<double>(entries) * std::numeric_limits<double>::epsilon() * diagonal;
    if (!(std::abs(diagonal + off_diagonal) <= rounding)) {
      row_sum.at("row", j, "sums to", diagonal + off_diagonal, "beside a diagonal of", diagonal);
    }
    if (isActive(laplacian, j) && !(diagonal > 0)) diagonal_sign.at("L", j, j, diagonal);
  }

  Breach boundary("boundary");
  for (std::size_t i = 0; i < laplacian.boundary.size(); ++i) {
    const int tag = static_cast<int>(laplacian.boundary[i]);
    const PointStatus status = laplacian.status[i];
    const bool has_surface = status == PointStatus::active || status == PointStatus::coincident;
    if (tag > (has_surface ? 3 : 0)) boundary.at("tag", i, tag);
  }
  Breach mass("mass");
  for (Eigen::Index i = 0; i < laplacian.M.size(); ++i) {
    const double m = laplacian.M[i];
    if (!std::isfinite(m)) finite.at("M", i, m);
    if (m < 0) mass.at("M", i, m);
    if (m != 0 && !isActive(laplacian, i)) inactive.at("M", i, m);
  }
  for (const Breach* breach : {&storage, &finite, &sign, &row_sum, &diagonal_sign, &inactive, &mass, &boundary}) {
    breach->addTo(broken);
  }
}

void checkSymmetry(const SparseMatrix& L, std::vector<std::string>& broken) {
  Breach symmetry("symmetry");
  const SparseMatrix transposed = L.transpose();
  for (Eigen::Index j = 0; j < L.cols(); ++j) {
    SparseMatrix::InnerIterator a(L, j), b(transposed, j);
    for (; a && b; ++a, ++b) {
      if (a.row() == b.row() && a.value() == b.value()) continue;
      symmetry.at("in column", j, "row", a.row(), "holds", a.value(), "and in row", j, "column", b.row(), b.value());
      break;
    }
    if (static_cast<bool>(a) != static_cast<bool>(b)) symmetry.at("in column", j);
  }
  symmetry.addTo(broken);
}

/// L + diagonal_shift diag(L) of the active points has a Cholesky factorisation, so L is positive semidefinite up to
/// rounding. Of large matrices the other checks say so: a symmetric L whose rows sum to zero and whose entries beside
/// the diagonal are not positive has x' L x = 1/2 sum_ij |L_ij| (x_i - x_j)^2.
void checkDefinite(const Laplacian& laplacian, std::vector<std::string>& broken) {
  const SparseMatrix& L = laplacian.L;
  if (L.cols() > most_factorised) return;
  std::vector<int> number(laplacian.status.size(), -1);
  int active = 0;
  for (Eigen::Index i = 0; i < L.cols(); ++i) {
    if (isActive(laplacian, i)) number[i] = active++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(L.nonZeros() / 2 + active));
  for (Eigen::Index j = 0; j < L.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(L, j); it; ++it) {
      if (it.row() < j || number[j] < 0 || number[it.row()] < 0) continue;
      entries.emplace_back(number[it.row()], number[j], it.row() == j ? it.value() * (1 + diagonal_shift) : it.value());
    }
  }
  if (active == 0) return;
  SparseMatrix lower(active, active);
  lower.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factor(lower);
  if (factor.info() != Eigen::Success) {
    broken.push_back("definite: the factorisation failed");
    return;
  }
  Breach definite("definite");
  const VectorXd pivots = factor.vectorD();
  for (Eigen::Index i = 0; i < pivots.size(); ++i) {
    if (!(pivots[i] > 0)) definite.at("pivot", pivots[i]);
  }
  definite.addTo(broken);
}

void checkCover(const Laplacian& laplacian, std::vector<std::string>& broken) {
  Breach breach("cover");
  const IntrinsicTriangulation& cover = laplacian.cover();
  if (cover.vertices != laplacian.L.cols()) breach.at("vertices", cover.vertices);
  for (const auto& face : cover.faces) {
    for (const int corner : face) {
      if (corner < 0 || corner >= cover.vertices) breach.at("corner", corner);
    }
  }
  if (cover.size() != 2 * laplacian.report.triangles) breach.at("faces", cover.size());
  const CoverCheck check = validate(cover);
  if (!check.ok()) {
    breach.at("not closed", check.not_closed, "not edge-manifold", check.not_edge_manifold, "not oriented",
              check.not_oriented, "unequal lengths", check.unequal_lengths, "triangle inequality",
              check.triangle_inequality, "not Delaunay", check.not_delaunay, "smallest cotan sum",
              check.smallest_cotan_sum);
  }
  breach.addTo(broken);
}

void checkReport(const Laplacian& laplacian, Eigen::Index n, std::vector<std::string>& broken) {
  const Report& report = laplacian.report;
  Breach failures("failures"), counts("counts");
  if (report.clamped_large != 0) {
    failures.at("clamped_large", report.clamped_large, "up to", report.largest_clamped, "of the diagonal");
  }
  if (report.flip_failures != 0) failures.at("flip_failures", report.flip_failures, "after", report.flips, "flips");

  std::array<std::int64_t, 4> found = {};
  for (const PointStatus status : laplacian.status) ++found[static_cast<std::size_t>(status)];
  const std::array<std::int64_t, 4> told = {report.active, report.not_finite, report.coincident, report.isolated};
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] != told[i]) counts.at("status", i, "counted", told[i], "found", found[i]);
  }
  if (report.points != n) counts.at("points", report.points, "instead of", n);
  if (std::accumulate(told.begin(), told.end(), std::int64_t{0}) != report.points) counts.at("do not add up");
  if (report.nonzeros != laplacian.L.nonZeros()) counts.at("nonzeros", report.nonzeros);
  if (report.components > report.active || (report.components > 0) != (report.active > 0)) {
    counts.at("components", report.components);
  }
  failures.addTo(broken);
  counts.addTo(broken);
}

/// Whether two points coincide once they are scaled by the spread, which loses what is below the smallest double.
bool areEqualScaled(const Points& points, const Laplacian& laplacian, int a, int b) {
  double largest = 1;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (laplacian.status[i] != PointStatus::not_finite)
      largest = std::max(largest, points.row(i).cwiseAbs().maxCoeff());
  }
  const double difference = (points.row(a) - points.row(b)).cwiseAbs().maxCoeff();
  return difference <= 2 * std::numeric_limits<double>::min() * largest;
}

/// Equal points of a cloud name the lowest of them; all other points, and all vertices of meshes, name themselves.
void checkStatus(const Laplacian& laplacian, const Points& points, std::vector<std::string>& broken) {
  const int n = static_cast<int>(points.rows());
  Breach status("status"), representative("representative");
  std::vector<int> expected(n);
  std::iota(expected.begin(), expected.end(), 0);
  if (laplacian.kind == Kind::cloud) {
    std::vector<int> order;
    for (int i = 0; i < n; ++i) {
      if (laplacian.status[i] != PointStatus::not_finite && points.row(i).allFinite()) order.push_back(i);
    }
    const auto place = [&](int i) { return std::array{points(i, 0), points(i, 1), points(i, 2)}; };
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      const auto at_a = place(a), at_b = place(b);
      return at_a < at_b || (at_a == at_b && a < b);
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (place(order[i]) == place(order[i - 1])) expected[order[i]] = expected[order[i - 1]];
    }
  }
  for (int i = 0; i < n; ++i) {
    const int same = laplacian.representative[i];
    if (same != expected[i] && !(same >= 0 && same < i && laplacian.representative[same] == same &&
                                 areEqualScaled(points, laplacian, i, same))) {
      representative.at("of", i, "is", same, "instead of", expected[i]);
    }
    if (!points.row(i).allFinite() && laplacian.status[i] != PointStatus::not_finite) status.at("of", i, "not finite");
    if ((same != i) != (laplacian.status[i] == PointStatus::coincident)) status.at("of", i, "coincident or not");
  }
  status.addTo(broken);
  representative.addTo(broken);
}

void checkFrames(const Laplacian& laplacian, std::vector<std::string>& broken) {
  Breach frame("frame");
  const Frames& frames = laplacian.frames;
  for (Eigen::Index i = 0; i < frames.normals.rows(); ++i) {
    if (!isActive(laplacian, i)) continue;
    const auto normal = frames.normals.row(i), tangent = frames.tangents.row(i);
    const double error =
        std::max({std::abs(normal.norm() - 1), std::abs(tangent.norm() - 1), std::abs(normal.dot(tangent))});
    if (!(error < 1e-9)) frame.at("of", i, "is off by", error);
  }
  frame.addTo(broken);
}

}  // namespace

std::vector<std::string> brokenGuarantees(const Laplacian& laplacian, const Points& points) {
  std::vector<std::string> broken;
  if (!checkSizes(laplacian, points.rows(), broken) || !checkColumns(laplacian.L, broken)) return broken;
  checkEntries(laplacian, broken);
  checkSymmetry(laplacian.L, broken);
  checkDefinite(laplacian, broken);
  checkCover(laplacian, broken);
  checkReport(laplacian, points.rows(), broken);
  checkStatus(laplacian, points, broken);
  checkFrames(laplacian, broken);
  return broken;
}

}  // namespace tufted::guarantees

// Smoothed aggregation after P. Vanek, J. Mandel, M. Brezina, "Algebraic multigrid by smoothed aggregation for second
// and fourth order elliptic problems" (1996). It is written here because the multigrid libraries in Debian (hypre,
// PETSc, Trilinos) are built for MPI and would make every program that uses tufted an MPI program.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/greater.h"
#include "algorithms/linear_backend.h"
#include "cover/components.h"

namespace tufted {
namespace {

/// Coarsening ends at a level of at most this many rows.
constexpr int coarsest_size = 500;
/// Maximum number of levels.
constexpr int most_levels = 25;
/// Neighbours are strong if their weight exceeds this part of the geometric mean of the two diagonals; it is halved per
/// level (Vanek et al.).
constexpr double strong = 0.08;
/// Weak entries are added to a diagonal only if this part of it remains; it might become negative otherwise.
constexpr double least_lumped = 0.1;
/// Coarsening ends if the next level would have more than this part of the rows.
constexpr double least_shrinking = 0.9;
/// A last level of at most this many rows is factorised, a larger one only smoothed.
constexpr int largest_direct = 20 * coarsest_size;
/// Group of a row without strong neighbours.
constexpr int alone = -1;

/// The matrix with weak off-diagonals added to the diagonal, so that its product with constants stays the same.
SparseMatrix filtered(const SparseMatrix& A, double threshold) {
  const VectorXd diagonal = A.diagonal();
  SparseMatrix result(A.rows(), A.cols());
  result.reserve(A.nonZeros());
  for (int j = 0; j < A.cols(); ++j) {
    result.startVec(j);
    double lumped = diagonal[j];
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      const int i = static_cast<int>(entry.row());
      const bool keep = i != j && std::abs(entry.value()) > threshold * std::sqrt(diagonal[i] * diagonal[j]);
      if (!keep && i != j) lumped += entry.value();
      if (keep || i == j) result.insertBack(i, j) = entry.value();
    }
    result.coeffRef(j, j) = lumped > least_lumped * diagonal[j] ? lumped : diagonal[j];
  }
  result.finalize();
  return result;
}

/// The group of every row: neighbourhoods of strong neighbours, `alone` for rows without any.
/// @param[out] count number of groups
std::vector<int> aggregate(const SparseMatrix& A, int& count) {
  const int n = static_cast<int>(A.cols());
  // A row that is in no group yet.
  constexpr int open = -2;
  std::vector<int> group(n, open);
  const auto forNeighbors = [&](int j, const auto& visit) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry)
      if (entry.row() != j) visit(static_cast<int>(entry.row()), std::abs(entry.value()));
  };
  count = 0;
  for (int j = 0; j < n; ++j) {  // whole neighbourhoods without a row in a group
    bool untouched = group[j] == open, neighbors = false;
    forNeighbors(j, [&](int i, double) { neighbors = true, untouched = untouched && group[i] == open; });
    if (!neighbors) group[j] = alone;
    if (!neighbors || !untouched) continue;
    group[j] = count;
    forNeighbors(j, [&](int i, double) { group[i] = count; });
    ++count;
  }
  const std::vector<int> before = group;
  for (int j = 0; j < n; ++j) {  // other rows join their strongest neighbour's group
    if (group[j] != open) continue;
    double strongest = 0;
    forNeighbors(j, [&](int i, double weight) {
      if (before[i] >= 0 && weight > strongest) strongest = weight, group[j] = before[i];
    });
  }
  for (int j = 0; j < n; ++j) {  // the remaining rows form groups among themselves
    if (group[j] != open) continue;
    group[j] = count;
    forNeighbors(j, [&](int i, double) {
      if (group[i] == open) group[i] = count;
    });
    ++count;
  }
  return group;
}

/// Constants per group, smoothed by a Jacobi step: I - 4/3 / rho D^-1 A with Gershgorin's bound of rho.
SparseMatrix prolongation(const SparseMatrix& A, const std::vector<int>& group, int count) {
  SparseMatrix piecewise(A.rows(), count);
  std::vector<Eigen::Triplet<double>> ones;
  for (int i = 0; i < static_cast<int>(group.size()); ++i)
    if (group[i] != alone) ones.emplace_back(i, group[i], 1.0);
  piecewise.setFromTriplets(ones.begin(), ones.end());
  const VectorXd inverse = A.diagonal().cwiseInverse();
  double rho = 0;
  for (int j = 0; j < A.cols(); ++j) {
    double sum = 0;
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) sum += std::abs(entry.value());
    rho = std::max(rho, sum * inverse[j]);
  }
  SparseMatrix smoothed = A * piecewise;
  // No product with an expression's asDiagonal(), which would copy the expression once per column.
  const VectorXd factor = inverse * (-4.0 / 3 / rho);
  for (int j = 0; j < smoothed.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(smoothed, j); entry; ++entry) entry.valueRef() *= factor[entry.row()];
  return piecewise + smoothed;
}

struct GridLevel {
  SparseMatrix A;
  SparseMatrix P;  ///< from the next, coarser level; none on the coarsest
};

class Multigrid : public LinearBackend {
 public:
  Multigrid(const MultigridOptions& options) : options_(options) {}

  /// Builds the levels. False if a diagonal entry is not positive.
  bool build(SparseMatrix A, const Workers& workers) {
    part_ = componentsOf(A);
    parts_ = part_.empty() ? 0 : *std::max_element(part_.begin(), part_.end()) + 1;
    while (true) {
      workers.report("coarsen", static_cast<double>(levels_.size()) / most_levels);
      if (!(A.diagonal().minCoeff() > 0)) return false;
      GridLevel& level = levels_.emplace_back();
      level.A = std::move(A);
      if (level.A.rows() <= coarsest_size || levels_.size() == most_levels) break;
      const SparseMatrix strong_part = filtered(level.A, strong * std::pow(0.5, double(levels_.size() - 1)));
      int count = 0;
      const std::vector<int> group = aggregate(strong_part, count);
      if (count == 0 || count > least_shrinking * static_cast<double>(level.A.rows())) break;
      level.P = prolongation(strong_part, group, count);
      const SparseMatrix image = level.A * level.P, restriction = level.P.transpose();
      A = restriction * image;
    }
    const SparseMatrix& last = levels_.back().A;
    direct_ = last.rows() <= largest_direct;
    if (direct_) coarsest_.compute(last);
    if (direct_ && coarsest_.info() != Eigen::Success) return false;
    for (const GridLevel& level : levels_) {
      nonzeros += level.A.nonZeros() + level.P.nonZeros();
      bytes += static_cast<std::size_t>(level.A.nonZeros() + level.P.nonZeros()) * (sizeof(double) + sizeof(int));
    }
    name = "multigrid (" + std::to_string(levels_.size()) + " levels)";
    return true;
  }

  int solve(Eigen::Ref<Eigen::MatrixXd> x, const Tick& tick) const override {
    int most = 0;
    const auto columns = static_cast<double>(x.cols());
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      // Scales each part to the same size, so that norms neither overflow nor underflow.
      VectorXd scale = VectorXd::Zero(parts_);
      for (Eigen::Index i = 0; i < x.rows(); ++i) scale[part_[i]] = std::max(scale[part_[i]], std::abs(x(i, c)));
      if (scale.isZero(0)) continue;
      scale = (scale.array() > 0).select(scale, 1);
      VectorXd b(x.rows()), solution = VectorXd::Zero(x.rows());
      for (Eigen::Index i = 0; i < x.rows(); ++i) b[i] = x(i, c) / scale[part_[i]];
      const auto tick_here = [&](double done) { tick((static_cast<double>(c) + done) / columns); };
      most = std::max(most, iterate(b, solution, tick_here));
      for (Eigen::Index i = 0; i < x.rows(); ++i) x(i, c) = scale[part_[i]] * solution[i];
    }
    return most;
  }

 private:
  /// The norm of a vector on each part.
  VectorXd norms(const VectorXd& values) const {
    if (parts_ == 1) return VectorXd::Constant(1, values.norm());
    VectorXd squares = VectorXd::Zero(parts_);
    for (Eigen::Index i = 0; i < values.size(); ++i) squares[part_[i]] += values[i] * values[i];
    return squares.cwiseSqrt();
  }

  /// Conjugate gradients, until the tolerance holds on every part of the matrix.
  int iterate(const VectorXd& b, VectorXd& x, const Tick& tick) const {
    const VectorXd size = norms(b);
    const auto residual = [&](const VectorXd& r) {
      const VectorXd left = norms(r);
      double most = 0;
      for (int part = 0; part < parts_; ++part)
        if (size[part] > 0) most = greater(most, left[part] / size[part]);
      return most;
    };
    VectorXd r = b, p, image;
    VectorXd z = cycle(0, r);
    p = z;
    double rz = r.dot(z), done = 0;
    for (int step = 1; step <= options_.max_iterations; ++step) {
      image.noalias() = levels_[0].A * p;
      const double alpha = rz / p.dot(image);
      x += alpha * p;
      r -= alpha * image;
      const double left = residual(r);
      if (left <= options_.tolerance) return step;
      done = std::max(done, std::log(left) / std::log(options_.tolerance));
      tick(std::min(done, 1.0));
      z = cycle(0, r);
      const double next = r.dot(z);
      p = z + (next / rz) * p;
      rz = next;
    }
    throw NotConverged{options_.max_iterations, residual(r)};
  }

  /// One V-cycle: Gauss-Seidel forwards, the coarser levels, Gauss-Seidel backwards. It is symmetric, as conjugate
  /// gradients need it.
  VectorXd cycle(std::size_t at, const VectorXd& b) const {
    const SparseMatrix& A = levels_[at].A;
    if (at + 1 == levels_.size() && direct_) return coarsest_.solve(b);
    VectorXd x = VectorXd::Zero(b.size());
    const int n = static_cast<int>(A.cols());
    for (int j = 0; j < n; ++j) relax(A, j, b, x);
    if (at + 1 < levels_.size()) {
      const SparseMatrix& P = levels_[at].P;
      const VectorXd residual = b - A * x;
      x += P * cycle(at + 1, P.transpose() * residual);
    }
    for (int j = n - 1; j >= 0; --j) relax(A, j, b, x);
    return x;
  }

  /// Relaxes row j (Gauss-Seidel), which is read as column j of the symmetric matrix.
  static void relax(const SparseMatrix& A, int j, const VectorXd& b, VectorXd& x) {
    double sum = b[j], diagonal = 1;
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      if (entry.row() == j)
        diagonal = entry.value();
      else
        sum -= entry.value() * x[entry.row()];
    }
    x[j] = sum / diagonal;
  }

  MultigridOptions options_;
  std::vector<GridLevel> levels_;
  std::vector<int> part_;  ///< connected part of the matrix that each row belongs to
  int parts_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> coarsest_;
  bool direct_ = false;
};

}  // namespace

std::unique_ptr<LinearBackend> makeMultigrid(const LongMatrix& lower, const MultigridOptions& options,
                                             const Workers& workers) {
  auto multigrid = std::make_unique<Multigrid>(options);
  SparseMatrix A(LongMatrix(lower.selfadjointView<Eigen::Lower>()));
  if (!multigrid->build(std::move(A), workers)) return nullptr;
  return multigrid;
}

}  // namespace tufted

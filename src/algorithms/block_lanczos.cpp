#include "algorithms/block_lanczos.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "algorithms/tall_matrix.h"
#include "base/dense_solvers.h"
#include "base/symmetric_eigen.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Number of right sides that share one pass over the factor: a solve takes 6 ms for each of them, and 14 ms for a
/// single one.
constexpr Index lanczos_block = 8;
/// Steps in which a random block is searched for missed eigenvalues if the factor cannot count them.
constexpr int search_steps = 8;
/// Steps in which a random block is searched for missed eigenvalues if the count says that one is missing.
constexpr int longest_search = 40;
/// A column is rounding if less of it than this part of the largest eigenvalue remains after orthogonalisation.
constexpr double least_remainder = 1e-15;
/// Products with A are uncertain by this part of the largest eigenvalue.
constexpr double product_rounding = 1e-13;
/// An eigenvalue this many times the next one converges at once, and its rounding spoils the digits of the others.
constexpr double dominance = 1e4;
/// If no eigenvalue changes by more than this part of itself, a random block has shown nothing new.
constexpr double settled = 1e-8;
/// If less than `least_left` of a column remains after orthogonalisation, the Cholesky factor of the Gram matrix is not
/// used. If more than `mostly_left` remains, one pass is enough: with 0.01 equal eigenvalues were off by 1e-10.
constexpr double least_left = 1e-5, mostly_left = 0.1;

/// A restart keeps more than the usual third of its room if the wanted pairs then converge this many times as fast, as
/// where they end within a cluster of eigenvalues.
constexpr double clearly_faster = 3;

class BlockLanczos {
 public:
  BlockLanczos(const LanczosProblem& problem, const LanczosOptions& options, const Workers& workers)
      : problem_(problem), options_(options), workers_(workers), quiet_(workers.count(), silent_) {
    // Room for 1.5 times the wanted vectors, or for six steps beyond them if that is more.
    const Index room = problem.wanted + std::max<Index>(problem.wanted / 2, 6 * lanczos_block);
    most_ = std::min(problem.dimension, (room + lanczos_block - 1) / lanczos_block * lanczos_block);
    basis_.resize(problem.mass.size(), most_ + lanczos_block);
    T_ = MatrixXd::Zero(most_ + lanczos_block, most_ + lanczos_block);
  }

  LanczosResult run() {
    addRandom();
    LanczosResult result;
    bool found = false;
    while (!found && result.iterations < options_.max_iterations) {
      workers_.report("eigenpairs", found_);
      const bool exhausted = !step();
      ++result.iterations;
      const bool full = size_ + fresh_ > most_;
      const bool cheap = size_ * size_ < problem_.mass.size();  // decomposing costs less than the products of a step
      if (!exhausted && !full && !cheap && result.iterations % 8 != 0) continue;
      decompose();
      if (exhausted) {
        found = size_ >= problem_.wanted && isWhole();
        break;
      }
      if (lockLeading()) continue;
      found = countConverged() == problem_.wanted && isComplete(result.iterations);
      // isComplete() may have restarted already.
      if (!found && size_ + fresh_ > most_) restart(countToKeep());
    }
    if (found) finish(result);
    return result;
  }

 private:
  /// Fills in the pairs and measures their residuals; those computed from T do not contain the rounding of the basis.
  void finish(LanczosResult& result) {
    result.values = values_.head(problem_.wanted);
    multiplyInPlace(basis_.leftCols(size_), vectors_.leftCols(problem_.wanted), quiet_);
    basis_.conservativeResize(Eigen::NoChange, problem_.wanted);
    result.vectors = std::move(basis_);
    result.images = problem_.apply(result.vectors);
    result.residuals.resize(problem_.wanted);
    result.converged = true;
    for (Index i = 0; i < problem_.wanted; ++i) {
      const double theta = result.values[i];
      const VectorXd rest = result.images.col(i) - theta * result.vectors.col(i);
      result.residuals[i] = std::sqrt(rest.cwiseProduct(problem_.mass).dot(rest)) / theta;
      if (!(theta > 0 && result.residuals[i] <= options_.tolerance + product_rounding * result.values[0] / theta))
        result.converged = false;
    }
  }

  /// Whether no eigenvalue is known to be missing, once the basis spans the whole space.
  bool isWhole() const { return !problem_.is_complete || problem_.is_complete(values_.head(problem_.wanted)) != false; }

  /// Whether no eigenvalue was missed. If unknown, starts or continues a search from a random block.
  bool isComplete(int iteration) {
    const VectorXd now = values_.head(problem_.wanted);
    const bool searching = before_.size() > 0;
    const bool changed = !searching || ((now - before_).cwiseAbs().array() > settled * before_.array()).any();
    if (!changed) return iteration - search_from_ >= (is_missing_ ? longest_search : search_steps);
    const std::optional<bool> complete = problem_.is_complete ? problem_.is_complete(now) : std::nullopt;
    if (complete == true) return true;
    is_missing_ = complete == false;
    before_ = now;
    search_from_ = iteration;
    // The random block replaces the fresh one, which the converged pairs no longer need.
    restart(problem_.wanted);
    return !addRandom();
  }

  auto fresh() { return basis_.middleCols(size_, fresh_); }

  /// Applies A to the fresh block, adds the inner products to T, and makes the next block from the part outside of the
  /// basis. False if the basis spans the whole space.
  bool step() {
    if (fresh_ == 0) return false;
    MatrixXd image = problem_.apply(fresh());
    const Index known = size_ + fresh_;
    MatrixXd products = innerProducts(basis_.leftCols(known), problem_.mass, image, quiet_);
    T_.block(0, size_, known, fresh_) = products;
    T_.block(size_, 0, fresh_, known) = products.transpose();
    subtractProduct(image, basis_.leftCols(known), products, quiet_);
    size_ = known;
    const MatrixXd rest = image;
    const Index room = std::min<Index>(lanczos_block, problem_.dimension - size_);
    scale_ = std::max(scale_, products.bottomRows(products.cols()).diagonal().maxCoeff());
    fresh_ = orthonormalize(image, room, least_remainder * scale_);
    if (fresh_ == 0) return addRandom();
    coupling_ = innerProducts(fresh(), problem_.mass, rest, quiet_);
    return true;
  }

  /// Adds a random block to the basis. False if the basis spans the whole space.
  bool addRandom() {
    const Index room = std::min<Index>(lanczos_block, problem_.dimension - size_);
    fresh_ = 0;
    coupling_.resize(0, 0);
    if (room == 0) return false;
    MatrixXd block(problem_.mass.size(), room);
    for (Index c = 0; c < room; ++c) {
      for (Index i = 0; i < block.rows(); ++i) {
        const double uniform = static_cast<double>(random_() >> 11) * 0x1p-52 - 1;  // in [-1, 1)
        block(i, c) = problem_.mass[i] > 0 ? uniform / std::sqrt(problem_.mass[i]) : 0;
      }
    }
    problem_.deflate(block);
    const double least = least_remainder * std::sqrt(innerProductsOfColumns(block).maxCoeff());
    fresh_ = orthonormalize(block, room, least);
    return fresh_ > 0;
  }

  /// Appends at most `room` orthonormal columns to the basis that span the part of `block` outside of it. Columns of
  /// which at most `least` remains are dropped.
  Index orthonormalize(const MatrixXd& block, Index room, double least) {
    if (block.cols() <= room) {
      basis_.middleCols(size_, block.cols()) = block;
      if (orthonormalizeTogether(block.cols(), least)) return block.cols();
    }
    return orthonormalizeOneByOne(block, room, least);
  }

  /// Orthonormalises the `count` columns behind the basis by the Cholesky factor of their Gram matrix, repeatedly if
  /// much was subtracted. False if they are nearly dependent.
  bool orthonormalizeTogether(Index count, double least) {
    auto all = basis_.leftCols(size_ + count);
    for (int pass = 0; pass < 4; ++pass) {
      // Rounding also adds parts of the null space of A, which grow if much of a column is subtracted.
      problem_.deflate(all.rightCols(count));
      const MatrixXd products = innerProducts(all, problem_.mass, all.rightCols(count), quiet_);
      const auto known = products.topRows(size_), own = products.bottomRows(count);
      const DenseCholesky gram(own - known.transpose() * known);
      if (!gram.isDefinite()) return false;
      const VectorXd left = gram.diagonal();
      const double least_share = (left.array() / own.diagonal().array().sqrt()).minCoeff();
      if (!(left.minCoeff() > least) || !(least_share > least_left)) return false;
      least = 0;  // the columns have length 1 from now on
      MatrixXd combination(size_ + count, count);
      combination.bottomRows(count) = gram.inverseOfUpper();
      combination.topRows(size_) = -known * combination.bottomRows(count);
      multiplyInto(all, combination, all.rightCols(count), quiet_);
      if (least_share > mostly_left) return true;
    }
    return false;
  }

  Index orthonormalizeOneByOne(const MatrixXd& block, Index room, double least) {
    Index count = 0;
    for (Index c = 0; c < block.cols() && count < room; ++c) {
      VectorXd column = block.col(c);
      const auto known = basis_.leftCols(size_ + count);
      double norm = 0;
      for (int pass = 0; pass < 4; ++pass) {
        problem_.deflate(column);
        subtractProduct(column, known, innerProducts(known, problem_.mass, column, quiet_), quiet_);
        norm = std::sqrt(column.cwiseProduct(problem_.mass).dot(column));
        if (!(norm > (pass == 0 ? least : 0.5))) break;
        column /= norm;
      }
      // A column that shrinks again after it was made orthogonal was rounding.
      if (norm > 0.5) basis_.col(size_ + count++) = column;
    }
    return count;
  }

  VectorXd innerProductsOfColumns(const MatrixXd& block) const {
    VectorXd result(block.cols());
    for (Index c = 0; c < block.cols(); ++c) result[c] = block.col(c).cwiseProduct(problem_.mass).dot(block.col(c));
    return result;
  }

  /// Eigenpairs of the projected operator, largest first.
  void decompose() {
    const Index rest = size_ - locked_;
    values_ = T_.diagonal().head(size_);
    vectors_ = MatrixXd::Identity(size_, size_);
    if (rest == 0) return;
    const auto solver = symmetricEigen(MatrixXd(T_.block(locked_, locked_, rest, rest)));
    values_.tail(rest) = solver.eigenvalues().reverse();
    vectors_.bottomRightCorner(rest, rest) = solver.eigenvectors().rowwise().reverse();
  }

  /// Locks the pairs whose eigenvalues are far above all others and restarts from a random block, as their rounding is
  /// in all other vectors. False if there are none.
  bool lockLeading() {
    Index leading = locked_;
    for (Index i = locked_; i + 1 < std::min(size_, problem_.wanted); ++i)
      if (values_[i] > dominance * values_[i + 1]) leading = i + 1;
    if (leading == locked_) return false;
    const VectorXd rest = residuals(leading);
    for (Index i = locked_; i < leading; ++i)
      if (!(rest[i] <= product_rounding * values_[i])) return false;
    restart(leading);
    locked_ = leading;
    scale_ = 0;
    addRandom();
    return true;
  }

  /// |A x - theta x| of the first `count` pairs: the coupling times the last rows of their vectors, or the size of
  /// rounding if there is no coupling.
  VectorXd residuals(Index count) const {
    if (coupling_.cols() == 0) return VectorXd::Constant(count, least_remainder * scale_);
    return (coupling_ * vectors_.bottomRows(coupling_.cols()).leftCols(count)).colwise().norm();
  }

  /// How many of the wanted pairs have a small residual.
  Index countConverged() {
    if (size_ < problem_.wanted) return 0;
    const VectorXd rest = residuals(problem_.wanted);
    Index count = 0;
    for (Index i = 0; i < problem_.wanted; ++i) count += rest[i] <= options_.tolerance * values_[i] ? 1 : 0;
    found_ = static_cast<double>(count) / static_cast<double>(problem_.wanted);
    return count;
  }

  /// How many vectors a restart keeps, so that the wanted ones converge fastest. The error of the last wanted vector
  /// falls exponentially in the steps until the next restart times the root of its relative gap to the first eigenvalue
  /// that is not kept; this product is maximised. For evenly falling eigenvalues a third of the room is kept; if the
  /// wanted ones end within a cluster, the whole cluster.
  Index countToKeep() const {
    const Index wanted = problem_.wanted;
    const auto steps = [&](Index keep) { return static_cast<double>(most_ - keep); };
    const auto worth = [&](Index keep) {
      return steps(keep) * std::sqrt(std::max(0.0, values_[wanted - 1] / values_[keep] - 1));
    };
    const Index usual = wanted + (most_ - wanted) / 3;
    Index best = usual;
    for (Index keep = usual + 1; keep <= most_ - lanczos_block && keep < size_ && values_[keep] > 0; ++keep)
      if (worth(keep) > worth(best)) best = keep;
    return worth(best) > clearly_faster * worth(usual) ? best : usual;
  }

  /// Reduces the basis to its first `keep` Ritz vectors, and keeps the fresh block behind them.
  void restart(Index keep) {
    const MatrixXd next = fresh();
    multiplyInPlace(basis_.leftCols(size_), vectors_.leftCols(keep), quiet_);
    T_.setZero();
    T_.diagonal().head(keep) = values_.head(keep);
    vectors_ = MatrixXd::Identity(keep, keep);  // they are the basis now
    size_ = keep;
    fresh() = next;
  }

  const LanczosProblem& problem_;
  const LanczosOptions& options_;
  const Workers& workers_;
  const Progress silent_;
  const Workers quiet_;  ///< products are not reported one by one
  std::mt19937_64 random_{1};
  Index most_ = 0;  ///< columns that the basis may have
  MatrixXd basis_;  ///< mass-orthonormal: `size_` columns that A has been applied to, then `fresh_` others
  Index size_ = 0, fresh_ = 0;
  Index locked_ = 0;   ///< number of leading columns of the basis that are final eigenvectors
  MatrixXd T_;         ///< basis^T diag(mass) A basis
  MatrixXd coupling_;  ///< the block of A that maps the last block to the fresh one
  VectorXd values_;
  MatrixXd vectors_;
  VectorXd before_;          ///< eigenvalues that had converged when the search for missed ones began
  int search_from_ = 0;      ///< iteration at which the search for missed eigenvalues began
  bool is_missing_ = false;  ///< whether an eigenvalue is known to be missing
  double scale_ = 0;         ///< about the largest eigenvalue that is not locked
  double found_ = 0;         ///< share of the wanted pairs that have converged
};

}  // namespace

LanczosResult largestEigenpairs(const LanczosProblem& problem, const LanczosOptions& options, const Workers& workers) {
  return BlockLanczos(problem, options, workers).run();
}

}  // namespace tufted

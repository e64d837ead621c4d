// Spectral conformal parameterisation (Mullen, Tong, Alliez, Desbrun 2008).
#include "algorithms/conformal_map.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <string>

#include "algorithms/chart_metric.h"
#include "algorithms/linear_system.h"
#include "base/number_text.h"
#include "base/symmetric_eigen.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

/// L_C is singular, so s B is added, where s is this times the number of points over that of the rim. It must stay
/// above the rounding of a factor, and far below the second eigenvalue, which is about the squared length of an edge.
constexpr double least_shift = 1e-13;
/// While the matrix is not positive definite, the shift grows by this factor.
constexpr double shift_growth = 100;
/// Maximum number of shifts that are tried.
constexpr int most_shifts = 4;
/// Eigenvectors that are iterated together. Only the first is used; with others, eigenvalues nearly equal to its own do
/// not slow it down.
constexpr int block_columns = 6;
/// Iterations end when (L_C + s B)^-1 B takes the vector to a complex multiple, a similar map, up to this relative
/// error. The rounding of the factor is about 1e-15 over the gap to the next eigenvalue.
constexpr double most_residual = 1e-7;
/// If iterations no longer help, a residual up to this part of the size of the map is accepted and reported: the
/// rounding of the large weights of thin triangles may exceed `most_residual`.
constexpr double most_rounding = 1e-4;
/// Iterations no longer help if so many of them have not halved the least residual.
constexpr int most_idle = 20;
/// Maximum number of iterations for the eigenvector.
constexpr int most_iterations = 500;
/// The length of the rim that belongs to one of its points is raised to at least this part of the mean.
constexpr double least_rim_mass = 1e-3;

/// The matrix of twice the conformal energy, 2n x 2n; rows 2i and 2i + 1 are u and v of point i.
SparseMatrix conformalMatrix(const Points& positions, const Chart& chart, int exponent, int n,
                             const std::vector<int>& local) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(24 * chart.triangles.size());
  for (const auto& corners : chart.triangles) {
    const TriangleSides sides = measureTriangle(positions, corners, exponent);
    for (int k = 0; k < 3; ++k) {
      const int a = local[corners[(k + 1) % 3]], b = local[corners[(k + 2) % 3]];
      const double weight = sides.cotan[k] / 2;
      for (int d = 0; d < 2; ++d) {
        entries.emplace_back(2 * a + d, 2 * a + d, weight);
        entries.emplace_back(2 * b + d, 2 * b + d, weight);
        entries.emplace_back(2 * a + d, 2 * b + d, -weight);
        entries.emplace_back(2 * b + d, 2 * a + d, -weight);
      }
    }
  }
  // Minus the area in the plane, which is a sum over the rim, as inner edges cancel.
  for (const std::vector<int>& rim : chart.rims) {
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const int a = local[rim[k]], b = local[rim[(k + 1) % rim.size()]];
      entries.emplace_back(2 * a, 2 * b + 1, -0.5);
      entries.emplace_back(2 * b + 1, 2 * a, -0.5);
      entries.emplace_back(2 * a + 1, 2 * b, 0.5);
      entries.emplace_back(2 * b, 2 * a + 1, 0.5);
    }
  }
  SparseMatrix A(2 * n, 2 * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// The points of all rims, and the length of rim that belongs to each: the diagonal of B.
struct RimMasses {
  std::vector<int> points;  ///< local indices, ascending
  VectorXd masses;          ///< scaled to the mean 1
};

RimMasses rimMasses(const Points& positions, const Chart& chart, int exponent, int n, const std::vector<int>& local) {
  VectorXd length = VectorXd::Constant(n, -1);
  for (const std::vector<int>& rim : chart.rims) {
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const int a = rim[k], b = rim[(k + 1) % rim.size()];
      const double half = std::ldexp((positions.row(a) - positions.row(b)).stableNorm(), -exponent) / 2;
      for (const int i : {local[a], local[b]}) length[i] = std::max(length[i], 0.0) + half;
    }
  }
  RimMasses rim;
  for (int i = 0; i < n; ++i)
    if (length[i] >= 0) rim.points.push_back(i);
  rim.masses = length(rim.points);
  const double mean = rim.masses.mean();
  if (mean > 0)
    rim.masses = (rim.masses / mean).cwiseMax(least_rim_mass);
  else
    rim.masses.setOnes();
  rim.masses /= rim.masses.mean();
  return rim;
}

/// Factorises L_C + s B with the first shift s for which it is positive definite.
LinearSystem shiftedSystem(const char* function, const SparseMatrix& A, const RimMasses& rim,
                           const SolverOptions& options) {
  const SystemNames names = {.function = function,
                             .matrix = "L_C + s B",
                             .if_indefinite = "the triangles have angles too small to be accurate",
                             .if_large = "take fewer points",
                             .if_too_large = IfTooLarge::refuse};
  double shift = least_shift * static_cast<double>(A.rows()) / 2 / static_cast<double>(rim.points.size());
  for (int round = 1;; ++round, shift *= shift_growth) {
    SparseMatrix shifted = A;
    for (std::size_t k = 0; k < rim.points.size(); ++k)
      for (int d = 0; d < 2; ++d)
        shifted.coeffRef(2 * rim.points[k] + d, 2 * rim.points[k] + d) += shift * rim.masses[static_cast<int>(k)];
    try {
      return LinearSystem::positiveDefinite(names, shifted, options);
    } catch (const SolverFailure&) {
      if (round == most_shifts) throw;
    }
  }
}

/// First vectors, the same on every system: the positions projected into three planes, slightly perturbed, and
/// pseudo-random ones.
MatrixXcd firstColumns(const Points& positions, const std::vector<int>& points, const RimMasses& rim, int exponent,
                       int columns) {
  MatrixXcd start(std::ssize(rim.points), columns);
  const Eigen::RowVector3d origin = positions.row(points[0]);
  std::uint64_t state = 1;
  const auto next = [&] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
  };
  for (Eigen::Index k = 0; k < start.rows(); ++k) {
    const Eigen::RowVector3d p = positions.row(points[rim.points[k]]) - origin;
    const double x[] = {std::ldexp(p.x(), -exponent), std::ldexp(p.y(), -exponent), std::ldexp(p.z(), -exponent)};
    for (int c = 0; c < columns; ++c)
      start(k, c) = c < 3 ? Complex(x[c], x[(c + 1) % 3]) + 1e-3 * Complex(next(), next()) : Complex(next(), next());
  }
  return start;
}

/// A unit eigenvector and its eigenvalue.
struct Eigenpair {
  double value;
  VectorXcd vector;
};

/// The largest eigenvalue of a Hermitian matrix, by the real matrix of twice the size, which has each eigenvalue twice.
/// The largest entry of the vector is real and positive.
Eigenpair largestPair(const MatrixXcd& hermitian) {
  const Eigen::Index n = hermitian.rows();
  Eigen::MatrixXd real(2 * n, 2 * n);
  real << hermitian.real(), -hermitian.imag(), hermitian.imag(), hermitian.real();
  const auto solver = symmetricEigen(real);
  const Eigen::VectorXd last = solver.eigenvectors().col(2 * n - 1);
  VectorXcd vector(n);
  for (Eigen::Index i = 0; i < n; ++i) vector[i] = {last[i], last[n + i]};
  Eigen::Index largest = 0;
  vector.cwiseAbs().maxCoeff(&largest);
  vector *= std::conj(vector[largest]) / std::abs(vector[largest]);
  return {solver.eigenvalues()[2 * n - 1], vector};
}

}  // namespace

Eigen::MatrixX2d conformalMap(const char* function, const Points& positions, const Chart& chart,
                              const std::vector<int>& points, const std::vector<int>& local,
                              const SolverOptions& options, ParameterizationReport& report) {
  const int n = static_cast<int>(points.size());
  const int exponent = exponentOf(positions, chart.triangles);
  const SparseMatrix A = conformalMatrix(positions, chart, exponent, n, local);
  const RimMasses rim = rimMasses(positions, chart, exponent, n, local);
  const LinearSystem system = shiftedSystem(function, A, rim, options);
  report.solver_method = system.report().method;

  // Inverse iteration on a block with a Rayleigh-Ritz step, on sqrt(B) x at the rim: B is 0 at all other points.
  const VectorXd root = rim.masses.cwiseSqrt();
  const VectorXd constant = root / root.norm();
  const int columns = std::min<int>(block_columns, static_cast<int>(rim.points.size()) - 1);
  const auto deflate = [&](MatrixXcd& x) {
    const Eigen::RowVectorXcd parts = constant.cast<Complex>().adjoint() * x;
    x -= constant.cast<Complex>() * parts;
  };
  const auto orthonormal = [&](MatrixXcd x) {
    deflate(x);
    for (int c = 0; c < columns; ++c) {
      for (int pass = 0; pass < 2; ++pass) {  // the second removes what rounding has left
        x.col(c).stableNormalize();
        for (int k = 0; k < c; ++k) x.col(c) -= x.col(k).dot(x.col(c)) * x.col(k);
      }
      x.col(c).stableNormalize();
    }
    return x;
  };
  MatrixXcd x = orthonormal(root.asDiagonal() * firstColumns(positions, points, rim, exponent, columns));
  double least = std::numeric_limits<double>::infinity();
  int idle = 0;
  for (int iteration = 1;; ++iteration) {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(2 * Eigen::Index{n}, columns);
    for (Eigen::Index k = 0; k < x.rows(); ++k) {
      b.row(2 * rim.points[k]) = root[k] * x.row(k).real();
      b.row(2 * rim.points[k] + 1) = root[k] * x.row(k).imag();
    }
    SolveReport solved;
    const Eigen::MatrixXd y = system.solve(function, b, &solved, options.progress);
    MatrixXcd image(x.rows(), columns);
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      for (int c = 0; c < columns; ++c)
        image(k, c) = root[k] * Complex(y(2 * rim.points[k], c), y(2 * rim.points[k] + 1, c));
    deflate(image);
    const MatrixXcd small = x.adjoint().lazyProduct(image);  // a product by blocks takes seconds to compile
    const auto [theta, weights] = largestPair((small + small.adjoint()) / 2);
    // A complex factor only scales and rotates the map; if the eigenvalue is near 0, rounding rotates it from step to
    // step.
    const VectorXcd vector = x.lazyProduct(weights), turned = image.lazyProduct(weights);
    const Complex factor = vector.dot(turned);
    const double residual = (turned - factor * vector).norm() / std::abs(factor);
    idle = residual <= least / 2 ? 0 : idle + 1;
    if (idle == 0) least = residual;
    if (residual <= most_residual || (idle >= most_idle && residual <= most_rounding)) {
      report.iterations = std::max(report.iterations, iteration);
      report.residual = std::max(report.residual, residual);
      Eigen::MatrixX2d uv(n, 2);
      for (int i = 0; i < n; ++i) {
        Complex z = 0;
        for (int c = 0; c < columns; ++c) z += weights[c] * Complex(y(2 * i, c), y(2 * i + 1, c));
        uv.row(i) << z.real() / theta, z.imag() / theta;
      }
      return uv;
    }
    if (iteration == most_iterations || !std::isfinite(residual))
      throw SolverFailure(std::string(function) + ": the residual of the eigenvector is " + numberText(residual) +
                          " after " + std::to_string(iteration) + " iterations, must be at most " +
                          numberText(most_residual));
    x = orthonormal(image);
  }
}

}  // namespace tufted

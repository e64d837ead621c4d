// Functional maps (Ovsjanikov et al. 2012) and ZoomOut (Melzi et al. 2019).
#include "tufted/shape_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "algorithms/check_positions.h"
#include "base/dense_solvers.h"
#include "base/number_text.h"
#include "base/require.h"
#include "neighbors/morton.h"
#include "neighbors/nearest_rows.h"
#include "tufted/check.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int energies = 100;                ///< of wave kernels, as Aubry et al. take
constexpr double kernel_steps = 7;           ///< width of a wave kernel in steps of the energy, by Aubry et al.
constexpr double least_kernel_width = 1e-8;  ///< of a wave kernel: far above the rounding of logarithms
constexpr int candidates_per_sample = 10;    ///< see ZoomOutOptions::samples
constexpr int first_pairs = 20;              ///< of a start from points; the null space alone tells no points apart

void requireAtLeast(const std::string& function, const char* name, int value, int least) {
  if (value < least)
    refuse(function, std::string(name) + " = " + std::to_string(value) + ", must be at least " + std::to_string(least));
}

/// Divides columns by their norms, where these are not 0.
Eigen::DiagonalMatrix<double, Eigen::Dynamic> inverted(const VectorXd& norms) {
  return norms.unaryExpr([](double norm) { return norm > 0 ? 1 / norm : 1; }).asDiagonal();
}

/// The first eigenpairs of a shape scaled to area 1, at all its points.
struct Basis {
  const Laplacian& laplacian;
  VectorXd values;   ///< k
  MatrixXd vectors;  ///< N x k
  VectorXd masses;   ///< N
  /// @param name of the shape, for errors
  Basis(const std::string& function, const char* name, const MappedShape& shape, Index k) : laplacian(shape.laplacian) {
    checkSizes(function, laplacian);
    const Spectrum& pairs = shape.spectrum;
    const auto n = std::ssize(laplacian.status);
    if (pairs.vectors.rows() != n || pairs.vectors.cols() != pairs.values.size())
      refuse(function, "the spectrum of the " + std::string(name) + " has " + std::to_string(pairs.values.size()) +
                           " values and vectors of " + std::to_string(pairs.vectors.rows()) + " x " +
                           std::to_string(pairs.vectors.cols()) + ", must have one vector of " + std::to_string(n) +
                           " per value");
    const double area = laplacian.M.sum();
    if (!(area > 0)) refuse(function, "the " + std::string(name) + " has the area 0, must have points that take part");
    values = area * pairs.values.head(k);
    vectors = std::sqrt(area) * pairs.vectors.leftCols(k);
    masses = laplacian.M / area;
  }

  bool takesPart(int i) const { return laplacian.status[laplacian.representative[i]] == PointStatus::active; }
  std::vector<int> points() const {
    std::vector<int> all;
    for (int i = 0; i < masses.size(); ++i)
      if (takesPart(i)) all.push_back(i);
    return all;
  }
  /// At most `count` points that take part, evenly spread: along a Morton curve, one from each equal share of the area.
  /// All if there are no more, or for 0.
  std::vector<int> sample(std::int64_t count) const {
    std::vector<PointStatus> status;
    std::vector<int> representative, all, found;
    for (const int i : rankPoints(laplacian.positions, status, representative).input_index)
      if (laplacian.status[i] == PointStatus::active && masses[i] > 0) all.push_back(i);
    if (count == 0 || std::ssize(all) <= count) return all;
    double passed = 0;
    for (const int i : all) {
      const double before = std::floor(passed * static_cast<double>(count));
      passed += masses[i];
      if (std::floor(passed * static_cast<double>(count)) > before) found.push_back(i);
    }
    return found;
  }
  /// The first k coefficients of functions divided by their norms.
  MatrixXd coefficients(const MatrixXd& functions, Index k) const {
    const VectorXd norms = (masses.transpose() * functions.cwiseAbs2()).transpose().cwiseSqrt();
    return vectors.leftCols(k).transpose() * (masses.asDiagonal() * functions) * inverted(norms);
  }
  /// Weights of eigenpairs at logarithms of eigenvalues; 0 for the null space.
  MatrixXd waveWeights(const VectorXd& logarithms, double width) const {
    MatrixXd weights(values.size(), logarithms.size());
    for (Index e = 0; e < weights.cols(); ++e) {
      const VectorXd exponents = values.unaryExpr([&](double value) {
        const double widths =
            (std::log(std::max(value, 0.)) - logarithms[e]) / width;  // log(0) is -infinity, and its weight 0
        return -widths * widths / 2;
      });
      // Far from all eigenvalues the nearest one counts.
      weights.col(e) = (exponents.array() - exponents.maxCoeff()).exp();
      weights.col(e) /= weights.col(e).sum();
    }
    return weights;
  }
};

/// Bases of equally many pairs, at most `most`.
struct Bases {
  Basis source, target;
  Bases(const std::string& function, const MappedShape& a, const MappedShape& b,
        Index most = std::numeric_limits<Index>::max())
      : source(function, "source", a, std::min({most, a.spectrum.values.size(), b.spectrum.values.size()})),
        target(function, "target", b, source.values.size()) {}
  Index size() const { return source.values.size(); }
  void checkMap(const std::string& function, const MatrixXd& C) const {
    const std::string sizes = "C is " + std::to_string(C.rows()) + " x " + std::to_string(C.cols());
    if (C.rows() != C.cols() || C.rows() < 1) refuse(function, sizes + ", must be k x k with k at least 1");
    if (C.rows() > size())
      refuse(function,
             sizes + ", must have at most " + std::to_string(size()) + " rows, the eigenpairs that both shapes have");
    if (!C.allFinite()) refuse(function, "C has a value that is not finite");
  }
};

/// The first coefficients of the functions that are 1 at one of the points, and where C, k x k, carries them.
RowsOfNumbers pointsOf(const Basis& basis, const std::vector<int>& points, Index k) {
  return basis.vectors(points, Eigen::seqN(0, k));
}
RowsOfNumbers imagesOf(const Basis& source, const std::vector<int>& points, const MatrixXd& C) {
  return pointsOf(source, points, C.cols()) * C.transpose();
}

/// For each row of `asked` that of the candidates whose row of `places` is nearest.
std::vector<int> nearestOf(const RowsOfNumbers& places, const std::vector<int>& candidates, const RowsOfNumbers& asked,
                           const Workers& workers) {
  std::vector<int> found = nearestRows(places, asked, workers);
  for (int& i : found) i = candidates[i];
  return found;
}

/// C, k x k, that fits best to a map from some points of the target to those of the source; negative ones are left out.
MatrixXd pulled(const Bases& bases, const std::vector<int>& points, const std::vector<int>& mapped, Index k) {
  std::vector<int> from, to;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mapped[i] < 0) continue;
    from.push_back(points[i]);
    to.push_back(mapped[i]);
  }
  const MatrixXd images = bases.source.vectors(to, Eigen::seqN(0, k));
  return leastSquares(bases.target.vectors(from, Eigen::seqN(0, k)), images);
}

/// The first coefficients, k x D, of functions of norm 1 on both shapes that correspond, and the square roots of their
/// weights.
struct Descriptors {
  MatrixXd source, target;
  VectorXd weights;
};

void checkDescriptors(const std::string& function, const Basis& basis, const char* name, const MatrixXd& given) {
  if (given.rows() != basis.masses.size())
    refuse(function, std::string(name) + " have " + std::to_string(given.rows()) + " rows, must have " +
                         std::to_string(basis.masses.size()));
  for (const int i : basis.points())
    if (!given.row(i).allFinite())
      refuse(function, std::string(name) + " have a value that is not finite at point " + std::to_string(i) +
                           ", which takes part");
}

/// The first k coefficients of the functions to compare, scaled to norm 1.
/// @param given N x D; without columns: wave kernel signatures
/// @param side 0: the source, 1: the target
MatrixXd compared(const std::string& function, const Basis& basis, const MatrixXd& waves, const MatrixXd& given,
                  const FunctionalMapOptions& options, int side, Index k) {
  MatrixXd own = given.cols() > 0 ? given : MatrixXd(basis.vectors.cwiseAbs2() * waves);
  for (int i = 0; i < own.rows(); ++i)
    if (!basis.takesPart(i)) own.row(i).setZero();
  for (auto column : own.colwise())
    if (const double most = column.cwiseAbs().maxCoeff(); most > 0) column /= most;
  MatrixXd all = basis.coefficients(own, k);
  const Index first = all.cols();
  all.conservativeResize(Eigen::NoChange, first + std::ssize(options.landmarks) * waves.cols());
  for (Index l = 0; l < std::ssize(options.landmarks); ++l) {
    const int place = options.landmarks[l][side];
    if (place < 0 || place >= basis.masses.size())
      refuse(function, "landmarks has " + std::to_string(place) + ", must lie in [0, " +
                           std::to_string(basis.masses.size()) + ")");
    if (!basis.takesPart(place))
      refuse(function, "landmarks has " + std::to_string(place) + ", a point of the " +
                           (side == 0 ? "source" : "target") + " that takes no part");
    const MatrixXd kernels = basis.vectors.row(place).transpose().asDiagonal() * waves;  // all their coefficients
    all.middleCols(first + l * waves.cols(), waves.cols()) = kernels.topRows(k) * inverted(kernels.colwise().norm());
  }
  return all;
}

Descriptors descriptorsOf(const std::string& function, const Bases& bases, const FunctionalMapOptions& options,
                          Index k) {
  const auto positive = [](const Basis& basis) { return (basis.values.array() > 0).count(); };
  if (std::min(positive(bases.source), positive(bases.target)) < 2)
    refuse(function, "fewer than two eigenvalues are positive: too few points take part");
  // Energies that lie within the spectra of both shapes.
  const auto first = [&](const Basis& basis) { return basis.values[basis.values.size() - positive(basis)]; };
  const double one = std::log(std::max(first(bases.source), first(bases.target)));
  const double other = std::log(std::min(bases.source.values.tail(1)[0], bases.target.values.tail(1)[0]));
  const VectorXd logarithms = VectorXd::LinSpaced(energies, std::min(one, other), std::max(one, other));
  const double width = std::max(kernel_steps * (logarithms[1] - logarithms[0]), least_kernel_width);
  const MatrixXd &a = options.source_descriptors, &b = options.target_descriptors;
  if (a.cols() != b.cols())
    refuse(function, "descriptors have " + std::to_string(a.cols()) + " and " + std::to_string(b.cols()) +
                         " columns, must have as many");
  if (a.cols() > 0) {
    checkDescriptors(function, bases.source, "descriptors of the source", a);
    checkDescriptors(function, bases.target, "descriptors of the target", b);
  }
  Descriptors found;
  found.source = compared(function, bases.source, bases.source.waveWeights(logarithms, width), a, options, 0, k);
  found.target = compared(function, bases.target, bases.target.waveWeights(logarithms, width), b, options, 1, k);
  found.weights = VectorXd::Ones(found.source.cols());
  if (options.weights.size() > 0) {
    if (options.weights.size() != a.cols())
      refuse(function, "weights has " + std::to_string(options.weights.size()) + " values, must have " +
                           std::to_string(a.cols()) + ", one per column of the descriptors");
    for (const double weight : options.weights)
      if (!(weight >= 0 && std::isfinite(weight)))
        refuse(function, "weights has " + numberText(weight) + ", must be finite and at least 0");
    found.weights.head(a.cols()) = options.weights.cwiseSqrt();
  }
  const auto norms = [](const MatrixXd& coefficients) -> VectorXd { return coefficients.colwise().norm(); };
  if ((found.weights.cwiseProduct(norms(found.source)).cwiseProduct(norms(found.target))).isZero(0))
    refuse(function, "descriptors have no column that is not 0 and has a weight above 0, must have one");
  return found;
}

MatrixXd refined(const Bases& bases, MatrixXd C, const std::vector<int>& points, const ZoomOutOptions& options) {
  const Index k = std::min<Index>(options.k, bases.size());
  const std::vector<int> candidates = bases.source.sample(
      candidates_per_sample * std::max<std::int64_t>(options.samples, 2 * k) * (options.samples > 0 ? 1 : 0));
  const Progress silent;
  const Workers turns(1, options.progress), workers(options.threads, silent);
  while (C.rows() < k) {
    turns.report("refine map", static_cast<double>(C.rows()) / static_cast<double>(k));
    const std::vector<int> found =
        nearestOf(imagesOf(bases.source, candidates, C), candidates, pointsOf(bases.target, points, C.rows()), workers);
    C = pulled(bases, points, found, std::min<Index>(k, C.rows() + options.step));
  }
  return C;
}

/// The points of the target that take part in the turns of zoomOut().
std::vector<int> samplePoints(const Bases& bases, const ZoomOutOptions& options) {
  requireAtLeast("zoomOut", "k", options.k, 1);
  requireAtLeast("zoomOut", "step", options.step, 1);
  requireAtLeast("zoomOut", "samples", options.samples, 0);
  checkPositions("zoomOut", bases.source.laplacian);
  checkPositions("zoomOut", bases.target.laplacian);
  return bases.target.sample(options.samples > 0 ? std::max<std::int64_t>(options.samples, 2 * std::int64_t{options.k})
                                                 : 0);
}

}  // namespace

MatrixXd functionalMap(const MappedShape& source, const MappedShape& target, const FunctionalMapOptions& options) {
  const std::string function = "functionalMap";
  requireAtLeast(function, "k", options.k, 1);
  if (!(options.commutativity >= 0 && std::isfinite(options.commutativity)))
    refuse(function, "commutativity = " + numberText(options.commutativity) + ", must be finite and at least 0");
  const Bases bases(function, source, target);
  const Index k = std::min<Index>(options.k, bases.size());
  const Descriptors found = descriptorsOf(function, bases, options, k);
  const VectorXd factors = found.weights / std::sqrt(static_cast<double>(found.weights.size()));
  const MatrixXd A = found.source * factors.asDiagonal(), B = found.target * factors.asDiagonal();
  const VectorXd D = bases.source.values.head(k), E = bases.target.values.head(k);
  const double largest = std::max({D[k - 1], E[k - 1], std::numeric_limits<double>::min()});
  const MatrixXd gram = A * A.transpose(), right = A * B.transpose();
  MatrixXd C(k, k);
  const Workers workers(1, options.progress);
  for (Index row = 0; row < k; ++row) {
    workers.report("functional map", static_cast<double>(row) / static_cast<double>(k));
    MatrixXd system = gram;
    system.diagonal().array() += options.commutativity * ((D.array() - E[row]) / largest).square();
    // The solution of least norm: several descriptors may be too few for a regular matrix.
    C.row(row) = leastSquares(system, right.col(row)).transpose();
  }
  return C;
}

MatrixXd zoomOut(const MappedShape& source, const MappedShape& target, const MatrixXd& C,
                 const ZoomOutOptions& options) {
  const Bases bases("zoomOut", source, target, std::max<Index>(options.k, C.rows()));
  bases.checkMap("zoomOut", C);
  return refined(bases, C, samplePoints(bases, options), options);
}

MatrixXd zoomOut(const MappedShape& source, const MappedShape& target, const std::vector<int>& to_source,
                 const ZoomOutOptions& options) {
  const std::string function = "zoomOut";
  const Bases bases(function, source, target, std::max(options.k, 1));
  const auto n = bases.source.masses.size();
  if (std::ssize(to_source) != bases.target.masses.size())
    refuse(function, "to_source has " + std::to_string(to_source.size()) + " indices, must have " +
                         std::to_string(bases.target.masses.size()) + ", one for each point of the target");
  for (const int i : to_source)
    if (i >= n) refuse(function, "to_source has " + std::to_string(i) + ", must be below " + std::to_string(n));
  const std::vector<int> known = bases.target.points(), points = samplePoints(bases, options);
  std::vector<int> mapped;
  for (const int i : known) mapped.push_back(to_source[i]);
  if (std::none_of(mapped.begin(), mapped.end(), [](int i) { return i >= 0; }))
    refuse(function, "to_source has no index of at least 0 at points that take part, must have one");
  const Index given = std::count_if(mapped.begin(), mapped.end(), [](int i) { return i >= 0; });
  const Index pairs = std::max<Index>(options.step, std::min<Index>(first_pairs, given));
  const MatrixXd start = pulled(bases, known, mapped, std::min<Index>({options.k, pairs, bases.size()}));
  return refined(bases, start, points, options);
}

PointMaps pointMaps(const MappedShape& source, const MappedShape& target, const MatrixXd& C, int threads,
                    const Progress& progress) {
  const Bases bases("pointMaps", source, target, std::max<Index>(C.rows(), 1));
  bases.checkMap("pointMaps", C);
  const Workers workers(threads, progress);
  const std::vector<int> first = bases.source.points(), second = bases.target.points();
  const RowsOfNumbers images = imagesOf(bases.source, first, C), places = pointsOf(bases.target, second, C.rows());
  const auto spread = [](const Basis& from, const std::vector<int>& points, const std::vector<int>& found) {
    std::vector<int> all(from.laplacian.status.size(), -1);
    for (std::size_t i = 0; i < points.size(); ++i) all[points[i]] = found[i];
    return all;
  };
  // A coincident point is as near as its representative, which comes first, and is not to be found instead of it.
  const auto represented = [](const Basis& to, std::vector<int> found) {
    for (int& i : found) i = to.laplacian.representative[i];
    return found;
  };
  return {spread(bases.source, first, represented(bases.target, nearestOf(places, second, images, workers))),
          spread(bases.target, second, represented(bases.source, nearestOf(images, first, places, workers)))};
}

}  // namespace tufted

// Curvature of fitted heights; where there is noise, in windows chosen by the intersection of confidence intervals.
#include "tufted/curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/check_positions.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "base/symmetric_eigen.h"
#include "neighbors/morton.h"
#include "operators/rings.h"
#include "stars/offsets.h"
#include "stars/quadratic_fit.h"
#include "stars/tangent_frame.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* curvature_name = "curvatures";

/// Rings of neighbours in the windows, each some 2.5 times as many points as the one before. Other ratios give the same
/// errors; 15 rings of 1,200 points lower the error on a noisy sphere, not on a torus, and take 1.4 times as long.
constexpr std::array<int, 5> window_rings = {2, 3, 5, 8, 12};
/// Noisy points get no window of fewer rings. With 2 rings everywhere denoised shapes have errors larger by 8 % than
/// with 3 (equal weights, 30,000 points, noise of 0.3 spacings).
constexpr int least_noisy_rings = 3;
/// A window with more points than this is not used if a narrower one is; 12 rings of an even sampling have fewer.
constexpr int most_points = 800;
/// Half the width of a confidence interval, in standard deviations of a second derivative. With 0.5, 0.7 and 1 real
/// shapes with noise of 0.3 spacings have errors of 56, 58 and 60 %, a noisy sphere of 4.1, 2.7 and 1.9 %.
constexpr double confidence = 0.7;
/// Where the fitted surface is steeper than this over its plane, the plane is turned to be tangent and the heights are
/// measured anew. With 0.001 a sphere of 1,000 points is exact to 1.5e-5 only.
constexpr double exact_slope = 1e-5;
/// The plane of a window of noisy points is turned only where the surface is steeper than this over it. A depth image
/// takes two thirds of the time that it takes with 1e-5, and the errors of a sphere and a torus with 1 % noise stay.
constexpr double noisy_slope = 1e-2;
/// Maximum number of turns of the plane for one window. With one turn the error of half a cylinder is twenty times as
/// large if the given normals lean by 29 degrees.
constexpr int most_turns = 5;
/// Maximum of CurvatureOptions::rings: 100 rings have some 30,000 points.
constexpr int most_rings = 100;
/// The radius of a window is this many times the distance of its farthest point, so that this has a weight.
constexpr double wider = 1.1;

/// A fit over one window.
struct Window {
  HeightFit fit;
  Eigen::Vector3d normal;  ///< of the plane over which heights were measured
  double radius;           ///< in the caller's unit
  int rings;

  /// Second derivatives of the height: along u and u, u and v, v and v, in 1 / length.
  Eigen::Array3d second() const {
    return Eigen::Array3d(2 * fit.coefficient[3], fit.coefficient[4], 2 * fit.coefficient[5]) / radius;
  }
  /// About the standard deviation of each, for independent errors of the heights.
  double deviation(double error) const { return 2 * error / radius / radius / std::sqrt(fit.least_pivot); }
};

/// Fits heights over the tangent plane of one point after the other.
class Fitter {
 public:
  /// @param rings of all windows; 0: chosen for each point
  Fitter(const Laplacian& laplacian, const Frames& frames, int rings)
      : positions_(laplacian.positions),
        frames_(frames),
        noise_(laplacian.noise),
        given_rings_(rings),
        rings_(laplacian.L) {}

  /// The window of a point, or none if its neighbours lie on a line or a conic.
  std::optional<Window> fit(int p) {
    normal_ = frames_.normals.row(p).transpose();
    rings_.start(p);
    if (given_rings_ > 0) {
      growTo(given_rings_);
      return fitWindow(p, exact_slope);
    }
    growTo(window_rings.front());
    return widestWindow(p, noiseAround());
  }

 private:
  /// The widest window whose confidence intervals have a value in common with those of all narrower ones; of exact
  /// points the narrowest.
  std::optional<Window> widestWindow(int p, double noise) {
    std::optional<Window> best;
    Eigen::Array3d low = Eigen::Array3d::Constant(-INFINITY), high = -low;
    for (const int rings : window_rings) {
      if (noise > 0 && rings < least_noisy_rings) continue;
      growTo(rings);
      if (best && std::ssize(rings_.points()) > most_points) break;
      const std::optional<Window> window = fitWindow(p, noise > 0 ? noisy_slope : exact_slope);
      if (!window) continue;
      if (noise == 0) return window;
      const double half = confidence * window->deviation(noise);
      low = low.max(window->second() - half);
      high = high.min(window->second() + half);
      if (best && (low > high).any()) break;
      best = window;
    }
    return best;
  }

  void growTo(int rings) {
    while (rings_.count() < rings) rings_.grow();
  }

  /// The mean noise of the points of the rings if denoising has moved most of them, else 0.
  double noiseAround() const {
    if (noise_.size() == 0) return 0;
    double sum = 0;
    std::ptrdiff_t moved = 0;
    for (const int q : rings_.points()) {
      sum += noise_[q];
      moved += noise_[q] > 0 ? 1 : 0;
    }
    return 2 * moved > std::ssize(rings_.points()) ? sum / static_cast<double>(moved) : 0;
  }

  /// Fits heights at the points of the rings, over a plane turned until the surface is at most this steep.
  std::optional<Window> fitWindow(int p, double most_slope) {
    const Eigen::RowVector3d center = positions_.row(p);
    const std::vector<int>& points = rings_.points();
    double extent = 0, farthest = 0;
    for (const int q : points) extent = std::max(extent, (positions_.row(q) - center).cwiseAbs().maxCoeff());
    const bool has_extent = extent > 0 && std::isfinite(extent);
    const double unit = has_extent ? std::ldexp(1.0, std::clamp(std::ilogb(extent), -1000, 1000)) : 1;
    const double scale = 1 / unit;  // exact, and faster than divisions
    offsets_.fill(static_cast<int>(std::ssize(points)) - 1, [&](int i) {
      const Eigen::RowVector3d d = (positions_.row(points[i + 1]) - center) * scale;
      farthest = std::max(farthest, d.squaredNorm());
      return d;
    });
    const double radius = wider * std::sqrt(farthest);
    HeightFit fit = fitHeights(weightedMoments(offsets_.view(), normal_, radius));
    for (int turn = 0; turn < most_turns && fit.is_valid; ++turn) {
      if (!(std::hypot(fit.coefficient[1], fit.coefficient[2]) > most_slope)) break;
      normal_ = normalOf(fit, normal_);
      fit = fitHeights(weightedMoments(offsets_.view(), normal_, radius));
    }
    return fit.is_valid ? std::optional(Window{fit, normal_, radius * unit, rings_.count()}) : std::nullopt;
  }

  const Points& positions_;
  const Frames& frames_;
  const VectorXd& noise_;
  const int given_rings_;
  Rings rings_;
  OffsetBuffer offsets_;    ///< of the points of the rings
  Eigen::Vector3d normal_;  ///< see Window
};

/// Stores the curvatures of the fitted surface at a point.
void setCurvatures(int p, const Window& window, Curvatures& result) {
  const double b = window.fit.coefficient[1], e = window.fit.coefficient[2], length = std::sqrt(1 + b * b + e * e);
  const Eigen::Array3d derivatives = window.second() / -length;  // positive where the surface falls on all sides
  Eigen::Matrix2d second;
  second << derivatives[0], derivatives[1], derivatives[1], derivatives[2];
  const auto solver = symmetricEigen(second);
  const Eigen::RowVector3d normal = window.normal, x = tangentOf(window.normal), y = normal.cross(x);
  const Eigen::Vector2d k = solver.eigenvalues();  // ascending
  // Adding 0 turns -0 into 0.
  result.principal.row(p) << k[1] + 0.0, k[0] + 0.0;
  result.mean[p] = (k[0] + k[1]) / 2 + 0.0;
  result.gaussian[p] = k[0] * k[1] + 0.0;
  const Eigen::Vector2d v = solver.eigenvectors().col(1);
  const Eigen::RowVector3d fitted_normal = (normal - b * x - e * y) / length;
  const Eigen::RowVector3d first = (v[0] * (x + b * normal) + v[1] * (y + e * normal)).normalized();
  result.first.row(p) = first;
  result.second.row(p) = fitted_normal.cross(first);
}

/// The active points along a Morton curve. Windows of neighbours on it have points in common, which are in the cache.
std::vector<int> visitingOrder(const Laplacian& laplacian, const Workers& workers) {
  std::vector<PointStatus> status;
  std::vector<int> representative;
  const Buffer<int> distinct = rankPoints(laplacian.positions, status, representative, workers).input_index;
  std::vector<int> order(distinct.begin(), distinct.end());
  // Active vertices of a mesh may coincide.
  for (int p = 0; p < std::ssize(status); ++p)
    if (status[p] != PointStatus::active) order.push_back(p);
  std::erase_if(order, [&](int p) { return laplacian.status[p] != PointStatus::active; });
  return order;
}

Curvatures fitCurvatures(const Laplacian& laplacian, const Frames& frames, int given_rings, const Workers& workers) {
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  const std::vector<int> order = visitingOrder(laplacian, workers);
  Curvatures result{VectorXd::Zero(n),  VectorXd::Zero(n),  Eigen::MatrixX2d::Zero(n, 2),
                    Points::Zero(n, 3), Points::Zero(n, 3), {}};
  std::vector<int> rings(n, 0);
  std::vector<std::optional<Fitter>> fitters(workers.count());
  workers.forBlocks("curvature", std::ssize(order), costly_block,
                    [&](std::int64_t begin, std::int64_t end, int worker) {
                      std::optional<Fitter>& fitter = fitters[worker];
                      if (!fitter) fitter.emplace(laplacian, frames, given_rings);
                      for (std::int64_t i = begin; i < end; ++i) {
                        const int p = order[i];
                        const std::optional<Window> window = fitter->fit(p);
                        if (!window) continue;
                        setCurvatures(p, *window, result);
                        rings[p] = window->rings;
                      }
                    });
  std::int64_t sum = 0;
  for (const int p : order) {
    sum += rings[p];
    if (rings[p] == 0) ++result.report.undetermined;
  }
  result.report.mean_rings =
      static_cast<double>(sum) / static_cast<double>(std::max<std::int64_t>(std::ssize(order), 1));
  return result;
}

/// The mean curvature H from L x = 2 H n M at each point.
Curvatures laplacianCurvatures(const Laplacian& laplacian, const Frames& frames, const Workers& workers) {
  const Points& positions = laplacian.positions;
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  Curvatures result;
  result.mean = VectorXd::Zero(n);
  workers.forBlocks("curvature", n, costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      if (laplacian.status[p] != PointStatus::active || !(laplacian.M[p] > 0)) continue;
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();  // of differences: exact far from the origin
      for (SparseMatrix::InnerIterator entry(laplacian.L, p); entry; ++entry)
        sum += entry.value() * (positions.row(entry.row()) - positions.row(p));
      result.mean[p] = sum.dot(frames.normals.row(p)) / laplacian.M[p] / 2 + 0.0;  // no -0
    }
  });
  return result;
}

}  // namespace

Curvatures curvatures(const Laplacian& laplacian, const CurvatureOptions& options) {
  return curvatures(laplacian, laplacian.frames, options);
}

Curvatures curvatures(const Laplacian& laplacian, const Frames& frames, const CurvatureOptions& options) {
  checkFrames(curvature_name, laplacian, frames);
  requireChoice(options.method, CurvatureMethod::laplacian, curvature_name, "method");
  if (options.threads < 0)
    throw InvalidInput(std::string(curvature_name) + ": threads = " + std::to_string(options.threads) +
                       ", must be >= 0");
  if (options.rings < 0 || options.rings > most_rings)
    throw InvalidInput(std::string(curvature_name) + ": rings = " + std::to_string(options.rings) +
                       ", must lie in [0, " + std::to_string(most_rings) + "]");
  if (options.rings > 0 && options.method != CurvatureMethod::fit)
    throw InvalidInput(std::string(curvature_name) + ": rings = " + std::to_string(options.rings) +
                       ", must be 0 without CurvatureMethod::fit");
  const Stopwatch watch;
  const Workers workers(options.threads, options.progress);
  const bool fits = options.method == CurvatureMethod::fit;
  Curvatures result =
      fits ? fitCurvatures(laplacian, frames, options.rings, workers) : laplacianCurvatures(laplacian, frames, workers);
  for (Eigen::Index i = 0; i < result.mean.size(); ++i) {
    const int source = laplacian.representative[i];
    if (source == i) continue;
    result.mean[i] = result.mean[source];
    if (!fits) continue;
    result.gaussian[i] = result.gaussian[source];
    result.principal.row(i) = result.principal.row(source);
    result.first.row(i) = result.first.row(source);
    result.second.row(i) = result.second.row(source);
  }
  if (!(result.mean.allFinite() && result.principal.allFinite() && result.gaussian.allFinite()))
    throw SolverFailure(std::string(curvature_name) +
                        ": a curvature overflows, because the points are too small in their unit: scale them up");
  result.report.seconds = watch.seconds();
  return result;
}

}  // namespace tufted

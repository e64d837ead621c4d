// Curvature of fitted heights, in windows chosen by the intersection of confidence intervals.
#include "tufted/curvature.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/check_frames.h"
#include "algorithms/height_fit.h"
#include "base/parallel.h"
#include "base/stage_clock.h"
#include "operators/rings.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* function_name = "curvatures";

/// Rings of neighbours in the first window of exact points: some 19 points for six unknowns.
constexpr int first_rings = 2;
/// Rings in the first window of noisy points, some 61 points: errors of denoised points are correlated over three
/// spacings. With 3 rings the error on a sphere with 1 % noise is 4.9 % instead of 2.2 %.
constexpr int first_noisy_rings = 4;
/// Rings in the widest window. 15 rings of 1,200 points lower the errors on the noisy sphere to 1.5 %, but not on the
/// torus, and take 1.4 times as long.
constexpr int last_rings = 12;
/// Each window has this many times the rings of the one before: 4, 5, 6, 7, 8, 10, 12. Growing by one ring gives the
/// same errors for more fits.
constexpr double ring_growth = 1.25;
/// A window with more points than this gets no further ring; 12 rings of an even sampling have fewer.
constexpr int most_points = 800;
/// Residuals below this part of the radius of a window are rounding, as on a plane or a sphere; taken for noise, they
/// would widen the windows.
constexpr double exact_below = 1e-6;
/// If the residuals over four rings are less than this many times those over two, they are noise (1 to 2 times); a
/// smooth surface has a ratio of 8 or 16. With 5 the results are the same.
constexpr double noisy_below = 4;
/// Where the fitted surface is steeper than this over its plane, the plane is turned to be tangent and the heights are
/// measured anew, as second derivatives are off by the square of the slope.
constexpr double most_slope = 0.1;
/// Half the width of a confidence interval, in standard deviations of independent errors. With 2 windows are wider,
/// which takes longer, and a clean torus has 0.55 %.
constexpr double confidence = 1;
/// Half the width of a confidence interval where noise is estimated from residuals, whose errors are not independent
/// but span some spacings. With 8 and 13 a noisy sphere has 3.2 and 1.8 %, a torus 2.2 and 2.3 %.
constexpr double noisy_confidence = 10;

/// A fit over one window.
struct Window {
  SurfaceFit fit;
  Eigen::RowVector3d normal, x;  ///< normal of the plane over which heights were measured, and an axis in it
  double radius;
  int rings;
};

/// Height residuals of fits to two and to four rings, root mean square in the caller's unit.
struct Residuals {
  double few = 0, more = 0;
};

/// Fits heights over the tangent plane of one point after the other.
class Fitter {
 public:
  Fitter(const Laplacian& laplacian, const Frames& frames)
      : positions_(laplacian.positions), frames_(frames), noise_(laplacian.noise), rings_(laplacian.L) {}

  /// Whether denoising has moved a point, so that its noise is known.
  bool isMoved(int p) const { return noise_.size() > 0 && noise_[p] > 0; }

  /// The residuals of fits around one point; 0 where they are only rounding.
  Residuals residuals(int p) {
    const auto leftOver = [&](int rings) {
      while (rings_.count() < rings && rings_.grow()) {
      }
      const std::optional<Window> window = fitWindow(p);
      if (!window) return 0.0;
      const double error = errorOf(window->fit, samples_, window->radius / unit_);
      return std::isfinite(error) && error >= exact_below ? error * window->radius : 0;
    };
    start(p);
    const double few = leftOver(first_rings);
    return {few, leftOver(first_noisy_rings)};
  }

  /// The widest window whose confidence intervals have a value in common with those of all narrower ones.
  /// @param residuals of all points, 0 at those whose noise is known
  std::optional<Window> fit(int p, const std::vector<Residuals>& residuals) {
    const Errors errors = errorsAround(p, residuals);
    start(p);
    std::optional<Window> best;
    int next_rings = errors.first_rings;
    Eigen::Array3d low = Eigen::Array3d::Constant(-INFINITY), high = -low;
    for (bool grows = true; grows && rings_.count() < last_rings && std::ssize(rings_.points()) <= most_points;) {
      grows = rings_.grow();
      if (grows && rings_.count() < next_rings) continue;
      next_rings = std::max(next_rings + 1, static_cast<int>(ring_growth * next_rings));
      const std::optional<Window> window = fitWindow(p);
      if (!window) continue;
      const Eigen::Array3d second = window->fit.coefficients.tail<3>().array() / window->radius;
      const Eigen::Array3d half = errors.interval / window->radius * (window->fit.deviation.array() / window->radius);
      low = low.max(second - half);
      high = high.min(second + half);
      if (best && (low > high).any()) break;
      best = window;
      if (errors.interval == 0) break;  // heights are exact: a wider window gains nothing
    }
    return best;
  }

 private:
  /// Errors of the heights around a point.
  struct Errors {
    int first_rings;  ///< rings of the first window
    double interval;  ///< half the width of the confidence interval of a height, in the caller's unit
  };

  /// If most points around were moved, their mean noise counts: after denoising it is smooth, so residuals do not show
  /// it, but over wide windows it is as strong as before, and independent.
  Errors errorsAround(int p, const std::vector<Residuals>& residuals) {
    rings_.start(p);
    while (rings_.count() < first_noisy_rings && rings_.grow()) {
    }
    Residuals sum;
    double noise = 0;
    int moved = 0;
    for (const int q : rings_.points()) {
      if (isMoved(q)) {
        noise += noise_[q];
        ++moved;
      }
      sum.few += residuals[q].few;
      sum.more += residuals[q].more;
    }
    const int points = static_cast<int>(std::ssize(rings_.points()));
    if (2 * moved > points) return {first_noisy_rings, confidence * noise / moved};
    const auto count = static_cast<double>(points - moved);
    const bool is_noisy = sum.more < noisy_below * sum.few;
    return is_noisy ? Errors{first_noisy_rings, noisy_confidence * sum.more / count}
                    : Errors{first_rings, confidence * sum.few / count};
  }

  void start(int p) {
    rings_.start(p);
    normal_ = frames_.normals.row(p);
    x_ = frames_.tangents.row(p);
    samples_.clear();
    farthest_ = 0;
  }

  std::optional<Window> fitWindow(int p) {
    takeNewPoints(p);
    const double radius = wider * std::sqrt(farthest_);
    if (!(radius > 0) || !std::isfinite(radius)) return std::nullopt;
    std::optional<SurfaceFit> fit = fitHeights(samples_, radius);
    if (fit && fit->coefficients.segment<2>(1).norm() > most_slope) {
      turnPlane(fit->coefficients[1], fit->coefficients[2]);
      samples_.clear();
      takeNewPoints(p);
      fit = fitHeights(samples_, radius);
    }
    return fit ? std::optional(Window{*fit, normal_, x_, radius * unit_, rings_.count()}) : std::nullopt;
  }

  /// Turns the plane to be tangent to a surface that rises by b along x and by c along the other axis.
  void turnPlane(double b, double c) {
    const Eigen::RowVector3d tangent = (x_ + b * normal_).normalized();
    normal_ = (normal_ - b * x_ - c * normal_.cross(x_)).normalized();
    x_ = tangent;
  }

  /// Adds samples for the points of rings added since the last window.
  void takeNewPoints(int p) {
    const Eigen::RowVector3d center = positions_.row(p), y = normal_.cross(x_);
    const std::vector<int>& points = rings_.points();
    if (samples_.u.empty()) {
      double extent = 0;
      for (const int q : points) extent = std::max(extent, (positions_.row(q) - center).cwiseAbs().maxCoeff());
      unit_ = extent > 0 && std::isfinite(extent) ? std::ldexp(1.0, std::clamp(std::ilogb(extent), -1000, 1000)) : 1;
    }
    for (std::size_t i = samples_.u.size(); i < points.size(); ++i) {
      const Eigen::RowVector3d offset = (positions_.row(points[i]) - center) / unit_;
      farthest_ = std::max(farthest_, offset.squaredNorm());
      samples_.add(offset.dot(x_), offset.dot(y), offset.dot(normal_));
    }
  }

  /// The radius is this many times the distance of the farthest point, so that its weight is not 0.
  static constexpr double wider = 1.1;

  const Points& positions_;
  const Frames& frames_;
  const VectorXd& noise_;
  Rings rings_;
  Eigen::RowVector3d normal_, x_;  ///< see Window
  HeightSamples samples_;          ///< one per point of the rings, in units of `unit_`
  double unit_ = 1;                ///< a power of two near the extent of the first window, in the caller's unit
  double farthest_ = 0;            ///< squared distance of the farthest sample
};

/// Stores the curvatures of the fitted surface at a point.
void setCurvatures(int p, const Window& window, Curvatures& result) {
  const auto& c = window.fit.coefficients;
  const double b = c[1], e = c[2], length = std::sqrt(1 + b * b + e * e);
  Eigen::Matrix2d second;
  second << c[3], c[4], c[4], c[5];
  second *= -1 / length;  // positive where the surface falls on all sides
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(second);
  const Eigen::RowVector3d normal = window.normal, x = window.x, y = normal.cross(x);
  const Eigen::Vector2d k = solver.eigenvalues() / window.radius;  // ascending
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

Curvatures fitCurvatures(const Laplacian& laplacian, const Frames& frames, const Workers& workers) {
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  Curvatures result{VectorXd::Zero(n),  VectorXd::Zero(n),  Eigen::MatrixX2d::Zero(n, 2),
                    Points::Zero(n, 3), Points::Zero(n, 3), {}};
  std::vector<int> rings(n, 0);
  std::vector<std::optional<Fitter>> fitters(workers.count());
  std::vector<Residuals> residuals(laplacian.status.size());
  workers.forBlocks("noise", n, costly_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    std::optional<Fitter>& fitter = fitters[worker];
    if (!fitter) fitter.emplace(laplacian, frames);
    for (int p = static_cast<int>(begin); p < end; ++p)
      if (laplacian.status[p] == PointStatus::active && !fitter->isMoved(p)) residuals[p] = fitter->residuals(p);
  });
  workers.forBlocks("curvature", n, costly_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    std::optional<Fitter>& fitter = fitters[worker];
    if (!fitter) fitter.emplace(laplacian, frames);
    for (int p = static_cast<int>(begin); p < end; ++p) {
      if (laplacian.status[p] != PointStatus::active) continue;
      const std::optional<Window> window = fitter->fit(p, residuals);
      if (!window) continue;
      setCurvatures(p, *window, result);
      rings[p] = window->rings;
    }
  });
  std::int64_t sum = 0, active = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    sum += rings[i];
    if (laplacian.status[i] != PointStatus::active) continue;
    ++active;
    if (rings[i] == 0) ++result.report.undetermined;
  }
  result.report.mean_rings = static_cast<double>(sum) / static_cast<double>(std::max<std::int64_t>(active, 1));
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
  checkFrames(function_name, laplacian, frames);
  if (options.threads < 0)
    throw InvalidInput(std::string(function_name) + ": threads = " + std::to_string(options.threads) +
                       ", must be >= 0");
  const Stopwatch watch;
  const Workers workers(options.threads, options.progress);
  const bool fits = options.method == CurvatureMethod::fit;
  Curvatures result =
      fits ? fitCurvatures(laplacian, frames, workers) : laplacianCurvatures(laplacian, frames, workers);
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
  result.report.seconds = watch.seconds();
  return result;
}

}  // namespace tufted

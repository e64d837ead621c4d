// Eigenvalues of the cap of a ball that a depth camera sees.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "bench/depth_views.h"
#include "bench/tables.h"
#include "tufted/laplacian.h"
#include "tufted/spectrum.h"

namespace tufted::bench {
namespace {

constexpr int wanted = 20;  // number of positive eigenvalues
/// Polar angle of the rim of the cap, from the point nearest to the camera. Rays meet the cap at less than 72 degrees,
/// so that its rim is known to a pixel.
constexpr double angle = 52 * std::numbers::pi / 180;

/// Neumann eigenvalues of the cap of the unit sphere: for each order m along the circles of latitude, those of an
/// equation in the polar angle, by linear finite elements.
std::vector<double> eigenvaluesOfCap() {
  constexpr int nodes = 400, most_order = 12;
  const double step = angle / (nodes - 1);
  std::vector<double> eigenvalues;
  for (int order = 0; order <= most_order; ++order) {
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(nodes, nodes), mass = stiffness;
    for (int e = 0; e + 1 < nodes; ++e) {
      for (const double at : {0.5 - 0.5 / std::numbers::sqrt3, 0.5 + 0.5 / std::numbers::sqrt3}) {
        const double sine = std::sin((e + at) * step), weight = step / 2;
        const Eigen::Vector2d value(1 - at, at), slope(-1 / step, 1 / step);
        stiffness.block<2, 2>(e, e) +=
            weight * (sine * slope * slope.transpose() + order * order / sine * value * value.transpose());
        mass.block<2, 2>(e, e) += weight * sine * value * value.transpose();
      }
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass, Eigen::EigenvaluesOnly);
    for (int i = 0; i < wanted; ++i)
      for (int copy = 0; copy < (order == 0 ? 1 : 2); ++copy) eigenvalues.push_back(solver.eigenvalues()[i]);
  }
  std::sort(eigenvalues.begin(), eigenvalues.end());
  return {eigenvalues.begin() + 1, eigenvalues.begin() + 1 + wanted};
}

/// The points whose pixels see the cap; others become NaN.
Points pointsOfCap(const View& view, Points points) {
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (!(ball_depth - view.points(i, 2) > ball_radius * std::cos(angle)))
      points.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
  return points;
}

/// Relative errors of the eigenvalues; the mean is signed.
struct Errors {
  double largest = 0, mean = 0;
  double largest_change = 0;  ///< largest relative difference from those of exact depths

  Errors& operator+=(const Errors& other) {
    largest += other.largest;
    mean += other.mean;
    largest_change += other.largest_change;
    return *this;
  }
};

Errors errorsOf(const std::vector<double>& found, const std::vector<double>& of_exact,
                const std::vector<double>& truth) {
  Errors errors;
  for (int i = 0; i < wanted; ++i) {
    const double error = found[i] / truth[i] - 1;
    errors.largest = std::max(errors.largest, std::abs(error));
    errors.mean += error / wanted;
    errors.largest_change = std::max(errors.largest_change, std::abs(found[i] / of_exact[i] - 1));
  }
  return errors;
}

/// The positive eigenvalues, scaled to the unit sphere.
std::vector<double> eigenvaluesOf(const Points& points, const CloudOptions& options) {
  const Spectrum found = spectrum(pointCloudLaplacian(points, options), wanted + 1);
  std::vector<double> eigenvalues;
  for (int i = 1; i <= wanted; ++i) eigenvalues.push_back(found.values[i] * ball_radius * ball_radius);
  return eigenvalues;
}

}  // namespace

void printDepthSpectra() {
  std::printf(
      "| depth | eigenvalues of the cap, by the tree: largest error, mean, largest change | by pixels |\n"
      "|---|---|---|\n");
  const std::vector<double> truth = eigenvaluesOfCap();
  std::vector<std::vector<double>> of_exact;  // for each seed, by the tree and by pixels
  for (const CameraNoise& noise : camera_noises) {
    Errors errors[2];
    std::size_t build = 0;
    for (std::uint64_t seed = first_view_seed; seed <= last_view_seed; ++seed) {
      const View view = ballView(seed);
      const ScanStructure structure = imageStructure(view.width, view.height);
      const Points points = pointsOfCap(view, seenBy(view, noise, seed));
      for (const bool by_pixels : {false, true}) {
        CloudOptions options;
        options.keep_cover = false;
        if (by_pixels) options.structure = &structure;
        const std::vector<double> found = eigenvaluesOf(points, options);
        if (noise.name == camera_noises.front().name) of_exact.push_back(found);
        errors[by_pixels ? 1 : 0] += errorsOf(found, of_exact[build++], truth);
      }
    }
    std::printf("| %s |", noise.name.c_str());
    for (const Errors& sum : errors)
      std::printf(" %.2f %%, %+.2f %%, %.2f %% |", 100 * sum.largest / view_seeds, 100 * sum.mean / view_seeds,
                  100 * sum.largest_change / view_seeds);
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace tufted::bench

#include "bench/real_scans.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/median.h"
#include "bench/nearest_points.h"
#include "bench/plane_steps.h"
#include "tufted/denoise.h"
#include "tufted/io/read.h"

namespace tufted::bench {
namespace {

constexpr std::uint64_t seed = 101;  // chooses the points that are predicted
constexpr int most_queries = 4000;
constexpr double most_height = 5;  // spacings; greater heights are no noise and are clamped to this
constexpr int icp_rounds = 30;
constexpr double overlap = 3;  // spacings; points farther from the other scan are outside of the overlap

/// The height of a position over the plane or quadratic fitted to points near it.
double heightOver(const Points& points, const Eigen::RowVector3d& place, int degree) {
  const Frame frame = frameOf(points);
  const Eigen::MatrixX3d at = (points.rowwise() - frame.middle) * frame.axes;
  const Eigen::RowVector3d here = (place - frame.middle) * frame.axes;
  const double size = std::max(at.leftCols<2>().cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const auto terms = [&](double u, double v) {
    u /= size;
    v /= size;
    return Eigen::RowVectorXd(degree == 1 ? Eigen::RowVectorXd{{1, u, v}}
                                          : Eigen::RowVectorXd{{1, u, v, u * u, u * v, v * v}});
  };
  Eigen::MatrixXd system(points.rows(), terms(0, 0).cols());
  for (Eigen::Index i = 0; i < points.rows(); ++i) system.row(i) = terms(at(i, 0), at(i, 1));
  const VectorXd coefficients = system.colPivHouseholderQr().solve(at.col(2));
  return here[2] - terms(here[0], here[1]).dot(coefficients);
}

/// The root mean squared height of the queries, in spacings, for the best degree and number of neighbours.
double bestFit(const NearestPoints& seen, const Points& queries, double spacing) {
  const std::vector<int> counts = {8, 12, 16, 24, 48, 96};
  Eigen::ArrayXXd squares = Eigen::ArrayXXd::Zero(static_cast<Eigen::Index>(counts.size()), 2);
  for (Eigen::Index q = 0; q < queries.rows(); ++q) {
    const std::vector<std::size_t> nearest = seen.of(queries.row(q), counts.back());
    for (std::size_t c = 0; c < counts.size(); ++c) {
      const Points near = rowsOf(seen.points(), nearest, std::min(counts[c], static_cast<int>(nearest.size())));
      for (const int degree : {1, 2}) {
        const double height = heightOver(near, queries.row(q), degree) / spacing;
        squares(static_cast<Eigen::Index>(c), degree - 1) += std::min(height * height, most_height * most_height);
      }
    }
  }
  return std::sqrt(squares.minCoeff() / static_cast<double>(queries.rows()));
}

double spacingOf(const NearestPoints& seen) {
  const Points& points = seen.points();
  Buffer<double> distance;
  for (Eigen::Index i = 0; i < points.rows(); i += 1 + points.rows() / most_queries)
    distance.push_back(
        (points.row(static_cast<Eigen::Index>(seen.of(points.row(i), 2).back())) - points.row(i)).norm());
  return medianOf(std::move(distance));
}

Prediction predict(const Points& seen, const Points& queries) {
  const NearestPoints raw(seen);
  const DenoisedPoints denoised = denoise(seen);
  const double spacing = spacingOf(raw);
  return {bestFit(raw, queries, spacing), bestFit(NearestPoints(denoised.positions), queries, spacing),
          static_cast<double>(denoised.report.moved) / static_cast<double>(seen.rows())};
}

Points someOf(const Points& points, std::mt19937_64& random) {
  std::vector<std::size_t> which(static_cast<std::size_t>(points.rows()));
  for (std::size_t i = 0; i < which.size(); ++i) which[i] = i;
  std::shuffle(which.begin(), which.end(), random);
  return rowsOf(points, which, static_cast<int>(std::min<std::size_t>(which.size(), most_queries)));
}

}  // namespace

Prediction predictHidden(const Points& scan) {
  std::mt19937_64 random(seed);
  std::vector<std::size_t> seen, hidden;
  for (std::size_t i = 0; i < static_cast<std::size_t>(scan.rows()); ++i)
    ((random() & 1U) != 0 ? seen : hidden).push_back(i);
  const Points queries = rowsOf(scan, hidden, static_cast<int>(hidden.size()));
  return predict(rowsOf(scan, seen, static_cast<int>(seen.size())), someOf(queries, random));
}

Prediction predictSecond(const Points& scan, Points other) {
  const NearestPoints seen(scan);
  const double spacing = spacingOf(seen);
  std::mt19937_64 random(seed);
  const auto isBeside = [&](const Eigen::RowVector3d& place) {
    return (scan.row(static_cast<Eigen::Index>(seen.of(place, 1).front())) - place).norm() > overlap * spacing;
  };
  for (int round = 0; round < icp_rounds; ++round) {
    const Points sample = someOf(other, random);
    PlaneSteps steps;
    for (Eigen::Index i = 0; i < sample.rows(); ++i) {
      const Eigen::RowVector3d place = sample.row(i);
      if (round > icp_rounds / 2 && isBeside(place)) continue;
      const Frame frame = frameOf(rowsOf(scan, seen.of(place, 12), 12));
      const Eigen::Vector3d normal = frame.axes.col(2);
      const double height = (place - frame.middle).dot(normal);
      if (std::abs(height) > most_height * spacing) continue;
      steps.add(place.transpose(), normal, height);
    }
    const Eigen::Isometry3d motion = steps.motion();
    other = ((other * motion.linear().transpose()).rowwise() + motion.translation().transpose()).eval();
  }
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < static_cast<std::size_t>(other.rows()); ++i)
    if (!isBeside(other.row(static_cast<Eigen::Index>(i)))) inside.push_back(i);
  return predict(scan, someOf(rowsOf(other, inside, static_cast<int>(inside.size())), random));
}

std::vector<ShapeFile> scanFiles(const std::filesystem::path& scans) {
  const std::filesystem::path data = std::filesystem::path(TUFTED_DATA_DIR) / "clouds";
  std::vector<ShapeFile> files;
  for (const char* name : {"learn12.pcd", "learn20.pcd", "learn31.pcd", "samp11-utm.pcd", "samp11-utm-ground.pcd"})
    files.push_back({scans / name, Half::choosing});
  for (const char* name : {"mosd_learn0.pcd", "milk.pcd"}) files.push_back({data / name, Half::choosing});
  files.push_back({std::filesystem::path(TUFTED_CGAL_DATA_DIR) / "points_3" / "building.ply", Half::choosing});
  for (const char* name : {"capture0004.pcd", "capture0005.pcd", "rops_cloud.pcd", "samp53-utm.pcd",
                           "samp53-utm-ground.pcd", "CSite1_red2-utm.pcd"})
    files.push_back({scans / name, Half::held_out});
  for (const char* name : {"office1.pcd", "five_people.pcd"}) files.push_back({data / name, Half::held_out});
  std::erase_if(files, [](const ShapeFile& file) { return !exists(file.path); });
  return files;
}

Points finitePoints(const std::filesystem::path& path) {
  const Geometry geometry = read(path, ReadAs::cloud);
  Points points(geometry.points.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < geometry.points.rows(); ++i)
    if (geometry.points.row(i).allFinite()) points.row(count++) = geometry.points.row(i);
  points.conservativeResize(count, 3);
  return points.rowwise() - points.colwise().mean().eval();
}

}  // namespace tufted::bench

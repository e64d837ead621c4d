// Small clouds and soups of triangles against the plainest code for each step.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "attacks/dense_oracle.h"
#include "attacks/odd_inputs.h"
#include "base/scaling.h"
#include "stars/offsets.h"
#include "stars/tangent_frame.h"
#include "support/cloud_stars.h"
#include "tufted/laplacian.h"

namespace tufted::attacks {
namespace {

using Link = std::set<std::array<int, 2>>;

/// With a larger tolerance a comparison says nothing.
constexpr double most_tolerance = 1e-2;
/// The share by which two numbers that are compared with each other may differ by rounding.
constexpr double rounding = 1e-9;
bool isNear(double a, double b) {
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

/// How many comparisons there were, and how many had to be left out.
struct Tally {
  int stars = 0, doubtful = 0, matrices = 0, flipped = 0, areas = 0;
  int endless = 0, lengthened = 0, thin = 0;

  std::string text() const {
    const auto number = [](const char* name, int count) { return std::string(name) + std::to_string(count); };
    return number("stars ", stars) + number(", doubtful ", doubtful) + number(", L ", matrices) +
           number(", with flips ", flipped) + number(", M ", areas) + number("; left out: thin ", thin) +
           number(", lengthened ", lengthened) + number(", endless ", endless);
  }
};

/// The star of each point by all-pairs distances, Eigen's eigenvectors and CGAL's triangulation.
class PlainStars {
 public:
  PlainStars(const RankedCloud& cloud, int k, const SurfaceStars& built)
      : points_(cloud.points.all()), k_(std::min(k, cloud.size() - 1)), built_(built) {
    for (int p = 0; p < cloud.size(); ++p) stars_.push_back(starOf(p));
  }

  struct Star {
    Link triangles;
    double fit_radius = 0;
    bool doubtful = false;
  };

  /// The star after Filter::radius.
  Star filtered(int p) const {
    Star star = stars_[p];
    if (points_.rows() <= k_ + 1) return star;
    for (auto it = star.triangles.begin(); it != star.triangles.end();) {
      const auto [a, b] = *it;
      const double radius = radiusOf(p, a, b), own = star.fit_radius;
      const double smallest = std::min({own, stars_[a].fit_radius, stars_[b].fit_radius});
      if (isNear(radius, own) || isNear(radius, 4 * smallest)) star.doubtful = true;
      star.doubtful = star.doubtful || stars_[a].doubtful || stars_[b].doubtful;
      it = radius > own || radius > 4 * smallest ? star.triangles.erase(it) : std::next(it);
    }
    return star;
  }

 private:
  std::vector<int> nearest(int p, int k) const {
    std::vector<std::pair<double, int>> all;
    for (int q = 0; q < points_.rows(); ++q)
      if (q != p) all.emplace_back((points_.row(q) - points_.row(p)).squaredNorm(), q);
    std::sort(all.begin(), all.end());
    std::vector<int> result;
    for (int i = 0; i < k; ++i) result.push_back(all[i].second);
    return result;
  }
  double distance(int p, int q) const { return (points_.row(q) - points_.row(p)).norm(); }

  Eigen::Matrix3d covariance(int p, const std::vector<int>& neighbors) const {
    Points d = Points::Zero(static_cast<Eigen::Index>(neighbors.size()) + 1, 3);
    for (std::size_t i = 0; i < neighbors.size(); ++i) d.row(i) = points_.row(neighbors[i]) - points_.row(p);
    d.rowwise() -= d.colwise().mean().eval();
    return d.transpose() * d / static_cast<double>(d.rows());
  }

  Star starOf(int p) const {
    Star star;
    int k = k_;
    std::vector<int> neighbors = nearest(p, k);
    if (neighbors.empty()) return star;
    const auto most = [&](int wanted) { return std::min(wanted, static_cast<int>(points_.rows()) - 1); };
    Eigen::Matrix3d a = covariance(p, neighbors);
    Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(a).eigenvalues();
    const auto isLine = [&] {
      if (isNear(values[1], 0.1 * values[2])) star.doubtful = true;
      return neighbors.size() < 3 || values[1] < 0.1 * values[2];
    };
    while (isLine() && most(std::min(2 * k, 8 * k_)) > k) {
      k = most(std::min(2 * k, 8 * k_));
      neighbors = nearest(p, k);
      a = covariance(p, neighbors);
      values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(a).eigenvalues();
    }
    star.fit_radius = distance(p, neighbors.back());
    EXPECT_DOUBLE_EQ(star.fit_radius, built_.support.fit_radius[p]) << "fit radius of rank " << p;
    // Where two directions are as good, any normal will do; from here on that of the library.
    const Eigen::Vector3d normal = built_.support.normals.row(p).transpose();
    EXPECT_NEAR(normal.norm(), 1, 1e-12);
    EXPECT_LE((a * normal - values[0] * normal).norm(), 1e-9 * values[2]) << "normal of rank " << p;

    TiedStar found = triangulate(p, normal, neighbors);
    if (found.closed) {
      double largest = 0;
      for (const auto& [b, c] : found.triangles) largest = std::max(largest, radiusOf(p, b, c));
      if (isNear(2 * largest, star.fit_radius)) star.doubtful = true;
      if (2 * largest > star.fit_radius && most(2 * k) > k) found = triangulate(p, normal, nearest(p, most(2 * k)));
    }
    star.doubtful = star.doubtful || found.doubtful;
    star.triangles.insert(found.triangles.begin(), found.triangles.end());
    return star;
  }

  /// Both the library and this read the same projected doubles, whose collinear points are decided exactly.
  Eigen::Vector2d project(int p, const Eigen::Vector3d& normal, int q) const {
    const Eigen::Vector3d x = tangentOf(normal), y = normal.cross(x);
    const Eigen::Vector3d d = (points_.row(q) - points_.row(p)).transpose();
    OffsetBuffer offsets;
    offsets.fill(1, [&](int) { return d.transpose().eval(); });
    PlanarOffsets planar;
    kernels().project(offsets.view(), 1, x.data(), y.data(), planar);
    EXPECT_NEAR(planar.u[0], d.dot(x), 1e-14 * d.norm());
    EXPECT_NEAR(planar.v[0], d.dot(y), 1e-14 * d.norm());
    return {planar.u[0], planar.v[0]};
  }

  TiedStar triangulate(int p, const Eigen::Vector3d& normal, const std::vector<int>& neighbors) const {
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> plane(neighbors.size(), 2);
    for (std::size_t i = 0; i < neighbors.size(); ++i) plane.row(i) = project(p, normal, neighbors[i]).transpose();
    return tiedStar(p, plane, neighbors);
  }

  double radiusOf(int p, int a, int b) const {
    const Eigen::Vector3d normal = built_.support.normals.row(p).transpose();
    const Eigen::Vector2d u = project(p, normal, a), v = project(p, normal, b);
    return u.norm() * v.norm() * (u - v).norm() / (2 * std::abs(u[0] * v[1] - u[1] * v[0]));
  }

  const Points points_;
  const int k_;
  const SurfaceStars& built_;
  std::vector<Star> stars_;
};

/// Compares L and M of the library with those of the dense code, which has the rows `input_index` in another order.
void compare(const Laplacian& l, const DenseResult& dense, const Buffer<int>& input_index, int exponent, Tally& tally) {
  const double tolerance = dense.aspect <= 100 ? 1e-10 : 1e-14 * dense.aspect * dense.aspect;
  EXPECT_LE(dense.worst_order, 1e-6);
  tally.endless += dense.is_endless ? 1 : 0;
  tally.lengthened += l.report.lengthened_edges > 0 ? 1 : 0;
  tally.thin += dense.has_flat || tolerance > most_tolerance ? 1 : 0;
  if (dense.has_flat || dense.is_endless || tolerance > most_tolerance || l.report.lengthened_edges > 0) return;
  ++tally.matrices;
  tally.flipped += dense.flips > 0 ? 1 : 0;
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(dense.L.rows(), dense.L.cols());
  VectorXd mass = VectorXd::Zero(dense.M.size());
  const Eigen::MatrixXd given(l.L);
  for (int i = 0; i < full.rows(); ++i) {
    mass[i] = std::ldexp(l.M[input_index[i]], -2 * exponent);
    for (int j = 0; j < full.cols(); ++j) full(i, j) = given(input_index[i], input_index[j]);
  }
  ASSERT_EQ((full.array() != 0).count(), (given.array() != 0).count()) << "entries of points that take no part";
  ASSERT_TRUE(full.allFinite());
  double worst = 0;
  for (int i = 0; i < full.rows(); ++i) {
    for (int j = 0; j < full.cols(); ++j) {
      const double diagonal = std::max({full(i, i), full(j, j), dense.L(i, i), dense.L(j, j)});
      if (full(i, j) != dense.L(i, j)) worst = std::max(worst, std::abs(full(i, j) - dense.L(i, j)) / diagonal);
    }
  }
  EXPECT_LE(worst, tolerance) << "L, aspect " << dense.aspect << ", " << dense.flips << " flips";
  EXPECT_NEAR(mass.sum(), dense.M.sum(), tolerance * dense.M.sum());
  if (dense.flips > 0 && dense.has_tie) return;  // either diagonal is Delaunay, and areas depend on which one is taken
  ++tally.areas;
  for (int i = 0; i < mass.size(); ++i)
    EXPECT_NEAR(mass[i], dense.M[i], tolerance * std::max(mass[i], dense.M[i])) << "M of row " << i;
}

void compareCloud(const Points& points, int k, Tally& tally) {
  CloudOptions options = cloudOptions(Preset::clean);
  options.neighbors = k;
  options.mollify = 0;
  options.threads = 1;
  const support::CloudStars library = support::starsOf(points, options);
  const RankedCloud& cloud = library.cloud;
  const Stars& stars = library.built.stars;
  const Points ranked = cloud.points.all();
  for (int p = 0; p < cloud.size(); ++p)
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(std::ldexp(ranked(p, axis), cloud.exponent), points(cloud.input_index[p], axis));

  std::vector<StarTriangle> triangles;
  std::vector<Link> links(cloud.size());
  for (int p = 0; p < cloud.size(); ++p) {
    for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
      if (!stars.hasTriangle(i)) continue;
      const int a = stars.link[i], b = stars.link[stars.after(p, i)];
      triangles.push_back({{p, a, b}, p});
      links[p].insert({a, b});
    }
  }
  if (cloud.size() > 1) {
    const PlainStars plain(cloud, k, library.built);
    for (int p = 0; p < cloud.size(); ++p) {
      const PlainStars::Star star = plain.filtered(p);
      ++(star.doubtful ? tally.doubtful : tally.stars);
      if (star.doubtful) continue;
      EXPECT_EQ(links[p], star.triangles) << "star of rank " << p << " of " << cloud.size();
    }
  }
  const DenseResult dense = denseLaplacian(ranked, triangles, 1.0 / 6);
  compare(pointCloudLaplacian(points, options), dense, cloud.input_index, cloud.exponent, tally);
}

TEST(DenseOracle, CloudsAreThoseOfThePlainCode) {
  Tally tally;
  for (int i = 0; i < rounds(200); ++i) {
    SCOPED_TRACE("seed " + std::to_string(101 + i));
    shapes::Random random(static_cast<std::uint64_t>(i));
    compareCloud(oddCloud(static_cast<std::uint64_t>(101 + i)), i % 3 == 0 ? 3 + random.below(20) : 30, tally);
    if (HasFailure()) break;
  }
  std::puts(tally.text().c_str());
}

TEST(DenseOracle, SoupsAreThoseOfThePlainCode) {
  Tally tally;
  for (int i = 0; i < rounds(200); ++i) {
    SCOPED_TRACE("seed " + std::to_string(101 + i));
    const Soup soup = oddSoup(static_cast<std::uint64_t>(101 + i));
    MeshOptions options;
    options.threads = 1;
    std::vector<PointStatus> status;
    const Progress silent;
    const int exponent = measureScaling(soup.points, status, Workers(1, silent)).exponent;
    const Points scaled = soup.points * std::ldexp(1.0, -exponent);
    std::vector<StarTriangle> triangles;
    for (const auto& t : soup.triangles.rowwise())
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back({{t[0], t[1], t[2]}, -1});
    Buffer<int> index(soup.points.rows());
    std::iota(index.begin(), index.end(), 0);
    compare(meshLaplacian(soup.points, soup.triangles, options), denseLaplacian(scaled, triangles, 0.5), index,
            exponent, tally);
    if (HasFailure()) break;
  }
  std::puts(tally.text().c_str());
}

}  // namespace
}  // namespace tufted::attacks

#include "bench/scan_metrics.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/disjoint_sets.h"
#include "base/stage_clock.h"
#include "bench/star_union.h"
#include "guarantees/guarantees.h"
#include "oracles/oracles.h"

namespace tufted::bench {
namespace {

using shapes::RoomSurface;

double spectrumError(const SparseMatrix& L, const VectorXd& M, const VectorXd& truth, int count) {
  const VectorXd values = oracles::smallestEigenvalues(L, M, count + 1);
  return oracles::meanRelativeError(values, truth.head(count + 1));
}

VectorXd withoutMean(const VectorXd& f, const VectorXd& M) {
  return f.array() - M.dot(f) / M.sum();
}

/// poissonError(build) for any L and M. Points of mass 0 do not count.
double poissonError(const SparseMatrix& L, const VectorXd& M, const Points& points) {
  const auto x = points.col(0).array(), y = points.col(1).array(), z = points.col(2).array();
  constexpr double eigenvalue = 3 * 4;
  const VectorXd expected = withoutMean(x * y * z, M);
  // The right side sums to 0, so doubling one diagonal entry makes u = 0 there; empty rows also get u = 0.
  SparseMatrix pinned = L;
  Eigen::Index pin = -1;
  for (Eigen::Index i = 0; i < L.rows(); ++i) {
    const double diagonal = L.coeff(i, i);
    if (diagonal == 0) pinned.coeffRef(i, i) = 1;
    if (diagonal != 0 && pin < 0) pinned.coeffRef(pin = i, i) += diagonal;
  }
  const Eigen::SimplicialLDLT<SparseMatrix> factor(pinned);
  if (factor.info() != Eigen::Success) return shapes::unknown;
  const VectorXd u = withoutMean(factor.solve(M.cwiseProduct(eigenvalue * expected)), M);
  const VectorXd error = u - expected;
  return std::sqrt(error.cwiseAbs2().dot(M) / expected.cwiseAbs2().dot(M));
}

std::optional<ScanStructure> structureOf(const Sample& sample, Neighbors neighbors) {
  const shapes::Cloud& cloud = sample.cloud;
  if (neighbors == Neighbors::searched) return std::nullopt;
  if (neighbors == Neighbors::image) return imageStructure(cloud.width, cloud.height);
  std::vector<int> ring;
  for (int i = 0; i < cloud.width * cloud.height; ++i) ring.push_back(i / cloud.width);
  return ringStructure(cloud.points, std::move(ring));
}

bool hasOneLabel(const std::vector<int>& labels, const Triangles& triangles, Eigen::Index t) {
  const int label = labels[triangles(t, 0)];
  return labels[triangles(t, 1)] == label && labels[triangles(t, 2)] == label;
}

/// Share of the area in triangles for which `isWrong(row of Build::stars())` is true.
template <class Test>
double shareOf(const Build& build, const Test& isWrong) {
  const Points& points = build.cloud().points;
  const Triangles& triangles = build.stars();
  double wrong = 0, whole = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::Vector3d a = points.row(triangles(t, 1)) - points.row(triangles(t, 0));
    const Eigen::Vector3d b = points.row(triangles(t, 2)) - points.row(triangles(t, 0));
    const double area = a.cross(b).norm();
    whole += area;
    if (isWrong(t)) wrong += area;
  }
  return wrong / whole;
}

/// 0 for the labels of floor, ceiling and walls, 1 for the box, 2 for the pole.
int bodyOf(int label) {
  if (label == static_cast<int>(RoomSurface::pole)) return 2;
  return label < static_cast<int>(RoomSurface::box_west) ? 0 : 1;
}

struct Tags {
  int rim = 0, tagged = 0, both = 0;
};

Tags countTags(const Build& build) {
  Tags tags{.rim = build.cloud().rim_points};
  const std::vector<Boundary>& boundary = build.laplacian().boundary;
  for (int i = 0; i < static_cast<int>(boundary.size()); ++i) {
    if (boundary[i] == Boundary::none) continue;
    ++tags.tagged;
    if (i < tags.rim) ++tags.both;
  }
  return tags;
}

/// Numbers of pixels of a depth image with and beside tags of one kind.
struct ImageTags {
  int truth = 0;   ///< pixels beside an edge of the kind
  int found = 0;   ///< of these, pixels that are tagged or beside a tagged pixel
  int tagged = 0;  ///< pixels with the tag
  int right = 0;   ///< of these, pixels at most two pixels from where the tag is allowed
};

/// @param edges pixels that should have the tag
/// @param allowed pixels that may have the tag
ImageTags countImageTags(const Build& build, Boundary kind, const std::vector<std::uint8_t>& edges,
                         const std::vector<std::uint8_t>& allowed) {
  const Laplacian& laplacian = build.laplacian();
  std::vector<std::uint8_t> tagged(edges.size());
  for (std::size_t i = 0; i < tagged.size(); ++i) tagged[i] = laplacian.boundary[i] == kind ? 1 : 0;
  const int width = build.cloud().width;
  const auto beside_tagged = shapes::widened(tagged, width, 1), beside_allowed = shapes::widened(allowed, width, 1);
  ImageTags tags;
  for (std::size_t i = 0; i < tagged.size(); ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    tags.truth += edges[i];
    tags.found += edges[i] & beside_tagged[i];
    tags.tagged += tagged[i];
    tags.right += tagged[i] & beside_allowed[i];
  }
  return tags;
}

/// @param kind rim or jump
ImageTags countImageTags(const Build& build, Boundary kind) {
  const shapes::ImageEdges& edges = build.sample().edges;
  if (kind == Boundary::jump) return countImageTags(build, kind, edges.jump, edges.other);
  std::vector<std::uint8_t> only_rim = edges.rim;
  const auto beside_other = shapes::widened(edges.other, build.cloud().width, 1);
  for (std::size_t i = 0; i < only_rim.size(); ++i) only_rim[i] = edges.rim[i] != 0 && beside_other[i] == 0 ? 1 : 0;
  return countImageTags(build, kind, only_rim, edges.rim);
}

}  // namespace

bool Sample::has(Neighbors neighbors) const {
  const bool is_room = !truth.inner.empty();
  return neighbors == Neighbors::searched || (cloud.height > 0 && (neighbors == Neighbors::rings) == is_room);
}

Build::Build(const Sample& sample, const Variant& variant, const Build* core)
    : sample_(sample), structure_(structureOf(sample, variant.neighbors)), options_(variant.options), core_(core) {
  if (structure_) options_.structure = &*structure_;
  if (sample.viewpoint) options_.viewpoint = &*sample.viewpoint;
  const Stopwatch watch;
  laplacian_ = pointCloudLaplacian(sample.cloud.points, options_);
  seconds_ = watch.seconds();
}

double Build::searchSeconds() const {
  double seconds = 0;
  for (const StageCost& stage : laplacian_.report.stages) {
    if (stage.name == "tree" || stage.name == "neighbors") seconds += stage.seconds;
  }
  return seconds;
}

const Triangles& Build::stars() const {
  if (!stars_) stars_ = unionOfStars(sample_.cloud.points, options_, laplacian_);
  return *stars_;
}

double spectrumError(const Build& build, int count) {
  // Every component adds an eigenvalue 0; if all are 0, the relative error is 1.
  if (build.laplacian().report.components > count) return 1;
  return spectrumError(build.laplacian().L, build.laplacian().M, build.cloud().eigenvalues, count);
}

double hullSpectrumError(const Sample& sample, int count) {
  const Points& points = sample.cloud.points;
  const auto [L, M] = oracles::cotanLaplacian(points, oracles::convexHullMesh(points));
  return spectrumError(L, M, sample.cloud.eigenvalues, count);
}

double poissonError(const Build& build) {
  return poissonError(build.laplacian().L, build.laplacian().M, build.cloud().points);
}

double hullPoissonError(const Sample& sample) {
  const Points& points = sample.cloud.points;
  const auto [L, M] = oracles::cotanLaplacian(points, oracles::convexHullMesh(points));
  return poissonError(L, M, points);
}

double areaError(const Build& build) {
  return build.laplacian().M.sum() / build.cloud().area - 1;
}

double gridAreaError(const Build& build) {
  return build.laplacian().M.sum() / build.sample().truth.area - 1;
}

double componentsOfSurfaces(const Build& build) {
  const SparseMatrix& L = build.laplacian().L;
  const std::vector<int>& labels = build.cloud().labels;
  DisjointSets sets(L.cols());
  auto components = build.laplacian().report.active;
  for (int column = 0; column < L.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(L, column); entry; ++entry) {
      const int row = static_cast<int>(entry.row());
      if (entry.value() != 0 && labels[row] == labels[column] && sets.unite(row, column)) --components;
    }
  }
  return static_cast<double>(components);
}

double closedInnerStars(const Build& build) {
  const Laplacian& laplacian = build.laplacian();
  const std::vector<std::uint8_t>& is_inner = build.sample().truth.inner;
  int inner = 0, closed = 0;
  for (std::size_t i = 0; i < is_inner.size(); ++i) {
    if (is_inner[i] == 0) continue;
    ++inner;
    if (laplacian.status[i] == PointStatus::active && laplacian.boundary[i] == Boundary::none) ++closed;
  }
  return static_cast<double>(closed) / inner;
}

double mixedBodies(const Build& build) {
  std::vector<int> bodies = build.cloud().labels;
  std::transform(bodies.begin(), bodies.end(), bodies.begin(), bodyOf);
  return shareOf(build, [&](Eigen::Index t) { return !hasOneLabel(bodies, build.stars(), t); });
}

double areaAcrossJumps(const Build& build) {
  const std::vector<int>& labels = build.cloud().labels;
  const Points& points = build.cloud().points;
  return shareOf(build, [&](Eigen::Index t) {
    for (int i = 0; i < 3; ++i) {
      const int a = build.stars()(t, i), b = build.stars()(t, (i + 1) % 3);
      if (bodyOf(labels[a]) != bodyOf(labels[b]) && shapes::crossesJump(points.row(a), points.row(b))) return true;
    }
    return false;
  });
}

double bridges(const Build& build) {
  const Triangles& triangles = build.stars();
  int count = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    if (!hasOneLabel(build.cloud().labels, triangles, t)) ++count;
  }
  return count;
}

double trianglesAcrossJumps(const Build& build) {
  constexpr double far_step = 1.05;
  const shapes::Cloud& cloud = build.cloud();
  const Triangles& triangles = build.stars();
  int count = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto [a, b, c] = std::array{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    const auto [near, far] = std::minmax({cloud.points(a, 2), cloud.points(b, 2), cloud.points(c, 2)});
    if (!(far > far_step * near)) continue;
    const bool jumps =
        shapes::jumpsBetween(cloud, a, b) || shapes::jumpsBetween(cloud, b, c) || shapes::jumpsBetween(cloud, c, a);
    count += jumps ? 1 : 0;
  }
  return count;
}

double boundaryRecall(const Build& build) {
  const Tags tags = countTags(build);
  return static_cast<double>(tags.both) / tags.rim;
}

double boundaryPrecision(const Build& build) {
  const Tags tags = countTags(build);
  return static_cast<double>(tags.both) / tags.tagged;
}

double imageRecall(const Build& build, Boundary kind) {
  const ImageTags tags = countImageTags(build, kind);
  return static_cast<double>(tags.found) / tags.truth;
}

double imagePrecision(const Build& build, Boundary kind) {
  const ImageTags tags = countImageTags(build, kind);
  return static_cast<double>(tags.right) / tags.tagged;
}

double equalColumns(const Build& build) {
  const SparseMatrix& L = build.laplacian().L;
  const SparseMatrix& reference = build.core().laplacian().L;
  const int *begin = reference.outerIndexPtr(), *columns = reference.innerIndexPtr();
  int active = 0, equal = 0;
  for (int i = 0; i < reference.outerSize(); ++i) {
    if (begin[i] == begin[i + 1]) continue;
    ++active;
    equal += std::equal(columns + begin[i], columns + begin[i + 1], L.innerIndexPtr() + L.outerIndexPtr()[i],
                        L.innerIndexPtr() + L.outerIndexPtr()[i + 1])
                 ? 1
                 : 0;
  }
  return static_cast<double>(equal) / active;
}

double equalRows(const Build& build) {
  const SparseMatrix& L = build.laplacian().L;
  const SparseMatrix& reference = build.core().laplacian().L;
  const SparseMatrix difference = L - reference;
  int active = 0, equal = 0;
  for (int column = 0; column < reference.outerSize(); ++column) {
    const double diagonal = reference.coeff(column, column);
    if (diagonal == 0) continue;
    ++active;
    double largest = 0;
    for (SparseMatrix::InnerIterator entry(difference, column); entry; ++entry) {
      largest = std::max(largest, std::abs(entry.value()));
    }
    if (largest <= 1e-6 * diagonal) ++equal;
  }
  return static_cast<double>(equal) / active;
}

double brokenPromises(const Build& build) {
  return static_cast<double>(guarantees::brokenGuarantees(build.laplacian(), build.cloud().points).size());
}

}  // namespace tufted::bench

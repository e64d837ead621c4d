// Signs of normals: towards a viewpoint, or consistent between neighbours (the problem of Hoppe et al. 1992, Section
// 3.3).
#include "tufted/normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/check_positions.h"
#include "algorithms/connected.h"
#include "algorithms/edge_contraction.h"
#include "algorithms/fine_normals.h"
#include "algorithms/signed_sets.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* normals_name = "orientedFrames";

/// Between planes that meet at less than 45 degrees, the cosine of the normals gives the sign; noise in positions does
/// not matter.
constexpr double smooth_cosine = 0.7;
/// The weight of an edge across a crease, which is less certain; an edge on a smooth surface has 1. From 0.25 to 0.8
/// the signs at all but 0.7 % of the points are the same.
constexpr double crease_share = 0.5;
/// If the `outward` of a closed component is smaller than this, its volume is rounding, and its mean normal decides.
constexpr double flat_share = 1e-6;
/// If the `outward` of an open component, whose mean normal is at least `most_mean` long, is smaller than this, the
/// mean normal decides: airborne scans have up to 0.024 of either sign, one view of a rabbit 0.1.
constexpr double flat_share_of_open = 0.05;
/// A part with fewer points than this share of the largest part of its component counts as joint.
constexpr double small_part = 0.05;
/// Rings of neighbours around disagreeing normals that count as joint between touching bodies. With 3 half of the
/// touching spheres stay joined, with 7 the holes are too large.
constexpr int joint_rings = 5;
/// The normals of a part are negated if its `outward` is below minus `body_share` (a sphere has 0.5 in size) and their
/// mean is shorter than `most_mean`: a closed surface without joints has 0, half a sphere 0.5.
constexpr double body_share = 0.1, most_mean = 0.3;

SignedEdge edgeBetween(const Points& positions, const Points& normals, int low, int high) {
  const Eigen::RowVector3d a = normals.row(low), b = normals.row(high);
  const double cosine = a.dot(b);
  if (std::abs(cosine) >= smooth_cosine) return {low, high, cosine};
  // At a crease: an arc through both points is symmetric about the plane between them.
  const Eigen::RowVector3d edge = (positions.row(high) - positions.row(low)).stableNormalized();
  const double reflected = cosine - 2 * a.dot(edge) * b.dot(edge);
  return {low, high, crease_share * (std::abs(reflected) > std::abs(cosine) ? reflected : cosine)};
}

std::vector<SignedEdge> edgesOf(const Laplacian& laplacian, const Points& normals) {
  std::vector<SignedEdge> edges;
  edges.reserve(static_cast<std::size_t>(laplacian.L.nonZeros()) / 2);
  for (int j = 0; j < laplacian.L.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(laplacian.L, j); entry && entry.row() < j; ++entry)
      if (entry.value() < 0)
        edges.push_back(edgeBetween(laplacian.positions, normals, static_cast<int>(entry.row()), j));
  }
  return edges;
}

/// For each part of the surface, how its normals point.
struct PartSides {
  std::vector<double> outward;  ///< three times the volume over area and extent; negative if normals point inwards
  std::vector<Eigen::RowVector3d> mean;  ///< mean normal by area; 0 on a closed part
};

PartSides sidesOf(const Laplacian& laplacian, const Components& components, const Points& normals) {
  const Points& positions = laplacian.positions;
  const VectorXd weights = components.weights(laplacian.M);
  // Positions are taken relative to one point and over the extent, against overflow and cancellation.
  std::vector<int> first(components.count, -1);
  std::vector<double> extent(components.count, 0);
  for (const int i : components.points) {
    int& start = first[components.of[i]];
    if (start < 0) start = i;
    double& most = extent[components.of[i]];
    most = std::max(most, (positions.row(i) / 2 - positions.row(start) / 2).cwiseAbs().maxCoeff());
  }
  const auto place = [&](int i) -> Eigen::RowVector3d {
    const int c = components.of[i];
    if (!(extent[c] > 0)) return Eigen::RowVector3d::Zero();
    return (positions.row(i) / 2 - positions.row(first[c]) / 2) / extent[c];
  };
  std::vector<Eigen::RowVector3d> center(components.count, Eigen::RowVector3d::Zero()), mean = center;
  for (const int i : components.points) {
    center[components.of[i]] += weights[i] * place(i);
    mean[components.of[i]] += weights[i] * normals.row(i);
  }
  std::vector<double> outward(components.count, 0);
  for (const int i : components.points)
    outward[components.of[i]] += weights[i] * normals.row(i).dot(place(i) - center[components.of[i]]);
  return {std::move(outward), std::move(mean)};
}

/// Whether the normals of each component must be negated: they point inwards, or away from `up` on an open one.
/// @param up null: open components that bulge are treated as closed ones
/// @param open increased by the number of open components
std::vector<bool> inwardComponents(const Laplacian& laplacian, const Components& components, const Points& normals,
                                   const Eigen::Vector3d* up, std::int64_t& open) {
  const auto [outward, mean] = sidesOf(laplacian, components, normals);
  std::vector<bool> inward(components.count);
  for (int c = 0; c < components.count; ++c) {
    Eigen::Index axis = 0;
    mean[c].cwiseAbs().maxCoeff(&axis);
    const bool is_open = mean[c].norm() >= most_mean;
    open += is_open ? 1 : 0;
    if (is_open && up != nullptr) {
      inward[c] = mean[c].dot(up->stableNormalized()) < 0;
      continue;
    }
    const double flat = is_open ? flat_share_of_open : flat_share;
    inward[c] = std::abs(outward[c]) > flat ? outward[c] < 0 : mean[c][axis] < 0;
  }
  return inward;
}

bool disagrees(const SignedEdge& edge, const Points& normals, const Points& positions) {
  return edgeBetween(positions, normals, edge.low, edge.high).alike < 0;
}

/// The parts of components outside of joints and `joint_rings` rings around them.
/// @param joint N; 1 at points whose normals disagree with a neighbour's; on return 1 at all points left out
Components partsBeside(const Laplacian& laplacian, const std::vector<SignedEdge>& edges,
                       std::vector<std::uint8_t>& joint) {
  for (int ring = 0; ring < joint_rings; ++ring) {
    const std::vector<std::uint8_t> core = joint;
    for (const SignedEdge& edge : edges) {
      if (core[edge.low] != 0) joint[edge.high] = 1;
      if (core[edge.high] != 0) joint[edge.low] = 1;
    }
  }
  DisjointSets sets(std::ssize(joint));
  for (const SignedEdge& edge : edges)
    if (joint[edge.low] == 0 && joint[edge.high] == 0) sets.unite(edge.low, edge.high);
  Components parts;
  parts.of.assign(joint.size(), -1);
  for (int i = 0; i < static_cast<int>(joint.size()); ++i) {
    if (joint[i] != 0 || laplacian.status[i] != PointStatus::active) continue;
    const int root = sets.root(i);  // first point of the part
    parts.of[i] = root == i ? parts.count++ : parts.of[root];
    parts.points.push_back(i);
  }
  return parts;
}

/// Gives the normals of joints the sign of their neighbours, ring by ring from the outside.
/// @param joint 1 at points without a sign; on return 0 at those that got one
void settleJoints(const Laplacian& laplacian, const std::vector<SignedEdge>& edges, std::vector<std::uint8_t>& joint,
                  Points& normals) {
  VectorXd alike(normals.rows());
  for (bool settles = true; settles;) {
    settles = false;
    alike.setZero();
    for (const SignedEdge& edge : edges) {
      if (joint[edge.low] == joint[edge.high]) continue;
      const int open = joint[edge.low] != 0 ? edge.low : edge.high;
      alike[open] += edgeBetween(laplacian.positions, normals, edge.low, edge.high).alike;
    }
    for (Eigen::Index i = 0; i < alike.size(); ++i) {
      if (alike[i] == 0) continue;
      if (alike[i] < 0) normals.row(i) *= -1;
      joint[i] = 0;
      settles = true;
    }
  }
}

/// Separates bodies that touch. They are one component, in which one is inside out and some neighbours disagree. A part
/// that these joints cut off and that is closed otherwise is oriented outwards.
void turnBodies(const Laplacian& laplacian, const std::vector<SignedEdge>& edges, Points& normals) {
  std::vector<std::uint8_t> joint(static_cast<std::size_t>(normals.rows()), 0);
  bool has_joint = false;
  for (const SignedEdge& edge : edges) {
    if (!disagrees(edge, normals, laplacian.positions)) continue;
    joint[edge.low] = joint[edge.high] = 1;
    has_joint = true;
  }
  if (!has_joint) return;
  const Components parts = partsBeside(laplacian, edges, joint);
  const auto [outward, mean] = sidesOf(laplacian, parts, normals);
  std::vector<std::uint8_t> turns(static_cast<std::size_t>(parts.count), 0);
  for (int c = 0; c < parts.count; ++c) turns[c] = outward[c] < -body_share && mean[c].norm() < most_mean ? 1 : 0;
  if (std::find(turns.begin(), turns.end(), 1) == turns.end()) return;
  VectorXd sizes = VectorXd::Zero(parts.count);
  for (const int i : parts.points) ++sizes[parts.of[i]];
  const Components components = findComponents(laplacian);
  VectorXd largest = VectorXd::Zero(components.count);
  for (const int i : parts.points) largest[components.of[i]] = std::max(largest[components.of[i]], sizes[parts.of[i]]);
  for (const int i : parts.points) {
    if (turns[parts.of[i]] != 0) normals.row(i) *= -1;
    joint[i] = sizes[parts.of[i]] < small_part * largest[components.of[i]] ? 1 : 0;
  }
  settleJoints(laplacian, edges, joint, normals);
}

/// Negates the normals of whole components so that they point outwards, or towards `up` on open ones.
void turnOutwards(const Laplacian& laplacian, const Eigen::Vector3d* up, Points& normals, OrientationReport& report) {
  const Components components = findComponents(laplacian);
  const std::vector<bool> inward = inwardComponents(laplacian, components, normals, up, report.open);
  for (const int i : components.points)
    if (inward[components.of[i]]) normals.row(i) *= -1;
  report.components = components.count;
}

/// Makes normals consistent between neighbours, and outwards.
void orientAlike(const Laplacian& laplacian, const OrientationOptions& options, Points& normals,
                 OrientationReport& report) {
  const Workers workers(1, options.progress);
  const std::vector<SignedEdge> edges = edgesOf(laplacian, normals);
  SignedSets sets(static_cast<int>(normals.rows()));
  contractEdges(edges, sets, workers);
  for (int i = 0; i < sets.size(); ++i)
    if (sets.isTurned(i)) normals.row(i) *= -1;
  turnOutwards(laplacian, options.up, normals, report);
  turnBodies(laplacian, edges, normals);
  for (const SignedEdge& edge : edges)
    report.disagreeing_edges += disagrees(edge, normals, laplacian.positions) ? 1 : 0;
}

}  // namespace

Frames orientedFrames(const Laplacian& laplacian, const OrientationOptions& options, OrientationReport* report) {
  return orientedFrames(laplacian, laplacian.frames, options, report);
}

Frames orientedFrames(const Laplacian& laplacian, const Frames& frames, const OrientationOptions& options,
                      OrientationReport* report) {
  checkFrames(normals_name, laplacian, frames);
  if (options.viewpoint != nullptr && !options.viewpoint->allFinite())
    throw InvalidInput(std::string(normals_name) + ": viewpoint is not finite, must be");
  if (options.up != nullptr && !(options.up->allFinite() && !options.up->isZero(0)))
    throw InvalidInput(std::string(normals_name) + ": up is 0 or not finite, must be a direction");
  const Stopwatch watch;
  OrientationReport made;
  Frames result = frames;
  const bool is_fine = laplacian.kind == Kind::cloud && frames.orientation != Orientation::given;
  if (options.viewpoint != nullptr) {
    if (is_fine) takeFineNormals(laplacian, options.threads, options.progress, result);
    const Eigen::RowVector3d viewpoint = options.viewpoint->transpose() / 2;
    for (Eigen::Index i = 0; i < result.normals.rows(); ++i) {
      if (laplacian.status[i] != PointStatus::active) continue;
      if (result.normals.row(i).dot(viewpoint - laplacian.positions.row(i) / 2) < 0) result.normals.row(i) *= -1;
    }
  } else if (laplacian.kind == Kind::mesh && frames.orientation == Orientation::given) {
    turnOutwards(laplacian, options.up, result.normals, made);  // triangles already give consistent signs
  } else {
    orientAlike(laplacian, options, result.normals, made);
    if (is_fine) takeFineNormals(laplacian, options.threads, options.progress, result);
  }
  for (Eigen::Index i = 0; i < result.normals.rows(); ++i) {
    const int source = laplacian.representative[i];
    if (laplacian.status[source] != PointStatus::active) continue;
    if (source != i) {
      result.normals.row(i) = result.normals.row(source);
      result.tangents.row(i) = result.tangents.row(source);
    } else if (result.normals.row(i).dot(frames.normals.row(i)) < 0) {
      result.tangents.row(i) *= -1;
      ++made.turned;
    }
  }
  result.orientation = options.viewpoint != nullptr ? Orientation::viewpoint : Orientation::consistent;
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return result;
}

}  // namespace tufted

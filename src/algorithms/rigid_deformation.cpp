#include "algorithms/rigid_deformation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "algorithms/local_rotations.h"
#include "algorithms/step_memory.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// A step is accepted if the energy falls by this part of force times step (Armijo's rule with the usual value, Nocedal
/// and Wright).
constexpr double least_descent = 1e-4;
/// Maximum number of halvings of a step: a direction that needs less than 1/4096 does not descend.
constexpr int most_halvings = 12;
/// The energy may rise by this part of itself, some roundings of the sum, which would decide about the last steps
/// otherwise.
constexpr double energy_rounding = 1e-14;
/// The resistance to rotation is at least this part of its mean, so that it is not 0 at points whose edges have no
/// length.
constexpr double least_resistance = 1e-6;

/// Second derivatives of the energy by the rotations, with positions fixed. A rotation about an axis perpendicular to
/// an edge of length l has w l^2, one about the edge 0; half of w l^2 is used for all axes.
SparseMatrix turningMatrix(const Laplacian& laplacian, const Components& components, const Eigen::MatrixXd& x,
                           const VectorXd& smoothing) {
  VectorXd resistance = VectorXd::Zero(x.rows()), ones = VectorXd::Zero(x.rows());
  for (const int i : components.points) {
    ones[i] = 1;
    for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry)
      if (entry.row() != i) resistance[i] -= entry.value() * (x.row(i) - x.row(entry.row())).squaredNorm() / 2;
  }
  const VectorXd means = components.sums(resistance).cwiseQuotient(components.sums(ones));
  for (const int i : components.points)
    resistance[i] = std::max(resistance[i], least_resistance * means[components.of[i]]);
  SparseMatrix A = (4 * smoothing).asDiagonal() * laplacian.L;
  A += resistance.asDiagonal();
  return A;
}

/// The largest move or, if that is more, the largest rotation angle of a step.
double lengthOf(const Eigen::MatrixXd& step) {
  return std::max(step.leftCols<3>().rowwise().norm().maxCoeff(), step.rightCols<3>().rowwise().norm().maxCoeff());
}

Pose after(Pose pose, const Eigen::MatrixXd& step) {
  for (Eigen::Index i = 0; i < step.rows(); ++i) {
    pose.places.row(i) += step.row(i).head<3>();
    const Eigen::Vector3d turn = step.row(i).tail<3>().transpose();
    const double angle = turn.norm();
    if (angle > 0) pose.rotations[i] = Eigen::AngleAxisd(angle, turn / angle) * pose.rotations[i];
  }
  return pose;
}

}  // namespace

RigidDeformation::RigidDeformation(const std::string& function, const Laplacian& laplacian, const PinnedPoints& pinned,
                                   Eigen::MatrixXd x, VectorXd smoothing, const SolverOptions& options)
    : L_(laplacian.L),
      x_(std::move(x)),
      smoothing_(std::move(smoothing)),
      places_({.function = function, .matrix = "L"}, pinned, L_, &laplacian, options),
      turns_(LinearSystem::positiveDefinite({.function = function, .matrix = "the matrix of turns"},
                                            turningMatrix(laplacian, pinned.components, x_, smoothing_), options)) {}

RigidDeformation::Evaluation RigidDeformation::evaluate(const Pose& pose, const Workers& workers) const {
  const Eigen::Index n = x_.rows();
  VectorXd energies = VectorXd::Zero(n);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(n, 6);
  workers.forBlocks("deform", n, star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto i = static_cast<int>(begin); i < end; ++i) {
      const Eigen::Matrix3d& own = pose.rotations[i];
      Eigen::RowVector3d pull = Eigen::RowVector3d::Zero();
      Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
      for (SparseMatrix::InnerIterator entry(L_, i); entry; ++entry) {
        const auto j = entry.row();
        if (j == i) continue;
        const double weight = -entry.value();
        const Eigen::Matrix3d& other = pose.rotations[j];
        const Eigen::Vector3d edge = (x_.row(i) - x_.row(j)).transpose(), turned = own * edge,
                              moved = (pose.places.row(i) - pose.places.row(j)).transpose();
        energies[i] += weight * ((moved - turned).squaredNorm() + smoothing_[i] * (own - other).squaredNorm()) / 2;
        pull += weight * (turned + other * edge - 2 * moved).transpose();
        turn += weight * (moved * turned.transpose() + 2 * smoothing_[i] * other * own.transpose());
      }
      if (places_.pinned().free[i] != 0) force.row(i).head<3>() = pull;
      force.row(i).tail<3>() << turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1);
    }
  });
  return {energies.sum(), std::move(force)};
}

Eigen::MatrixXd RigidDeformation::solve(const std::string& function, const Eigen::MatrixXd& force,
                                        const Progress& progress) const {
  Eigen::MatrixXd step = Eigen::MatrixXd::Zero(force.rows(), 6);
  int iterations = 0;
  const Eigen::MatrixXd moves = places_.solve(function, force.leftCols<3>() / 2, progress, iterations);
  for (const int i : places_.freePoints()) step.row(i).head<3>() = moves.row(i);
  step.rightCols<3>() = turns_.solve(function, force.rightCols<3>(), nullptr, progress, Refine::never);
  return step;
}

double RigidDeformation::start(const std::string& function, Pose& pose, const Workers& workers,
                               const Progress& progress) const {
  pose.rotations.assign(pose.rotations.size(), Eigen::Matrix3d::Identity());
  Eigen::MatrixXd step = solve(function, evaluate(pose, workers).force, progress);
  step.rightCols<3>().setZero();
  pose.places = after(pose, step).places;
  const Components& components = places_.pinned().components;
  std::vector<Eigen::Matrix3d> turns(components.count, Eigen::Matrix3d::Zero());
  for (const int i : components.points) turns[components.of[i]] += edgeProducts(L_, x_, pose.places, i);
  std::transform(turns.begin(), turns.end(), turns.begin(), nearestRotation);
  for (const int i : components.points) pose.rotations[i] = turns[components.of[i]];
  return lengthOf(step);
}

RigidDeformation::Result RigidDeformation::run(const std::string& function, Pose& pose, double tolerance,
                                               int max_iterations, int threads, const Progress& progress) const {
  const Workers workers(threads, progress);
  Result made = {.iterations = 1, .last_move = start(function, pose, workers, progress)};
  Evaluation now = evaluate(pose, workers);
  if (!std::isfinite(now.energy)) throw SolverFailure(function + ": a position overflows");
  StepMemory memory;
  while (!made.converged && made.iterations < max_iterations) {
    workers.report("deform", static_cast<double>(made.iterations) / max_iterations);
    ++made.iterations;
    const Eigen::MatrixXd step =
        memory.direction(now.force, [&](const Eigen::MatrixXd& force) { return solve(function, force, progress); });
    made.last_move = lengthOf(step);
    const double promised = StepMemory::product(now.force, step);
    double share = 1;
    Pose next = after(pose, step);
    Evaluation found = evaluate(next, workers);
    const auto descends = [&] {
      return found.energy <= now.energy - least_descent * share * promised + energy_rounding * now.energy;
    };
    for (int k = 0; k < most_halvings && !descends(); ++k) {
      share /= 2;
      next = after(pose, share * step);
      found = evaluate(next, workers);
    }
    made.converged = made.last_move <= tolerance;
    if (descends()) {
      memory.add(share * step, now.force - found.force);
      pose = std::move(next);
      now = std::move(found);
    } else if (memory.empty()) {
      break;
    } else {
      memory.clear();
    }
  }
  return made;
}

}  // namespace tufted

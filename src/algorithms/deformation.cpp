// Deformation by handles: as rigid as possible (Levi and Gotsman 2015), and linear (Lipman et al. 2004).
#include "tufted/deformation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/bending.h"
#include "algorithms/coincident.h"
#include "algorithms/kept_laplacian.h"
#include "algorithms/local_rotations.h"
#include "algorithms/pinned_system.h"
#include "algorithms/rigid_deformation.h"
#include "algorithms/shape_frame.h"
#include "base/number_text.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"

namespace tufted {
namespace {

constexpr const char* deformation_name = "deform";
/// Largest smoothness that is accepted. From 1e3 to 1e8 a bent mesh does not change in six digits; at 1e12 rounding
/// changes it by 0.2 %.
constexpr double most_smoothness = 1e6;

void checkOptions(const std::string& function, const DeformationOptions& options) {
  requireChoice(options.method, DeformationMethod::linear, function, "method");
  if (!(options.smoothness >= 0 && std::isfinite(options.smoothness)))
    throw InvalidInput(function + ": smoothness = " + numberText(options.smoothness) +
                       ", must be finite and at least 0");
  if (options.smoothness > most_smoothness)
    throw InvalidInput(function + ": smoothness = " + numberText(options.smoothness) + ", must be at most " +
                       numberText(most_smoothness));
  if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
    throw InvalidInput(function + ": tolerance = " + numberText(options.tolerance) + ", must be finite and above 0");
  if (options.max_iterations < 1)
    throw InvalidInput(function + ": max_iterations = " + std::to_string(options.max_iterations) +
                       ", must be at least 1");
}

void checkTargets(const std::vector<int>& handles, const PointsRef& targets) {
  if (targets.rows() != std::ssize(handles))
    throw InvalidInput(std::string(deformation_name) + ": targets has " + std::to_string(targets.rows()) +
                       " rows, must have " + std::to_string(handles.size()) + ", one per handle");
  for (Eigen::Index k = 0; k < targets.rows(); ++k)
    if (!targets.row(k).allFinite())
      throw InvalidInput(std::string(deformation_name) + ": the target of point " + std::to_string(handles[k]) +
                         " is not finite, must be");
}

}  // namespace

struct DeformationSolver::State {
  Laplacian laplacian;
  std::vector<int> handles;
  DeformationOptions options;
  Points positions;
  ShapeFrame frame;
  Eigen::MatrixXd x;  ///< N x 3 positions, in `frame`
  std::optional<RigidDeformation> rigid;
  std::optional<InterpolationSolver> linear;
  PinnedPoints pinned;

  State(const std::string& function, const Laplacian& given, std::vector<int> points, const DeformationOptions& chosen)
      : laplacian(keptLaplacian(given)),
        handles(std::move(points)),
        options(chosen),
        positions(given.positions),
        frame(function, given),
        x(frame.toFrame(given.positions)),
        pinned(pinnedPoints(function, laplacian, handles, "handles")) {
    checkOptions(function, options);
    if (options.method == DeformationMethod::as_rigid_as_possible) {
      const VectorXd areas = pinned.components.sums(laplacian.M);
      VectorXd smoothing = VectorXd::Zero(x.rows());
      for (const int i : pinned.components.points)
        smoothing[i] = options.smoothness * frame.areaToFrame(areas[pinned.components.of[i]]);
      rigid.emplace(function, laplacian, pinned, x, std::move(smoothing), options.solver);
    } else {
      linear.emplace(given, handles, Interpolation::biharmonic, options.solver);
    }
    options.solver.progress = {};
  }

  double stretchOf(const Pose& pose) const {
    double differences = 0, lengths = 0;
    for (const int i : pinned.components.points) {
      if (pinned.free[i] == 0 && pinned.pinned[i] == 0) continue;
      for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry) {
        const auto j = entry.row();
        if (j == i) continue;
        const Eigen::Vector3d edge = (x.row(i) - x.row(j)).transpose(),
                              wanted = (pose.rotations[i] + pose.rotations[j]) * edge / 2;
        differences -= entry.value() * (pose.places.row(i) - pose.places.row(j) - wanted.transpose()).squaredNorm();
        lengths -= entry.value() * edge.squaredNorm();
      }
    }
    return lengths > 0 ? std::sqrt(differences / lengths) : 0;
  }

  void deformRigidly(const Eigen::MatrixXd& at_handles, double longest_way, const Progress& progress, Pose& pose,
                     DeformationReport& made) const {
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      if (pinned.pinned[i] != 0) pose.places.row(i) = at_handles.row(i);
    const RigidDeformation::Result result = rigid->run(deformation_name, pose, options.tolerance * longest_way,
                                                       options.max_iterations, options.solver.threads, progress);
    made.iterations = result.iterations;
    made.last_move = frame.toCaller(result.last_move);
    made.converged = result.converged;
  }

  void deformLinearly(const Eigen::MatrixXd& targets, const Progress& progress, Pose& pose,
                      DeformationReport& made) const {
    const Workers workers(options.solver.threads, progress);
    const auto take = [&](const Eigen::MatrixXd& found, bool is_difference) {
      for (const int i : pinned.components.points)
        if (pinned.free[i] != 0 || pinned.pinned[i] != 0)
          pose.places.row(i) =
              is_difference ? Eigen::RowVector3d(x.row(i) + found.row(i)) : Eigen::RowVector3d(found.row(i));
      pose.rotations = localRotations(laplacian.L, x, pose.places, workers);
    };
    const Eigen::MatrixXd from = x(handles, Eigen::all);
    take(linear->query(targets - from, nullptr, progress), true);
    const std::vector<int>& points = pinned.components.points;
    const VectorXd means = meanMasses(laplacian, pinned.components);
    Eigen::MatrixXd turned = Eigen::MatrixXd::Zero(x.rows(), 3);
    for (const int i : points) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry)
        if (entry.row() != i) sum += entry.value() * (x.row(entry.row()) - x.row(i)).transpose();
      const double mass = std::max(laplacian.M[i], least_mass_of_bending * means[pinned.components.of[i]]);
      if (mass > 0) turned.row(i) = (pose.rotations[i] * sum / mass).transpose();
    }
    take(linear->queryPoisson(turned, targets, nullptr, progress), false);
    made.iterations = 2;
  }

  Points deform(const PointsRef& targets, DeformationReport* report, const Progress& progress) const {
    const Stopwatch watch;
    checkTargets(handles, targets);
    DeformationReport made;
    const Eigen::MatrixXd in_frame = frame.toFrame(targets);
    const PinnedValues given = pinnedValues(laplacian, pinned, handles, in_frame);
    double longest_way = 0;
    for (const int i : pinned.components.points) {
      made.moved += pinned.free[i];
      if (pinned.pinned[i] != 0) {
        ++made.handles;
        longest_way = std::max(longest_way, (given.values.row(i) - x.row(i)).norm());
      } else if (pinned.free[i] == 0) {
        ++made.floating;
      }
    }
    if (!std::isfinite(longest_way))
      throw InvalidInput(std::string(deformation_name) +
                         ": targets lie too far away, must be finite in the surface's size");
    made.longest_way = frame.toCaller(longest_way);
    Pose pose = {x, std::vector<Eigen::Matrix3d>(static_cast<std::size_t>(x.rows()), Eigen::Matrix3d::Identity())};
    if (longest_way > 0) {
      if (rigid)
        deformRigidly(given.values, longest_way, progress, pose, made);
      else
        deformLinearly(in_frame, progress, pose, made);
      made.stretch = stretchOf(pose);
    }
    Eigen::MatrixXd result = positions;
    for (Eigen::Index i = 0; longest_way > 0 && i < result.rows(); ++i)
      if (pinned.free[i] != 0) result.row(i) = frame.toCaller(Eigen::RowVector3d(pose.places.row(i)));
    const PinnedValues exact = pinnedValues(laplacian, pinned, handles, targets);
    for (const int i : pinned.components.points)
      if (pinned.pinned[i] != 0) result.row(i) = exact.values.row(i);
    copyToCoincident(laplacian, result);
    made.seconds = watch.seconds();
    if (report != nullptr) *report = made;
    return result;
  }
};

Points deform(const Laplacian& laplacian, const std::vector<int>& handles, const PointsRef& targets,
              const DeformationOptions& options, DeformationReport* report) {
  const Stopwatch watch;
  checkTargets(handles, targets);
  const DeformationSolver solver(laplacian, handles, options);
  Points result = solver.query(targets, report, options.solver.progress);
  if (report != nullptr) report->seconds = watch.seconds();
  return result;
}

DeformationSolver::DeformationSolver(const Laplacian& laplacian, std::vector<int> handles,
                                     const DeformationOptions& options) {
  state_ = std::make_unique<const State>(deformation_name, laplacian, std::move(handles), options);
}

Points DeformationSolver::query(const PointsRef& targets, DeformationReport* report, const Progress& progress) const {
  return state_->deform(targets, report, progress);
}

}  // namespace tufted

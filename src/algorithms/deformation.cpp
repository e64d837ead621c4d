// Surfaces that follow their handles: as rigid as possible (Sorkine and Alexa 2007), and linear (Lipman et al. 2004).
#include "tufted/deformation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/bending.h"
#include "algorithms/coincident.h"
#include "algorithms/local_rotations.h"
#include "algorithms/pinned_solver.h"
#include "algorithms/shape_frame.h"
#include "base/number_text.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"

namespace tufted {
namespace {

constexpr const char* function_name = "deform";

using Rotations = std::vector<Eigen::Matrix3d>;

void checkOptions(const std::string& function, const DeformationOptions& options) {
  if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
    throw InvalidInput(function + ": tolerance = " + numberText(options.tolerance) + ", must be finite and above 0");
  if (options.max_iterations < 1)
    throw InvalidInput(function + ": max_iterations = " + std::to_string(options.max_iterations) +
                       ", must be at least 1");
}

void checkTargets(const std::vector<int>& handles, const PointsRef& targets) {
  if (targets.rows() != std::ssize(handles))
    throw InvalidInput(std::string(function_name) + ": targets has " + std::to_string(targets.rows()) +
                       " rows, must have " + std::to_string(handles.size()) + ", one per handle");
  for (Eigen::Index k = 0; k < targets.rows(); ++k)
    if (!targets.row(k).allFinite())
      throw InvalidInput(std::string(function_name) + ": the target of point " + std::to_string(handles[k]) +
                         " is not finite, must be");
}

}  // namespace

struct DeformationSolver::State {
  std::shared_ptr<const Laplacian> laplacian;
  std::vector<int> handles;
  DeformationOptions options;
  ShapeFrame frame;
  Eigen::MatrixXd x;  ///< N x 3, in the frame
  std::optional<PinnedSolver> rigid;
  std::optional<InterpolationSolver> linear;
  PinnedPoints pinned;

  State(const std::string& function, std::shared_ptr<const Laplacian> given, std::vector<int> points,
        const DeformationOptions& chosen)
      : laplacian(std::move(given)),
        handles(std::move(points)),
        options(chosen),
        frame(function, *laplacian),
        x(frame.toFrame(laplacian->positions)),
        pinned(pinnedPoints(function, *laplacian, handles, "handles")) {
    checkOptions(function, options);
    if (options.method == DeformationMethod::as_rigid_as_possible) {
      const SystemNames names = {.function = function, .matrix = "L"};
      rigid.emplace(names, pinned, laplacian->L, laplacian.get(), options.solver);
    } else {
      linear.emplace(laplacian, handles, Interpolation::biharmonic, options.solver);
    }
    options.solver.progress = {};
  }

  /// Row i of minus the sum over neighbours of the edges as the neighbourhoods at both ends turn them.
  template <class Visit>
  void forEdges(int i, const Rotations& rotations, const Visit& visit) const {
    for (SparseMatrix::InnerIterator entry(laplacian->L, i); entry; ++entry) {
      const int j = static_cast<int>(entry.row());
      if (j == i) continue;
      const Eigen::Vector3d edge = (x.row(i) - x.row(j)).transpose();
      visit(-entry.value(), j, Eigen::RowVector3d(((rotations[i] + rotations[j]) * edge / 2).transpose()));
    }
  }

  /// What is missing at the free points so that the edges are as the neighbourhoods turn them.
  Eigen::MatrixXd missing(const Eigen::MatrixXd& moved, const Rotations& rotations, const Workers& workers) const {
    constexpr std::int64_t block_size = 4096;
    Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(x.rows(), 3);
    workers.forBlocks("deform", x.rows(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
      for (auto i = static_cast<int>(begin); i < end; ++i) {
        if (pinned.free[i] == 0) continue;
        forEdges(i, rotations, [&](double weight, int j, const Eigen::RowVector3d& wanted) {
          rest.row(i) += weight * (wanted - (moved.row(i) - moved.row(j)));
        });
      }
    });
    return rest;
  }

  double stretchOf(const Eigen::MatrixXd& moved, const Rotations& rotations) const {
    double differences = 0, lengths = 0;
    for (const int i : pinned.components.points) {
      if (pinned.free[i] == 0 && pinned.pinned[i] == 0) continue;
      forEdges(i, rotations, [&](double weight, int j, const Eigen::RowVector3d& wanted) {
        differences += weight * (moved.row(i) - moved.row(j) - wanted).squaredNorm();
        lengths += weight * (x.row(i) - x.row(j)).squaredNorm();
      });
    }
    return lengths > 0 ? std::sqrt(differences / lengths) : 0;
  }

  void deformRigidly(const Eigen::MatrixXd& at_handles, double longest_way, const Progress& progress,
                     Eigen::MatrixXd& moved, Rotations& rotations, DeformationReport& made) const {
    const Workers workers(options.solver.threads, progress);
    for (Eigen::Index i = 0; i < moved.rows(); ++i)
      if (pinned.pinned[i] != 0) moved.row(i) = at_handles.row(i);
    made.converged = false;
    // The first solve, without rotations, adds the harmonic displacement.
    while (made.iterations < options.max_iterations && !made.converged) {
      workers.report("deform", static_cast<double>(made.iterations) / options.max_iterations);
      int iterations = 0;
      const Eigen::MatrixXd step =
          rigid->solve(function_name, missing(moved, rotations, workers), progress, iterations);
      double farthest = 0;
      for (const int i : rigid->freePoints()) {
        moved.row(i) += step.row(i);
        farthest = std::max(farthest, step.row(i).norm());
      }
      if (!std::isfinite(farthest)) throw SolverFailure(std::string(function_name) + ": a position overflows");
      rotations = localRotations(laplacian->L, x, moved, workers);
      ++made.iterations;
      made.last_move = frame.toCaller(farthest);
      made.converged = made.iterations > 1 && farthest <= options.tolerance * longest_way;
    }
  }

  void deformLinearly(const Eigen::MatrixXd& targets, const Progress& progress, Eigen::MatrixXd& moved,
                      Rotations& rotations, DeformationReport& made) const {
    const Workers workers(options.solver.threads, progress);
    const auto take = [&](const Eigen::MatrixXd& found, bool is_difference) {
      for (const int i : pinned.components.points)
        if (pinned.free[i] != 0 || pinned.pinned[i] != 0)
          moved.row(i) = is_difference ? Eigen::RowVector3d(x.row(i) + found.row(i)) : Eigen::RowVector3d(found.row(i));
    };
    const Eigen::MatrixXd from = x(handles, Eigen::all);
    take(linear->interpolate(targets - from, nullptr, progress), true);
    rotations = localRotations(laplacian->L, x, moved, workers);
    const std::vector<int>& points = pinned.components.points;
    const double mean = meanMass(*laplacian, points);
    Eigen::MatrixXd turned = Eigen::MatrixXd::Zero(x.rows(), 3);
    for (const int i : points) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (SparseMatrix::InnerIterator entry(laplacian->L, i); entry; ++entry)
        if (entry.row() != i) sum += entry.value() * (x.row(entry.row()) - x.row(i)).transpose();
      const double mass = std::max(laplacian->M[i], least_mass_of_bending * mean);
      if (mass > 0) turned.row(i) = (rotations[i] * sum / mass).transpose();
    }
    take(linear->poisson(turned, targets, nullptr, progress), false);
    rotations = localRotations(laplacian->L, x, moved, workers);
    made.iterations = 2;
  }

  Points deform(const PointsRef& targets, DeformationReport* report, const Progress& progress) const {
    const Stopwatch watch;
    checkTargets(handles, targets);
    DeformationReport made;
    const Eigen::MatrixXd in_frame = frame.toFrame(targets);
    const PinnedValues given = pinnedValues(*laplacian, pinned, handles, in_frame);
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
      throw InvalidInput(std::string(function_name) +
                         ": targets lie too far away, must be finite in the surface's size");
    made.longest_way = frame.toCaller(longest_way);
    Eigen::MatrixXd moved = x;
    Rotations rotations(static_cast<std::size_t>(x.rows()), Eigen::Matrix3d::Identity());
    if (longest_way > 0) {
      if (rigid)
        deformRigidly(given.values, longest_way, progress, moved, rotations, made);
      else
        deformLinearly(in_frame, progress, moved, rotations, made);
      made.stretch = stretchOf(moved, rotations);
    }
    Eigen::MatrixXd result = laplacian->positions;
    for (Eigen::Index i = 0; longest_way > 0 && i < result.rows(); ++i)
      if (pinned.free[i] != 0) result.row(i) = frame.toCaller(Eigen::RowVector3d(moved.row(i)));
    const PinnedValues exact = pinnedValues(*laplacian, pinned, handles, targets);
    for (const int i : pinned.components.points)
      if (pinned.pinned[i] != 0) result.row(i) = exact.values.row(i);
    copyToCoincident(*laplacian, result);
    made.seconds = watch.seconds();
    if (report != nullptr) *report = made;
    return result;
  }
};

Points deform(const Laplacian& laplacian, const std::vector<int>& handles, const PointsRef& targets,
              const DeformationOptions& options, DeformationReport* report) {
  const Stopwatch watch;
  checkTargets(handles, targets);
  // Borrowed for this call.
  const DeformationSolver solver({std::shared_ptr<const void>(), &laplacian}, handles, options);
  Points result = solver.deform(targets, report, options.solver.progress);
  if (report != nullptr) report->seconds = watch.seconds();
  return result;
}

DeformationSolver::DeformationSolver(std::shared_ptr<const Laplacian> laplacian, std::vector<int> handles,
                                     const DeformationOptions& options) {
  if (laplacian == nullptr) throw InvalidInput("DeformationSolver: laplacian is null, must not be");
  state_ = std::make_unique<const State>(function_name, std::move(laplacian), std::move(handles), options);
}

Points DeformationSolver::deform(const PointsRef& targets, DeformationReport* report, const Progress& progress) const {
  return state_->deform(targets, report, progress);
}

DeformationSolver::DeformationSolver(DeformationSolver&&) noexcept = default;
DeformationSolver& DeformationSolver::operator=(DeformationSolver&&) noexcept = default;
DeformationSolver::~DeformationSolver() = default;

}  // namespace tufted

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/boolean_shapes.h"
#include "bench/cotan_weights.h"
#include "bench/tables.h"
#include "shapes/shapes.h"
#include "tufted/deformation.h"

namespace tufted::bench {
namespace {

/// A motion of one face of a solid, while another one stays in place.
struct Edit {
  const char* name;
  double angle;
  Eigen::Vector3d axis;
  Eigen::RowVector3d shift;
};
const std::vector<Edit> edits = {{"twisted by 30 degrees", M_PI / 6, Eigen::Vector3d::UnitZ(), {0, 0, 0}},
                                 {"bent by 45 degrees", M_PI / 4, Eigen::Vector3d::UnitY(), {0, 0, 0}},
                                 {"shifted", 0, Eigen::Vector3d::UnitY(), {0.4, 0, 0.2}}};

struct Method {
  const char* name;
  DeformationOptions options;
};
const std::vector<Method> methods = {
    {"rigid", {}}, {"rigid --smoothness 0", {.smoothness = 0}}, {"linear", {.method = DeformationMethod::linear}}};

/// A face that stays and one that moves.
struct Handles {
  Plane stays, moves;
  Eigen::RowVector3d centre;  ///< centre of rotation
};

/// @param points vertices of a mesh of the solid
Handles handlesOf(const Points& points, const Plane& stays, const Plane& moves) {
  const Points face = points(pointsIn(moves, points), Eigen::all);
  return {stays, moves, face.colwise().maxCoeff() / 2 + face.colwise().minCoeff() / 2};
}

/// The displacement of each point, N x 3.
Points displacement(const Laplacian& laplacian, const Handles& handles, const Edit& edit,
                    const DeformationOptions& options, double* longest_way = nullptr) {
  const Points& points = laplacian.positions;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(edit.angle, edit.axis).toRotationMatrix();
  std::vector<int> held = pointsIn(handles.stays, points);
  const std::vector<int> moving = pointsIn(handles.moves, points);
  Points targets(std::ssize(held) + std::ssize(moving), 3);
  targets << points(held, Eigen::all),
      ((points(moving, Eigen::all).rowwise() - handles.centre) * turn.transpose()).rowwise() +
          (handles.centre + edit.shift);
  held.insert(held.end(), moving.begin(), moving.end());
  DeformationReport report;
  const Points moved = deform(laplacian, held, targets, options, &report);
  if (longest_way != nullptr) *longest_way = report.longest_way;
  return moved - points;
}

/// Distances of results from a reference, in units of the longest way of a handle.
struct Difference {
  double mean = 0, farthest = 0;  ///< mean and greatest over points, of the worst result

  /// @param made computes a result; if it throws, as with cotan weights, the distance is infinite
  void take(const Points& reference, double longest_way, const std::function<Points()>& made) {
    VectorXd lengths = VectorXd::Constant(reference.rows(), HUGE_VAL);
    try {
      lengths = (made() - reference).rowwise().norm() / longest_way;
    } catch (const std::exception&) {
    }
    mean = std::max(mean, lengths.mean());
    farthest = std::max(farthest, lengths.maxCoeff());
  }
};

void printSlivers() {
  std::printf(
      "| solid | edit of its top | `deform --method` | slivers, farthest, in the handles' way | cotan, the same |\n"
      "|---|---|---|---|---|\n");
  for (const bool is_prism : {false, true}) {
    const auto solid = [&](shapes::Quality quality) {
      return is_prism ? shapes::prismMesh(20, quality, first_seed) : shapes::cubeMesh(20, quality, first_seed);
    };
    const shapes::Mesh good = solid(shapes::Quality::good), bad = solid(shapes::Quality::bad);
    const double top = good.points.col(2).maxCoeff();
    const Handles handles = handlesOf(good.points, {Eigen::Vector3d::UnitZ(), 0}, {Eigen::Vector3d::UnitZ(), -top});
    const Laplacian reference = meshLaplacian(good.points, good.triangles),
                    ours = meshLaplacian(bad.points, bad.triangles), cotan = withCotan(ours, bad.points, bad.triangles);
    for (const Edit& edit : edits) {
      for (const auto& [name, options] : methods) {
        double way = 0;
        const Points wanted = displacement(reference, handles, edit, options, &way);
        Difference by_ours, by_cotan;
        by_ours.take(wanted, way, [&] { return displacement(ours, handles, edit, options); });
        by_cotan.take(wanted, way, [&] { return displacement(cotan, handles, edit, options); });
        std::printf("| %s | %s | `%s` | %.1e | %.2g |\n", is_prism ? "prism" : "cube", edit.name, name,
                    by_ours.farthest, by_cotan.farthest);
      }
    }
  }
}

void printBooleans() {
  std::printf(
      "| boolean result | edit | `deform --method` | from its remeshing, %%, mean / farthest | cotan, the same |\n"
      "|---|---|---|---|---|\n");
  const std::vector<std::function<BooleanSolid(std::uint64_t)>> solids = {
      [](std::uint64_t seed) { return cubeAndBall(true, seed); },
      [](std::uint64_t seed) { return cubeAndBall(false, seed); }, cubeAndPost};
  for (const auto& solid : solids) {
    std::string name;
    std::vector<std::vector<Difference>> by_ours(edits.size(), std::vector<Difference>(methods.size()));
    std::vector<std::vector<Difference>> by_cotan = by_ours;
    for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
      const BooleanSolid made = solid(seed);
      name = made.name;
      const BooleanMesh &cut = made.cut, &remeshed = made.remeshed;
      const Handles handles = handlesOf(remeshed.points, made.stays, made.moves);
      const Laplacian reference = meshLaplacian(remeshed.points, remeshed.triangles),
                      ours = meshLaplacian(cut.points, cut.triangles),
                      cotan = withCotan(ours, cut.points, cut.triangles);
      for (std::size_t e = 0; e < edits.size(); ++e) {
        for (std::size_t m = 0; m < methods.size(); ++m) {
          const DeformationOptions& options = methods[m].options;
          double way = 0;
          const Points wanted =
              valuesAt(remeshed, displacement(reference, handles, edits[e], options, &way), cut.points);
          by_ours[e][m].take(wanted, way, [&] { return displacement(ours, handles, edits[e], options); });
          by_cotan[e][m].take(wanted, way, [&] { return displacement(cotan, handles, edits[e], options); });
        }
      }
    }
    for (std::size_t e = 0; e < edits.size(); ++e)
      for (std::size_t m = 0; m < methods.size(); ++m)
        std::printf("| %s | %s | `%s` | %.2f / %.2f | %.2g / %.2g |\n", name.c_str(), edits[e].name, methods[m].name,
                    100 * by_ours[e][m].mean, 100 * by_ours[e][m].farthest, 100 * by_cotan[e][m].mean,
                    100 * by_cotan[e][m].farthest);
  }
}

}  // namespace

void printHandles() {
  printSlivers();
  std::printf("\n");
  printBooleans();
}

}  // namespace tufted::bench

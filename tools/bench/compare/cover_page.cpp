// The drawing of cover_drawing.cpp as a page, which one can turn.
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/compare/cover_sheets.h"
#include "tufted/view/page.h"

namespace tufted::bench {
namespace {

using Eigen::Vector3d;

enum Part : std::uint8_t { front, back, glued, of_mesh, flipped_on_front, flipped_on_back };
const std::vector<std::string> part_names = {"front",
                                             "back",
                                             "between sides that are glued",
                                             "edge of the mesh",
                                             "flipped edge on a front",
                                             "flipped edge on a back"};

/// Polygons, each with its own corners and a label.
class Polygons {
 public:
  void add(const std::vector<Vector3d>& corners, Part part, const Vector3d& shift = Vector3d::Zero()) {
    const int first = static_cast<int>(corners_.size());
    for (const Vector3d& corner : corners) {
      corners_.emplace_back(corner + shift);
      labels_.push_back(part);
    }
    for (int k = 2; k < static_cast<int>(corners.size()); ++k) triangles_.push_back({first, first + k - 1, first + k});
  }

  Scene scene() const {
    Scene scene{.title = "A tufted cover, and its intrinsic Delaunay edges", .positions = {}};
    scene.positions.resize(std::ssize(corners_), 3);
    scene.triangles.resize(std::ssize(triangles_), 3);
    Eigen::VectorXd labels(std::ssize(corners_));
    for (Eigen::Index i = 0; i < labels.size(); ++i) {
      scene.positions.row(i) = corners_[static_cast<std::size_t>(i)];
      labels[i] = labels_[static_cast<std::size_t>(i)];
    }
    for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k) scene.triangles(t, k) = triangles_[static_cast<std::size_t>(t)][k];
    scene.fields = {{.name = "part", .kind = FieldKind::label, .values = labels, .label_names = part_names}};
    return scene;
  }

 private:
  std::vector<Vector3d> corners_;
  std::vector<Part> labels_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

void writeCoverPage(const Points& points, const IntrinsicTriangulation& cover, const IntrinsicEdges& found, double size,
                    const std::filesystem::path& path) {
  Polygons polygons;
  const Sheets apart = Sheets::apart(points, cover, size), close = Sheets::close(points, cover, size);
  const double width = points.col(0).maxCoeff() - points.col(0).minCoeff();
  const Vector3d beside(1.2 * width + size, 0, 0);
  for (int f = 0; f < cover.size(); ++f) {
    const Part side = f % 2 == 0 ? front : back;
    polygons.add(apart.corners(f), side);
    polygons.add(close.corners(f), side, beside);
  }
  for (int side = 0; side < 3 * cover.size(); ++side)
    if (side <= cover.glue[static_cast<std::size_t>(side)]) polygons.add(apart.band(side), glued);
  for (const IntrinsicEdge& edge : found.edges) {
    for (const EdgePart& part : edge.parts) {
      // A strip a little above the face, wide where the mesh has no such edge.
      const Vector3d up = close.shift(part.face);
      const Vector3d across = (edge.is_flipped ? 0.012 : 0.005) * size * up.cross(part.to - part.from).normalized();
      const Part kind = !edge.is_flipped ? of_mesh : part.face % 2 == 0 ? flipped_on_front : flipped_on_back;
      polygons.add({part.from - across, part.to - across, part.to + across, part.from + across}, kind,
                   beside + 1.2 * up);
    }
  }
  writePage(path, polygons.scene());
}

}  // namespace tufted::bench

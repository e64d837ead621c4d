// Figures 2, 3, 8 and 11 of the paper for any small mesh: its tufted cover, and the intrinsic Delaunay edges on it.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "bench/compare/cover_lines.h"
#include "bench/compare/cover_sheets.h"
#include "bench/compare/tables.h"
#include "cover/geometry.h"
#include "shapes/shapes.h"
#include "tufted/io/read.h"

namespace tufted::bench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int most_drawn = 2000;  ///< more triangles than this are too small to see
constexpr double panel = 440, margin = 20;
constexpr const char* front_color = "#c8640a";
constexpr const char* back_color = "#1f4e9c";
/// Colours of the pairs around an edge, which repeat after eight.
constexpr std::array<const char*, 8> pair_colors = {"#2a8a57", "#8a3fa0", "#c9a400", "#c0392b",
                                                    "#3aa6b9", "#7a5230", "#e377c2", "#555555"};

/// Shapes in parallel projection from the front right, drawn from far to near.
class Panel {
 public:
  Panel(const Points& points, double left) : left_(left) {
    Eigen::AlignedBox2d box;
    for (Eigen::Index i = 0; i < points.rows(); ++i) box.extend(projected(points.row(i)));
    middle_ = box.center();
    scale_ = (panel - 4 * margin) / std::max(box.sizes().maxCoeff(), std::numeric_limits<double>::min());
  }

  /// @param style attributes of the element
  /// @param place by which the shape is sorted; its distance from the viewer counts
  void add(const std::vector<Vector3d>& corners, const std::string& style, const Vector3d& place) {
    std::string path;
    for (const Vector3d& corner : corners) {
      const Vector2d at = scale_ * (projected(corner) - middle_);
      char text[64];
      std::snprintf(text, sizeof text, "%s%.1f,%.1f", path.empty() ? "M " : " L ", left_ + panel / 2 + at.x(),
                    panel / 2 - at.y());
      path += text;
    }
    shapes_.emplace_back(place.dot(towards_viewer_),
                         "<path d=\"" + path + (corners.size() > 2 ? " Z" : "") + "\" " + style + "/>\n");
  }

  void write(std::ofstream& file) {
    // Lines have the place of their face, and are added later.
    std::stable_sort(shapes_.begin(), shapes_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [depth, text] : shapes_) file << text;
  }

 private:
  Vector2d projected(const Vector3d& point) const { return {point.dot(right_), point.dot(up_)}; }

  const Vector3d towards_viewer_ = Vector3d(0.14, -1, 0.5).normalized();
  const Vector3d right_ = Vector3d::UnitZ().cross(towards_viewer_).normalized();
  const Vector3d up_ = towards_viewer_.cross(right_);
  double left_, scale_ = 1;
  Vector2d middle_ = Vector2d::Zero();
  std::vector<std::pair<double, std::string>> shapes_;
};

void addFaces(const Sheets& sheets, const IntrinsicTriangulation& cover, const std::string& style, Panel& to) {
  for (int f = 0; f < cover.size(); ++f)
    to.add(sheets.corners(f), style + " fill=\"" + (f % 2 == 0 ? "#fbe9d7" : "#e3ebf7") + "\"", sheets.middle(f));
}

std::string line(const char* color, double width) {
  return "fill=\"none\" stroke-linecap=\"round\" stroke=\"" + std::string(color) + "\" stroke-width=\"" +
         std::to_string(width).substr(0, 4) + "\"";
}

/// Draws the cover: bands of one colour join two sides that are glued.
void drawCover(const Points& points, const IntrinsicTriangulation& cover, double size, Panel& to) {
  const Sheets sheets = Sheets::apart(points, cover, size);
  addFaces(sheets, cover, "stroke=\"#767676\" stroke-width=\"0.7\" fill-opacity=\"0.9\"", to);
  std::map<std::pair<int, int>, std::size_t> pairs;
  for (int side = 0; side < 3 * cover.size(); ++side) {
    const int mate = cover.glue[static_cast<std::size_t>(side)];
    if (side > mate) continue;
    const std::pair<int, int> ends = std::minmax({tail(cover, side), head(cover, side)});
    const char* const color = pair_colors[pairs[ends]++ % pair_colors.size()];
    const std::vector<Vector3d> band = sheets.band(side);
    to.add(band, line(color, 0.8) + " fill-opacity=\"0.6\" style=\"fill:" + color + "\"",
           (band[0] + band[1] + band[2] + band[3]) / 4);
  }
}

/// Draws the intrinsic edges on fronts and backs; those that the mesh does not have are wide.
void drawEdges(const Points& points, const IntrinsicTriangulation& cover, const IntrinsicEdges& found, double size,
               Panel& to) {
  const Sheets sheets = Sheets::close(points, cover, size);
  addFaces(sheets, cover, "stroke=\"#c8c8c8\" stroke-width=\"0.7\" fill-opacity=\"0.85\"", to);
  for (const IntrinsicEdge& edge : found.edges)
    for (const EdgePart& part : edge.parts)
      to.add({part.from + sheets.shift(part.face), part.to + sheets.shift(part.face)},
             line(!edge.is_flipped     ? "#222222"
                  : part.face % 2 == 0 ? front_color
                                       : back_color,
                  edge.is_flipped ? 2.2 : 0.9),
             sheets.middle(part.face));
}

void draw(const Points& points, const IntrinsicTriangulation& cover, const IntrinsicEdges& found, double size,
          const std::filesystem::path& path) {
  Panel left(points, 0), right(points, panel);
  drawCover(points, cover, size, left);
  drawEdges(points, cover, found, size, right);
  std::ofstream file(path);
  file << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << 2 * panel << "\" height=\"" << panel + 2 * margin
       << "\" font-family=\"sans-serif\" font-size=\"13\">\n<title>A tufted cover and its intrinsic Delaunay "
          "edges</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  left.write(file);
  right.write(file);
  const auto text = [&](double x, double y, const char* words) {
    file << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"middle\">" << words << "</text>\n";
  };
  text(panel / 2, panel, "The cover: fronts orange, backs blue;");
  text(panel / 2, panel + margin, "bands join sides that are glued, a colour for each pair of an edge");
  text(1.5 * panel, panel, "Intrinsic Delaunay edges: black if the mesh has them,");
  text(1.5 * panel, panel + margin, "wide if flipped, on fronts orange, on backs blue");
  file << "</svg>\n";
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

Table printCover(const Settings& settings) {
  Points points;
  Triangles triangles;
  if (settings.file.empty()) {
    const shapes::Mesh book = shapes::book(3, 2);
    points = book.points, triangles = book.triangles;
    points.col(2) += 1.5 * points.leftCols(2).rowwise().norm();  // sheared, so that triangles are obtuse
  } else {
    const Geometry geometry = read(settings.file, ReadAs::mesh);
    points = geometry.points, triangles = geometry.triangles;
  }
  if (triangles.rows() == 0 || triangles.rows() > most_drawn)
    throw std::runtime_error("the mesh has " + std::to_string(triangles.rows()) + " triangles, must have 1 to " +
                             std::to_string(most_drawn));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Vector3d a = points.row(triangles(t, 0)), b = points.row(triangles(t, 1)), c = points.row(triangles(t, 2));
    if (!((b - a).cross(c - a).norm() >
          1e-6 * std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()})))
      throw std::runtime_error("triangle " + std::to_string(t) + " is too thin to be drawn, or not finite");
  }
  const IntrinsicTriangulation cover = gluedCover(points, triangles);
  const IntrinsicEdges found = intrinsicEdges(cover, points);
  const auto flipped =
      std::count_if(found.edges.begin(), found.edges.end(), [](const auto& e) { return e.is_flipped; });
  Table table({"triangles", "faces of the cover", "edges of the cover", "flips", "edges that the mesh does not have",
               "greatest distance of a traced end from its vertex, in lengths"});
  table.row({static_cast<int>(triangles.rows()), static_cast<int>(cover.size()), static_cast<int>(found.edges.size()),
             found.flips, static_cast<int>(flipped), Cell("%.1e", found.greatest_miss)});
  double size = 0;  // the mean length of an edge
  for (const double length : cover.length) size += length / static_cast<double>(cover.length.size());
  if (!settings.picture.empty()) draw(points, cover, found, size, settings.picture);
  if (!settings.page.empty()) writeCoverPage(points, cover, found, size, settings.page);
  return table;
}

}  // namespace tufted::bench

#include "point_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

#include "options.h"
#include "tufted/errors.h"
#include "tufted/nearest_point.h"

namespace {

/// The distance from a point to its farthest neighbour.
double spacingAt(int point, const tufted::Laplacian& laplacian, const tufted::Points& points) {
  double farthest = 0;
  for (tufted::SparseMatrix::InnerIterator entry(laplacian.L, point); entry; ++entry)
    farthest = std::max(farthest, (points.row(entry.row()) - points.row(point)).norm());
  return farthest;
}

/// Notes which point is nearest to a position.
/// @param number number of the position, from 0
void addNearest(const Place& place, int point, std::size_t number, const Operator& source, Results& results) {
  constexpr std::size_t most = 10;  // most lines of the summary; the report has all
  const double distance = (source.geometry.points.row(point).transpose() - place.position).norm();
  const double spacing = spacingAt(point, source.laplacian, source.geometry.points);
  results.report["nearest"].push_back({{"position", {place.position.x(), place.position.y(), place.position.z()}},
                                       {"point", point},
                                       {"distance", distance},
                                       {"spacing", spacing}});
  if (number < most)
    results.summary.add("nearest", "point %d, %.6g from %s", source.chosen.numberOf(point), distance,
                        place.name.c_str());
  else if (number == most)
    results.summary.add("nearest", "to further positions: see report.json");
  if (distance <= spacing) return;
  if (results.warnings.size() < most)
    results.warnings.push_back(place.name + ": the nearest point, " + std::to_string(source.chosen.numberOf(point)) +
                               ", is " + numberText(distance) + " away, and its neighbours at most " +
                               numberText(spacing));
  else if (results.warnings.size() == most)
    results.warnings.emplace_back("further positions are as far from their nearest point: see report.json");
}

}  // namespace

Eigen::Vector3d parsePosition(const std::string& text, const std::string& option) {
  const std::vector<double> numbers = parseNumbers(text, option);
  if (numbers.size() != 3) throw tufted::InvalidInput(option + " " + text + " is not X,Y,Z");
  Eigen::Vector3d position(numbers[0], numbers[1], numbers[2]);
  if (!position.allFinite()) throw tufted::InvalidInput(option + " " + text + " is not finite, must be");
  return position;
}

Place placeOf(const std::vector<double>& numbers, const Operator& source, const std::string& name) {
  Place place;
  place.name = name;
  if (numbers.size() == 3) {
    place.position = {numbers[0], numbers[1], numbers[2]};
    if (!place.position.allFinite()) throw tufted::InvalidInput(name + " is not finite, must be");
  } else {
    if (numbers.size() != 1) throw tufted::InvalidInput(name + " is neither an index nor X,Y,Z");
    const auto points = std::max(source.chosen.of, static_cast<std::int64_t>(source.points()));
    if (!(numbers[0] >= 0 && numbers[0] < static_cast<double>(points) && numbers[0] == std::floor(numbers[0])))
      throw tufted::InvalidInput(name + " is no index in [0, " + std::to_string(points) + "), the number of points");
    place.index = source.chosen.rowOf(static_cast<int>(numbers[0]));
    if (place.index < 0) throw tufted::InvalidInput(name + " is a point that was not chosen, must be one that was");
  }
  return place;
}

int indexOf(const Row& row, const Operator& source) {
  if (row.numbers.size() != 1) throw tufted::IoError(row.name + ": is not INDEX");
  return placeOf(row.numbers, source, row.name).index;
}

std::vector<int> locate(const std::vector<Place>& places, const Operator& source, Results& results) {
  std::vector<int> points;
  std::vector<std::size_t> by_position;  // indices into `points` of those named by position
  for (const Place& place : places) {
    if (place.index < 0) by_position.push_back(points.size());
    points.push_back(place.index);
  }
  if (by_position.empty()) return points;
  if (source.geometry.points.rows() == 0)
    throw tufted::InvalidInput("a position needs points, and " + source.name + " has none");
  tufted::Points positions(std::ssize(by_position), 3);
  for (std::size_t k = 0; k < by_position.size(); ++k)
    positions.row(static_cast<Eigen::Index>(k)) = places[by_position[k]].position;
  const std::vector<int> nearest = tufted::nearestPoints(source.laplacian, source.geometry.points, positions);
  for (std::size_t k = 0; k < by_position.size(); ++k) {
    points[by_position[k]] = nearest[k];
    addNearest(places[by_position[k]], nearest[k], k, source, results);
  }
  return points;
}

std::vector<Place> NamedPoints::places(const Operator& source) const {
  std::vector<Place> found;
  for (const std::string& list : indices) {
    std::istringstream words(list);
    for (const double index : parseNumbers(list, "--source")) {
      std::string word;
      std::getline(words, word, ',');
      found.push_back(placeOf({index}, source, "--source " + word));
    }
  }
  for (const std::string& position : positions) {
    const std::vector<double> numbers = parseNumbers(position, "--near");
    if (numbers.size() != 3) throw tufted::InvalidInput("--near " + position + " is not X,Y,Z");
    found.push_back(placeOf(numbers, source, "--near " + position));
  }
  if (!file.empty())
    for (const Row& row : readRows(file)) found.push_back(placeOf(row.numbers, source, row.name));
  return found;
}

void requireMesh(const std::string& name, const Operator& source) {
  if (!source.geometry.is_mesh)
    throw tufted::InvalidInput(name + " applies to meshes, and " + source.name +
                               (source.geometry.points.rows() > 0 ? " is a cloud" : " has no points"));
}

tufted::SurfacePoint pointInFace(const std::vector<double>& numbers, const std::string& name, const Operator& source) {
  if (numbers.size() != 4) throw tufted::InvalidInput(name + " is not FACE,A,B,C");
  if (!(numbers[0] == std::floor(numbers[0]) && std::abs(numbers[0]) < 2e9))
    throw tufted::InvalidInput(name + ": FACE = " + numberText(numbers[0]) + ", must be the index of a triangle");
  return forOption(name, [&] {
    return tufted::SurfacePoint::inFace(source.geometry.points, source.geometry.triangles, static_cast<int>(numbers[0]),
                                        {numbers[1], numbers[2], numbers[3]});
  });
}

std::vector<tufted::SurfacePoint> pointsInFaces(const std::vector<std::string>& faces, const Operator& source) {
  if (!faces.empty()) requireMesh("--face", source);
  std::vector<tufted::SurfacePoint> points;
  for (const std::string& text : faces)
    points.push_back(pointInFace(parseNumbers(text, "--face"), "--face " + text, source));
  return points;
}

void addFaceOption(CLI::App& command, std::vector<std::string>& faces, const std::string& what) {
  command
      .add_option("--face", faces,
                  what +
                      " in triangle FACE, counted from 0, with barycentric coordinates A,B,C; may be repeated; "
                      "meshes only")
      ->allow_extra_args(false)
      ->type_name("FACE,A,B,C");
}

void addPointOptions(CLI::App& command, NamedPoints& points, const std::string& what) {
  command.add_option("--source", points.indices, what + ": indices in FILE, counted from 0")
      ->allow_extra_args(false)  // the next word may be FILE
      ->type_name("I,J,...");
  command.add_option("--near", points.positions, what + ": the point nearest to this position; may be repeated")
      ->allow_extra_args(false)
      ->type_name("X,Y,Z");
  addText(command, "--sources TEXT", points.file, what + ": text file of lines INDEX or X Y Z");
}

namespace {

/// Why a point takes no part, with its row in the results; an empty string if it does.
std::string whyLeftOut(int point, const Operator& source) {
  const tufted::Laplacian& laplacian = source.laplacian;
  const tufted::PointStatus status = laplacian.status[laplacian.representative[point]];
  if (status == tufted::PointStatus::active) return "";
  const std::string name = "point " + std::to_string(point);
  if (status == tufted::PointStatus::not_finite) return name + " is not finite";
  const bool is_excluded = !source.all_components.empty() && source.all_components[point] >= 0;
  return name + (is_excluded ? " lies on a component that " + source.chosen_by + " leaves out" : " is isolated");
}

}  // namespace

void noteLeftOut(const std::vector<int>& points, const Operator& source, Results& results, bool others) {
  constexpr std::size_t most = 3;  // most reasons in the warning; the report has all points
  std::vector<int> left_out;
  std::string why;
  for (const int point : points) {
    const std::string reason = whyLeftOut(point, source);
    if (reason.empty()) continue;
    if (left_out.size() < most) why += (why.empty() ? "" : ", ") + reason;
    left_out.push_back(point);
  }
  if (left_out.empty()) return;
  if (left_out.size() > most) why += " and so on, see report.json";
  if (left_out.size() == points.size() && !others)
    throw tufted::InvalidInput("no point that is named takes part, must be at least one: " + why);
  const std::string count = std::to_string(left_out.size()) + " of " + std::to_string(points.size());
  results.warnings.push_back(count + " points that are named take no part: " + source.chosen.inFile(why));
  results.summary.add("left out", "%s points that are named", count.c_str());
  results.report["left_out"] = left_out;
}

void requireTakingPart(const std::vector<int>& points, const Operator& source) {
  for (const int point : points)
    if (const std::string why = whyLeftOut(point, source); !why.empty())
      throw tufted::InvalidInput(why + ", must take part");
}

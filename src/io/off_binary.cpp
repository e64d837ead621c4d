#include "io/off_binary.h"

// CGAL prints before it throws for a failed assertion: w = 0 in a homogeneous vertex is data, and gives infinity.
#define CGAL_NO_ASSERTIONS
#include <CGAL/IO/OFF.h>
#include <CGAL/Simple_cartesian.h>

#include <iterator>
#include <sstream>
#include <stdexcept>

#include "io/columns.h"
#include "io/errors.h"
#include "io/polygon_soup.h"

namespace tufted::io {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

/// The corners of a polygon. CGAL sizes it by the count it reads, before it looks for the corners.
struct Corners : std::vector<int> {
  void resize(std::size_t count) {
    constexpr std::size_t most = std::size_t{1} << 24;
    if (count > most) throw std::length_error("a face of " + std::to_string(count) + " corners");
    std::vector<int>::resize(count);
  }
};

/// CGAL makes room for as many vertices and faces as the header counts.
void checkSize(const std::filesystem::path& path, std::istream& stream, std::size_t bytes) {
  const CGAL::File_scanner_OFF header(stream);
  if (!stream) refuse(path, "the header is not that of an OFF file");
  const std::size_t vertices = header.size_of_vertices(), faces = header.size_of_facets();
  // Three floats and one count.
  const std::size_t vertex_bytes = 12, face_bytes = 4;
  if (vertices > bytes / vertex_bytes + 1 || faces > bytes / face_bytes + 1 ||
      vertices * vertex_bytes + faces * face_bytes > bytes)
    refuse(path, "too short for the " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                     " faces of its header");
  if (header.n_dimensional()) refuse(path, "nOFF (other dimensions than 3) is not supported");
}

template <class Triples>
Points toPoints(const Triples& triples) {
  Points points(static_cast<Eigen::Index>(triples.size()), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) << triples[i].x(), triples[i].y(), triples[i].z();
  return points;
}

}  // namespace

Geometry readBinaryOff(const std::filesystem::path& path, std::string bytes, std::size_t body) {
  // Behind the counts of vertices and faces stands that of edges, which nobody needs and CGAL doubles into an overflow.
  if (bytes.size() >= body + 12) bytes.replace(body + 8, 4, 4, '\0');
  std::istringstream stream(std::move(bytes));
  checkSize(path, stream, stream.view().size());
  stream.clear();
  stream.seekg(0);
  std::vector<Kernel::Point_3> points;
  std::vector<Kernel::Vector_3> normals;
  std::vector<Corners> corners;
  bool complete = false;
  std::string reason = "no complete OFF";
  try {
    complete = CGAL::IO::read_OFF(stream, points, corners,
                                  CGAL::parameters::vertex_normal_output_iterator(std::back_inserter(normals)));
  } catch (const std::length_error& error) {
    reason = error.what();
  }
  if (!complete) {
    stream.clear();
    refuseByte(path, static_cast<std::size_t>(stream.tellg()), reason + " up to there");
  }
  Geometry geometry;
  geometry.width = static_cast<int>(checkedRows(path, static_cast<std::int64_t>(points.size())));
  geometry.points = toPoints(points);
  if (normals.size() == points.size()) geometry.normals = toPoints(normals);
  PolygonSoup soup;
  soup.polygons.assign(std::move_iterator(corners.begin()), std::move_iterator(corners.end()));
  setPolygons(path, soup, geometry);
  return geometry;
}

}  // namespace tufted::io

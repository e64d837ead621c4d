// Lines in formats that viewers and modellers read.
#include "io/line_files.h"

#include <array>
#include <string>

#include "io/output_file.h"

namespace tufted::io {

void writeLinesPly(const OutputPath& to, const std::vector<Polyline>& lines) {
  Eigen::Index vertices = 0, edges = 0;
  for (const Polyline& line : lines) {
    vertices += line.points.rows();
    edges += line.points.rows() - (line.is_closed ? 0 : 1);
  }
  OutputFile file(to);
  file.write("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
             "\nproperty double x\nproperty double y\nproperty double z\nproperty double value\nelement edge " +
             std::to_string(edges) + "\nproperty int vertex1\nproperty int vertex2\nend_header\n");
  for (const Polyline& line : lines) {
    for (Eigen::Index i = 0; i < line.points.rows(); ++i) {
      file.write(line.points.row(i).data(), 3 * sizeof(double));
      file.write(&line.value, sizeof(double));
    }
  }
  int first = 0;
  for (const Polyline& line : lines) {
    const int count = static_cast<int>(line.points.rows());
    for (int i = 0; i < count - (line.is_closed ? 0 : 1); ++i) {
      const std::array<int, 2> edge = {first + i, first + (i + 1) % count};
      file.write(edge.data(), sizeof edge);
    }
    first += count;
  }
  file.close();
}

void writeLinesObj(const OutputPath& to, const std::vector<Polyline>& lines) {
  OutputFile file(to);
  Eigen::Index first = 1;  // OBJ counts from 1
  for (const Polyline& line : lines) {
    for (Eigen::Index i = 0; i < line.points.rows(); ++i) {
      file.write("v");
      for (const double coordinate : line.points.row(i)) {
        file.write(" ");
        file.writeNumber(coordinate);
      }
      file.write("\n");
    }
    file.write("l");
    for (Eigen::Index i = 0; i < line.points.rows() + (line.is_closed ? 1 : 0); ++i) {
      file.write(" ");
      file.writeInteger(first + i % line.points.rows());
    }
    file.write("\n");
    first += line.points.rows();
  }
  file.close();
}

}  // namespace tufted::io

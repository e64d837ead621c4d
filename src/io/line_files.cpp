// Lines in formats that viewers and modellers read.
#include "io/line_files.h"

#include <array>
#include <string>

#include "io/output_buffer.h"

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
  OutputBuffer buffer(file);
  for (const Polyline& line : lines) {
    for (Eigen::Index i = 0; i < line.points.rows(); ++i) {
      buffer.append(line.points.row(i).data(), 3 * sizeof(double));
      buffer.append(&line.value, sizeof(double));
    }
  }
  int first = 0;
  for (const Polyline& line : lines) {
    const int count = static_cast<int>(line.points.rows());
    for (int i = 0; i < count - (line.is_closed ? 0 : 1); ++i) {
      const std::array<int, 2> edge = {first + i, first + (i + 1) % count};
      buffer.append(edge.data(), sizeof edge);
    }
    first += count;
  }
  buffer.flush();
  file.close();
}

void writeLinesObj(const OutputPath& to, const std::vector<Polyline>& lines) {
  OutputFile file(to);
  OutputBuffer buffer(file);
  Eigen::Index first = 1;  // OBJ counts from 1
  for (const Polyline& line : lines) {
    for (Eigen::Index i = 0; i < line.points.rows(); ++i) {
      buffer.append("v");
      for (const double coordinate : line.points.row(i)) {
        buffer.append(" ");
        buffer.appendNumber(coordinate);
      }
      buffer.append("\n");
    }
    buffer.append("l");
    for (Eigen::Index i = 0; i < line.points.rows() + (line.is_closed ? 1 : 0); ++i) {
      buffer.append(" ");
      buffer.appendInteger(first + i % line.points.rows());
    }
    buffer.append("\n");
    first += line.points.rows();
  }
  buffer.flush();
  file.close();
}

}  // namespace tufted::io

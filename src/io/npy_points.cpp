#include <string>
#include <vector>

#include "io/columns.h"
#include "io/errors.h"
#include "io/file_text.h"
#include "io/formats.h"
#include "io/npy.h"
#include "io/npy_table.h"
#include "io/unread.h"
#include "tufted/io/results.h"

namespace tufted::io {

bool looksLikeNpy(std::string_view bytes) {
  return bytes.starts_with("\x93NUMPY");
}

Geometry readNpy(const std::filesystem::path& path, std::string_view bytes) {
  const NpyTable table = parseNpyTable(bytes, bytes.size(), path);
  const bool is_named = !table.members.empty();
  if (!is_named && (table.columns < 3 || (table.columns > 3 && table.columns > table.rows() && table.rows() > 0)))
    refuseByte(path, npy_dictionary,
               "is an array of " + std::to_string(table.rows()) + " points of " + std::to_string(table.columns) +
                   " values, must be N x 3 or more: a point per row" +
                   (table.rows() > 2 ? "; in Python: numpy.save(file, array.T)" : ""));
  Columns columns;
  columns.rows = checkedRows(path, table.rows());
  for (std::int64_t c = 0; c < (columns.rows > 0 || is_named ? table.columns : 3); ++c)
    columns.fields.push_back(table.field(c));
  if (is_named)
    nameColumns(path, 1, columns.fields);
  else
    nameByPlace(columns, false);
  Geometry geometry = toGeometry(std::move(columns));
  geometry.format = "NPY, " + table.type;
  if (table.width > 1 && table.height > 1) {
    geometry.width = static_cast<int>(table.width);
    geometry.height = static_cast<int>(table.height);
  }
  noteUnread(path, bytes, table.end, geometry);
  return geometry;
}

}  // namespace tufted::io

Eigen::MatrixXd tufted::readArray(const std::filesystem::path& path) {
  const std::string bytes = io::readBytes(path);
  const io::NpyTable array = io::parseNpyTable(bytes, bytes.size(), path, true);
  if (array.dimensions > 2) io::refuse(path, "is not an array of N or of N x c values");
  if (array.end < bytes.size())
    io::refuseByte(path, array.end, std::to_string(bytes.size() - array.end) + " bytes behind the values of the array");
  Eigen::MatrixXd values(array.rows(), array.columns);
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const Field column = array.field(c);
    for (Eigen::Index i = 0; i < values.rows(); ++i) values(i, c) = valueOf(column, static_cast<std::size_t>(i));
  }
  return values;
}

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "io/output_file.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// One column of a file of points: where its values lie in memory, little endian (npy.cpp asserts this order).
struct PointColumn {
  std::string name;
  FieldType type;
  int count;  ///< values per point, one after the other
  const std::byte* first;
  std::size_t stride;  ///< bytes from one point to the next
};

/// The columns of a file of points. Names are unique: a second column called `name` becomes name_2. Values are
/// borrowed.
class PointTable {
 public:
  explicit PointTable(std::int64_t rows) : rows_(rows) {}

  void add(PointColumn column);
  /// Adds three columns, as float32 if that loses nothing or if `narrow`, otherwise as float64.
  void addTriple(const std::array<const char*, 3>& names, const Points& values, bool narrow = false);

  /// Allocates memory, owned by the table, for values that are not borrowed.
  std::byte* allocate(std::size_t bytes) { return made_.emplace_back(bytes).data(); }

  std::int64_t rows() const { return rows_; }
  const std::vector<PointColumn>& columns() const { return columns_; }
  /// Writes the values, point by point.
  void write(OutputFile& file) const;

 private:
  std::int64_t rows_;
  std::vector<PointColumn> columns_;
  std::deque<std::vector<std::byte>> made_;
};

/// Makes the columns of points.ply, points.pcd or points.las: x y z, normals, the fields of the input, then mass,
/// boundary, status and representative, which replace fields of these names.
/// @param M N masses to write
/// @param normal_names names of the normals' columns in this format
/// @param add_field adds a field of the input as columns of this format
PointTable pointTable(const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
                      const std::array<const char*, 3>& normal_names,
                      const std::function<void(PointTable&, const Field&)>& add_field);

/// Adds the channels of a field `rgb` or `rgba` that PCL packed as 0xAARRGGBB, as columns of 8 bits. Returns false if
/// the field is no packed colour.
bool addPackedColor(PointTable& table, const Field& field);

/// Geometry::viewpoint as seven numbers that parse to the same doubles.
std::string viewpointText(const Geometry& geometry);

}  // namespace tufted::io

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "io/output_buffer.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// Values per point: where they lie in memory, in the machine's little endian order (see npy.cpp).
struct PointColumn {
  std::string name;
  FieldType type;
  int count;  ///< values per point, one after the other
  const std::byte* first;
  std::size_t stride;  ///< bytes from one point to the next
};

/// The columns of a file of points. Every name occurs once: a second column of that name is called name_2. Values are
/// borrowed.
class PointTable {
 public:
  explicit PointTable(std::int64_t rows) : rows_(rows) {}

  void add(PointColumn column);
  /// Adds three columns, as float32 if that loses nothing or if `narrow`.
  void addTriple(const std::array<const char*, 3>& names, const Points& values, bool narrow = false);

  /// Makes room for values that are made for the table.
  std::byte* allocate(std::size_t bytes) { return made_.emplace_back(bytes).data(); }

  std::int64_t rows() const { return rows_; }
  const std::vector<PointColumn>& columns() const { return columns_; }
  /// The values, point by point.
  void write(OutputBuffer& buffer) const;

 private:
  std::int64_t rows_;
  std::vector<PointColumn> columns_;
  std::deque<std::vector<std::byte>> made_;
};

/// The columns that points.ply and points.pcd have in common: x y z, normals, the fields of the input, then mass,
/// boundary, status and representative, which replace fields of these names.
/// @param M the masses to write
/// @param normal_names what the format calls normals
/// @param add_field adds a field of the input in the way of the format
PointTable pointTable(const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
                      const std::array<const char*, 3>& normal_names,
                      const std::function<void(PointTable&, const Field&)>& add_field);

/// Geometry::viewpoint as seven numbers that read as the same doubles.
std::string viewpointText(const Geometry& geometry);

}  // namespace tufted::io

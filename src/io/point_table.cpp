#include "io/point_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "io/columns.h"
#include "io/number.h"

namespace tufted::io {
namespace {

template <class T>
const std::byte* bytesOf(const T* values) {
  return reinterpret_cast<const std::byte*>(values);
}

bool fitsFloat(double value) {
  return static_cast<double>(static_cast<float>(value)) == value || std::isnan(value);
}

/// Whether a field of the input has a name that normals have.
bool namesNormals(const Geometry& geometry) {
  constexpr const char* names[] = {"nx", "ny", "nz", "normal_x", "normal_y", "normal_z"};
  return std::any_of(geometry.fields.begin(), geometry.fields.end(), [&](const Field& field) {
    return std::find(std::begin(names), std::end(names), field.name) != std::end(names);
  });
}

}  // namespace

void PointTable::add(PointColumn column) {
  const auto isTaken = [this](const std::string& name) {
    return std::any_of(columns_.begin(), columns_.end(), [&](const PointColumn& other) { return other.name == name; });
  };
  const std::string name = column.name;
  for (int copy = 2; isTaken(column.name); ++copy) column.name = name + "_" + std::to_string(copy);
  columns_.push_back(std::move(column));
}

void PointTable::addTriple(const std::array<const char*, 3>& names, const Points& values, bool narrow) {
  narrow = narrow || std::all_of(values.data(), values.data() + values.size(), fitsFloat);
  const FieldType type = narrow ? FieldType::float32 : FieldType::float64;
  const std::byte* first = bytesOf(values.data());
  if (narrow) {
    std::byte* const made = allocate(values.size() * sizeof(float));
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const float value = static_cast<float>(values.data()[i]);
      std::memcpy(made + i * sizeof(float), &value, sizeof(float));
    }
    first = made;
  }
  const std::size_t bytes = values.size() > 0 ? sizeOf(type) : 0;  // without points there is no memory
  for (std::size_t c = 0; c < 3; ++c) add({names[c], type, 1, first + c * bytes, 3 * bytes});
}

void PointTable::write(OutputFile& file) const {
  struct Source {
    const std::byte* next;
    std::size_t bytes, stride;
  };
  std::vector<Source> sources;
  for (const PointColumn& column : columns_)
    sources.push_back({column.first, sizeOf(column.type) * column.count, column.stride});
  for (std::int64_t i = 0; i < rows_; ++i)
    for (Source& source : sources) {
      file.write(source.next, source.bytes);
      source.next += source.stride;
    }
}

PointTable pointTable(const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
                      const std::array<const char*, 3>& normal_names,
                      const std::function<void(PointTable&, const Field&)>& add_field) {
  std::vector<PointColumn> results = {
      {"mass", FieldType::float64, 1, bytesOf(M.data()), sizeof(double)},
      {"boundary", FieldType::uint8, 1, bytesOf(laplacian.boundary.data()), 1},
      {"status", FieldType::uint8, 1, bytesOf(laplacian.status.data()), 1},
      {"representative", FieldType::int32, 1, bytesOf(laplacian.representative.data()), sizeof(int)}};
  if (laplacian.status.empty() && geometry.points.rows() > 0) results.clear();  // results without a Laplacian

  PointTable table(geometry.points.rows());
  table.addTriple({"x", "y", "z"}, geometry.points);
  if (geometry.normals.rows() > 0)
    table.addTriple(normal_names, geometry.normals);
  else if (laplacian.frames.normals.rows() == geometry.points.rows() && !namesNormals(geometry))
    table.addTriple(normal_names, laplacian.frames.normals, true);
  for (const Field& field : geometry.fields) {
    const auto replaced = [&](const PointColumn& result) { return result.name == field.name; };
    if (std::none_of(results.begin(), results.end(), replaced)) add_field(table, field);
  }
  for (const PointColumn& result : results) table.add(result);
  return table;
}

bool addPackedColor(PointTable& table, const Field& field) {
  if (!isPackedColor(field)) return false;
  const std::byte* const bytes = field.bytes.data();
  table.add({"red", FieldType::uint8, 1, bytes + 2, 4});
  table.add({"green", FieldType::uint8, 1, bytes + 1, 4});
  table.add({"blue", FieldType::uint8, 1, bytes, 4});
  if (field.name == "rgba") table.add({"alpha", FieldType::uint8, 1, bytes + 3, 4});
  return true;
}

std::string viewpointText(const Geometry& geometry) {
  std::string text;
  for (const double value : geometry.viewpoint) text.append(text.empty() ? "" : " ").append(shortestText(value));
  return text;
}

}  // namespace tufted::io

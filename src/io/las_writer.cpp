#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "io/columns.h"
#include "io/las_header.h"
#include "io/output_file.h"
#include "io/point_table.h"
#include "io/point_writers.h"
#include "tufted/errors.h"
#include "tufted/version.h"

// Writes LAS 1.4 (ASPRS, LAS Specification 1.4 R15). A field whose name and type are those of an item of the point
// format becomes that item again, all others become extra bytes.
namespace tufted::io {
namespace {

constexpr std::size_t longest_name = 32;       // bytes, of a value or of the program
constexpr std::size_t most_bytes = 65535;      // of a record of extra bytes, or of a point
constexpr std::size_t return_byte = 14;        // of a point: return number and number of returns
constexpr std::int64_t old_return_counts = 5;  // numbers of points by return that a header before LAS 1.4 has

[[noreturn]] void refuseLas(const std::string& reason) {
  throw InvalidInput("points.las: " + reason);
}

/// Adds a field, each of its values as a column of its own, with a name that LAS can hold.
void addLasField(PointTable& table, const Field& field) {
  if (addPackedColor(table, field)) return;
  const std::size_t size = sizeOf(field.type);
  for (int c = 0; c < field.count; ++c) {
    const std::string tail = field.count == 1 ? "" : "_" + std::to_string(c);
    table.add({field.name.substr(0, longest_name - tail.size()) + tail, field.type, 1, field.bytes.data() + c * size,
               field.count * size});
  }
}

/// The point format of the output: that of the input, or 6, with the colours that the points have, and without waves,
/// which lie outside of the points.
int formatFor(const PointTable& table, const std::string& las_header) {
  constexpr int plain[] = {0, 1, 2, 3, 1, 3, 6, 7, 8, 6, 8}, colored[] = {2, 3, 2, 3, 3, 3, 7, 7, 8, 7, 8};
  const int given = las_header.empty() ? 6 : static_cast<std::uint8_t>(las_header[las_byte::point_format]);
  const auto is_red = [](const PointColumn& column) { return column.name == "red"; };
  return std::any_of(table.columns().begin(), table.columns().end(), is_red) ? colored[given] : plain[given];
}

/// A column of the table as an item of the point records.
struct Stored {
  const PointColumn* column;
  std::size_t byte;
  int first_bit = 0;
  int bits = 0;             ///< 0: the whole value
  bool is_widened = false;  ///< whether a colour of 8 bits is stored with 16
};

/// How an item would store a column; a null column if that loses anything.
Stored storedAs(const LasItem& item, const PointColumn& column, std::int64_t rows) {
  const Stored stored = {&column, static_cast<std::size_t>(item.byte), item.first_bit, item.bits};
  if (column.name != item.name) return {};
  if (column.type == FieldType::uint8 && (column.name == "red" || column.name == "green" || column.name == "blue"))
    return {&column, stored.byte, 0, 0, true};
  if (column.type != item.type) return {};
  for (std::int64_t i = 0; item.bits > 0 && i < rows; ++i)
    if (std::to_integer<int>(column.first[i * column.stride]) >> item.bits != 0) return {};
  return stored;
}

/// A name that fits: what follows its last '_', which tells equal beginnings apart, stays.
std::string fittingName(const std::string& name) {
  if (name.size() <= longest_name) return name;
  const std::string tail = name.substr(std::max(name.rfind('_'), name.size() - longest_name));
  return name.substr(0, longest_name - tail.size()) + tail;
}

/// The description of a column in the record of extra bytes.
std::string descriptionOf(const PointColumn& column) {
  constexpr char kinds[] = {2, 1, 4, 3, 6, 5, 8, 7, 9, 10};  // of int8, uint8, int16, ..., float64
  std::string text(las_descriptor, '\0');
  text[2] = kinds[static_cast<int>(column.type)];
  const std::string name = fittingName(column.name);
  text.replace(4, name.size(), name);
  if (!isInteger(column.type)) {
    text[3] = 1;  // the next value, NaN, stands for no data
    put(text, 40, std::numeric_limits<double>::quiet_NaN());
  }
  return text;
}

class LasWriter {
 public:
  LasWriter(const PointTable& table, const Geometry& geometry) : points_(geometry.points) {
    header_ = geometry.las_header.empty() ? newHeader() : geometry.las_header;
    if (header_.size() < las_header_bytes || header_[las_byte::point_format] < 0 ||
        header_[las_byte::point_format] > 10)
      refuseLas("Geometry::las_header is not that of a LAS file");
    for (int c = 0; c < 3; ++c) {
      std::memcpy(&scale_[c], header_.data() + las_byte::scale + 8 * c, sizeof(double));
      std::memcpy(&offset_[c], header_.data() + las_byte::offset + 8 * c, sizeof(double));
    }
    std::string program = "Tufted " TUFTED_VERSION;
    program.resize(longest_name);
    header_.replace(las_byte::program, longest_name, program);
    const int format = formatFor(table, geometry.las_header);
    header_[las_byte::point_format] = static_cast<char>(format);
    place(table, format);
    countPoints(format);
  }

  void write(const OutputPath& to) const {
    OutputFile file(to);
    file.write(header_);
    std::string record(record_bytes_, '\0');
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      fill(i, record);
      file.write(record);
    }
    file.close();
  }

 private:
  /// A header for points that were not read from a LAS file. The scale is a power of ten, fine enough that the box of
  /// the points has 10^8 to 1.5 * 10^9 steps to either side.
  std::string newHeader() const {
    std::string header(las_header_bytes, '\0');
    header.replace(0, 4, "LASF");
    header[las_byte::global_encoding] = 16;  // the coordinate reference system, if there is one, is text
    header[las_byte::version] = 1;
    header[las_byte::version + 1] = 4;
    put<std::uint16_t>(header, las_byte::header_bytes, las_header_bytes);
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    double unit = 1;  // the power of ten from half the extent on
    if (points_.rows() > 0) {
      const Eigen::RowVector3d least = points_.colwise().minCoeff(), most = points_.colwise().maxCoeff();
      const double half = (most / 2 - least / 2).maxCoeff();
      if (half > 0) unit = std::pow(10, std::ceil(std::log10(half)));
      middle = ((least / 2 + most / 2) / unit).array().round() * unit;
    }
    const double scale = std::max(1e-9 * unit, std::numeric_limits<double>::min());
    for (int c = 0; c < 3; ++c) {
      put(header, las_byte::scale + 8 * c, scale);
      put(header, las_byte::offset + 8 * c, middle[c]);
    }
    return header;
  }

  /// Finds the place of each column in a record, and appends the record of extra bytes to the header.
  void place(const PointTable& table, int format) {
    std::vector<LasItem> items = lasItems(format);
    record_bytes_ = lasPointBytes(format);
    std::string extras;
    for (auto column = table.columns().begin() + 3; column != table.columns().end(); ++column) {  // after x, y, z
      Stored stored = {};
      for (const LasItem& item : items)
        if (stored.column == nullptr) stored = storedAs(item, *column, table.rows());
      if (stored.column == nullptr) {
        stored = {&*column, record_bytes_};
        extras += descriptionOf(*column);
        record_bytes_ += sizeOf(column->type);
      }
      stored_.push_back(stored);
    }
    const auto is_return = [](const Stored& stored) { return stored.byte == return_byte; };
    if (std::none_of(stored_.begin(), stored_.end(), is_return)) only_return_ = format < 6 ? 0b001'001 : 0b0001'0001;
    if (extras.size() > most_bytes || record_bytes_ > most_bytes)
      refuseLas(std::to_string(extras.size() / las_descriptor) + " values per point are more than LAS can hold, 341");
    if (!extras.empty()) appendExtraBytes(extras);
    put(header_, las_byte::point_bytes, static_cast<std::uint16_t>(record_bytes_));
    put(header_, las_byte::points_begin, static_cast<std::uint32_t>(header_.size()));
  }

  void appendExtraBytes(const std::string& extras) {
    const std::size_t begin = header_.size();
    header_.append(las_record_header, '\0').append(extras);
    header_.replace(begin + 2, 9, "LASF_Spec");
    put<std::uint16_t>(header_, begin + 18, 4);
    put(header_, begin + 20, static_cast<std::uint16_t>(extras.size()));
    std::uint32_t records = 0;
    std::memcpy(&records, header_.data() + las_byte::records, sizeof(records));
    put(header_, las_byte::records, records + 1);
  }

  /// Enters the number of points, the numbers by return, and the box of the points into the header.
  void countPoints(int format) {
    const auto count = static_cast<std::uint64_t>(points_.rows());
    std::array<std::uint64_t, 16> by_return = {};
    std::string record(record_bytes_, '\0');
    std::array<std::int32_t, 3> least, most;
    least.fill(std::numeric_limits<std::int32_t>::max());
    most.fill(std::numeric_limits<std::int32_t>::min());
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      fill(i, record);
      ++by_return[record[return_byte] & (format < 6 ? 7 : 15)];
      const auto position = positionOf(i);
      for (int c = 0; c < 3; ++c) {
        least[c] = std::min(least[c], position[c]);
        most[c] = std::max(most[c], position[c]);
      }
    }
    for (int c = 0; c < 3; ++c) {
      put(header_, las_byte::box + 16 * c, count > 0 ? most[c] * scale_[c] + offset_[c] : 0.0);
      put(header_, las_byte::box + 16 * c + 8, count > 0 ? least[c] * scale_[c] + offset_[c] : 0.0);
    }
    // The old counts must be 0 for the point formats of LAS 1.4.
    put(header_, las_byte::old_count, static_cast<std::uint32_t>(format < 6 ? count : 0));
    for (std::int64_t r = 0; r < old_return_counts; ++r)
      put(header_, las_byte::old_count + 4 + 4 * r, static_cast<std::uint32_t>(format < 6 ? by_return[r + 1] : 0));
    put(header_, las_byte::count, count);
    for (std::size_t r = 0; r < 15; ++r) put(header_, las_byte::count_by_return + 8 * r, by_return[r + 1]);
  }

  /// The coordinates of a point in steps of the scale.
  std::array<std::int32_t, 3> positionOf(Eigen::Index i) const {
    constexpr double most = std::numeric_limits<std::int32_t>::max();
    std::array<std::int32_t, 3> position;
    for (int c = 0; c < 3; ++c) {
      const double steps = std::round((points_(i, c) - offset_[c]) / scale_[c]);
      if (!(std::abs(steps) <= most))
        refuseLas("point " + std::to_string(i) + " at " + std::to_string(points_(i, 0)) + ", " +
                  std::to_string(points_(i, 1)) + ", " + std::to_string(points_(i, 2)) +
                  " is not finite, or out of the range of the scale and offset");
      position[c] = static_cast<std::int32_t>(steps);
    }
    return position;
  }

  void fill(Eigen::Index i, std::string& record) const {
    const auto position = positionOf(i);
    std::fill(record.begin(), record.end(), '\0');
    std::memcpy(record.data(), position.data(), sizeof(position));
    for (const Stored& stored : stored_) {
      const std::byte* const value = stored.column->first + i * static_cast<Eigen::Index>(stored.column->stride);
      char* const to = record.data() + stored.byte;
      if (stored.is_widened)
        to[0] = to[1] = static_cast<char>(*value);
      else if (stored.bits > 0)
        *to = static_cast<char>(*to | std::to_integer<int>(*value) << stored.first_bit);
      else
        std::memcpy(to, value, sizeOf(stored.column->type));
    }
    record[return_byte] = static_cast<char>(record[return_byte] | only_return_);
  }

  const Points& points_;
  std::string header_;
  std::array<double, 3> scale_, offset_;
  std::vector<Stored> stored_;
  std::size_t record_bytes_ = 0;
  int only_return_ = 0;  ///< first of one return, for points without returns
};

}  // namespace

void writeLas(const OutputPath& to, const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M) {
  const PointTable table = pointTable(laplacian, geometry, M, {"nx", "ny", "nz"}, addLasField);
  LasWriter(table, geometry).write(to);
}

void checkLas(const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M) {
  LasWriter(pointTable(laplacian, geometry, M, {"nx", "ny", "nz"}, addLasField), geometry);
}

}  // namespace tufted::io

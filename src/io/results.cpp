#include "tufted/io/results.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "io/columns.h"
#include "io/conventions.h"
#include "io/line_files.h"
#include "io/npy.h"
#include "io/output_file.h"
#include "io/point_writers.h"
#include "io/pose.h"
#include "io/report_json.h"
#include "io/result_folder.h"
#include "io/stage_results.h"
#include "tufted/errors.h"
#include "tufted/io/select.h"

namespace tufted {
namespace {

void check(const Laplacian& laplacian, const Geometry& geometry, const std::vector<ResultArray>& arrays,
           const ResultOptions& options) {
  const auto n = laplacian.status.empty() ? geometry.points.rows() : static_cast<Eigen::Index>(laplacian.status.size());
  const auto require = [&](const std::string& name, Eigen::Index rows) {
    if (rows != n)
      throw InvalidInput("writeResults: " + name + " has " + std::to_string(rows) + " rows, must have " +
                         std::to_string(n));
  };
  if (!options.copies.empty()) require("geometry", geometry.points.rows());
  if (const char* const fault = io::poseFault(geometry.viewpoint); !options.copies.empty() && fault != nullptr)
    throw InvalidInput(std::string("writeResults: ") + fault);
  for (const ResultArray& array : arrays) {
    if (array.per_point) require(array.name, array.values.rows());
    if (array.name.empty() || array.name.find_first_of(" \t\r\n/") != std::string::npos)
      throw InvalidInput("writeResults: the name '" + array.name + "' is not one word");
  }
  for (const Format format : options.copies)
    if (format != Format::ply && format != Format::pcd && format != Format::las)
      throw InvalidInput("writeResults: copies of the points are ply, pcd or las");
}

const char* copyName(Format format) {
  return format == Format::ply ? "points.ply" : format == Format::pcd ? "points.pcd" : "points.las";
}

/// Writes values as a .npy file.
/// @param descr numpy's name of the type `Number`
template <class Number>
void writeArray(const io::OutputPath& to, const char* descr, const Eigen::MatrixXd& values) {
  const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values.cast<Number>();
  std::vector<std::int64_t> shape = {values.rows(), values.cols()};
  if (values.cols() == 1) shape.pop_back();
  io::writeNpy(to, descr, shape, rows.data());
}

/// A field of float32, which viewers and PCL take without conversion; NAME.npy keeps all digits.
Field fieldOf(const ResultArray& array) {
  Field field = {array.name, FieldType::float32, static_cast<int>(array.values.cols()), {}};
  const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = array.values.cast<float>();
  field.bytes.resize(static_cast<std::size_t>(rows.size()) * sizeof(float));
  if (rows.size() > 0) std::memcpy(field.bytes.data(), rows.data(), field.bytes.size());
  return field;
}

/// Whether a field is called `name`, or like one of its columns in copies in PLY, such as NAME_3.
bool isNamed(const std::string& field, const std::string& name) {
  if (field.rfind(name, 0) != 0) return false;
  const std::string rest = field.substr(name.size());
  return rest.empty() ||
         (rest.size() > 1 && rest[0] == '_' && rest.find_first_not_of("0123456789", 1) == std::string::npos);
}

/// The points with the results as fields, which replace fields of the same names.
Geometry copyWith(const Geometry& geometry, const std::vector<ResultArray>& arrays) {
  Geometry copy = geometry;
  for (const ResultArray& array : arrays) {
    if (!array.per_point || array.values.cols() == 0) continue;
    std::erase_if(copy.fields, [&](const Field& field) { return isNamed(field.name, array.name); });
    copy.fields.push_back(fieldOf(array));
  }
  return copy;
}

}  // namespace

std::vector<std::string> resultFiles(const std::vector<ResultArray>& arrays, const ResultOptions& options) {
  std::vector<std::string> names;
  names.reserve(arrays.size() + options.copies.size() + 1);
  for (const ResultArray& array : arrays) names.push_back(array.name + ".npy");
  if (options.lines) names.insert(names.end(), {"lines.ply", "lines.obj", "lines.svg"});
  for (const Format format : options.copies) names.emplace_back(copyName(format));
  names.emplace_back(io::report_name);
  return names;
}

const Field* io::fileRowOf(const Geometry& geometry) {
  for (const Field& field : geometry.fields)
    if (field.name == file_row && field.type == FieldType::int32 && field.count == 1) return &field;
  return nullptr;
}

void io::stageFileRow(StagedFiles& files, const Geometry& geometry) {
  const Field* const field = fileRowOf(geometry);
  if (field == nullptr) return;
  writeNpy(files.stage(file_row_name), "<i4", {geometry.points.rows()}, field->bytes.data());
}

void io::stageResults(StagedFiles& files, const Laplacian& laplacian, const Geometry& geometry,
                      const std::vector<ResultArray>& arrays, const ResultOptions& options) {
  stageFileRow(files, geometry);
  const std::size_t steps = options.copies.size() + 1;
  std::size_t done = 0;
  const auto report = [&] {
    if (options.progress && !options.progress("write", static_cast<double>(done++) / static_cast<double>(steps)))
      throw Cancelled("writeResults: cancelled");
  };
  report();
  if (!options.copies.empty()) {
    const Geometry copy = copyWith(geometry, arrays);
    const std::vector<Convention> about =
        laplacian.status.empty() ? std::vector<Convention>() : conventions(laplacian, WriteOptions());
    for (const Format format : options.copies) {
      const OutputPath to = files.stage(copyName(format));
      if (format == Format::ply)
        writePly(to, laplacian, copy, laplacian.M, about);
      else if (format == Format::pcd)
        writePcd(to, laplacian, copy, laplacian.M, about);
      else
        writeLas(to, laplacian, copy, laplacian.M);
      report();
    }
  }
  const OutputPath to = files.stage(report_name);
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(options.report, nullptr, false);
  if (!json.is_object()) throw InvalidInput("writeResults: the report is no JSON object");
  json["files"] = files.names();
  writeText(to, jsonText(json));
  report();
}

void writeResults(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                  const std::vector<ResultArray>& arrays, const ResultOptions& options) {
  check(laplacian, geometry, arrays, options);
  io::StagedFiles files(dir);
  for (const ResultArray& array : arrays) {
    if (options.progress && !options.progress("write", 0)) throw Cancelled("writeResults: cancelled");
    const io::OutputPath to = files.stage(array.name + ".npy");
    if (array.is_integer)
      writeArray<std::int32_t>(to, "<i4", array.values);
    else
      writeArray<double>(to, "<f8", array.values);
  }
  if (options.lines) {
    io::writeLinesPly(files.stage("lines.ply"), *options.lines);
    io::writeLinesObj(files.stage("lines.obj"), *options.lines);
    io::writeLinesSvg(files.stage("lines.svg"), *options.lines);
  }
  io::stageResults(files, laplacian, geometry, arrays, options);
  files.commit();
}

void checkLas(const Geometry& geometry, const std::vector<ResultArray>& arrays) {
  const Eigen::Index rows = std::min<Eigen::Index>(1, geometry.points.rows());
  Geometry first;
  first.points = geometry.points.topRows(rows);
  if (geometry.normals.rows() > 0) first.normals = geometry.normals.topRows(rows);
  first.las_header = geometry.las_header;
  for (const Field& field : geometry.fields) {
    const auto end = field.bytes.begin() + rows * field.count * static_cast<std::ptrdiff_t>(io::sizeOf(field.type));
    first.fields.push_back({field.name, field.type, field.count, {field.bytes.begin(), end}});
  }
  std::vector<ResultArray> of_first;
  for (const ResultArray& array : arrays)
    of_first.push_back({array.name, Eigen::MatrixXd::Zero(rows, array.values.cols())});
  const auto size = static_cast<std::size_t>(rows);
  Laplacian laplacian;
  laplacian.M = VectorXd::Zero(rows);
  laplacian.status.resize(size);
  laplacian.boundary.resize(size);
  laplacian.representative.resize(size);
  laplacian.frames.normals = Points::Zero(rows, 3);
  io::checkLas(laplacian, copyWith(first, of_first), laplacian.M);
}

}  // namespace tufted

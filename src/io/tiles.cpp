#include "tufted/io/tiles.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/npy.h"
#include "io/output_file.h"
#include "io/report_json.h"
#include "io/result_folder.h"
#include "io/row_store.h"
#include "io/staged_files.h"
#include "tufted/errors.h"
#include "tufted/version.h"

namespace tufted {
namespace {

constexpr std::array names = {"L_indptr", "L_indices",      "L_data",   "M",
                              "status",   "representative", "boundary", "normals"};

std::string fileOf(const char* name) {
  return std::string(name) + ".npy";
}

/// A .npy file that is written part by part.
class ArrayFile {
 public:
  ArrayFile(io::StagedFiles& files, const char* name, const char* descr, const std::vector<std::int64_t>& shape)
      : file_(files.stage(fileOf(name))) {
    file_.write(io::npyHeader(descr, shape));
  }
  template <class Value>
  void append(const Value* values, std::size_t count) {
    file_.write(values, count * sizeof(Value));
  }
  template <class Value>
  void append(const std::vector<Value>& values) {
    append(values.data(), values.size());
  }
  void close() { file_.close(); }

 private:
  io::OutputFile file_;
};

void askProgress(const TileOptions& options, double share) {
  if (options.progress && !options.progress("write", share)) throw Cancelled("writeLaplacianByTiles: cancelled");
}

void writeArrays(io::RowStore& store, const TileReport& report, const TileOptions& options, io::StagedFiles& files) {
  const std::int64_t n = report.points;
  ArrayFile starts(files, "L_indptr", "<i8", {n + 1}), indices(files, "L_indices", "<i8", {report.nonzeros}),
      data(files, "L_data", "<f8", {report.nonzeros}), masses(files, "M", "<f8", {n}),
      status(files, "status", "|u1", {n}), representative(files, "representative", "<i8", {n}),
      boundary(files, "boundary", "|u1", {n}), normals(files, "normals", "<f8", {n, 3});
  std::int64_t before = 0;
  starts.append(&before, 1);
  askProgress(options, 0);
  store.forBlocks([&](const TileRows& rows) {
    for (std::size_t r = 1; r < rows.begin.size(); ++r) {
      const std::int64_t end = before + rows.begin[r];
      starts.append(&end, 1);
    }
    before += rows.begin.back();
    indices.append(rows.column);
    data.append(rows.value);
    masses.append(rows.M.data(), static_cast<std::size_t>(rows.M.size()));
    status.append(rows.status);
    representative.append(rows.representative);
    boundary.append(rows.boundary);
    normals.append(rows.normals.data(), static_cast<std::size_t>(rows.normals.size()));
    askProgress(options, static_cast<double>(rows.point.back() + 1) / static_cast<double>(n));
  });
  for (ArrayFile* file : {&starts, &indices, &data, &masses, &status, &representative, &boundary, &normals})
    file->close();
}

void writeFileRows(const TileSourceText& text, std::int64_t points, const TileOptions& options,
                   io::StagedFiles& files) {
  const bool is_wide = text.of > std::numeric_limits<std::int32_t>::max();
  ArrayFile file(files, "file_row", is_wide ? "<i8" : "<i4", {points});
  std::int64_t done = 0;
  text.rows([&](const std::vector<std::int64_t>& rows) {
    askProgress(options, static_cast<double>(done) / static_cast<double>(points));
    done += std::ssize(rows);
    if (is_wide)
      file.append(rows);
    else
      file.append(std::vector<std::int32_t>(rows.begin(), rows.end()));
  });
  if (done != points)
    throw InvalidInput("writeLaplacianByTiles: rows gives " + std::to_string(done) + " rows, must give " +
                       std::to_string(points));
  file.close();
}

std::string reportText(const TileReport& report, const TileOptions& options, const TileSourceText& text,
                       const std::vector<std::string>& files) {
  nlohmann::ordered_json json = {{"tufted", TUFTED_VERSION}};
  json["source"] = text.source;
  if (!text.selection.empty()) json["selection"] = nlohmann::ordered_json::parse(text.selection);
  json["kind"] = "cloud";
  json["options"] = {{"preset", text.preset},
                     {"neighbors", options.cloud.neighbors},
                     {"denoise", options.cloud.steps.denoise},
                     {"mollify", options.cloud.mollify},
                     {"keep_noise", text.keep_noise}};
  if (text.memory.empty())
    json["options"]["memory"] = options.memory;
  else
    json["options"]["memory"] = text.memory;
  json["files"] = files;
  json["conventions"] = {{"sign", "L is positive semidefinite: L u = M f, L x = lambda M x"},
                         {"layout", "L by rows: L_indptr, L_indices and L_data, as of scipy.sparse.csr_matrix"},
                         {"normals", "the sign of each is arbitrary"}};
  json["report"] = {{"points", report.points},
                    {"active", report.active},
                    {"not_finite", report.not_finite},
                    {"coincident", report.coincident},
                    {"isolated", report.isolated},
                    {"nonzeros", report.nonzeros},
                    {"area", report.area},
                    {"cells", report.cells},
                    {"tiles", report.tiles},
                    {"builds", report.builds},
                    {"most_points", report.most_points},
                    {"margin", report.margin}};
  return io::jsonText(json);
}

}  // namespace

std::vector<std::string> tileFiles() {
  std::vector<std::string> files;
  for (const char* name : names) files.push_back(fileOf(name));
  files.emplace_back(io::report_name);
  return files;
}

TileReport writeLaplacianByTiles(const std::filesystem::path& dir, const PointSource& source,
                                 const TileOptions& options, const TileSourceText& text) {
  if (text.rows && text.of < source.size)
    throw InvalidInput("writeLaplacianByTiles: of = " + std::to_string(text.of) + ", must be at least the " +
                       std::to_string(source.size) + " points of the source, if rows are given");
  io::StagedFiles files(dir);
  io::RowStore store(dir, source.size);
  TileOptions used = options;
  used.folder = dir;
  const TileReport report = laplacianByTiles(source, used, [&](const TileRows& rows) { store.add(rows); });
  writeArrays(store, report, options, files);
  if (text.rows) writeFileRows(text, source.size, options, files);
  const io::OutputPath path = files.stage(io::report_name);
  const std::string json = reportText(report, options, text, files.names());
  io::writeText(path, json);
  files.commit();
  return report;
}

}  // namespace tufted

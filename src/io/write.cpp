#include "tufted/io/write.h"

#include <functional>
#include <utility>
#include <vector>

#include "io/columns.h"
#include "io/npy.h"
#include "io/npz.h"
#include "io/output_file.h"
#include "io/ply_writer.h"
#include "io/report_json.h"
#include "io/staged_files.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

template <class T>
void writeNpy(const std::filesystem::path& path, const std::filesystem::path& shown, const char* descr, const T* values,
              std::int64_t length) {
  io::OutputFile file(path, shown);
  file.write(io::npyHeader(descr, length));
  file.write(values, length * sizeof(T));
  file.close();
}

void writeText(const std::filesystem::path& path, const std::filesystem::path& shown, const std::string& text) {
  io::OutputFile file(path, shown);
  file.write(text);
  file.close();
}

void check(const Laplacian& laplacian, const Geometry& geometry) {
  const auto points = static_cast<std::size_t>(geometry.points.rows());
  const auto require = [](const std::string& name, std::size_t length, std::size_t expected) {
    if (length != expected)
      throw InvalidInput("writeLaplacian: " + name + " has length " + std::to_string(length) + ", not " +
                         std::to_string(expected));
  };
  require("L", laplacian.L.rows(), points);
  require("L", laplacian.L.cols(), points);
  require("M", laplacian.M.size(), points);
  require("status", laplacian.status.size(), points);
  require("representative", laplacian.representative.size(), points);
  require("boundary", laplacian.boundary.size(), points);
  for (const Field& field : geometry.fields)
    require("the field " + field.name, field.bytes.size(), points * field.count * io::sizeOf(field.type));
}

}  // namespace

void writeLaplacian(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                    const WriteOptions& options) {
  check(laplacian, geometry);
  const std::int64_t points = geometry.points.rows();
  using Path = std::filesystem::path;
  const std::vector<std::pair<const char*, std::function<void(const Path&, const Path&)>>> writers = {
      {"L.npz", [&](const Path& path, const Path& shown) { io::writeNpz(path, shown, laplacian.L); }},
      {"M.npy", [&](const Path& path, const Path& shown) { writeNpy(path, shown, "<f8", laplacian.M.data(), points); }},
      {"status.npy",
       [&](const Path& path, const Path& shown) { writeNpy(path, shown, "|u1", laplacian.status.data(), points); }},
      {"representative.npy",
       [&](const Path& path, const Path& shown) {
         writeNpy(path, shown, "<i4", laplacian.representative.data(), points);
       }},
      {"boundary.npy",
       [&](const Path& path, const Path& shown) { writeNpy(path, shown, "|u1", laplacian.boundary.data(), points); }},
      {"report.json",
       [&](const Path& path, const Path& shown) {
         writeText(path, shown, io::reportJson(laplacian.report, geometry, options));
       }},
      {"points.ply", [&](const Path& path, const Path& shown) { io::writePly(path, shown, laplacian, geometry); }},
  };
  io::StagedFiles files(dir);
  for (std::size_t w = 0; w <= writers.size(); ++w) {
    if (options.progress && !options.progress("write", static_cast<double>(w) / static_cast<double>(writers.size())))
      throw Cancelled("writeLaplacian: cancelled");
    if (w < writers.size()) writers[w].second(files.stage(writers[w].first), files.finished(writers[w].first));
  }
  files.commit();
}

}  // namespace tufted

#include <zip.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/npy.h"
#include "tufted/io/results.h"

namespace tufted {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

/// Members of a .npz file.
class NpzReader {
 public:
  explicit NpzReader(const Path& path) : path_(path), bytes_(io::readBytes(path)) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes_.data(), bytes_.size(), 0, &error);
    if (source != nullptr) archive_.reset(zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error));
    if (source != nullptr && !archive_) zip_source_free(source);
    zip_error_fini(&error);
    if (!archive_) io::refuse(path_, "is no archive of numpy");
  }

  /// The bytes of the member `name`.npy.
  std::string read(const std::string& name) const {
    zip_stat_t status;
    if (zip_stat(archive_.get(), (name + ".npy").c_str(), 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0)
      io::refuse(path_, "has no array " + io::quote(name));
    // Deflate shrinks a thousandfold at best: what claims more is damaged, and not worth the memory.
    if (status.size / 2048 > bytes_.size())
      io::refuse(path_, "the array " + io::quote(name) + " claims to be too large");
    std::string content(status.size, '\0');
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive_.get(), status.index, 0),
                                                                 &zip_fclose);
    if (!file || zip_fread(file.get(), content.data(), content.size()) != static_cast<zip_int64_t>(content.size()))
      io::refuse(path_, "the array " + io::quote(name) + " is damaged");
    return content;
  }

 private:
  struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
  };
  Path path_;
  std::string bytes_;
  std::unique_ptr<zip_t, Discard> archive_;
};

/// Integers in [least, most].
std::vector<int> integersOf(const std::vector<double>& numbers, double least, double most, const Path& shown) {
  std::vector<int> result(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!(numbers[i] >= least && numbers[i] <= most) || numbers[i] != std::floor(numbers[i]))
      io::refuse(shown, "value " + std::to_string(i) + " is none of those expected");
    result[i] = static_cast<int>(numbers[i]);
  }
  return result;
}

/// A symmetric matrix, so csc and csr are the same.
SparseMatrix readMatrix(const Path& path) {
  const NpzReader archive(path);
  const auto numbers = [&](const std::string& name) {
    const std::string bytes = archive.read(name);
    return io::numbersOf(io::parseNpy(bytes, path), path);
  };
  const std::string format_bytes = archive.read("format");
  const std::string_view format = io::parseNpy(format_bytes, path).values;
  if (format.substr(0, 3) != "csc" && format.substr(0, 3) != "csr")
    io::refuse(path, "is a matrix of the format " + io::quote(format) + ", must be csc or csr");
  const std::vector<double> shape = numbers("shape"), data = numbers("data");
  const double most = std::numeric_limits<int>::max();
  if (shape.size() != 2 || shape[0] != shape[1] || !(shape[0] >= 0 && shape[0] < most))
    io::refuse(path, "holds no square matrix");
  const int n = static_cast<int>(shape[0]);
  const std::vector<int> start = integersOf(numbers("indptr"), 0, most, path);
  const std::vector<int> indices = integersOf(numbers("indices"), 0, n - 1.0, path);
  if (start.size() != static_cast<std::size_t>(n) + 1 || start.front() != 0 ||
      !std::is_sorted(start.begin(), start.end()) || static_cast<std::size_t>(start.back()) != indices.size() ||
      indices.size() != data.size())
    io::refuse(path, "has columns that do not fit its entries");
  SparseMatrix matrix(n, n);
  std::vector<Eigen::Triplet<double>> entries;  // in any order within a column, as scipy allows
  entries.reserve(data.size());
  for (int j = 0; j < n; ++j)
    for (int k = start[j]; k < start[j + 1]; ++k) entries.emplace_back(indices[k], j, data[k]);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<double> readArray(const Path& path, std::size_t length) {
  const std::string bytes = io::readBytes(path);
  const io::NpyArray array = io::parseNpy(bytes, path);
  if (array.shape.size() != 1 || static_cast<std::size_t>(array.size()) != length)
    io::refuse(path, "is not an array of " + std::to_string(length) + " values, one for each row of L");
  return io::numbersOf(array, path);
}

/// Members of the report that algorithms look at.
void readReport(const Json& json, Report& report) {
  const auto take = [&](const char* name, auto& value) {
    if (json.contains(name) && json[name].is_number()) value = json[name].get<std::decay_t<decltype(value)>>();
  };
  take("points", report.points);
  take("active", report.active);
  take("not_finite", report.not_finite);
  take("coincident", report.coincident);
  take("isolated", report.isolated);
  take("rim_points", report.rim_points);
  take("jump_points", report.jump_points);
  take("lost_points", report.lost_points);
  take("neighbors", report.neighbors);
  take("triangles", report.triangles);
  take("mean_edge", report.mean_edge);
  take("mean_squared_edge", report.mean_squared_edge);
  take("area", report.area);
  take("cover_area", report.cover_area);
  take("nonzeros", report.nonzeros);
  take("components", report.components);
}

void removeDummies(Laplacian& laplacian) {
  laplacian.L.prune([&](Eigen::Index i, Eigen::Index j, double) {
    return laplacian.status[i] == PointStatus::active && laplacian.status[j] == PointStatus::active;
  });
  for (std::size_t i = 0; i < laplacian.status.size(); ++i)
    if (laplacian.status[i] != PointStatus::active) laplacian.M[static_cast<Eigen::Index>(i)] = 0;
}

/// A later run into the same folder with other formats leaves the matrices of the former.
void checkWritten(const Json& written, const std::filesystem::path& report_path) {
  if (!written.is_object() || !written.contains("files") || !written["files"].is_array()) return;
  for (const char* name : {"L.npz", "M.npy", "status.npy", "representative.npy", "boundary.npy"}) {
    const Json& files = written["files"];
    if (std::find(files.begin(), files.end(), name) == files.end())
      io::refuse(report_path, std::string("is of a run that did not write ") + name);
  }
}

}  // namespace

Laplacian readLaplacian(const std::filesystem::path& dir) {
  const Path report_path = dir / "report.json";
  const Json json = Json::parse(io::readBytes(report_path), nullptr, false);
  if (!json.is_object() || !json.contains("report") || !json["report"].is_object())
    io::refuse(report_path, "is no report of a Laplacian");
  const Json written = json.value("write_options", Json::object());
  checkWritten(written, report_path);
  Laplacian laplacian;
  laplacian.L = readMatrix(dir / "L.npz");
  const auto n = static_cast<std::size_t>(laplacian.L.rows());
  const std::vector<double> mass = readArray(dir / "M.npy", n);
  laplacian.M = Eigen::Map<const VectorXd>(mass.data(), laplacian.L.rows());
  const double last = static_cast<double>(n) - 1;
  for (const int code : integersOf(readArray(dir / "status.npy", n), 0, 3, dir / "status.npy"))
    laplacian.status.push_back(static_cast<PointStatus>(code));
  laplacian.representative = integersOf(readArray(dir / "representative.npy", n), 0, last, dir / "representative.npy");
  for (const int code : integersOf(readArray(dir / "boundary.npy", n), 0, 3, dir / "boundary.npy"))
    laplacian.boundary.push_back(static_cast<Boundary>(code));
  readReport(json["report"], laplacian.report);
  if (written.is_object() && written.value("sign", Json()) == "igl") laplacian.L = -laplacian.L;
  removeDummies(laplacian);
  laplacian.cover_areas = laplacian.M;
  return laplacian;
}

}  // namespace tufted

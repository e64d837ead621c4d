#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "io/record_file.h"
#include "io/where.h"
#include "tufted/errors.h"
#include "tufted/io/tiles.h"

namespace tufted {
namespace {

[[noreturn]] void refuseMesh(const std::string& name) {
  throw InvalidInput(name + " holds a mesh, must be a cloud; --as cloud, or ReadAs::cloud, takes its vertices alone");
}

/// Calls visit(points that are kept, their rows in the file, number of the first point) for batches of all points.
template <class Visit>
void forChosen(io::RecordFile& file, const Selection& selection, const Visit& visit) {
  file.forBatches([&](const Geometry& batch, std::int64_t first) {
    if (selection.isEmpty()) return visit(batch.points, std::vector<std::int64_t>(), first);
    const std::vector<int> rows = io::chosenRows(batch, selection, {});
    std::vector<std::int64_t> numbers(rows.begin(), rows.end());
    for (std::int64_t& number : numbers) number += first;
    if (!file.layout().is_organized) return visit(Points(batch.points(rows, Eigen::all)), numbers, first);
    Points points = Points::Constant(batch.points.rows(), 3, std::numeric_limits<double>::quiet_NaN());
    points(rows, Eigen::all) = batch.points(rows, Eigen::all);
    visit(points, numbers, first);
  });
}

}  // namespace

FileSource sourceOf(const std::filesystem::path& path, ReadAs as, const Selection& selection,
                    const Progress& progress) {
  const auto file = as == ReadAs::mesh || selection.thin > 0 ? nullptr : io::RecordFile::open(path);
  if (!file || (file->layout().is_named_by_values && !selection.where.empty()))
    return sourceOf(read(path, as, FileFormat::automatic, progress), path.string(), selection, progress);
  if (file->layout().has_faces && as != ReadAs::cloud) refuseMesh(path.string());
  FileSource source;
  source.size = source.of = source.kept = file->layout().points;
  source.notes = file->notes();
  source.pass = [file, selection](const auto& take) {
    forChosen(*file, selection, [&](const Points& points, const auto&, std::int64_t) { take(points); });
  };
  if (selection.isEmpty()) return source;
  source.kept = 0;
  forChosen(*file, selection, [&](const Points&, const auto& rows, std::int64_t first) {
    if (progress && !progress("select", static_cast<double>(first) / static_cast<double>(source.of)))
      throw Cancelled("sourceOf: cancelled");
    source.kept += std::ssize(rows);
  });
  if (source.kept == 0) io::refuseNone(source.of);
  if (file->layout().is_organized) return source;
  source.size = source.kept;
  source.rows = [file, selection](const auto& take) {
    forChosen(*file, selection, [&](const Points&, const auto& rows, std::int64_t) { take(rows); });
  };
  return source;
}

FileSource sourceOf(Geometry geometry, const std::string& name, const Selection& selection, const Progress& progress) {
  if (geometry.is_mesh) refuseMesh(name);
  FileSource source;
  source.of = source.kept = geometry.points.rows();
  if (!selection.isEmpty()) {
    std::vector<int> rows = select(geometry, selection, progress);
    source.kept = std::ssize(rows);
    source.memory = static_cast<double>(rows.size() * sizeof(int));
    if (geometry.height == 1)
      source.rows = [rows = std::move(rows)](const auto& take) {
        constexpr std::ptrdiff_t most = 1 << 20;  // 8 MB as numbers of 64 bits
        for (auto first = rows.begin(); first != rows.end();) {
          const auto end = first + std::min(most, rows.end() - first);
          take({first, end});
          first = end;
        }
      };
  }
  source.notes = std::move(geometry.notes);
  source.size = geometry.points.rows();
  source.memory += static_cast<double>(source.size) * 3 * sizeof(double);
  const auto points = std::make_shared<const Points>(std::move(geometry.points));
  source.pass = [points](const auto& take) { sourceOf(*points).pass(take); };
  return source;
}

}  // namespace tufted

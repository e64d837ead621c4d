#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "io/chosen_rows.h"
#include "io/record_file.h"
#include "tufted/errors.h"
#include "tufted/io/tiles.h"

namespace tufted {
namespace {

[[noreturn]] void refuseMesh(const std::string& name) {
  throw InvalidInput(name + " holds a mesh, must be a cloud; --as cloud, or ReadAs::cloud, takes its vertices alone");
}

/// The chosen points of a batch, or of an organized cloud all of them, the others without coordinates.
Points chosenPoints(const Points& batch, const std::vector<int>& rows, bool is_organized) {
  if (!is_organized) return batch(rows, Eigen::all);
  Points points = Points::Constant(batch.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  points(rows, Eigen::all) = batch(rows, Eigen::all);
  return points;
}

/// The points of a file that a selection keeps, in passes through the file.
class ChosenRecords {
 public:
  ChosenRecords(std::shared_ptr<io::RecordFile> file, Selection selection)
      : file_(std::move(file)), selection_(std::move(selection)) {}

  /// Calls visit(points of a batch, rows in it that are kept, number of its first point).
  template <class Visit>
  void forBatches(const Visit& visit) const {
    file_->forBatches([&](const Geometry& batch, std::int64_t first) {
      visit(batch.points, io::chosenRows(batch, selection_, {}), first);
    });
  }

  std::int64_t count(const Progress& progress) const {
    const std::int64_t all = file_->layout().points;
    std::int64_t kept = 0;
    forBatches([&](const Points&, const std::vector<int>& rows, std::int64_t first) {
      if (progress && !progress("select", static_cast<double>(first) / static_cast<double>(all)))
        throw Cancelled("sourceOf: cancelled");
      kept += std::ssize(rows);
    });
    if (kept == 0) io::refuseNone(all);
    return kept;
  }

  void givePoints(const std::function<void(const PointsRef&)>& take) const {
    forBatches([&](const Points& batch, const std::vector<int>& rows, std::int64_t) {
      take(chosenPoints(batch, rows, file_->layout().is_organized));
    });
  }

  void giveRows(const std::function<void(const std::vector<std::int64_t>&)>& take) const {
    forBatches([&](const Points&, const std::vector<int>& rows, std::int64_t first) {
      std::vector<std::int64_t> numbers(rows.begin(), rows.end());
      for (std::int64_t& number : numbers) number += first;
      take(numbers);
    });
  }

 private:
  std::shared_ptr<io::RecordFile> file_;
  Selection selection_;
};

}  // namespace

FileSource sourceOf(const std::filesystem::path& path, ReadAs as, const Selection& selection,
                    const Progress& progress) {
  const auto file = as == ReadAs::mesh || selection.thin > 0 ? nullptr : io::RecordFile::open(path);
  if (!file || (file->layout().is_named_by_values && !selection.where.empty()))
    return sourceOf(read(path, as, FileFormat::automatic, progress), path.string(), selection, progress);
  const io::RecordLayout& layout = file->layout();
  if (layout.has_faces && as != ReadAs::cloud) refuseMesh(path.string());
  FileSource source;
  source.size = source.of = source.kept = layout.points;
  source.memory = file->batchMemory();
  source.notes = file->notes();
  source.pass = [file](const auto& take) {
    file->forBatches([&](const Geometry& batch, std::int64_t) { take(batch.points); });
  };
  if (selection.isEmpty()) return source;
  const ChosenRecords chosen(file, selection);
  source.kept = chosen.count(progress);
  source.pass = [chosen](const auto& take) { chosen.givePoints(take); };
  if (layout.is_organized) return source;
  source.size = source.kept;
  source.rows = [chosen](const auto& take) { chosen.giveRows(take); };
  return source;
}

FileSource sourceOf(Geometry geometry, const std::string& name, const Selection& selection, const Progress& progress) {
  if (geometry.is_mesh) refuseMesh(name);
  FileSource source;
  source.of = source.kept = geometry.points.rows();
  std::vector<int> rows;
  if (!selection.isEmpty()) {
    rows = select(geometry, selection, progress);
    source.kept = std::ssize(rows);
    if (geometry.height > 1) rows.clear();
  }
  source.notes = std::move(geometry.notes);
  source.size = geometry.points.rows();
  source.memory = static_cast<double>(static_cast<std::size_t>(geometry.points.size()) * sizeof(double) +
                                      rows.size() * sizeof(int));
  const auto points = std::make_shared<const Points>(std::move(geometry.points));
  source.pass = [points](const auto& take) { sourceOf(*points).pass(take); };
  if (!rows.empty()) source.rows = [rows = std::move(rows)](const auto& take) { take({rows.begin(), rows.end()}); };
  return source;
}

}  // namespace tufted

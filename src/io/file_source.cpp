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

/// The points of a file that a selection keeps, in passes through the file. The first pass decides, and a bit per point
/// remembers.
class ChosenRecords {
 public:
  ChosenRecords(std::shared_ptr<io::RecordFile> file, const Selection& selection, const Progress& progress)
      : file_(std::move(file)) {
    const std::int64_t all = file_->layout().points;
    is_kept_.resize(static_cast<std::size_t>(all));
    file_->forBatches([&](const Geometry& batch, std::int64_t first) {
      if (progress && !progress("select", static_cast<double>(first) / static_cast<double>(all)))
        throw Cancelled("sourceOf: cancelled");
      const std::vector<int> rows = io::chosenRows(batch, selection, {});
      for (const int row : rows) is_kept_[static_cast<std::size_t>(first + row)] = true;
      count_ += std::ssize(rows);
    });
    if (count_ == 0) io::refuseNone(all);
  }

  std::int64_t count() const { return count_; }
  double memory() const { return static_cast<double>(is_kept_.size()) / 8; }

  void givePoints(const std::function<void(const PointsRef&)>& take) const {
    file_->forBatches([&](const Geometry& batch, std::int64_t first) {
      const std::vector<int> rows = rowsOf(batch, first);
      if (!file_->layout().is_organized) return take(batch.points(rows, Eigen::all).eval());
      Points points = Points::Constant(batch.points.rows(), 3, std::numeric_limits<double>::quiet_NaN());
      points(rows, Eigen::all) = batch.points(rows, Eigen::all);
      take(points);
    });
  }

  void giveRows(const std::function<void(const std::vector<std::int64_t>&)>& take) const {
    file_->forBatches([&](const Geometry& batch, std::int64_t first) {
      const std::vector<int> rows = rowsOf(batch, first);
      std::vector<std::int64_t> numbers(rows.begin(), rows.end());
      for (std::int64_t& number : numbers) number += first;
      take(numbers);
    });
  }

 private:
  /// The rows of a batch that are kept.
  std::vector<int> rowsOf(const Geometry& batch, std::int64_t first) const {
    std::vector<int> rows;
    for (int row = 0; row < batch.points.rows(); ++row)
      if (is_kept_[static_cast<std::size_t>(first + row)]) rows.push_back(row);
    return rows;
  }

  std::shared_ptr<io::RecordFile> file_;
  std::vector<bool> is_kept_;
  std::int64_t count_ = 0;
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
  const auto chosen = std::make_shared<const ChosenRecords>(file, selection, progress);
  source.kept = chosen->count();
  source.memory += chosen->memory();
  source.pass = [chosen](const auto& take) { chosen->givePoints(take); };
  if (layout.is_organized) return source;
  source.size = source.kept;
  source.rows = [chosen](const auto& take) { chosen->giveRows(take); };
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

#include "io/record_file.h"

#include <algorithm>
#include <utility>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/unread.h"

namespace tufted::io {
namespace {

/// A pass in batches of eight times as many points took seven times as long: these stay in the cache.
constexpr std::size_t most_points = std::size_t{1} << 15;

}  // namespace

std::shared_ptr<RecordFile> RecordFile::open(const std::filesystem::path& path, std::size_t batch_bytes) {
  const MappedFile mapped(path);
  if (mapped.bytes().empty()) return nullptr;
  const auto file = std::make_shared<RecordFile>();
  file->path_ = path;
  file->file_.rdbuf()->pubsetbuf(nullptr, 0);  // every read sees the file as it is
  file->file_.open(path, std::ios::binary);
  if (!file->file_) return nullptr;
  std::optional<RecordLayout> layout = recordLayout(path, mapped.bytes(), mapped.size());
  if (!layout) return nullptr;
  const std::size_t point_bytes = layout->record_bytes * static_cast<std::size_t>(layout->columns);
  const std::size_t most = std::clamp<std::size_t>(batch_bytes / point_bytes, 1, most_points);
  file->sums_.resize((static_cast<std::size_t>(layout->points) + most - 1) / most);
  file->layout_ = std::move(*layout);
  return file;
}

void RecordFile::read(std::size_t begin, std::size_t count, std::string& bytes) {
  const std::size_t before = bytes.size();
  bytes.resize(before + count);
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(begin)).read(bytes.data() + before, static_cast<std::streamsize>(count));
  const auto got = static_cast<std::size_t>(file_.gcount());
  if (file_.bad()) refuse(path_, "cannot be read");
  if (got < count) refuseByte(path_, begin + got, "the file ends there, and was longer when it was opened");
}

std::vector<std::string> RecordFile::notes() {
  const std::size_t begin =
      layout_.begin + static_cast<std::size_t>(layout_.points * layout_.columns) * layout_.record_bytes;
  if (begin >= layout_.end) return {};
  constexpr std::size_t block = std::size_t{1} << 20;
  bool are_zero = true;
  std::string bytes;
  for (std::size_t at = begin; at < layout_.end && are_zero; at += block) {
    bytes.clear();
    read(at, std::min(block, layout_.end - at), bytes);
    are_zero = areZero(bytes);
  }
  Geometry some;
  some.points.resize(1, 3);
  noteRest(path_, "byte " + std::to_string(begin), layout_.end - begin, are_zero, some);
  return some.notes;
}

void RecordFile::forBatches(const std::function<void(const Geometry& batch, std::int64_t first)>& visit) {
  std::int64_t first = 0;
  for (std::size_t b = 0; b < sums_.size(); ++b) {
    const auto left = static_cast<std::int64_t>(sums_.size() - b), points = (layout_.points - first) / left;
    std::string bytes = layout_.header(points);
    const std::size_t place = layout_.begin + static_cast<std::size_t>(first) * layout_.record_bytes;
    for (std::int64_t c = 0; c < layout_.columns; ++c)
      read(place + static_cast<std::size_t>(c * layout_.points) * layout_.record_bytes,
           static_cast<std::size_t>(points) * layout_.record_bytes, bytes);
    const std::size_t sum = std::hash<std::string>()(bytes);
    if (sums_[b].value_or(sum) != sum)
      refuseByte(path_, place, "the points from there on have changed since they were first read");
    sums_[b] = sum;
    visit(parse(bytes, path_, ReadAs::cloud, layout_.format), first);
    first += points;
  }
}

}  // namespace tufted::io

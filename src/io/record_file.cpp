#include "io/record_file.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string_view>
#include <utility>

#include "io/errors.h"
#include "io/las_header.h"
#include "io/unread.h"

namespace tufted::io {
namespace {

constexpr std::size_t longest_header = std::size_t{1} << 20;  // but that of LAS has records of 65,535 bytes each
constexpr std::size_t most_points = std::size_t{1} << 15;     // eight times as many took seven times as long

}  // namespace

std::shared_ptr<RecordFile> RecordFile::open(const std::filesystem::path& path, std::size_t batch_bytes) {
  InputFile file(path);
  std::string bytes;
  file.read(0, std::min(file.size(), longest_header), bytes);
  if (bytes.size() == longest_header && bytes.starts_with("LASF")) {
    std::uint32_t begin = 0;
    std::memcpy(&begin, bytes.data() + las_byte::points_begin, sizeof begin);
    const std::size_t end = std::clamp<std::size_t>(begin, longest_header, file.size());
    file.read(longest_header, end - longest_header, bytes);
  }
  std::optional<RecordLayout> layout = recordLayout(path, bytes, file.size());
  return layout ? std::make_shared<RecordFile>(std::move(file), std::move(*layout), batch_bytes) : nullptr;
}

RecordFile::RecordFile(InputFile file, RecordLayout layout, std::size_t batch_bytes)
    : file_(std::move(file)), layout_(std::move(layout)) {
  const std::size_t point_bytes = layout_.record_bytes * static_cast<std::size_t>(layout_.columns);
  const std::size_t most = std::clamp<std::size_t>(batch_bytes / point_bytes, 1, most_points);
  sums_.resize((static_cast<std::size_t>(layout_.points) + most - 1) / most);
}

std::string RecordFile::bytesOf(std::int64_t batch) const {
  const std::int64_t first = firstOf(batch), points = firstOf(batch + 1) - first;
  std::string bytes = layout_.header(points);
  for (std::int64_t column = 0; column < layout_.columns; ++column)
    file_.read(layout_.begin + static_cast<std::size_t>(column * layout_.points + first) * layout_.record_bytes,
               static_cast<std::size_t>(points) * layout_.record_bytes, bytes);
  return bytes;
}

Geometry RecordFile::parseBatch(std::string_view bytes) const {
  return parse(bytes, file_.path(), ReadAs::cloud, layout_.format);
}

double RecordFile::batchMemory() const {
  const std::string file_bytes = bytesOf(0);
  const Geometry batch = parseBatch(file_bytes);
  std::size_t bytes = file_bytes.size();
  for (const Field& field : batch.fields) bytes += field.bytes.size();
  constexpr Eigen::Index copies = 3;  // as they are in the file, as doubles, and those that are chosen
  return static_cast<double>(bytes) +
         static_cast<double>((copies * batch.points.size() + batch.normals.size()) * sizeof(double));
}

std::vector<std::string> RecordFile::notes() const {
  bool are_zero = true;
  for (std::size_t at = layout_.rest; at < layout_.end && are_zero; at += usual_bytes) {
    std::string bytes;
    file_.read(at, std::min(layout_.end - at, usual_bytes), bytes);
    are_zero = bytes.find_first_not_of('\0') == std::string::npos;
  }
  if (layout_.rest >= layout_.end) return {};
  return {unreadNote(file_.path(), "byte " + std::to_string(layout_.rest), layout_.end - layout_.rest, are_zero)};
}

void RecordFile::forBatches(const std::function<void(const Geometry& batch, std::int64_t first)>& visit) {
  for (std::int64_t b = 0; b < batches(); ++b) {
    std::string bytes = bytesOf(b);
    std::optional<std::size_t>& sum = sums_[static_cast<std::size_t>(b)];
    const std::size_t found = std::hash<std::string_view>()(bytes);
    if (sum.value_or(found) != found)
      refuseByte(file_.path(), layout_.begin + static_cast<std::size_t>(firstOf(b)) * layout_.record_bytes,
                 "the points from there on have changed since they were first read");
    sum = found;
    const Geometry batch = parseBatch(std::exchange(bytes, {}));
    visit(batch, firstOf(b));
  }
}

}  // namespace tufted::io

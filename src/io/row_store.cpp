#include "io/row_store.h"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "io/errors.h"

namespace tufted::io {
namespace {

constexpr std::int64_t least_points = std::int64_t{1} << 19;  // points per file: their rows take 100 MB of memory
constexpr std::int64_t most_files = 256;                      // processes may often open 1,024

/// A row in a file; its entries follow.
struct RowHead {
  std::int64_t point, representative, entries;
  double mass;
  double normal[3];
  PointStatus status;
  Boundary boundary;
};
struct Entry {
  std::int64_t column;
  double value;
};

}  // namespace

RowStore::RowStore(std::filesystem::path folder, std::int64_t points)
    : folder_(std::move(folder)),
      points_(points),
      block_points_(std::max(least_points, (points + most_files - 1) / most_files)) {
  for (std::int64_t first = 0; first < points; first += block_points_) {
    std::string name = (folder_ / ".rows-XXXXXX").string();
    const int number = ::mkstemp(name.data());
    if (number < 0) refuseErrno(folder_, "create a file of rows", errno);
    ::unlink(name.c_str());
    blocks_.emplace_back(::fdopen(number, "w+b"), &std::fclose);
    if (blocks_.back() != nullptr) continue;
    const int error = errno;
    ::close(number);
    refuseErrno(folder_, "create a file of rows", error);
  }
}

void RowStore::write(std::FILE* file, const void* bytes, std::size_t size) const {
  if (std::fwrite(bytes, 1, size, file) != size) refuseErrno(folder_, "write a file of rows", errno);
}

void RowStore::add(const TileRows& rows) {
  std::vector<Entry> entries;
  for (std::size_t r = 0; r < rows.point.size(); ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    const std::int64_t begin = rows.begin[r], end = rows.begin[r + 1];
    RowHead head = {};
    head.point = rows.point[r], head.representative = rows.representative[r], head.entries = end - begin;
    head.mass = rows.M[row];
    for (int axis = 0; axis < 3; ++axis) head.normal[axis] = rows.normals(row, axis);
    head.status = rows.status[r], head.boundary = rows.boundary[r];
    std::FILE* const file = blocks_[head.point / block_points_].get();
    write(file, &head, sizeof head);
    entries.clear();
    for (std::int64_t e = begin; e < end; ++e) entries.push_back({rows.column[e], rows.value[e]});
    write(file, entries.data(), entries.size() * sizeof(Entry));
  }
}

std::vector<char> RowStore::readBlock(std::FILE* file) const {
  if (std::fflush(file) != 0 || std::fseek(file, 0, SEEK_END) != 0) refuseErrno(folder_, "write a file of rows", errno);
  std::vector<char> bytes(static_cast<std::size_t>(std::ftell(file)));
  std::rewind(file);
  if (std::fread(bytes.data(), 1, bytes.size(), file) != bytes.size())
    refuseErrno(folder_, "read a file of rows", errno);
  return bytes;
}

void RowStore::forBlocks(const std::function<void(const TileRows& rows)>& visit) {
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    const std::int64_t first = static_cast<std::int64_t>(block) * block_points_;
    const auto count = static_cast<std::size_t>(std::min(block_points_, points_ - first));
    const std::vector<char> bytes = readBlock(blocks_[block].get());
    blocks_[block].reset();
    constexpr std::size_t none = SIZE_MAX;
    std::vector<std::size_t> place(count, none);  // of each row in `bytes`, the last of those of one point
    RowHead head;
    for (std::size_t at = 0; at < bytes.size();) {
      std::memcpy(&head, bytes.data() + at, sizeof head);
      place[static_cast<std::size_t>(head.point - first)] = at;
      at += sizeof head + static_cast<std::size_t>(head.entries) * sizeof(Entry);
    }
    TileRows rows;
    rows.M.setZero(static_cast<Eigen::Index>(count));
    rows.normals.setZero(static_cast<Eigen::Index>(count), 3);
    rows.begin.push_back(0);
    for (std::size_t r = 0; r < count; ++r) {
      const auto row = static_cast<Eigen::Index>(r);
      const std::int64_t point = first + row;
      head = {point, point, 0, 0, {}, PointStatus::not_finite, Boundary::none};
      if (place[r] != none) std::memcpy(&head, bytes.data() + place[r], sizeof head);
      rows.point.push_back(point);
      rows.representative.push_back(head.representative);
      rows.M[row] = head.mass;
      rows.normals.row(row) = Eigen::Map<const Eigen::RowVector3d>(head.normal);
      rows.status.push_back(head.status);
      rows.boundary.push_back(head.boundary);
      for (std::int64_t e = 0; e < head.entries; ++e) {
        Entry entry;
        std::memcpy(&entry, bytes.data() + place[r] + sizeof head + static_cast<std::size_t>(e) * sizeof entry,
                    sizeof entry);
        rows.column.push_back(entry.column);
        rows.value.push_back(entry.value);
      }
      rows.begin.push_back(std::ssize(rows.column));
    }
    visit(rows);
  }
}

}  // namespace tufted::io

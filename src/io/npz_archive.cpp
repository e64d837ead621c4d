#include "io/npz_archive.h"

#include <zlib.h>

#include <algorithm>
#include <initializer_list>

#include "io/npy.h"
#include "io/zip_reader.h"

namespace tufted::io {
namespace {

/// Versions of the format that a reader must know, without and with numbers of eight bytes.
constexpr std::uint64_t plain_version = 20, zip64_version = 45;
/// The date is always 1 January 1980, so that equal arrays give equal files.
constexpr std::uint64_t first_day = (0 << 9) | (1 << 5) | 1;

struct Number {
  std::uint64_t value;
  int bytes;
};

/// Appends numbers, their lowest byte first.
void append(std::string& to, std::initializer_list<Number> numbers) {
  for (const Number& number : numbers)
    for (int i = 0; i < number.bytes; ++i) to += static_cast<char>(number.value >> (8 * i));
}

}  // namespace

// The fields stand in the order of https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT, sections 4.3.7
// and 4.3.12. No compression, as by default in numpy: weights hardly shrink, and deflate would take longer than the
// build.
void NpzArchive::add(const std::string& name, std::string_view descr, const std::vector<std::int64_t>& shape,
                     const void* values, std::size_t bytes) {
  const std::string npy = npyHeader(descr, shape);
  uLong checksum = crc32_z(0, reinterpret_cast<const Bytef*>(npy.data()), npy.size());
  if (bytes > 0) checksum = crc32_z(checksum, static_cast<const Bytef*>(values), bytes);
  const std::uint64_t all = npy.size() + bytes;
  const bool is_large = std::max(all, written_) >= zip64_field;
  const std::uint64_t size = is_large ? zip64_field : all, version = is_large ? zip64_version : plain_version;

  std::string local;
  append(local, {{0x04034b50, 4}, {version, 2}, {0, 2}, {0, 2}, {0, 2}, {first_day, 2}, {checksum, 4}, {size, 4}});
  append(local, {{size, 4}, {name.size(), 2}, {is_large ? 20u : 0u, 2}});
  local += name;
  if (is_large) append(local, {{1, 2}, {16, 2}, {all, 8}, {all, 8}});

  append(directory_, {{0x02014b50, 4}, {version, 2}, {version, 2}, {0, 2}, {0, 2}, {0, 2}, {first_day, 2}});
  append(directory_, {{checksum, 4}, {size, 4}, {size, 4}, {name.size(), 2}, {is_large ? 28u : 0u, 2}, {0, 2}, {0, 2}});
  append(directory_, {{0, 2}, {0, 4}, {is_large ? zip64_field : written_, 4}});
  directory_ += name;
  if (is_large) append(directory_, {{1, 2}, {24, 2}, {all, 8}, {all, 8}, {written_, 8}});

  file_.write(local);
  file_.write(npy);
  file_.write(values, bytes);
  written_ += local.size() + all;
  ++arrays_;
}

void NpzArchive::close() {
  std::string end;
  const std::uint64_t size = directory_.size();
  if (written_ >= zip64_field) {
    append(end, {{0x06064b50, 4}, {44, 8}, {zip64_version, 2}, {zip64_version, 2}, {0, 4}, {0, 4}});
    append(end, {{arrays_, 8}, {arrays_, 8}, {size, 8}, {written_, 8}});
    append(end, {{0x07064b50, 4}, {0, 4}, {written_ + size, 8}, {1, 4}});  // where the record above begins
  }
  append(end, {{0x06054b50, 4}, {0, 2}, {0, 2}, {arrays_, 2}, {arrays_, 2}, {size, 4}});
  append(end, {{std::min(written_, zip64_field), 4}, {0, 2}});
  file_.write(directory_);
  file_.write(end);
  file_.close();
}

}  // namespace tufted::io

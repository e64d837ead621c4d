#include "io/zip_reader.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>

// The fields are those of https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT, section 4.3.
namespace tufted::io {
namespace {

/// Sizes of the records without the texts of varying size at their ends.
constexpr std::uint64_t local_bytes = 30, entry_bytes = 46, end_bytes = 22, zip64_end_bytes = 56, locator_bytes = 20;
constexpr std::uint64_t most_comment_bytes = 65535;

/// A number of at most eight bytes, its lowest byte first, which must lie in the text.
std::uint64_t number(std::string_view text, std::uint64_t at, std::size_t bytes) {
  std::uint64_t value = 0;
  std::memcpy(&value, text.data() + at, bytes);
  return value;
}

/// Whether a record of this size begins there, with this signature.
bool isAt(std::string_view text, std::uint64_t at, std::uint64_t bytes, std::string_view signature) {
  return at <= text.size() && bytes <= text.size() - at && text.substr(at, signature.size()) == signature;
}

/// Replaces numbers that are elsewhere by those in the extra field of an entry. @return false if one is not there
bool readLargeNumbers(std::string_view extra, std::initializer_list<std::uint64_t*> numbers) {
  std::string_view large;
  while (extra.size() >= 4 && large.empty()) {
    const std::string_view field = extra.substr(4, number(extra, 2, 2));
    if (number(extra, 0, 2) == 1) large = field;
    extra.remove_prefix(4 + field.size());
  }
  for (std::uint64_t* const value : numbers) {
    if (*value != zip64_field) continue;
    if (large.size() < 8) return false;
    *value = number(large, 0, 8);
    large.remove_prefix(8);
  }
  return true;
}

struct Directory {
  std::uint64_t start, end;  ///< place of its first entry, and of the record behind its last one
};

/// nullopt without a directory.
std::optional<Directory> findDirectory(std::string_view bytes) {
  const std::uint64_t tail = std::min<std::uint64_t>(bytes.size(), end_bytes + most_comment_bytes);
  const std::size_t found = bytes.substr(bytes.size() - tail).rfind("PK\5\6");
  if (found == std::string_view::npos) return {};
  const std::uint64_t end = bytes.size() - tail + found;
  if (!isAt(bytes, end, end_bytes, "PK\5\6")) return {};
  const std::uint64_t start = number(bytes, end + 16, 4);
  if (start != zip64_field) return Directory{start, end};
  if (end < locator_bytes || !isAt(bytes, end - locator_bytes, locator_bytes, "PK\6\7")) return {};
  const std::uint64_t large_end = number(bytes, end - locator_bytes + 8, 8);
  if (!isAt(bytes, large_end, zip64_end_bytes, "PK\6\6")) return {};
  return Directory{number(bytes, large_end + 48, 8), large_end};
}

}  // namespace

std::optional<std::map<std::string, ZipEntry, std::less<>>> readZipDirectory(std::string_view bytes) {
  const std::optional<Directory> directory = findDirectory(bytes);
  if (!directory) return {};
  std::map<std::string, ZipEntry, std::less<>> entries;
  std::uint64_t at = directory->start;
  while (isAt(bytes, at, entry_bytes, "PK\1\2")) {
    const std::uint64_t flags = number(bytes, at + 8, 2), method = number(bytes, at + 10, 2);
    std::uint64_t packed_size = number(bytes, at + 20, 4), local = number(bytes, at + 42, 4);
    ZipEntry entry = {.packed = {},
                      .size = number(bytes, at + 24, 4),
                      .checksum = static_cast<std::uint32_t>(number(bytes, at + 16, 4)),
                      .is_deflated = method == 8,
                      .is_readable = (flags & 1) == 0 && (method == 0 || method == 8)};
    const std::uint64_t name_bytes = number(bytes, at + 28, 2), extra_bytes = number(bytes, at + 30, 2);
    const std::uint64_t next = at + entry_bytes + name_bytes + extra_bytes + number(bytes, at + 32, 2);
    if (next > bytes.size()) return {};
    const std::string_view extra = bytes.substr(at + entry_bytes + name_bytes, extra_bytes);
    if (!readLargeNumbers(extra, {&entry.size, &packed_size, &local})) return {};
    if (!isAt(bytes, local, local_bytes, "PK\3\4")) return {};
    const std::uint64_t values = local + local_bytes + number(bytes, local + 26, 2) + number(bytes, local + 28, 2);
    if (values > bytes.size() || packed_size > bytes.size() - values) return {};
    entry.packed = bytes.substr(values, packed_size);
    if (entry.is_readable && method == 0 && packed_size != entry.size) return {};
    // Of two files with the same name numpy reads the last one, and this table would keep the first.
    if (!entries.emplace(bytes.substr(at + entry_bytes, name_bytes), entry).second) return {};
    at = next;
  }
  if (at != directory->end) return {};
  return entries;
}

void ZipStream::End::operator()(z_stream* stream) const {
  inflateEnd(stream);
  delete stream;
}

ZipStream::ZipStream(const ZipEntry& entry) : entry_(entry) {
  if (!entry.is_deflated) return;
  auto stream = std::make_unique<z_stream>();
  // Negative: without the header that zlib writes around deflated bytes in other files.
  if (inflateInit2(stream.get(), -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  stream_.reset(stream.release());
}

bool ZipStream::read(char* to, std::size_t bytes) {
  if (bytes > entry_.size - taken_) return false;
  if (stream_) {
    std::size_t left = bytes;
    while (left > 0) {
      // zlib counts in unsigned int.
      constexpr std::size_t most = std::numeric_limits<unsigned>::max();
      const auto in = static_cast<unsigned>(std::min(entry_.packed.size(), most));
      const auto out = static_cast<unsigned>(std::min(left, most));
      stream_->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(entry_.packed.data()));
      stream_->avail_in = in;
      stream_->next_out = reinterpret_cast<Bytef*>(to + (bytes - left));
      stream_->avail_out = out;
      const int status = inflate(stream_.get(), Z_NO_FLUSH);
      if (status == Z_MEM_ERROR) throw std::bad_alloc();
      if (status != Z_OK && status != Z_STREAM_END) return false;
      entry_.packed.remove_prefix(in - stream_->avail_in);
      left -= out - stream_->avail_out;
      if (status == Z_STREAM_END && left > 0) return false;
    }
  } else {
    std::memcpy(to, entry_.packed.data() + taken_, bytes);
  }
  checksum_ = crc32_z(checksum_, reinterpret_cast<const Bytef*>(to), bytes);
  taken_ += bytes;
  return taken_ < entry_.size || checksum_ == entry_.checksum;
}

}  // namespace tufted::io

#include "io/las_header.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/columns.h"
#include "io/errors.h"

// The offsets below are those of ASPRS, LAS Specification 1.4 R15: Table 3 (public header), Table 7 (variable length
// records) and Table 24 (Extra Bytes descriptor). Earlier versions have the same header, but shorter. All numbers are
// little endian.
namespace tufted::io {
namespace {

constexpr std::size_t smallest_header = 227;     // bytes, LAS 1.0 to 1.2
constexpr std::size_t header_of_1_3 = 235;       // bytes, LAS 1.3
constexpr std::uint16_t extra_bytes_record = 4;  // number of the record that describes extra bytes
constexpr std::size_t later_header = 60;         // bytes of the header of a record after the points
constexpr std::size_t longest_record = 65535;    // bytes, of a record before the points

/// The name of an extra value as one printable word, because headers of PLY and PCD hold no others.
std::string fieldName(std::string_view text, std::size_t number) {
  std::string name(text.substr(0, text.find('\0')));
  while (!name.empty() && name.back() == ' ') name.pop_back();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c <= ' ' || c > '~'; }, '_');
  return name.empty() ? "extra_" + std::to_string(number) : name;
}

class LasHeaderParser {
 public:
  LasHeaderParser(const std::filesystem::path& path, std::string_view bytes, std::size_t size)
      : path_(path), bytes_(bytes), size_(size) {}

  LasHeader parse() {
    if (!bytes_.starts_with("LASF")) refuseByte(path_, 0, "does not begin with 'LASF'");
    if (bytes_.size() < smallest_header) refuseByte(path_, bytes_.size(), "ends inside the header");
    readVersion();
    readPointFormat();
    readCount();
    findEnd();
    for (int c = 0; c < 3; ++c) {
      header_.scale[c] = at<double>(131 + 8 * c);
      header_.offset[c] = at<double>(155 + 8 * c);
      if (!std::isfinite(header_.scale[c]) || header_.scale[c] == 0)
        refuseByte(path_, 131 + 8 * c, "a scale that is zero or not finite");
      if (!std::isfinite(header_.offset[c])) refuseByte(path_, 155 + 8 * c, "an offset that is not finite");
    }
    beginKept();
    readRecords();
    readLaterRecords();
    describeTheRest();
    return std::move(header_);
  }

 private:
  template <class T>
  T at(std::size_t byte) const {
    T value;
    if (byte > bytes_.size() || sizeof(T) > bytes_.size() - byte)
      refuseByte(path_, bytes_.size(), "ends inside the header");
    std::memcpy(&value, bytes_.data() + byte, sizeof(T));
    return value;
  }

  void readVersion() {
    header_.minor = at<std::uint8_t>(25);
    if (at<std::uint8_t>(24) != 1 || header_.minor > 4)
      refuseByte(path_, 24,
                 "LAS " + std::to_string(at<std::uint8_t>(24)) + "." + std::to_string(header_.minor) +
                     " is not one of 1.0 to 1.4");
    header_bytes_ = at<std::uint16_t>(94);
    const std::size_t least = header_.minor == 4 ? las_header_bytes : smallest_header;
    if (header_bytes_ < least || header_bytes_ > bytes_.size())
      refuseByte(path_, 94, "a header of " + std::to_string(header_bytes_) + " bytes");
    header_.body = at<std::uint32_t>(96);
    if (header_.body < header_bytes_ || header_.body > bytes_.size())
      refuseByte(path_, 96,
                 "the points begin at byte " + std::to_string(header_.body) + " of " + std::to_string(size_));
  }

  void readPointFormat() {
    const auto format = at<std::uint8_t>(104);
    if ((format & 0xc0) != 0)
      refuseByte(path_, 104,
                 "the points are compressed (LAZ), which is not read; `laszip` and `pdal translate` write them as LAS");
    if (format > 10) refuseByte(path_, 104, "unknown point format " + std::to_string(format));
    header_.point_format = format;
    header_.record_bytes = at<std::uint16_t>(105);
    if (header_.record_bytes < lasPointBytes(format))
      refuseByte(path_, 105,
                 "points of " + std::to_string(header_.record_bytes) + " bytes, where format " +
                     std::to_string(format) + " has " + std::to_string(lasPointBytes(format)));
  }

  /// Reads the number of points: 64 bits in LAS 1.4, or if they are zero the 32 bits of older versions.
  void readCount() {
    std::uint64_t count = at<std::uint32_t>(107);
    std::size_t place = 107;
    if (header_.minor == 4 && at<std::uint64_t>(247) != 0) count = at<std::uint64_t>(place = 247);
    const std::uint64_t rest = size_ - header_.body;
    if (count > rest / header_.record_bytes)
      refuseByte(path_, place,
                 std::to_string(count) + " points of " + std::to_string(header_.record_bytes) +
                     " bytes are more than the " + std::to_string(rest) + " bytes behind the header");
    header_.points = static_cast<std::int64_t>(count);
  }

  /// Finds where the points end: waveforms (LAS 1.3) or extended variable length records (1.4) may follow.
  void findEnd() {
    header_.end = size_;
    const std::size_t points = header_.body + static_cast<std::size_t>(header_.points) * header_.record_bytes;
    const auto addPart = [&](std::uint64_t begin) {
      if (begin >= points && begin < header_.end) header_.end = static_cast<std::size_t>(begin);
    };
    if (header_.minor >= 3 && header_bytes_ >= header_of_1_3) addPart(at<std::uint64_t>(227));
    if (header_.minor == 4 && at<std::uint32_t>(243) > 0) addPart(at<std::uint64_t>(235));
  }

  /// Reads the variable length records between header and points, of which only Extra Bytes records are used.
  void readRecords() {
    const auto records = at<std::uint32_t>(100);
    std::size_t record = header_bytes_;
    for (std::uint32_t r = 0; r < records; ++r) {
      if (record + las_record_header > header_.body)
        refuseByte(path_, record,
                   "record " + std::to_string(r + 1) + " of " + std::to_string(records) +
                       " lies behind the beginning of the points");
      const std::size_t length = at<std::uint16_t>(record + 20);
      if (length > header_.body - record - las_record_header)
        refuseByte(path_, record + 20, "a record of " + std::to_string(length) + " bytes reaches into the points");
      if (isOfSpecification(record) && at<std::uint16_t>(record + 18) == extra_bytes_record)
        for (std::size_t d = 0; d + las_descriptor <= length; d += las_descriptor)
          readExtra(record + las_record_header + d);
      keep(record, bytes_.substr(record + las_record_header, length), record + 22);
      record += las_record_header + length;
    }
  }

  /// Reads the records after the points, of which only those that can be kept are used.
  void readLaterRecords() {
    if (header_.minor < 4) return;
    auto record = at<std::uint64_t>(las_byte::later_records);
    if (record < header_.body + static_cast<std::size_t>(header_.points) * header_.record_bytes) return;
    for (auto left = at<std::uint32_t>(las_byte::later_records + 8); left > 0; --left) {
      if (record > bytes_.size() || bytes_.size() - record < later_header) return;
      const auto length = at<std::uint64_t>(record + 20);
      if (length > bytes_.size() - record - later_header) return;
      if (length <= longest_record) keep(record, bytes_.substr(record + later_header, length), record + 28);
      record += later_header + length;
    }
  }

  bool isOfSpecification(std::size_t record) const {
    return bytes_.substr(record + 2, 16).starts_with(std::string_view("LASF_Spec\0", 10));
  }

  /// Keeps a record, unless it describes extra bytes or waves of the points, which are written anew or not at all.
  void keep(std::size_t record, std::string_view content, std::size_t description) {
    const auto number = at<std::uint16_t>(record + 18);
    const bool is_of_waves = (number >= 100 && number < 355) || number == 65535;
    if (isOfSpecification(record) && (number == extra_bytes_record || is_of_waves)) return;
    header_.kept.append(bytes_.substr(record, 20));
    header_.kept.append(2, '\0').append(bytes_.substr(description, 32)).append(content);
    put(header_.kept, header_.kept.size() - content.size() - 34, static_cast<std::uint16_t>(content.size()));
    put(header_.kept, las_byte::records, ++kept_records_);
  }

  /// Begins LasHeader::kept with the public header.
  void beginKept() {
    constexpr std::uint16_t wave_flags = 6;  // bits of the global encoding
    std::string& kept = header_.kept;
    kept = bytes_.substr(0, std::min(header_bytes_, las_byte::waves));
    kept.resize(las_header_bytes);
    put<std::uint8_t>(kept, las_byte::version + 1, 4);
    put(kept, las_byte::global_encoding,
        static_cast<std::uint16_t>(at<std::uint16_t>(las_byte::global_encoding) & ~wave_flags));
    put<std::uint16_t>(kept, las_byte::header_bytes, las_header_bytes);
    put<std::uint32_t>(kept, las_byte::records, 0);
  }

  void readExtra(std::size_t place) {
    constexpr FieldType types[] = {FieldType::uint8,   FieldType::int8,   FieldType::uint16, FieldType::int16,
                                   FieldType::uint32,  FieldType::int32,  FieldType::uint64, FieldType::int64,
                                   FieldType::float32, FieldType::float64};
    LasExtra extra;
    const int kind = at<std::uint8_t>(place + 2), options = at<std::uint8_t>(place + 3);
    extra.name = fieldName(bytes_.substr(place + 4, 32), header_.extras.size() + 1);
    if (kind == 0) {
      extra.count = options;  // undocumented bytes
    } else if (kind <= 30) {  // 11 to 20 are pairs, 21 to 30 triples
      extra.type = types[(kind - 1) % 10];
      extra.count = 1 + (kind - 1) / 10;
      extra.scaled = (options & 0x18) != 0;
      for (int c = 0; c < extra.count; ++c) {
        if ((options & 0x08) != 0) extra.scale[c] = at<double>(place + 112 + 8 * c);
        if ((options & 0x10) != 0) extra.offset[c] = at<double>(place + 136 + 8 * c);
        if (!std::isfinite(extra.scale[c])) refuseByte(path_, place + 112 + 8 * c, "a scale that is not finite");
        if (!std::isfinite(extra.offset[c])) refuseByte(path_, place + 136 + 8 * c, "an offset that is not finite");
      }
    } else {
      refuseByte(path_, place + 2, "unknown type " + std::to_string(kind) + " of an extra value");
    }
    if (extra.count > 0) header_.extras.push_back(extra);
  }

  /// Adds undescribed bytes of a record as a field.
  void describeTheRest() {
    std::size_t described = lasPointBytes(header_.point_format);
    for (const LasExtra& extra : header_.extras) described += sizeOf(extra.type) * extra.count;
    if (described > header_.record_bytes)
      refuseByte(path_, 105,
                 "the described values take " + std::to_string(described) + " bytes of points of " +
                     std::to_string(header_.record_bytes));
    LasExtra rest;
    rest.name = "extra_bytes";
    rest.count = static_cast<int>(header_.record_bytes - described);
    if (rest.count > 0) header_.extras.push_back(rest);
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  std::size_t size_;
  std::size_t header_bytes_ = 0;
  std::uint32_t kept_records_ = 0;
  LasHeader header_;
};

}  // namespace

std::size_t lasPointBytes(int point_format) {
  constexpr std::size_t bytes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  return bytes[point_format];
}

LasHeader parseLasHeader(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  return LasHeaderParser(path, bytes, size).parse();
}

}  // namespace tufted::io

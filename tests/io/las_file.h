#pragma once

#include <cstdint>
#include <cstring>
#include <string>

/// Bytes of a point of LAS format 0 to 10.
inline constexpr std::size_t las_format_bytes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// A LAS file of some points, written from the tables of the specification.
class LasFile {
 public:
  LasFile(int minor, int format, std::size_t extra_bytes = 0)
      : minor_(minor), record_(las_format_bytes[format] + extra_bytes) {
    bytes_.assign(minor == 4 ? 375 : minor == 3 ? 235 : 227, '\0');
    std::memcpy(bytes_.data(), "LASF", 4);
    set<std::uint8_t>(24, 1);
    set<std::uint8_t>(25, static_cast<std::uint8_t>(minor));
    set<std::uint16_t>(94, static_cast<std::uint16_t>(bytes_.size()));
    set<std::uint8_t>(104, static_cast<std::uint8_t>(format));
    set<std::uint16_t>(105, static_cast<std::uint16_t>(record_));
    for (int c = 0; c < 3; ++c) {
      set<double>(131 + 8 * c, c < 2 ? 0.01 : 0.001);
      set<double>(155 + 8 * c, c == 0 ? 500000.0 : c == 1 ? 5400000.0 : -100.0);
    }
    endRecords();
  }

  template <class T>
  void set(std::size_t byte, T value) {
    std::memcpy(bytes_.data() + byte, &value, sizeof(T));
  }

  /// Describes an extra value, with scale and offset where they are not 1 and 0. Before the first point.
  void describe(const std::string& name, int kind, double scale = 1, double offset = 0) {
    const std::size_t begin = bytes_.size();
    bytes_.append(54 + 192, '\0');
    std::memcpy(bytes_.data() + begin + 2, "LASF_Spec", 9);
    set<std::uint16_t>(begin + 18, 4);
    set<std::uint16_t>(begin + 20, 192);
    set<std::uint8_t>(begin + 54 + 2, static_cast<std::uint8_t>(kind));
    set<std::uint8_t>(begin + 54 + 3, scale != 1 || offset != 0 ? 0x18 : 0);
    std::memcpy(bytes_.data() + begin + 54 + 4, name.data(), name.size());
    set<double>(begin + 54 + 112, scale);
    set<double>(begin + 54 + 136, offset);
    set<std::uint32_t>(100, ++records_);
    endRecords();
  }

  /// Appends a variable length record. Before the first point.
  void addRecord(const std::string& user, std::uint16_t number, const std::string& content) {
    const std::size_t begin = bytes_.size();
    bytes_.append(54, '\0').append(content);
    bytes_.replace(begin + 2, user.size(), user);
    set<std::uint16_t>(begin + 18, number);
    set<std::uint16_t>(begin + 20, static_cast<std::uint16_t>(content.size()));
    set<std::uint32_t>(100, ++records_);
    endRecords();
  }

  /// Appends an extended variable length record (LAS 1.4). After the last point.
  void addLaterRecord(const std::string& user, std::uint16_t number, const std::string& content) {
    if (later_records_++ == 0) set<std::uint64_t>(235, bytes_.size());
    set<std::uint32_t>(243, later_records_);
    const std::size_t begin = bytes_.size();
    bytes_.append(60, '\0').append(content);
    bytes_.replace(begin + 2, user.size(), user);
    set<std::uint16_t>(begin + 18, number);
    set<std::uint64_t>(begin + 20, content.size());
  }

  /// Appends a point; returns where it begins.
  std::size_t addPoint(std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::size_t begin = bytes_.size();
    bytes_.append(record_, '\0');
    set(begin, x);
    set(begin + 4, y);
    set(begin + 8, z);
    ++points_;
    if (minor_ == 4)
      set<std::uint64_t>(247, points_);
    else
      set<std::uint32_t>(107, static_cast<std::uint32_t>(points_));
    return begin;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  void endRecords() { set<std::uint32_t>(96, static_cast<std::uint32_t>(bytes_.size())); }

  int minor_;
  std::size_t record_;
  std::uint64_t points_ = 0;
  std::uint32_t records_ = 0, later_records_ = 0;
  std::string bytes_;
};

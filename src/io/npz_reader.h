#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/npy.h"
#include "io/zip_reader.h"

namespace tufted::io {

/// An array in a .npz file. Its header is read first, its numbers in pieces: one deflated byte can become a thousand
/// bytes, so callers must bound the memory that they fill with them.
class NpzArray {
 public:
  const NpyHeader& header() const { return header_; }
  std::int64_t size() const { return header_.size(); }

  /// Reads the next of size() numbers, in C order. @throws IoError for a damaged array, or one without numbers
  double next();
  /// Reads the next number, which must be an integer in [least, most].
  /// @throws IoError naming the value that is not, and as next()
  int nextInteger(double least, double most);

 private:
  friend class NpzReader;
  NpzArray(std::filesystem::path path, std::string name, const ZipEntry& entry)
      : path_(std::move(path)), name_(std::move(name)), stream_(entry) {}
  /// Reads exactly this many bytes.
  std::string take(std::size_t bytes);
  void takeHeader(std::uint64_t all);
  void readPiece();
  [[noreturn]] void refuseDamaged() const;

  std::filesystem::path path_;
  std::string name_;
  ZipStream stream_;
  NpyHeader header_;
  std::uint64_t value_bytes_ = 0;  ///< number of bytes after the header
  std::vector<double> piece_;
  std::size_t place_ = 0;   ///< index of the next number in `piece_`
  std::int64_t taken_ = 0;  ///< numbers in `piece_` and all pieces before
};

/// The arrays of a .npz file.
class NpzReader {
 public:
  /// Opens the archive.
  /// @throws IoError for a file that is not an archive
  explicit NpzReader(const std::filesystem::path& path);
  NpzReader(const NpzReader&) = delete;  // `entries_` refer to `bytes_`
  NpzReader& operator=(const NpzReader&) = delete;

  /// Opens the array `name`, which can be read while this reader exists. @throws IoError if missing or not an array
  NpzArray open(const std::string& name) const;
  /// Reads a small array of `count` numbers. @throws IoError also for another count
  std::vector<double> numbers(const std::string& name, std::int64_t count) const;
  /// Reads the text in an array, of at most 64 bytes. @throws IoError also if it is longer
  std::string text(const std::string& name) const;

 private:
  std::filesystem::path path_;
  std::string bytes_;
  std::map<std::string, ZipEntry, std::less<>> entries_;
};

/// Converts numbers to integers in [least, most]. @throws IoError naming the first that is not one
std::vector<int> integersOf(const std::vector<double>& numbers, double least, double most,
                            const std::filesystem::path& shown);

}  // namespace tufted::io

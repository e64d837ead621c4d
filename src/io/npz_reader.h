#pragma once

#include <zip.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/npy.h"

namespace tufted::io {

/// An array in a .npz file. Its header is read at once, its numbers in pieces: one deflated byte can become a thousand
/// bytes, so callers must check the memory that they fill before and while numbers are read.
class NpzArray {
 public:
  const NpyHeader& header() const { return header_; }
  std::int64_t size() const { return header_.size(); }

  /// The next number, in C order; to be called size() times. @throws IoError if damaged or not an array of numbers
  double next();
  /// The next number, which must be an integer in [least, most].
  /// @throws IoError naming the value that is not one, or if damaged or not an array of numbers
  int nextInteger(double least, double most);

 private:
  friend class NpzReader;
  struct Close {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
  };

  NpzArray(std::filesystem::path path, std::string name) : path_(std::move(path)), name_(std::move(name)) {}
  /// Reads exactly this many bytes.
  std::string take(std::size_t bytes);
  void takeHeader(std::uint64_t all);
  void readPiece();
  [[noreturn]] void refuseDamaged() const;

  std::filesystem::path path_;
  std::string name_;
  std::unique_ptr<zip_file_t, Close> file_;
  NpyHeader header_;
  std::uint64_t value_bytes_ = 0;  ///< number of bytes behind the header
  std::vector<double> piece_;
  std::size_t place_ = 0;   ///< place of the next number in the piece
  std::int64_t taken_ = 0;  ///< numbers in this piece and those before
};

/// The arrays of a .npz file.
class NpzReader {
 public:
  /// Opens the archive.
  /// @throws IoError for a file that is not an archive
  explicit NpzReader(const std::filesystem::path& path);

  /// The array `name`, whose numbers can be read while this lives. @throws IoError if missing or not an array
  NpzArray open(const std::string& name) const;
  /// The numbers of a small array. @throws IoError also if there are not `count` numbers
  std::vector<double> numbers(const std::string& name, std::int64_t count) const;
  /// The text in an array, of a few letters at most. @throws IoError also if it is longer
  std::string text(const std::string& name) const;

 private:
  struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
  };
  std::filesystem::path path_;
  std::string bytes_;
  std::unique_ptr<zip_t, Discard> archive_;
};

/// The numbers as integers in [least, most]. @throws IoError naming the first that is not one
std::vector<int> integersOf(const std::vector<double>& numbers, double least, double most,
                            const std::filesystem::path& shown);

}  // namespace tufted::io

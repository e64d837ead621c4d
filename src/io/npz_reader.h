#pragma once

#include <zip.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/npy.h"

namespace tufted::io {

/// An array in a .npz file. Its header is read at once, its numbers in pieces: deflate makes a thousand bytes of one,
/// so what they fill is to be judged before and while they come.
class NpzArray {
 public:
  const NpyHeader& header() const { return header_; }
  std::int64_t size() const { return header_.size(); }

  /// The next number, in C order; to be called size() times. @throws IoError for what is damaged or no array of numbers
  double next();
  /// The next number, which must be an integer in [least, most].
  /// @throws IoError naming the value that is not; and as next()
  int nextInteger(double least, double most);

 private:
  friend class NpzReader;
  struct Close {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
  };

  NpzArray(std::filesystem::path path, std::string name) : path_(std::move(path)), name_(std::move(name)) {}
  /// Exactly so many bytes.
  std::string take(std::size_t bytes);
  void takeHeader(std::uint64_t all);
  void readPiece();
  [[noreturn]] void refuseDamaged() const;

  std::filesystem::path path_;
  std::string name_;
  std::unique_ptr<zip_file_t, Close> file_;
  NpyHeader header_;
  std::uint64_t value_bytes_ = 0;  ///< behind the header
  std::vector<double> piece_;
  std::size_t place_ = 0;   ///< in the piece
  std::int64_t taken_ = 0;  ///< numbers in this piece and those before
};

/// The arrays of a .npz file.
class NpzReader {
 public:
  /// @throws IoError for what is no archive
  explicit NpzReader(const std::filesystem::path& path);

  /// The array `name`, whose numbers can be read while this lives. @throws IoError where it is missing or none
  NpzArray open(const std::string& name) const;
  /// A few numbers. @throws IoError also for another number of them
  std::vector<double> numbers(const std::string& name, std::int64_t count) const;
  /// A short text. @throws IoError for what is longer than a few letters, too
  std::string text(const std::string& name) const;

 private:
  struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
  };
  std::filesystem::path path_;
  std::string bytes_;
  std::unique_ptr<zip_t, Discard> archive_;
};

/// The numbers as integers in [least, most]. @throws IoError naming the first that is none
std::vector<int> integersOf(const std::vector<double>& numbers, double least, double most,
                            const std::filesystem::path& shown);

}  // namespace tufted::io

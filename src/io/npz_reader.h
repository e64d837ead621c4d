#pragma once

#include <zip.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tufted::io {

/// Members of a .npz file.
class NpzReader {
 public:
  /// @throws IoError for what is no archive
  explicit NpzReader(const std::filesystem::path& path);

  /// The bytes of the member `name`.npy. @throws IoError where it is missing or damaged
  std::string read(const std::string& name) const;
  /// Its numbers, in C order. @throws IoError as read(), and for what is no array of numbers
  std::vector<double> numbers(const std::string& name) const;

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

#pragma once

#include <zip.h>

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/output_file.h"

namespace tufted::io {

/// Writes a .npz file of named arrays, without compression. The same arrays give the same bytes.
class NpzArchive {
 public:
  explicit NpzArchive(const OutputPath& to);

  /// Adds an array.
  /// @param name with the ending .npy
  /// @param descr numpy's name of the type, such as "<f8"
  /// @param shape in C order; empty for a single value
  /// @param values `bytes` bytes, borrowed until close()
  void add(const std::string& name, std::string_view descr, const std::vector<std::int64_t>& shape, const void* values,
           std::size_t bytes);
  /// Writes the file. @throws IoError
  void close();

 private:
  /// One array. libzip reads it from one source made of two fragments, header and values, which it does not copy.
  struct Member {
    std::string header;
    std::array<zip_buffer_fragment_t, 2> fragments;
  };
  struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
  };

  [[noreturn]] void fail() const;

  std::filesystem::path shown_;
  std::deque<Member> members_;
  std::unique_ptr<zip_t, Discard> archive_;  // declared after members_, from which it borrows
};

}  // namespace tufted::io

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

/// A .npz file being written: arrays of one name each, stored without compression. The same arrays give the same bytes.
class NpzArchive {
 public:
  explicit NpzArchive(const OutputPath& to);

  /// @param name with the ending .npy
  /// @param descr numpy's name of the type, such as "<f8"
  /// @param shape in C order; empty for a single value
  /// @param values borrowed until close()
  void add(const std::string& name, std::string_view descr, const std::vector<std::int64_t>& shape, const void* values,
           std::size_t bytes);
  /// @throws IoError
  void close();

 private:
  /// One array: libzip takes a file from a single source, made of a header and values it does not copy.
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
  std::unique_ptr<zip_t, Discard> archive_;  // before the members it borrows from
};

}  // namespace tufted::io

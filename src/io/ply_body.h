#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "io/ply_header.h"

namespace tufted::io {

/// The values after a PLY header, read one after another. All functions throw IoError naming the line or byte.
class PlyBody {
 public:
  virtual ~PlyBody() = default;

  /// Called before and after the values of each item of an element, which is a line in ascii.
  virtual void beginItem(const PlyElement& element) = 0;
  virtual void endItem() = 0;
  /// Notes bytes after the last element, see noteUnread().
  virtual void end(Geometry& geometry) = 0;
  /// Stores the next value at `bytes` in native byte order.
  virtual void value(FieldType type, std::byte* bytes) = 0;
  /// The line or byte of the current item.
  virtual std::int64_t place() const = 0;
  virtual const char* placeName() const = 0;
  [[noreturn]] virtual void refuse(const std::string& reason) const = 0;

  std::int64_t integer(FieldType type);
  /// Reads the length of the list that begins here, and checks it against the rest of the file.
  std::int64_t listLength(const PlyProperty& property);
  /// Skips the next property.
  void skip(const PlyProperty& property);

 protected:
  virtual std::int64_t mostValues(FieldType type) const = 0;  ///< how many the rest of the item or file can hold
};

/// Makes the reader for the header's format. `path` and `bytes`, the whole file, are borrowed.
std::unique_ptr<PlyBody> makePlyBody(const std::filesystem::path& path, std::string_view bytes,
                                     const PlyHeader& header);

}  // namespace tufted::io

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tufted/errors.h"
#include "tufted/io/read.h"

// Any bytes at all are either read or refused with an IoError that is one line and begins with the path.
// With --format=pcd the reader goes by that extension, without by the content.

namespace {

std::string name = "fuzz";  ///< the reader takes the bytes for a file of this name

void require(bool condition) {
  if (!condition) std::abort();
}

std::size_t sizeOf(tufted::FieldType type) {
  switch (type) {
    case tufted::FieldType::int8:
    case tufted::FieldType::uint8:
      return 1;
    case tufted::FieldType::int16:
    case tufted::FieldType::uint16:
      return 2;
    case tufted::FieldType::int32:
    case tufted::FieldType::uint32:
    case tufted::FieldType::float32:
      return 4;
    case tufted::FieldType::int64:
    case tufted::FieldType::uint64:
    case tufted::FieldType::float64:
      return 8;
  }
  std::abort();  // no type at all
}

void checkGeometry(const tufted::Geometry& geometry) {
  const auto points = geometry.points.rows();
  require(static_cast<std::int64_t>(geometry.width) * geometry.height == points);
  require(geometry.normals.rows() == 0 || geometry.normals.rows() == points);
  for (const tufted::Field& field : geometry.fields)
    require(field.bytes.size() == static_cast<std::size_t>(points) * field.count * sizeOf(field.type));
  for (const int corner : geometry.triangles.reshaped()) require(corner >= 0 && corner < points);
}

}  // namespace

/// libFuzzer leaves options that begin with two dashes to the target.
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  constexpr std::string_view option = "--format=";
  for (int i = 1; i < *count; ++i) {
    const std::string_view argument = (*arguments)[i];
    if (argument.starts_with(option)) name.append(".").append(argument.substr(option.size()));
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const tufted::Geometry geometry = tufted::parse({reinterpret_cast<const char*>(data), size}, name);
    checkGeometry(geometry);
  } catch (const tufted::IoError& error) {
    const std::string_view message = error.what();
    require(message.starts_with(name + ": "));
    require(message.find('\n') == std::string_view::npos);
  }
  return 0;
}

#include "io/npy.h"

#include <bit>
#include <cstring>
#include <limits>

#include "io/columns.h"
#include "io/errors.h"

namespace tufted::io {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

namespace {

constexpr std::string_view magic = "\x93NUMPY";

/// The text after `key` in a header's dictionary, without leading spaces.
std::string_view entry(std::string_view dictionary, const std::string& key, const std::filesystem::path& shown) {
  const std::size_t at = dictionary.find("'" + key + "':");
  if (at == std::string_view::npos) refuseByte(shown, npy_dictionary, "the header of the array has no " + quote(key));
  std::string_view rest = dictionary.substr(at + key.size() + 3);
  return rest.substr(std::min(rest.find_first_not_of(' '), rest.size()));
}

std::vector<std::int64_t> parseShape(std::string_view text, const std::filesystem::path& shown) {
  std::vector<std::int64_t> shape;
  const std::size_t end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos)
    refuseByte(shown, npy_dictionary, "the array has no shape");
  std::int64_t product = 1, number = -1;
  for (const char c : std::string(text.substr(1, end - 1)) + ",") {
    if (c >= '0' && c <= '9') {
      number = std::max<std::int64_t>(number, 0) * 10 + (c - '0');
      if (number > std::int64_t(1) << 48) refuseByte(shown, npy_dictionary, "the shape of the array is too large");
    } else if (c == ',') {
      if (number >= 0) shape.push_back(number);
      number = -1;
    } else if (c != ' ') {
      refuseByte(shown, npy_dictionary, "the shape of the array is " + quote(text.substr(0, end + 1)));
    }
  }
  for (const std::int64_t length : shape) {
    if (length > 0 && product > (std::int64_t(1) << 48) / length)
      refuseByte(shown, npy_dictionary, "the shape of the array is too large");
    product *= length;
  }
  return shape;
}

/// The type that numpy calls <f8, |u1, or in the other order of bytes >f8.
std::optional<FieldType> typeNamed(std::string_view descr, std::string_view orders) {
  if (descr.size() != 3 || orders.find(descr[0]) == std::string_view::npos) return std::nullopt;
  return typeOf(descr[1], static_cast<std::size_t>(descr[2] - '0'));
}

}  // namespace

std::string npyHeader(std::string_view descr, const std::vector<std::int64_t>& shape) {
  // The format aligns values to this many bytes.
  constexpr std::size_t alignment = 64;
  constexpr std::size_t before = 10;  // magic, version and length of the dictionary
  std::string lengths;
  for (const std::int64_t length : shape)
    lengths.append(lengths.empty() ? "" : " ").append(std::to_string(length)).append(",");
  if (shape.size() > 1) lengths.pop_back();
  std::string dictionary =
      "{'descr': '" + std::string(descr) + "', 'fortran_order': False, 'shape': (" + lengths + "), }";
  dictionary.append(alignment - (before + dictionary.size() + 1) % alignment, ' ');
  dictionary += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(dictionary.size() & 0xff);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

std::int64_t NpyHeader::size() const {
  std::int64_t product = 1;
  for (const std::int64_t length : shape) product *= length;
  return product;
}

std::size_t npyHeaderBytes(std::string_view beginning, const std::filesystem::path& shown) {
  if (!beginning.starts_with(magic) || beginning.size() < npy_beginning) refuseByte(shown, 0, "is no array of numpy");
  const int version = static_cast<unsigned char>(beginning[6]);
  if (version < 1 || version > 3)
    refuseByte(shown, 6, "is an array of numpy in the unknown version " + std::to_string(version));
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i)
    length |= std::size_t(static_cast<unsigned char>(beginning[8 + i])) << 8 * i;
  return 8 + length_bytes + length;
}

NpyLayout parseNpyLayout(std::string_view bytes, const std::filesystem::path& shown) {
  NpyLayout layout;
  layout.bytes = npyHeaderBytes(bytes, shown);
  if (layout.bytes > bytes.size()) refuseByte(shown, bytes.size(), "ends within the header of the array");
  const std::string_view dictionary = bytes.substr(8, layout.bytes - 8);
  layout.is_by_columns = !entry(dictionary, "fortran_order", shown).starts_with("False");
  layout.descr = entry(dictionary, "descr", shown);
  layout.shape = parseShape(entry(dictionary, "shape", shown), shown);
  return layout;
}

NpyHeader parseNpyHeader(std::string_view bytes, std::uint64_t all, const std::filesystem::path& shown) {
  const NpyLayout layout = parseNpyLayout(bytes, shown);
  if (layout.is_by_columns) refuseByte(shown, npy_dictionary, "is an array in Fortran's order, must be in C's");
  const std::size_t end = layout.descr.find('\'', 1);
  if (!layout.descr.starts_with('\'') || end == std::string_view::npos)
    refuseByte(shown, npy_dictionary, "is an array of structures");
  NpyHeader header;
  header.bytes = layout.bytes;
  header.descr = layout.descr.substr(1, end - 1);
  header.shape = layout.shape;
  const std::uint64_t values = all - header.bytes;
  header.type = typeNamed(header.descr, "<|");
  if (header.type) {
    if (values != static_cast<std::uint64_t>(header.size()) * sizeOf(*header.type))
      refuseByte(shown, header.bytes,
                 "has " + std::to_string(values) + " bytes of values, its shape says another number");
  }
  return header;
}

FieldType numberType(const NpyHeader& header, const std::filesystem::path& shown) {
  if (header.type) return *header.type;
  const bool is_swapped = typeNamed(header.descr, ">").has_value();
  refuseByte(shown, npy_dictionary,
             "is an array of " + quote(header.descr) +
                 (is_swapped ? ", which are big-endian, must be little-endian"
                             : ", must be of integers of 1 to 8 bytes, float32 or float64"));
}

std::vector<double> numbersOf(const NpyHeader& header, std::string_view values, const std::filesystem::path& shown) {
  const FieldType type = numberType(header, shown);
  std::vector<double> numbers(values.size() / sizeOf(type));
  const auto* const bytes = reinterpret_cast<const std::byte*>(values.data());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = valueOf(type, bytes + i * sizeOf(type));
  return numbers;
}

}  // namespace tufted::io

#include "view/page_block.h"

#include <zlib.h>

#include <bit>
#include <cstring>
#include <new>

namespace tufted::view {

namespace {

/// The bytes of integers: first the lowest byte of each, then the next, because bytes of one weight deflate well.
template <typename Integer>
std::vector<std::uint8_t> bytePlanes(const std::vector<Integer>& values) {
  std::vector<std::uint8_t> planes(values.size() * sizeof(Integer));
  for (std::size_t byte = 0; byte < sizeof(Integer); ++byte)
    for (std::size_t i = 0; i < values.size(); ++i)
      planes[byte * values.size() + i] = static_cast<std::uint8_t>(values[i] >> (8 * byte));
  return planes;
}

/// Differences from the value before, modulo 2 to the power of the integers' bits.
template <typename Integer>
std::vector<Integer> differences(std::vector<Integer> values) {
  for (std::size_t i = values.size(); i > 1; --i) values[i - 1] = static_cast<Integer>(values[i - 1] - values[i - 2]);
  return values;
}

}  // namespace

int PageBlocks::add(const std::vector<std::uint8_t>& values) {
  return addBytes(differences(values));
}

int PageBlocks::add(const std::vector<std::uint16_t>& values) {
  return addBytes(bytePlanes(differences(values)));
}

int PageBlocks::add(const std::vector<std::uint32_t>& values) {
  return addBytes(bytePlanes(differences(values)));
}

int PageBlocks::add(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) bits[i] = std::bit_cast<std::uint64_t>(values[i]);
  return addBytes(bytePlanes(bits));
}

int PageBlocks::addBytes(const std::vector<std::uint8_t>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  // The buffer is large enough, so it fails only if memory does not suffice.
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes.data(), static_cast<uLong>(bytes.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  html_ += "<script type=\"application/octet-stream\" id=\"block-" + std::to_string(count_) + "\">" + base64(packed) +
           "</script>\n";
  return count_++;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace tufted::view

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tufted::view {

/// Blocks of numbers for a page, one element of HTML each: deflated and in base64. The type of the element is none that
/// a browser runs.
class PageBlocks {
 public:
  /// Adds integers, as differences to the one before: those of neighbouring points are small.
  /// @returns the number of the block, from 0 on, which names its element
  int add(const std::vector<std::uint8_t>& values);
  int add(const std::vector<std::uint16_t>& values);
  int add(const std::vector<std::uint32_t>& values);
  /// Adds numbers bit for bit.
  int add(const std::vector<double>& values);

  /// The elements of all blocks.
  const std::string& html() const { return html_; }

 private:
  int addBytes(const std::vector<std::uint8_t>& bytes);

  std::string html_;
  int count_ = 0;
};

/// Bytes in base64, RFC 4648.
std::string base64(std::string_view bytes);

}  // namespace tufted::view

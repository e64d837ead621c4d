#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tufted::view {

/// Collects blocks of numbers for a page, each in an HTML element of a type that browsers do not run: deflated, in
/// base64.
class PageBlocks {
 public:
  /// Adds integers, stored as differences from the one before, which are small for neighbouring points.
  /// @return the number of the block, counted from 0, by which its element is named
  int add(const std::vector<std::uint8_t>& values);
  int add(const std::vector<std::uint16_t>& values);
  int add(const std::vector<std::uint32_t>& values);
  /// Adds numbers, stored bit for bit.
  int add(const std::vector<double>& values);

  /// The elements of all blocks.
  const std::string& html() const { return html_; }

 private:
  int addBytes(const std::vector<std::uint8_t>& bytes);

  std::string html_;
  int count_ = 0;
};

/// Encodes bytes in base64 (RFC 4648).
std::string base64(std::string_view bytes);

}  // namespace tufted::view

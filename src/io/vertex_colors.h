#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "io/line_scanner.h"
#include "tufted/io/read.h"

namespace tufted::io {

/// Colours of vertices in OFF and OBJ: three or four numbers after the coordinates, the same count for all vertices.
/// They become fields red, green, blue (and alpha).
class VertexColors {
 public:
  /// Adds the next vertex: the tokens of the scanner's line from number `first` on. @throws IoError naming the line
  void add(const LineScanner& scanner, std::size_t first);
  /// Appends the fields, or no field if a vertex has no colour. Integers up to 255 become uint8, others float32.
  /// @param ones_are_bytes whether integers that are all at most 1 are bytes (OFF) or parts of 1 (OBJ)
  /// @return whether all vertices have a colour or none has
  bool moveTo(std::vector<Field>& fields, bool ones_are_bytes);
  std::int64_t given() const { return given_; }  ///< number of vertices with values after the coordinates

 private:
  std::size_t vertices_ = 0;
  std::int64_t given_ = 0;
  std::size_t count_ = 0;  ///< values per vertex; 0 once vertices differ
  bool are_bytes_ = true;
  std::vector<float> values_;
};

}  // namespace tufted::io

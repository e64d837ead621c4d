#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "io/line_scanner.h"
#include "tufted/io/read.h"

namespace tufted::io {

/// The colours that OFF and OBJ put behind the values of a vertex: three or four numbers, the same count for all
/// vertices. They become fields red, green, blue (alpha).
class VertexColors {
 public:
  /// Takes the tokens of the next vertex's line from number `first` on. @throws IoError naming the line
  void add(const LineScanner& scanner, std::size_t first);
  /// Appends the fields, or no field if a vertex has no colour. Integers up to 255 become uint8, others float32.
  /// @param ones_are_bytes whether integers that are all at most 1 are bytes (OFF) or parts of 1 (OBJ)
  /// @returns whether all vertices have a colour or none has
  bool moveTo(std::vector<Field>& fields, bool ones_are_bytes);
  std::int64_t given() const { return given_; }  ///< vertices with further values

 private:
  std::size_t vertices_ = 0;
  std::int64_t given_ = 0;
  std::size_t count_ = 0;  ///< values per vertex, 0 once they differ
  bool are_bytes_ = true;
  std::vector<float> values_;
};

}  // namespace tufted::io

#include "field_values.h"

#include <cstdint>
#include <cstring>

Eigen::MatrixXd valuesOf(const tufted::Field& field, Eigen::Index points) {
  const bool is_packed = tufted::isPackedColor(field);
  Eigen::MatrixXd values(points, is_packed ? 3 : field.count);
  for (Eigen::Index i = 0; i < points; ++i) {
    std::uint32_t packed = 0;
    if (is_packed) std::memcpy(&packed, field.bytes.data() + 4 * i, 4);
    for (Eigen::Index c = 0; c < values.cols(); ++c)
      values(i, c) = is_packed ? packed >> (16 - 8 * c) & 0xff
                               : tufted::valueOf(field, static_cast<std::size_t>(i * field.count + c));
  }
  return values;
}

#include "io/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tufted::io {

void VertexColors::add(const LineScanner& scanner, std::size_t first) {
  const std::size_t tokens = scanner.tokens().size();
  const std::size_t given = tokens > first ? tokens - first : 0;
  if (vertices_++ == 0 && (given == 3 || given == 4)) count_ = given;
  if (given > 0) ++given_;
  if (given != count_) {
    count_ = 0;
    values_.clear();
  }
  for (std::size_t c = 0; c < count_; ++c) {
    const double value = scanner.number(first + c);
    are_bytes_ = are_bytes_ && value >= 0 && value <= 255 && value == std::trunc(value) &&
                 scanner.tokens()[first + c].find('.') == std::string_view::npos;
    values_.push_back(static_cast<float>(value));
  }
}

bool VertexColors::moveTo(std::vector<Field>& fields, bool ones_are_bytes) {
  if (!ones_are_bytes && std::none_of(values_.begin(), values_.end(), [](float value) { return value > 1; }))
    are_bytes_ = false;
  constexpr const char* names[] = {"red", "green", "blue", "alpha"};
  for (std::size_t c = 0; c < count_; ++c) {
    Field field = {names[c], are_bytes_ ? FieldType::uint8 : FieldType::float32, 1, {}};
    field.bytes.resize(vertices_ * (are_bytes_ ? 1 : sizeof(float)));
    for (std::size_t v = 0; v < vertices_; ++v) {
      const float value = values_[v * count_ + c];
      if (are_bytes_)
        field.bytes[v] = static_cast<std::byte>(value);
      else
        std::memcpy(field.bytes.data() + v * sizeof(float), &value, sizeof(float));
    }
    fields.push_back(std::move(field));
  }
  return count_ > 0 || given_ == 0;
}

}  // namespace tufted::io

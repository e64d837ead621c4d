#include "view/page_parts.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <new>

#include "view/shown_values.h"

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

namespace {

/// The greatest level.
constexpr double top_level = no_level - 1;
/// Values beyond the outer percentiles by more than this many times their distance are stored in full, because levels
/// for them would cost the others digits. Uniformly or normally distributed values have none.
constexpr double level_reach = 6;

}  // namespace

LevelColumn levelsOf(const Eigen::Ref<const Eigen::VectorXd>& values) {
  LevelColumn column;
  column.levels.assign(static_cast<std::size_t>(values.size()), no_level);
  std::vector<double> finite;
  finite.reserve(column.levels.size());
  for (const double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  column.finite = static_cast<Eigen::Index>(finite.size());
  if (finite.empty()) return column;

  const auto [minimum, maximum] = std::minmax_element(finite.begin(), finite.end());
  column.minimum = *minimum;
  column.maximum = *maximum;
  column.low = percentile(finite, 0.01);
  column.high = percentile(finite, 0.99);
  // Halves, because a difference may overflow. An infinite `reach` does no harm.
  const double reach = 2 * level_reach * (column.high / 2 - column.low / 2);
  column.least = std::max(column.minimum, column.low - reach);
  const double greatest = std::min(column.maximum, column.high + reach);
  column.step = greatest / top_level - column.least / top_level;
  for (Eigen::Index row = 0; row < values.size(); ++row) {
    const double value = values[row];
    if (!std::isfinite(value)) continue;
    const double level = column.step > 0 ? (value / 2 - column.least / 2) / (column.step / 2) : 0;
    column.levels[static_cast<std::size_t>(row)] =
        static_cast<std::uint16_t>(std::clamp(std::round(level), 0.0, top_level));
    if (value < column.least || value > greatest) {
      column.far_rows.push_back(static_cast<std::uint32_t>(row));
      column.far_values.push_back(value);
    }
  }
  return column;
}

LabelColumn labelsOf(const Eigen::Ref<const Eigen::VectorXd>& values) {
  LabelColumn column;
  for (const double value : values)
    if (std::isfinite(value)) column.names.push_back(value);
  std::sort(column.names.begin(), column.names.end());
  column.names.erase(std::unique(column.names.begin(), column.names.end()), column.names.end());
  column.indices.reserve(static_cast<std::size_t>(values.size()));
  for (const double value : values) {
    const auto name =
        std::isfinite(value) ? std::lower_bound(column.names.begin(), column.names.end(), value) : column.names.end();
    column.indices.push_back(static_cast<std::uint32_t>(name - column.names.begin()));
  }
  return column;
}

void octahedralBytes(const Eigen::Vector3d& direction, std::uint8_t bytes[2]) {
  // Steps from 0 to 1: normals are off by less than a degree, which shading does not show.
  constexpr double steps = 127;
  bytes[0] = bytes[1] = 0;
  const double largest = direction.cwiseAbs().maxCoeff();  // divided out first, because a sum may overflow
  if (!direction.allFinite() || !(largest > 0)) return;
  const Eigen::Vector3d unit = direction / largest;
  Eigen::Array2d p = unit.head<2>().array() / unit.cwiseAbs().sum();
  if (unit.z() < 0) {
    const Eigen::Array2d folded = 1 - p.abs().reverse();
    p = (p < 0).select(-folded, folded);
  }
  for (int i = 0; i < 2; ++i) bytes[i] = static_cast<std::uint8_t>(128 + std::lround(steps * p[i]));
}

}  // namespace tufted::view

#include "view/shading.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "view/threads.h"

namespace tufted::view {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Values = std::array<float, 2>;

/// Rows per parallel task.
constexpr std::int64_t rows_per_block = 16;
/// Values of discs with a larger radius than this, in samples, are blended with those of neighbouring discs; smaller
/// discs differ by less than a colour.
constexpr float blended_radius = 1.5F;
/// Blending takes samples in this many steps per radius to each side, so 49 in all.
constexpr int blend_steps = 3;
/// Standard deviation of the blending weights, in radii: isolines become smooth, and values hardly move.
constexpr float blend_width = 0.5F;
/// Samples are on one surface if their depths differ by at most this many radii of the disc.
constexpr float same_surface = 4;
/// Factor of the colour of a surface that faces the light: no colour is lighter than in the map.
constexpr float full_light = 1;
/// Factor of the colour of a surface that the light does not reach: dark sides still show their colour.
constexpr float least_light = 0.42F;
/// Strength of shading by depth if there are normals: edges stand out, surfaces do not change.
constexpr float weak_edges = 18;
/// Strength of shading by depth without normals, when it alone shows the shape.
constexpr float strong_edges = 60;
/// Distance in samples of those whose depths are compared: edges are a pixel and a half wide.
constexpr int edge_reach = 3;
/// Factor of the colour under an isoline.
constexpr float line_share = 0.35F;
constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

class Shader {
 public:
  Shader(const SeenScene& seen, const FieldColors& colors, const PictureOptions& options)
      : seen_(seen),
        colors_(colors),
        options_(options),
        points_(static_cast<std::uint32_t>(seen.scene.positions.rows())) {}

  Picture run() {
    const std::size_t size = seen_.samples.size();
    const auto rows = [this](const auto& work) {
      forBlocks(options_.threads, seen_.height, rows_per_block, [&](std::int64_t begin, std::int64_t end) {
        for (int y = static_cast<int>(begin); y < end; ++y)
          for (int x = 0; x < seen_.width; ++x) work(x, y);
      });
    };
    const bool draws_values = colors_.isBlended() && colors_.field->kind != FieldKind::vector;
    if (draws_values) {
      std::vector<Values> unblended(size);
      rows([&](int x, int y) { unblended[at(x, y)] = valuesAt(x, y); });
      values_.resize(size);
      rows([&](int x, int y) { values_[at(x, y)] = blendedValues(unblended, x, y); });
    }
    if (options_.light) {
      log_depths_.resize(size);
      rows([&](int x, int y) {
        const Sample sample = seen_.samples[at(x, y)];
        log_depths_[at(x, y)] = sample == nothing ? no_value : std::log2(depthOf(sample));
      });
    }
    shaded_.resize(size);
    rows([&](int x, int y) { shaded_[at(x, y)] = colorAt(x, y); });
    return average();
  }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * seen_.width + x; }
  bool isInside(int x, int y) const { return x >= 0 && y >= 0 && x < seen_.width && y < seen_.height; }

  SeenTriangle triangleOf(std::uint32_t t) const {
    const auto corner = [&](int k) {
      return seen_.views[static_cast<std::size_t>(seen_.scene.triangles(t, k))].cast<double>().eval();
    };
    return {seen_.projection, corner(0), corner(1), corner(2)};
  }
  /// The barycentric coordinates of a sample in a triangle.
  Vector3d sharesAt(std::uint32_t t, int x, int y) const {
    const Vector3d shares = triangleOf(t).shares(rayThrough(seen_.projection, x, y));
    const double sum = shares.sum();
    return std::abs(sum) > 0 ? Vector3d(shares / sum) : Vector3d(1, 0, 0);
  }

  Values valuesOfPoint(std::uint32_t point) const {
    return {colors_.channels[0][point], colors_.channels.size() > 1 ? colors_.channels[1][point] : 0};
  }

  Values valuesAt(int x, int y) const {
    const Sample sample = seen_.samples[at(x, y)];
    if (sample == nothing) return {no_value, no_value};
    const std::uint32_t number = numberOf(sample);
    if (number >= points_) {
      const std::uint32_t t = number - points_;
      const Vector3d shares = sharesAt(t, x, y);
      Values values = {0, 0};
      const auto valuesOfCorner = [&](Eigen::Index k) {
        return valuesOfPoint(static_cast<std::uint32_t>(seen_.scene.triangles(t, k)));
      };
      Eigen::Index nearest = 0;
      shares.maxCoeff(&nearest);
      const Values own = valuesOfCorner(nearest);
      for (int k = 0; k < 3; ++k) {
        const Values corner = valuesOfCorner(k);
        if (isCutBetween(own, corner)) return own;
        for (std::size_t c = 0; c < 2; ++c) values[c] += static_cast<float>(shares[k]) * corner[c];
      }
      return values;
    }
    return valuesOfPoint(number);
  }

  /// Whether coordinates jump between neighbours, as those of a logarithmic map do at the cut locus.
  bool isCutBetween(const Values& a, const Values& b) const {
    return colors_.field->kind == FieldKind::coordinates &&
           std::hypot(a[0] - b[0], a[1] - b[1]) > colors_.shareOfStep();
  }

  /// The mean of the values around a sample, with Gaussian weights in proportion to the radius of the disc there.
  /// Values on triangles are not blended.
  Values blendedValues(const std::vector<Values>& unblended, int x, int y) const {
    const Sample sample = seen_.samples[at(x, y)];
    const Values own = unblended[at(x, y)];
    if (sample == nothing || numberOf(sample) >= points_) return own;
    const float radius = seen_.screen_radii[numberOf(sample)];
    if (!(radius > blended_radius) || !std::isfinite(own[0])) return own;
    const float depth = depthOf(sample);
    const float tolerance = same_surface * radius / static_cast<float>(seen_.projection.scaleAt(depth));
    const float step = std::max(radius / blend_steps, 1.0F);
    std::array<int, 2 * blend_steps + 1> offsets;
    std::array<float, 2 * blend_steps + 1> bell;
    for (std::size_t index = 0; index < offsets.size(); ++index) {
      const int k = static_cast<int>(index) - blend_steps;
      offsets[index] = static_cast<int>(std::floor(static_cast<float>(k) * step + 0.5F));
      const float far = static_cast<float>(offsets[index]) / (blend_width * radius);
      bell[index] = std::exp(-0.5F * far * far);
    }
    float weights = 0;
    Values sum = {0, 0};
    for (std::size_t j = 0; j < offsets.size(); ++j)
      for (std::size_t i = 0; i < offsets.size(); ++i) {
        const int u = x + offsets[i];
        const int v = y + offsets[j];
        if (!isInside(u, v)) continue;
        const Sample other = seen_.samples[at(u, v)];
        if (other == nothing || numberOf(other) >= points_ || std::abs(depthOf(other) - depth) > tolerance) continue;
        const Values& values = unblended[at(u, v)];
        if (!std::isfinite(values[0]) || isCutBetween(own, values)) continue;
        const float weight = bell[i] * bell[j];
        weights += weight;
        for (std::size_t c = 0; c < 2; ++c) sum[c] += weight * values[c];
      }
    for (float& value : sum) value /= weights;
    return sum;
  }

  Rgb baseColor(int x, int y, std::uint32_t number) const {
    if (colors_.field == nullptr || colors_.field->kind == FieldKind::vector) return none_color;
    if (!values_.empty()) return colors_.colorOf(values_[at(x, y)]);
    if (number < points_) return colors_.colorOfPoint(static_cast<int>(number));
    const std::uint32_t t = number - points_;
    int corner = 0;
    sharesAt(t, x, y).maxCoeff(&corner);
    return colors_.colorOfPoint(seen_.scene.triangles(t, corner));
  }

  /// The normal towards the eye; 0 if unknown.
  Vector3f normalAt(int x, int y, std::uint32_t number) const {
    if (number < points_) return seen_.normals.empty() ? Vector3f::Zero().eval() : seen_.normals[number];
    const std::uint32_t t = number - points_;
    const auto corner = [&](int k) { return static_cast<std::size_t>(seen_.scene.triangles(t, k)); };
    const Vector3f flat = (seen_.views[corner(1)] - seen_.views[corner(0)])
                              .cross(seen_.views[corner(2)] - seen_.views[corner(0)])
                              .stableNormalized();
    Vector3f normal = Vector3f::Zero();
    if (!seen_.normals.empty()) {
      const Vector3f shares = sharesAt(t, x, y).cast<float>();
      for (int k = 0; k < 3; ++k) {
        const Vector3f& n = seen_.normals[corner(k)];
        normal += shares[k] * (n.dot(flat) < 0 ? Vector3f(-n) : n);
      }
    }
    normal = normal.squaredNorm() > 0 ? normal.stableNormalized() : flat;
    return normal.dot(seen_.projection.sight(rayThrough(seen_.projection, x, y)).cast<float>()) > 0 ? Vector3f(-normal)
                                                                                                    : normal;
  }

  /// The factor by which light and depth shade a sample.
  float lightAt(int x, int y, Sample sample) const {
    const Vector3f normal = normalAt(x, y, numberOf(sample));
    const bool is_known = normal.squaredNorm() > 0;
    float light = full_light;
    if (is_known) {
      // The light comes from the left and above the eye; depth grows away from it.
      static const Vector3f source = Vector3f(-0.35F, 0.45F, -1).normalized();
      light = least_light + (full_light - least_light) * std::max(normal.dot(source), 0.0F);
    }
    return light * std::exp(-(is_known ? weak_edges : strong_edges) * depthBelowNeighbors(x, y));
  }

  /// How far neighbours are in front of a sample: the mean difference of the logarithms of depth (Boucheny 2009,
  /// Section 3.3).
  float depthBelowNeighbors(int x, int y) const {
    static constexpr std::array<std::array<int, 2>, 8> steps = {
        {{3, 0}, {2, 2}, {0, 3}, {-2, 2}, {-3, 0}, {-2, -2}, {0, -3}, {2, -2}}};
    static_assert(edge_reach == steps[0][0]);
    const float depth = log_depths_[at(x, y)];
    float sum = 0;
    for (const auto& step : steps) {
      if (!isInside(x + step[0], y + step[1])) continue;
      const float other = log_depths_[at(x + step[0], y + step[1])];
      if (!std::isnan(other)) sum += std::max(0.0F, depth - other - slack_);
    }
    return sum / static_cast<float>(steps.size());
  }

  bool isOnLine(int x, int y, Sample sample) const {
    if (!(colors_.step > 0) || values_.empty()) return false;
    const Values& own = values_[at(x, y)];
    if (!std::isfinite(own[0])) return false;
    for (std::size_t c = 0; c < colors_.channels.size(); ++c)
      for (const auto& [i, j] : {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)}) {
        if (!isInside(x + i, y + j)) continue;
        const Sample other = seen_.samples[at(x + i, y + j)];
        const float value = values_[at(x + i, y + j)][c];
        if (other == nothing || !std::isfinite(value) || colors_.levelOf(value) == colors_.levelOf(own[c])) continue;
        if (isCutBetween(own, values_[at(x + i, y + j)])) continue;
        const bool is_step = std::abs(value - own[c]) < 2 * colors_.shareOfStep();
        if (is_step && std::abs(depthOf(other) / depthOf(sample) - 1) < 0.03F) return true;
      }
    return false;
  }

  std::array<std::uint8_t, 4> colorAt(int x, int y) const {
    const Sample sample = seen_.samples[at(x, y)];
    if (sample == nothing) return backgroundColor(options_.background);
    const Rgb base = baseColor(x, y, numberOf(sample));
    float share = options_.light ? lightAt(x, y, sample) : 1;
    if (isOnLine(x, y, sample)) share *= line_share;
    std::array<std::uint8_t, 4> color = {0, 0, 0, 255};
    for (std::size_t k = 0; k < 3; ++k)
      color[k] = static_cast<std::uint8_t>(std::lround(std::clamp(share * static_cast<float>(base[k]), 0.0F, 255.0F)));
    return color;
  }

  Picture average() const {
    Picture picture = {seen_.width / samples_per_pixel, seen_.height / samples_per_pixel, {}};
    picture.pixels.resize(4 * static_cast<std::size_t>(picture.width) * picture.height);
    forBlocks(options_.threads, picture.height, rows_per_block, [&](std::int64_t begin, std::int64_t end) {
      for (int y = static_cast<int>(begin); y < end; ++y)
        for (int x = 0; x < picture.width; ++x) {
          std::array<int, 4> sum = {0, 0, 0, 0};
          for (int j = 0; j < samples_per_pixel; ++j)
            for (int i = 0; i < samples_per_pixel; ++i) {
              const auto& color = shaded_[at(samples_per_pixel * x + i, samples_per_pixel * y + j)];
              for (std::size_t k = 0; k < 3; ++k) sum[k] += color[k] * color[3];
              sum[3] += color[3];
            }
          std::uint8_t* const pixel = &picture.pixels[4 * (static_cast<std::size_t>(y) * picture.width + x)];
          if (sum[3] == 0) continue;
          for (std::size_t k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>((sum[k] + sum[3] / 2) / sum[3]);
          constexpr int count = samples_per_pixel * samples_per_pixel;
          pixel[3] = static_cast<std::uint8_t>((sum[3] + count / 2) / count);
        }
    });
    return picture;
  }

  const SeenScene& seen_;
  const FieldColors& colors_;
  const PictureOptions& options_;
  std::uint32_t points_;
  /// Differences of logarithms of depth up to this do not shade, as they are due to the bulges of discs.
  float slack_ = 0.0005F;
  std::vector<Values> values_;
  std::vector<float> log_depths_;  // NaN where nothing is seen
  std::vector<std::array<std::uint8_t, 4>> shaded_;
};

}  // namespace

Picture shade(const SeenScene& seen, const FieldColors& colors, const PictureOptions& options) {
  return Shader(seen, colors, options).run();
}

std::array<std::uint8_t, 4> backgroundColor(Background background) {
  switch (background) {
    case Background::dark:
      return {24, 26, 30, 255};
    case Background::transparent:
      return {255, 255, 255, 0};
    default:
      return {255, 255, 255, 255};
  }
}

}  // namespace tufted::view

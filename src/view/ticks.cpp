#include "view/ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tufted::view {
namespace {

/// About how many marks a scale has.
constexpr int most_steps = 6;
/// A logarithmic scale of fewer powers of ten also has marks at two and five times these, seven or eight in all.
constexpr double most_powers = 2.5;
/// A scale shorter than this, relative to its greatest number, has marks relative to a round number near its low end,
/// because all would begin with the same digits.
constexpr double short_scale = 1e-4;
/// A scale shorter than this, relative to its greatest number, has one mark: it is within rounding of doubles.
constexpr double shortest_scale = 1e-13;

/// A number with `digits` decimals and a typographic minus sign.
std::string numberText(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, std::abs(value));
  const bool is_zero = std::string(text).find_first_not_of("0.") == std::string::npos;
  std::string signed_text = value < 0 && !is_zero ? "\u2212" : "";
  return signed_text += text;
}

}  // namespace

double niceStep(double span, int count) {
  if (!(span > 0) || !std::isfinite(span)) return 0;
  const double rough = span / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  if (!(power > 0)) return 0;  // underflow
  const double share = rough / power;
  return power * (share <= 1.0001 ? 1 : share <= 2.0001 ? 2 : share <= 5.0001 ? 5 : 10);
}

Ticks ticksOf(double low, double high) {
  Ticks ticks;
  const double most = std::max(std::abs(low), std::abs(high)), span = high - low;
  if (span > shortest_scale * most && span < short_scale * most) {
    const double unit = std::pow(10.0, std::ceil(std::log10(span)));
    const double offset = std::floor(low / unit) * unit;
    ticks = ticksOf(low - offset, high - offset);
    for (double& value : ticks.values) value += offset;
    ticks.offset = offset;
    return ticks;
  }
  if (most > 0 && (most >= 1e5 || most < 1e-2)) {
    ticks.exponent = static_cast<int>(std::floor(std::log10(most)));
    ticks.exponent -= ((ticks.exponent % 3) + 3) % 3;
  }
  const double step = niceStep(span, most_steps);
  const bool is_one_value = step == 0 || span <= shortest_scale * most;
  if (is_one_value) {
    ticks.values = {low};
  } else {
    const double first = std::ceil(low / step - 1e-6), last = std::floor(high / step + 1e-6);
    for (int k = 0; k <= static_cast<int>(last - first); ++k) ticks.values.push_back((first + k) * step);
  }
  const double shift = ticks.exponent;
  const double shown = std::log10(is_one_value ? std::max(most, 1e-300) / 1e3 : step) - shift;
  const int digits = std::clamp(static_cast<int>(std::ceil(-shown - 1e-6)), 0, 12);
  for (const double value : ticks.values)
    ticks.texts.push_back(numberText(value * std::pow(10.0, -shift / 2) * std::pow(10.0, -shift / 2), digits));
  return ticks;
}

Ticks logarithmicTicksOf(double low, double high) {
  Ticks ticks;
  if (!(high - low >= 1)) {  // less than a factor of ten: linear marks, at their logarithms
    ticks = ticksOf(std::pow(10.0, low), std::pow(10.0, high));
    for (double& value : ticks.values) value = std::log10(value);
    return ticks;
  }
  const int every = static_cast<int>(std::ceil((high - low) / most_steps));
  const bool has_more = high - low < most_powers;
  for (int power = static_cast<int>(std::floor(low)); power <= high + 1e-9; ++power) {
    if (power % every != 0) continue;
    for (const int digit : has_more ? std::vector<int>{1, 2, 5} : std::vector<int>{1}) {
      const double place = power + std::log10(digit);
      if (place < low - 1e-9 || place > high + 1e-9) continue;
      ticks.values.push_back(place);
      const bool is_short = power >= -3 && power < 5;
      std::string text = digit == 1 ? "" : std::to_string(digit) + "\u00d7";
      ticks.texts.push_back(is_short ? numberText(digit * std::pow(10.0, power), std::max(0, -power))
                                     : text + "10" + raised(power));
    }
  }
  return ticks;
}

std::string raised(int exponent) {
  static const char* const digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                       "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "\u207b" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[digit - '0'];
  return text;
}

}  // namespace tufted::view

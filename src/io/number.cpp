#include "io/number.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace tufted::io {
namespace {

/// Parses what Microsoft's printf wrote before 2015: 1.#INF, -1.#IND, 1.#QNAN and 1.#SNAN, and digits after them.
template <class T>
bool parseMicrosoft(std::string_view token, T& value) {
  const bool negative = token.starts_with('-');
  if (negative) token.remove_prefix(1);
  if (!token.starts_with("1.#")) return false;
  token.remove_prefix(3);
  const bool infinite = token.starts_with("INF");
  if (!infinite && !token.starts_with("IND") && !token.starts_with("QNAN") && !token.starts_with("SNAN")) return false;
  value = infinite ? std::numeric_limits<T>::infinity() : std::numeric_limits<T>::quiet_NaN();
  if (negative) value = -value;
  return true;
}

/// The value of a number that from_chars() finds out of range, and does not return: 0 or infinite, with its sign.
template <class T>
T outOfRange(std::string_view token) {
  const bool negative = token.starts_with('-');
  if (negative) token.remove_prefix(1);
  const std::size_t exponent = token.find_first_of("eE");
  const bool small = exponent == std::string_view::npos ? token.starts_with("0") || token.starts_with(".")
                                                        : token.substr(exponent + 1).starts_with('-');
  const T magnitude = small ? T(0) : std::numeric_limits<T>::infinity();
  return negative ? -magnitude : magnitude;
}

template <class T>
bool parseFloat(std::string_view token, T& value) {
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (end != token.data() + token.size()) return parseMicrosoft(token, value);
  if (error == std::errc::result_out_of_range) {
    value = outOfRange<T>(token);
    return true;
  }
  return error == std::errc();
}

template <class T>
bool parseInteger(std::string_view token, T& value) {
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error == std::errc() && end == token.data() + token.size()) return true;
  double decimal = 0;
  if (!parseFloat(token, decimal) || decimal != std::trunc(decimal)) return false;
  // Compares with a power of two, which is exact in double; the greatest 64-bit integer is not.
  const double above = std::ldexp(1.0, std::numeric_limits<T>::digits);
  const double least = std::is_signed_v<T> ? -above : 0.0;
  if (!(decimal >= least && decimal < above)) return false;
  value = static_cast<T>(decimal);
  return true;
}

}  // namespace

template <class T>
bool parseNumber(std::string_view token, T& value) {
  if (token.starts_with('+')) {
    token.remove_prefix(1);
    if (token.starts_with('-')) return false;
  }
  if constexpr (std::is_integral_v<T>)
    return parseInteger(token, value);
  else
    return parseFloat(token, value);
}

template bool parseNumber(std::string_view, std::int8_t&);
template bool parseNumber(std::string_view, std::uint8_t&);
template bool parseNumber(std::string_view, std::int16_t&);
template bool parseNumber(std::string_view, std::uint16_t&);
template bool parseNumber(std::string_view, std::int32_t&);
template bool parseNumber(std::string_view, std::uint32_t&);
template bool parseNumber(std::string_view, std::int64_t&);
template bool parseNumber(std::string_view, std::uint64_t&);
template bool parseNumber(std::string_view, float&);
template bool parseNumber(std::string_view, double&);

std::string shortestText(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

}  // namespace tufted::io

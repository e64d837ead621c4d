#pragma once

#include <CLI/App.hpp>
#include <charconv>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <system_error>

/// Parses a size in bytes. K, M, G and T are powers of 1024, as for the shell's tools. Not by CLI11, which converts -1
/// to the largest number.
/// @returns nothing if `text` is no size, or one of less than 1 byte or of 2^63 and more
inline std::optional<std::size_t> parseBytes(const std::string& text) {
  static const std::map<std::string, double> units = {
      {"", 1},       {"B", 1},      {"kB", 1e3},   {"MB", 1e6},     {"GB", 1e9},     {"TB", 1e12},    {"K", 0x1p10},
      {"M", 0x1p20}, {"G", 0x1p30}, {"T", 0x1p40}, {"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30}, {"TiB", 0x1p40}};
  double number = 0;
  const char* const text_end = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), text_end, number);
  const auto unit = units.find(std::string(end, text_end));
  if (error != std::errc() || unit == units.end()) return std::nullopt;
  const double bytes = number * unit->second;
  return bytes >= 1 && bytes < 0x1p63 ? std::optional(static_cast<std::size_t>(bytes)) : std::nullopt;
}

/// Adds an option that takes a size in bytes.
/// @param set called with the size and with its text
template <class Set>
CLI::Option* addBytes(CLI::App& app, const std::string& name, const Set& set, const std::string& help) {
  const auto check = [](const std::string& text) {
    return parseBytes(text) ? std::string() : text + " is not a size such as 4G or 500M";
  };
  return app
      .add_option_function<std::string>(
          name, [set](const std::string& text) { set(parseBytes(text).value(), text); }, help)
      ->check(check)
      ->type_name("SIZE");
}

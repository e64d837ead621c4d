#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <charconv>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>

#include "tufted/io/read.h"

// What the options of several subcommands have in common.

/// The values of --as.
inline const std::map<std::string, tufted::ReadAs> kinds = {{"cloud", tufted::ReadAs::cloud},
                                                            {"mesh", tufted::ReadAs::mesh}};

/// An option that takes one of the names in `values`.
template <class T>
CLI::Option* addChoice(CLI::App& app, const std::string& name, T& target, const std::map<std::string, T>& values,
                       const std::string& help) {
  std::string names;
  for (const auto& [key, value] : values) names += (names.empty() ? "" : "|") + key;
  const auto set = [&target, &values](const std::string& key) { target = values.at(key); };
  const auto check = [&values, names](const std::string& key) {
    return values.count(key) > 0 ? std::string() : key + " is none of " + names;
  };
  return app.add_option_function<std::string>(name, set, help)->check(check)->type_name(names);
}

/// A check: a path must not be empty.
inline std::string notEmpty(const std::string& path) {
  return path.empty() ? "must not be empty" : "";
}

/// An option that takes a number in [least, most].
template <class T, class Target>
CLI::Option* addNumber(CLI::App& app, const std::string& name, Target& target, T least, T most,
                       const std::string& help) {
  const auto parse = [least, most](const std::string& text) -> std::optional<T> {
    T value = {};
    const char* const text_end = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), text_end, value);
    const bool valid = error == std::errc() && end == text_end && value >= least && value <= most;
    return valid ? std::optional<T>(value) : std::nullopt;
  };
  const auto check = [parse, least, most](const std::string& text) {
    if (parse(text)) return std::string();
    std::ostringstream message;
    message << text << " is not " << (std::is_integral_v<T> ? "an integer" : "a number") << " in [" << least << ", "
            << most << ']';
    return message.str();
  };
  const auto set = [&target, parse](const std::string& text) { target = parse(text).value(); };
  return app.add_option_function<std::string>(name, set, help)->check(check);
}

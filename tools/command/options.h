#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include "suggestion.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

// Helpers for options of several subcommands.

/// The values of --as.
inline const std::map<std::string, tufted::ReadAs> kinds = {{"cloud", tufted::ReadAs::cloud},
                                                            {"mesh", tufted::ReadAs::mesh}};

/// A number for messages.
inline std::string numberText(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// A count with its noun: "1 component", "2 components".
inline std::string countText(std::int64_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/// The names of fields.
template <class Fields>
std::vector<std::string> namesOf(const Fields& fields) {
  std::vector<std::string> names;
  for (const auto& field : fields) names.push_back(field.name);
  return names;
}

template <class T>
std::vector<std::string> namesIn(const std::map<std::string, T>& values) {
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

/// The message for a word that is none of the known ones; an empty string if it is one.
inline std::string refuseName(const std::string& word, const std::vector<std::string>& known) {
  const bool is_known = std::find(known.begin(), known.end(), word) != known.end();
  return is_known ? "" : noneOf(word, known, "|");
}

/// Adds an option that takes one of the names in `values`. The target may be std::optional.
template <class Target, class T>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Target& target, const std::map<std::string, T>& values,
                       const std::string& help) {
  const auto set = [&target, &values](const std::string& key) { target = values.at(key); };
  const std::vector<std::string> known = namesIn(values);
  const auto check = [known](const std::string& key) { return refuseName(key, known); };
  return app.add_option_function<std::string>(name, set, help)->check(check)->type_name(joined(known, "|"));
}

/// Check of a path: the message if it is empty, otherwise an empty string.
inline std::string notEmpty(const std::string& path) {
  return path.empty() ? "must not be empty" : "";
}

/// An option's name, and the type of its value that the help shows, from "--name TYPE"; without a type CLI11's own.
struct TypedName {
  explicit TypedName(const std::string& text) : name(text.substr(0, text.find(' '))) {
    if (name.size() < text.size()) type = text.substr(name.size() + 1);
  }
  CLI::Option* on(CLI::Option* option) const { return type.empty() ? option : option->type_name(type); }
  std::string name, type;
};

/// Adds an option that takes a text, such as a path, which must not be empty.
/// @param name with the type of the value, such as "--handles TEXT"
template <class Target>
CLI::Option* addText(CLI::App& app, const std::string& name, Target& target, const std::string& help) {
  const TypedName typed(name);
  return typed.on(app.add_option(typed.name, target, help)->check(notEmpty));
}

/// Splits a list at its commas.
inline std::vector<std::string> wordsOf(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list + ',');
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

/// Adds an option that takes words separated by commas, none of them empty, and may be repeated.
/// @param check returns the message for a word that is not valid, otherwise an empty string
/// @param set called with all words
template <class Check, class Set>
CLI::Option* addList(CLI::App& app, const std::string& name, const std::string& help, const Check& check,
                     const Set& set) {
  const auto check_all = [check](const std::string& list) {
    if (list.empty()) return std::string("must not be empty");
    for (const std::string& word : wordsOf(list)) {
      const std::string why = word.empty() ? list + " has an empty word, must have none" : check(word);
      if (!why.empty()) return why;
    }
    return std::string();
  };
  const auto set_all = [set](const std::vector<std::string>& lists) {
    std::vector<std::string> words;
    for (const std::string& list : lists)
      for (const std::string& word : wordsOf(list)) words.push_back(word);
    set(words);
  };
  return app.add_option_function<std::vector<std::string>>(name, set_all, help)
      ->allow_extra_args(false)  // what follows may be FILE
      ->check(check_all);
}

/// Removes the function's name from a message of the library if it is a member of a class, which users do not know.
inline std::string withoutClass(std::string message) {
  if (const std::size_t colon = message.find(": "); message.find("::") < colon) message.erase(0, colon + 2);
  return message;
}

/// Runs `work`, and adds the option to the message of InvalidInput.
/// @param option name and value, as the user gave them
template <class Work>
auto forOption(const std::string& option, const Work& work) {
  try {
    return work();
  } catch (const tufted::InvalidInput& error) {
    throw tufted::InvalidInput(option + ": " + withoutClass(error.what()));
  }
}

/// Parses a whole word as a number.
/// @return whether it is one
template <class T>
bool parseNumber(const std::string& word, T& number) {
  const char* const word_end = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), word_end, number);
  return error == std::errc() && end == word_end;
}

/// The text of a range for messages; the least and the greatest double stand for 0 and infinity.
template <class T>
std::string rangeText(T least, T most) {
  std::ostringstream text;
  const bool is_above_0 = !std::is_integral_v<T> && least == std::numeric_limits<T>::min();
  const bool is_unbounded = !std::is_integral_v<T> && most == std::numeric_limits<T>::max();
  is_above_0 ? text << "(0" : text << '[' << least;
  text << ", ";
  is_unbounded ? text << "inf)" : text << most << ']';
  return text.str();
}

/// Adds an option that takes a number in [least, most].
/// @param name with the type of the value, such as "--count K"
template <class T, class Target>
CLI::Option* addNumber(CLI::App& app, const std::string& name, Target& target, T least, T most,
                       const std::string& help) {
  const auto parse = [least, most](const std::string& text) -> std::optional<T> {
    T value = {};
    return parseNumber(text, value) && value >= least && value <= most ? std::optional(value) : std::nullopt;
  };
  const auto check = [parse, least, most](const std::string& text) {
    if (parse(text)) return std::string();
    return text + " is not " + (std::is_integral_v<T> ? "an integer" : "a number") + " in " + rangeText(least, most);
  };
  const auto set = [&target, parse](const std::string& text) { target = parse(text).value(); };
  const TypedName typed(name);
  return typed.on(app.add_option_function<std::string>(typed.name, set, help)->check(check));
}

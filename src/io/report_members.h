#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "io/errors.h"

namespace tufted::io {

/// Reads a member of a report into `value`, which stays where there is no such member, or null: an older version did
/// not have it, or a real number was not finite. Integers must fit, and arrays have their length.
/// @throws IoError naming `path`
template <class Value>
void readMember(const nlohmann::json& json, const std::string& name, const std::filesystem::path& path, Value& value) {
  const auto member = json.find(name);
  if (member == json.end() || member->is_null()) return;
  const auto refuseMember = [&](const std::string& rule) {
    refuse(path, "has " + name + " = " + quote(member->dump()) + ", must be " + rule);
  };
  if constexpr (std::is_same_v<Value, bool>) {
    if (!member->is_boolean()) refuseMember("true or false");
    value = member->template get<bool>();
  } else if constexpr (std::is_integral_v<Value>) {
    // What is read as no unsigned number is negative or no integer.
    constexpr Value most = std::numeric_limits<Value>::max();
    if (!member->is_number_unsigned() || member->template get<std::uint64_t>() > static_cast<std::uint64_t>(most))
      refuseMember("an integer in [0, " + std::to_string(most) + "]");
    value = member->template get<Value>();
  } else if constexpr (std::is_floating_point_v<Value>) {
    if (member->is_number()) value = member->template get<Value>();
  } else {  // an array
    if (!member->is_array() || member->size() != value.size())
      refuseMember("an array of " + std::to_string(value.size()));
    for (std::size_t k = 0; k < value.size(); ++k)
      readMember(nlohmann::json{{name, (*member)[k]}}, name, path, value[k]);
  }
}

}  // namespace tufted::io

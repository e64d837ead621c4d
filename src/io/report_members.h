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

/// Reads a member of a report into `value`, which stays as it is if the member is missing, as in older versions, or
/// null, as JSON has it for numbers that are not finite.
/// @throws IoError naming `path` for another type, an integer that does not fit, or an array of another length
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
    // Negative numbers and decimals are not `unsigned` in JSON.
    constexpr Value most = std::numeric_limits<Value>::max();
    if (!member->is_number_unsigned() || member->template get<std::uint64_t>() > static_cast<std::uint64_t>(most))
      refuseMember("an integer in [0, " + std::to_string(most) + "]");
    value = member->template get<Value>();
  } else if constexpr (std::is_floating_point_v<Value>) {
    if (member->is_number()) value = member->template get<Value>();
  } else {  // Value is an array
    if (!member->is_array() || member->size() != value.size())
      refuseMember("an array of " + std::to_string(value.size()));
    for (std::size_t k = 0; k < value.size(); ++k)
      readMember(nlohmann::json{{name, (*member)[k]}}, name, path, value[k]);
  }
}

}  // namespace tufted::io

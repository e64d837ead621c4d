#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// The first line of the table that `validate` prints.
std::string tableHeader();
/// The line of a file, which ends with its name and messages.
/// @param row result of judge(); missing members are shown as "-"
std::string tableLine(const nlohmann::ordered_json& row);

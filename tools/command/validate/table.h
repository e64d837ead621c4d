#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// The lines of the table that `validate` prints; each ends in the file and what is to be said about it.
std::string tableHeader();
/// @param row members as the worker names them; those that are absent show as "-"
std::string tableLine(const nlohmann::ordered_json& row);

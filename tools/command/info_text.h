#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// What `tufted info` prints, from the members of its JSON.

/// One sentence for each oddity that a user should know before trusting a result.
/// @param joins_equal whether equal vertices of a mesh are joined
std::vector<std::string> findOddities(const nlohmann::ordered_json& info, bool joins_equal);

/// Prints what the head of a file says, at once, because reading a large file takes a while.
void printInfoHead(const nlohmann::ordered_json& info);

/// Prints what only shows when the file is read.
void printInfo(const nlohmann::ordered_json& info);

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "summary.h"

// What `tufted info` prints, from the members of its JSON.

/// One sentence for each oddity that a user should know before trusting a result.
/// @param joins_equal whether equal vertices of a mesh are joined
std::vector<std::string> findOddities(const nlohmann::ordered_json& info, bool joins_equal);

/// What the head of a file says.
Summary infoHead(const nlohmann::ordered_json& info);

/// What only shows when the file is read.
Summary infoBody(const nlohmann::ordered_json& info);

#pragma once

#include <string>
#include <vector>

#include "progress_bar.h"
#include "tufted/laplacian.h"

/// How many points have which status, if no point is active; otherwise an empty string.
std::string nothingActive(const tufted::Laplacian& laplacian);

/// What a user must know of a build, see tufted::warnings(), each line with the name of the file in front.
std::vector<std::string> warningsOf(const std::string& file, const tufted::Report& report);

/// Writes a line to stderr, in place of the bar.
void warn(ProgressBar& bar, const std::string& line);

#pragma once

#include <string>
#include <vector>

#include "progress_bar.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"

/// How many points have which status if no point is active; otherwise an empty string.
std::string nothingActive(const tufted::Laplacian& laplacian);

/// What is to be said of a geometry that was read: its notes, tufted::hoveringWarning() of a cloud without pixels, and
/// lines of what was computed, each preceded by the name of the file.
std::vector<std::string> warningsOf(const std::string& file, const tufted::Geometry& geometry,
                                    const std::vector<std::string>& computed = {});

/// Clears the bar and writes a line to stderr.
void warn(ProgressBar& bar, const std::string& line);

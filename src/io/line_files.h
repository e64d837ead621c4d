#pragma once

#include <vector>

#include "io/output_file.h"
#include "tufted/polyline.h"

namespace tufted::io {

/// Writes lines.ply as documented at writeResults().
/// @throws IoError
void writeLinesPly(const OutputPath& to, const std::vector<Polyline>& lines);
/// Writes lines.obj as documented at writeResults().
/// @throws IoError
void writeLinesObj(const OutputPath& to, const std::vector<Polyline>& lines);
/// Writes lines.svg as documented at writeResults().
/// @throws IoError
void writeLinesSvg(const OutputPath& to, const std::vector<Polyline>& lines);

}  // namespace tufted::io

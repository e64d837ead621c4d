#pragma once

#include <string>
#include <vector>

#include "tufted/io/write.h"

namespace tufted::io {

/// A convention of the files, such as the sign of L, stated in the same words in every file.
struct Convention {
  std::string name;
  std::string text;        ///< ASCII, one line
  bool per_point = false;  ///< whether it concerns values per point, so that files of points state it too
};

/// The conventions of files written with these options: names, sign, scale and dummy values.
std::vector<Convention> conventions(const Laplacian& laplacian, const WriteOptions& options);

/// Lines "<prefix>name: text", one per convention.
/// @param per_point_only whether to leave out those that do not concern values per point
std::string conventionLines(const std::vector<Convention>& conventions, const std::string& prefix,
                            bool per_point_only = false);

}  // namespace tufted::io

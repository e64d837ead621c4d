#pragma once

#include <string>
#include <vector>

#include "tufted/io/write.h"

namespace tufted::io {

/// A line on what the numbers in the files mean, the same in every file.
struct Convention {
  std::string name;
  std::string text;        ///< ASCII, one line
  bool per_point = false;  ///< about the values per point, which files of points hold too
};

/// States names, sign, scale and dummy values of what is written with these options.
std::vector<Convention> conventions(const Laplacian& laplacian, const WriteOptions& options);

/// A line "<prefix>name: text" for each convention, or only for those about the values per point.
std::string conventionLines(const std::vector<Convention>& conventions, const std::string& prefix,
                            bool per_point_only = false);

}  // namespace tufted::io

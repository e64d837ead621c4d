#pragma once

#include "operator.h"

/// Size and spacing of a surface, with which lengths and times that a user gives are compared.
struct Extent {
  std::string name;  ///< name of the source, for messages
  double size = 0;   ///< diagonal of the box of the active points, or the root of the area if that is larger, as for a
                     ///< rolled-up surface, or the points are unknown
  double spacing = 0;  ///< mean edge length

  /// "FILE has the size 0.25 and the spacing 0.002", for messages.
  std::string text() const;
};

Extent extentOf(const Operator& source);

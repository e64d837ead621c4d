#pragma once

#include "operator.h"

/// How large the shape of a Laplacian is, and how near to each other its points are. Lengths and times that a user
/// gives are compared with these.
struct Extent {
  std::string name;    ///< of the source, for messages
  double size = 0;     ///< the diagonal of the box around the active points; the root of the area if that is larger, as
                       ///< of a rolled-up surface, or if the points are unknown
  double spacing = 0;  ///< the mean edge length

  /// "FILE has the size 0.25 and the spacing 0.002", for messages.
  std::string text() const;
};

Extent extentOf(const Operator& source);

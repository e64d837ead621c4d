#pragma once

#include <memory>

#include "base/parallel.h"
#include "denoise/moves.h"
#include "denoise/neighbor_lists.h"
#include "denoise/windows.h"
#include "support/ranked.h"

namespace tufted::support {

inline const Progress silent;

/// A cloud with room for windows around every eighth point.
struct WindowCloud {
  RankedCloud ranked;
  Workers workers = Workers(1, silent);
  NeighborSource source;
  Windows windows;
  NeighborLists lists;

  explicit WindowCloud(const Points& points)
      : ranked(support::ranked(points)),
        source(windowSource(std::make_unique<NeighborSearch>(ranked.points), ranked.size())),
        lists(ranked.size()) {
    windows.resize(ranked.size(), Windows::widest_stride);
  }
};

}  // namespace tufted::support

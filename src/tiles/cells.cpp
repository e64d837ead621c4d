#include "tiles/cells.h"

namespace tufted {

Cells::Cells(double edge, std::vector<std::int64_t> begin, std::vector<CellBox> boxes)
    : edge_(edge), begin_(std::move(begin)) {
  tree_.push_back(std::move(boxes));
  while (tree_.back().size() > 1) {
    const std::vector<CellBox>& below = tree_.back();
    std::vector<CellBox> level((below.size() + fan - 1) / fan);
    for (std::size_t i = 0; i < below.size(); ++i) level[i / fan].widen(below[i]);
    tree_.push_back(std::move(level));
  }
}

}  // namespace tufted

#include "operators/check_cover.h"

#include "base/cover_source.h"
#include "tufted/errors.h"

namespace tufted {

void checkCover(const std::string& function, const Laplacian& laplacian) {
  const std::string name = function + ": cover ";
  if (laplacian.hasCover() && laplacian.cover_source->stored() == nullptr) return;  // that of a cloud's stars fits
  const IntrinsicTriangulation& cover = laplacian.cover();
  const auto n = std::ssize(laplacian.status);
  if (cover.vertices != n)
    throw InvalidInput(name + "has " + std::to_string(cover.vertices) + " vertices, must have " + std::to_string(n));
  if (std::ssize(cover.length) != 3 * cover.size())
    throw InvalidInput(name + "has " + std::to_string(cover.length.size()) + " lengths, must have " +
                       std::to_string(3 * cover.size()));
  for (const auto& face : cover.faces) {
    for (const int corner : face) {
      if (corner >= 0 && corner < n) continue;
      throw InvalidInput(name + "has the corner " + std::to_string(corner) + ", must lie in [0, " + std::to_string(n) +
                         ")");
    }
  }
}

}  // namespace tufted

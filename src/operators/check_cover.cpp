#include "operators/check_cover.h"

#include "base/cover_source.h"
#include "tufted/errors.h"

namespace tufted {

void checkCover(const std::string& function, const Laplacian& laplacian) {
  const std::string name = function + ": cover ";
  const auto n = std::ssize(laplacian.status);
  const int vertices = laplacian.hasCover() ? laplacian.cover_source->vertices() : laplacian.cover().vertices;
  if (vertices != n)
    throw InvalidInput(name + "has " + std::to_string(vertices) + " vertices, must have " + std::to_string(n));
  if (laplacian.cover_source->stored() == nullptr) return;  // a build has made its faces
  const IntrinsicTriangulation& cover = laplacian.cover();
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

#include "pipeline/union_cover.h"

#include "base/buffer.h"
#include "cover/cover.h"
#include "direct/star_triangles.h"

namespace tufted {
void addStars(const Stars& stars, Gluing gluing, IntrinsicTriangulation& cover, const Workers& workers) {
  const int n = stars.size();
  const Buffer<int> first = firstTriangles(stars);
  resizeCover(cover, n, first[n]);
  workers.forBlocks("union", n, usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      int t = first[p];
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i)
        if (stars.hasTriangle(i)) addTriangle(cover, t++, p, stars.link[i], stars.link[stars.after(p, i)]);
      if (gluing == Gluing::star) glueSpokes(stars, p, first[p], cover);
    }
  });
}

}  // namespace tufted

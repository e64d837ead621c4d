#include "io/cover_file.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/errors.h"
#include "io/npz_archive.h"
#include "io/npz_reader.h"

namespace tufted::io {
namespace {

/// Reads the mate of each side. Stops at the first side that is glued to itself or not back, to bound the memory: a
/// file holds few more different numbers than bytes.
std::vector<int> readGlue(NpzArray& array, const std::filesystem::path& path) {
  const double last = static_cast<double>(array.size()) - 1;
  std::vector<int> glue;
  std::vector<bool> is_mate;
  for (std::int64_t side = 0; side < array.size(); ++side) {
    const int mate = array.nextInteger(0, last);
    if (is_mate.size() <= static_cast<std::size_t>(mate)) is_mate.resize(mate + std::size_t{1});
    if (mate == side || is_mate[mate] || (mate < side && glue[mate] != side))
      refuse(path, "is no cover: sides that are glued to themselves or not back, side " + std::to_string(side) +
                       " the first");
    is_mate[mate] = true;
    glue.push_back(mate);
  }
  return glue;
}

}  // namespace

void writeCover(const OutputPath& to, const IntrinsicTriangulation& cover) {
  NpzArchive archive(to);
  archive.add("faces.npy", "<i4", {cover.size(), 3}, cover.faces.data(), cover.faces.size() * 3 * sizeof(int));
  archive.add("glue.npy", "<i4", {cover.size(), 3}, cover.glue.data(), cover.glue.size() * sizeof(int));
  archive.add("length.npy", "<f8", {cover.size(), 3}, cover.length.data(), cover.length.size() * sizeof(double));
  archive.close();
}

IntrinsicTriangulation readCover(const std::filesystem::path& path, int vertices) {
  const NpzReader archive(path);
  NpzArray corners = archive.open("faces"), glue = archive.open("glue"), lengths = archive.open("length");
  const std::int64_t sides = corners.size();
  if (sides % 3 != 0 || sides > std::numeric_limits<int>::max())
    refuse(path, "has " + std::to_string(sides) + " corners, must have three per face and less than 2^31");
  if (glue.size() != sides || lengths.size() != sides)
    refuse(path, "has arrays of different sizes, must have three values per face in each");
  IntrinsicTriangulation cover{vertices, {}, readGlue(glue, path), {}};
  cover.faces.resize(static_cast<std::size_t>(sides / 3));
  for (auto& face : cover.faces)
    for (int& corner : face) corner = corners.nextInteger(0, vertices - 1.0);
  cover.length.resize(static_cast<std::size_t>(sides));
  for (double& length : cover.length) {
    length = lengths.next();
    if (!(length >= 0 && std::isfinite(length))) refuse(path, "has lengths that are negative or not finite");
  }
  const CoverCheck check = validate(cover);
  const std::pair<const char*, std::int64_t> faults[] = {
      {"sides that are glued to themselves or not back", check.not_edge_manifold},
      {"sides that are glued to others than their edge's", check.not_oriented},
      {"sides of another length than those they are glued to", check.unequal_lengths},
      {"faces whose lengths make no triangle", check.triangle_inequality}};
  for (const auto& [fault, count] : faults)
    if (count > 0) refuse(path, "is no cover: " + std::to_string(count) + " " + fault);
  return cover;
}

}  // namespace tufted::io

#include "io/cover_file.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "io/errors.h"
#include "io/npz_archive.h"
#include "io/npz_reader.h"

namespace tufted::io {

void writeCover(const OutputPath& to, const IntrinsicTriangulation& cover) {
  NpzArchive archive(to);
  archive.add("faces.npy", "<i4", {cover.size(), 3}, cover.faces.data(), cover.faces.size() * 3 * sizeof(int));
  archive.add("glue.npy", "<i4", {cover.size(), 3}, cover.glue.data(), cover.glue.size() * sizeof(int));
  archive.add("length.npy", "<f8", {cover.size(), 3}, cover.length.data(), cover.length.size() * sizeof(double));
  archive.close();
}

IntrinsicTriangulation readCover(const std::filesystem::path& path, int vertices) {
  const NpzReader archive(path);
  const std::vector<int> corners = integersOf(archive.numbers("faces"), 0, vertices - 1.0, path);
  IntrinsicTriangulation cover{vertices, {}, {}, archive.numbers("length")};
  const auto sides = std::ssize(corners);
  if (sides % 3 != 0 || sides > std::numeric_limits<int>::max())
    refuse(path, "has " + std::to_string(sides) + " corners, must have three per face and less than 2^31");
  cover.glue = integersOf(archive.numbers("glue"), 0, static_cast<double>(sides) - 1, path);
  if (std::ssize(cover.glue) != sides || std::ssize(cover.length) != sides)
    refuse(path, "has arrays of different sizes, must have three values per face in each");
  cover.faces.reserve(corners.size() / 3);
  for (std::size_t k = 0; k < corners.size(); k += 3)
    cover.faces.push_back({corners[k], corners[k + 1], corners[k + 2]});
  for (const double length : cover.length)
    if (!(length >= 0 && std::isfinite(length))) refuse(path, "has lengths that are negative or not finite");
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

#include "las_classes.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace {

/// Names of ASPRS, LAS Specification 1.4 R15, Table 17.
std::string nameOfClass(int number) {
  constexpr const char* names[] = {"never classified",
                                   "unclassified",
                                   "ground",
                                   "low vegetation",
                                   "medium vegetation",
                                   "high vegetation",
                                   "building",
                                   "low noise",
                                   "model key point",
                                   "water",
                                   "rail",
                                   "road surface",
                                   "overlap",
                                   "wire guard",
                                   "wire conductor",
                                   "transmission tower",
                                   "wire connector",
                                   "bridge deck",
                                   "high noise",
                                   "overhead structure",
                                   "ignored ground",
                                   "snow",
                                   "temporal exclusion"};
  constexpr int first_of_users = 64;
  if (number < std::ssize(names)) return names[number];
  return number < first_of_users ? "reserved" : "user defined";
}

}  // namespace

std::vector<LasClass> lasClasses(const tufted::Geometry& geometry) {
  std::vector<LasClass> classes;
  const auto field = std::find_if(geometry.fields.begin(), geometry.fields.end(),
                                  [](const tufted::Field& each) { return each.name == "classification"; });
  if (geometry.las_header.empty() || field == geometry.fields.end()) return classes;
  std::array<std::int64_t, 256> counts = {};
  for (const std::byte value : field->bytes) ++counts[std::to_integer<std::size_t>(value)];
  for (int number = 0; number < 256; ++number)
    if (counts[number] > 0) classes.push_back({number, nameOfClass(number), counts[number]});
  return classes;
}

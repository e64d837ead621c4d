#include "io/component_edges_file.h"

#include <cmath>
#include <string>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/npy.h"

namespace tufted::io {

void writeComponentEdges(const OutputPath& to, const std::vector<ComponentEdges>& edges) {
  std::vector<double> numbers;
  numbers.reserve(3 * edges.size());
  for (const auto& [sides, mean, mean_square] : edges)
    numbers.insert(numbers.end(), {static_cast<double>(sides), mean, mean_square});
  OutputFile file(to);
  file.write(npyHeader("<f8", {std::ssize(edges), 3}));
  file.write(numbers.data(), numbers.size() * sizeof(double));
  file.close();
}

std::vector<ComponentEdges> readComponentEdges(const std::filesystem::path& path, std::size_t components) {
  const std::string bytes = readBytes(path);
  const NpyArray array = parseNpy(bytes, path);
  const auto count = static_cast<std::int64_t>(components);
  if (array.shape.size() != 2 || array.shape[1] != 3 || (array.shape[0] != count && array.shape[0] != 0))
    refuse(path, "is not an array of " + std::to_string(count) + " x 3 values, edges for each component of L");
  const std::vector<double> numbers = numbersOf(array, path);
  std::vector<ComponentEdges> edges;
  for (std::size_t k = 0; k < numbers.size(); k += 3) {
    if (!(numbers[k] >= 0 && numbers[k] <= 0x1p53 && numbers[k] == std::floor(numbers[k]) && numbers[k + 1] >= 0 &&
          numbers[k + 2] >= 0))
      refuse(path, "component " + std::to_string(k / 3) + " has a negative number, or no whole number of sides");
    edges.push_back({static_cast<std::int64_t>(numbers[k]), numbers[k + 1], numbers[k + 2]});
  }
  return edges;
}

}  // namespace tufted::io

// The circular order of faces around edges (Section 5.4 of the paper).
#include <cmath>

#include "bench/compare/tables.h"
#include "shapes/spectra.h"
#include "tufted/laplacian.h"
#include "tufted/spectrum.h"

namespace tufted::bench {
namespace {

/// One input under all orders: how far eigenvalues are apart, and their errors.
template <class Build>
std::vector<Cell> orderRow(const std::string& name, const VectorXd& exact, const Build& build) {
  const auto valuesBy = [&](FaceOrder order, std::uint64_t seed) {
    PaperOptions paper;
    paper.order = order, paper.seed = seed;
    return spectrum(build(paper), compared, {.null_space = false, .threads = 1}).values;
  };
  const VectorXd by_angle = valuesBy(FaceOrder::angle, 0), by_area = valuesBy(FaceOrder::area, 0);
  const auto apart = [&](const VectorXd& other) { return (other.array() / by_angle.array() - 1).abs().maxCoeff(); };
  const auto error = [&](const VectorXd& found) {
    return percent(oracles::meanRelativeError(found, exact), "%.2f %%");
  };
  double farthest = 0;
  VectorXd by_chance;
  for (const std::uint64_t seed : {101, 102, 103}) {
    by_chance = valuesBy(FaceOrder::random, seed);
    farthest = std::max(farthest, apart(by_chance));
  }
  return {name,
          percent(apart(by_area), "%.3f %%"),
          percent(farthest, "%.3f %%"),
          error(by_angle),
          error(by_area),
          error(by_chance)};
}

}  // namespace

Table printOrders(const Settings& settings) {
  Table table({"input", "area: eigenvalues move by", "random: by", "error by angle", "by area", "by random order"});
  struct Input {
    std::string name;
    Points points;
    VectorXd eigenvalues;
  };
  const int n = settings.pointsOr(8000);
  std::vector<Input> inputs = {{"sphere", shapes::sphere(n, shapes::Sampling::uniform, settings.first_seed).points,
                                shapes::sphereSpectrum(compared + 1).tail(compared)}};
  for (const RealShape& shape : shapesOf(settings, compared))
    inputs.push_back({shape.name, sampleOf(shape, n, settings.noise, settings.first_seed).points, shape.eigenvalues});
  for (const auto& [gluing, name] :
       {std::pair{Gluing::star, ", glued per star"}, {Gluing::vertex_pair, ", per pair"}}) {
    for (const Input& input : inputs) {
      table.row(orderRow(input.name + name, input.eigenvalues, [&, by = gluing](const PaperOptions& paper) {
        CloudOptions options = cloudOptions(Preset::clean);
        options.paper = paper, options.paper.gluing = by, options.threads = 1;
        return pointCloudLaplacian(input.points, options);
      }));
    }
  }
  for (const int pages : {3, 5}) {
    const shapes::Mesh book = shapes::book(pages, 30);
    const VectorXd exact = shapes::bookSpectrum(pages, 1, 1, compared + 1).tail(compared);
    table.row(orderRow("mesh of " + std::to_string(pages) + " pages", exact, [&](const PaperOptions& paper) {
      return meshLaplacian(book.points, book.triangles, {.threads = 1, .paper = paper});
    }));
  }
  return table;
}

}  // namespace tufted::bench

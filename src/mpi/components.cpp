#include "mpi/components.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/sort_unique.h"
#include "mpi/exchange.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"

namespace tufted {
namespace {

/// Rows of one process that are connected by its own rows, named by the least of them.
struct Part {
  PetscInt row;
  double area;
};

/// Pairs of parts that an entry of L connects, of all processes.
std::vector<std::pair<PetscInt, PetscInt>> connectedParts(MPI_Comm comm, const std::vector<std::size_t>& begin,
                                                          const std::vector<PetscInt>& column,
                                                          const std::vector<PetscScalar>& value, PetscInt first,
                                                          const std::vector<PetscInt>& part, Vec part_of_row) {
  const auto size = static_cast<PetscInt>(part.size());
  std::vector<std::int64_t> outside;
  for (const PetscInt c : column)
    if (c < first || c >= first + size) outside.push_back(c);
  sortUnique(outside);
  const std::vector<double> theirs = valuesAt(part_of_row, outside);
  std::vector<std::pair<PetscInt, PetscInt>> pairs;
  for (std::size_t i = 0; i < part.size(); ++i)
    for (std::size_t e = begin[i]; e < begin[i + 1]; ++e) {
      const PetscInt c = column[e];
      if (!(value[e] < 0) || (c >= first && c < first + size)) continue;
      const auto place = std::lower_bound(outside.begin(), outside.end(), c) - outside.begin();
      pairs.emplace_back(part[i], static_cast<PetscInt>(theirs[place]));
    }
  sortUnique(pairs);
  return gatherAll(comm, pairs);
}

}  // namespace

void findComponents(MPI_Comm comm, const std::vector<std::size_t>& begin, const std::vector<PetscInt>& column,
                    const std::vector<PetscScalar>& value, DistributedLaplacian& result) {
  const std::vector<double> areas = localOf(result.M.get());
  const auto size = static_cast<PetscInt>(areas.size());
  PetscInt first = 0;
  check(VecGetOwnershipRange(result.M.get(), &first, nullptr));
  DisjointSets rows(size);
  for (PetscInt i = 0; i < size; ++i)
    for (std::size_t e = begin[i]; e < begin[i + 1]; ++e)
      if (value[e] < 0 && column[e] >= first && column[e] < first + size) rows.unite(i, column[e] - first);

  std::vector<PetscInt> part(areas.size());
  std::vector<double> part_areas(areas.size());
  for (PetscInt i = 0; i < size; ++i) {
    part[i] = first + rows.root(i);
    part_areas[rows.root(i)] += areas[i];
  }
  std::vector<Part> parts;
  for (PetscInt i = 0; i < size; ++i)
    if (part[i] == first + i) parts.push_back({first + i, part_areas[i]});
  parts = gatherAll(comm, parts);  // ascending, as the rows of processes are
  const auto indexOf = [&](PetscInt row) {
    const auto isBefore = [](const Part& p, PetscInt r) { return p.row < r; };
    return static_cast<int>(std::lower_bound(parts.begin(), parts.end(), row, isBefore) - parts.begin());
  };

  PetscVector part_of_row;
  check(VecDuplicate(result.M.get(), part_of_row.make()));
  setLocal(part_of_row.get(), {part.begin(), part.end()});
  DisjointSets components(std::ssize(parts));
  for (const auto& [a, b] : connectedParts(comm, begin, column, value, first, part, part_of_row.get()))
    components.unite(indexOf(a), indexOf(b));

  std::vector<double> component_areas(parts.size());
  std::vector<int> roots;
  for (int p = 0; p < std::ssize(parts); ++p) {
    component_areas[components.root(p)] += parts[p].area;
    if (components.root(p) == p) roots.push_back(p);
  }
  std::stable_sort(roots.begin(), roots.end(), [&](int a, int b) { return component_areas[a] > component_areas[b]; });
  std::vector<PetscInt> number(parts.size());
  for (std::size_t c = 0; c < roots.size(); ++c) number[roots[c]] = static_cast<PetscInt>(c);
  result.components = static_cast<PetscInt>(roots.size());
  for (const PetscInt p : part) result.component.push_back(number[components.root(indexOf(p))]);
}

}  // namespace tufted

#include "mpi/ghosts.h"

#include <algorithm>
#include <utility>

#include "base/sort_unique.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"
#include "mpi/rows.h"

namespace tufted {

Ghosts::Ghosts(const DistributedLaplacian& laplacian, std::vector<std::int64_t> rows) : others_(std::move(rows)) {
  PetscInt last = 0;
  check(VecGetOwnershipRange(laplacian.M.get(), &first_, &last));
  own_ = static_cast<int>(last - first_);
  const auto is_own = [&](std::int64_t row) { return first_ <= row && row < last; };
  others_.erase(std::remove_if(others_.begin(), others_.end(), is_own), others_.end());
  sortUnique(others_);
  const std::vector<PetscInt> numbers(others_.begin(), others_.end());
  check(VecCreateGhost(commOf(laplacian), own_, PETSC_DETERMINE, static_cast<PetscInt>(numbers.size()), numbers.data(),
                       vector_.make()));
}

int Ghosts::numberOf(std::int64_t row) const {
  if (first_ <= row && row < first_ + own_) return static_cast<int>(row - first_);
  return own_ + static_cast<int>(std::lower_bound(others_.begin(), others_.end(), row) - others_.begin());
}

void Ghosts::update(std::vector<double>& values) const {
  const Vec vector = vector_.get();
  setLocal(vector, {values.begin(), values.begin() + own_});
  check(VecGhostUpdateBegin(vector, INSERT_VALUES, SCATTER_FORWARD));
  check(VecGhostUpdateEnd(vector, INSERT_VALUES, SCATTER_FORWARD));
  Vec all = nullptr;
  check(VecGhostGetLocalForm(vector, &all));
  values = localOf(all);
  check(VecGhostRestoreLocalForm(vector, &all));
}

}  // namespace tufted

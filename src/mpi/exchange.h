#pragma once

#include <mpi.h>

#include <vector>

namespace tufted {

/// The values of all processes, process by process. They are copied byte by byte.
template <class Value>
std::vector<Value> gatherAll(MPI_Comm comm, const std::vector<Value>& own) {
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(sizeof(Value)), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  int processes = 0;
  MPI_Comm_size(comm, &processes);
  std::vector<int> counts(static_cast<std::size_t>(processes)), before(counts.size());
  const int count = static_cast<int>(own.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (std::size_t p = 1; p < counts.size(); ++p) before[p] = before[p - 1] + counts[p - 1];
  std::vector<Value> all(static_cast<std::size_t>(before.back() + counts.back()));
  MPI_Allgatherv(own.data(), count, type, all.data(), counts.data(), before.data(), type, comm);
  MPI_Type_free(&type);
  return all;
}

}  // namespace tufted

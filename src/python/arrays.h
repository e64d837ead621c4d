#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tufted/errors.h"
#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

// Conversions between NumPy's arrays and the library's types. pybind11/eigen.h converts matrices of doubles: results
// move into memory that the array owns.
namespace tufted::python {

using Doubles = pybind11::array_t<double, pybind11::array::c_style>;
using Shape = std::vector<pybind11::ssize_t>;
using Integers = pybind11::array_t<int, pybind11::array::c_style>;

/// A view of an N x 3 array, which must outlive it.
/// @throws InvalidInput for another shape
inline Eigen::Map<const Points> pointsOf(const Doubles& array) {
  if (array.ndim() != 2 || array.shape(1) != 3) throw InvalidInput("points: the shape must be N x 3");
  return {array.data(), array.shape(0), 3};
}

inline Eigen::Map<const Triangles> trianglesOf(const Integers& array) {
  if (array.ndim() != 2 || array.shape(1) != 3) throw InvalidInput("faces: the shape must be F x 3");
  return {array.data(), array.shape(0), 3};
}

inline std::vector<int> indicesOf(const Integers& array) {
  return {array.data(), array.data() + array.size()};
}

/// An array on memory of `owner`, which it keeps alive. It is read-only, because solvers were made from that memory.
template <class T>
pybind11::array_t<T> shown(const T* data, Shape shape, const pybind11::object& owner) {
  pybind11::array_t<T> array(std::move(shape), data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// An array that owns the values.
template <class T>
pybind11::array_t<T> owned(std::vector<T> values) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const auto size = static_cast<pybind11::ssize_t>(kept->size());
  const T* const data = kept->data();
  const pybind11::capsule owner(kept.release(), [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
  return pybind11::array_t<T>(Shape{size}, data, owner);
}

/// data, indices and indptr for a scipy.sparse.csc_matrix, as read-only arrays on memory of `owner`.
inline pybind11::tuple shownSparse(const SparseMatrix& matrix, const pybind11::object& owner) {
  return pybind11::make_tuple(shown(matrix.valuePtr(), {matrix.nonZeros()}, owner),
                              shown(matrix.innerIndexPtr(), {matrix.nonZeros()}, owner),
                              shown(matrix.outerIndexPtr(), {matrix.cols() + 1}, owner));
}

/// data, indices and indptr for a scipy.sparse.csc_matrix, as arrays that own the matrix.
inline pybind11::tuple ownedSparse(SparseMatrix matrix) {
  matrix.makeCompressed();
  auto kept = std::make_unique<SparseMatrix>(std::move(matrix));
  const SparseMatrix& m = *kept;
  const pybind11::capsule owner(kept.release(), [](void* pointer) { delete static_cast<SparseMatrix*>(pointer); });
  return pybind11::make_tuple(pybind11::array_t<double>(Shape{m.nonZeros()}, m.valuePtr(), owner),
                              pybind11::array_t<int>(Shape{m.nonZeros()}, m.innerIndexPtr(), owner),
                              pybind11::array_t<int>(Shape{m.cols() + 1}, m.outerIndexPtr(), owner));
}

/// The value of `choices` that has this name.
/// @throws InvalidInput naming the argument and all choices, if there is none
template <class T>
T chosen(const char* argument, const std::string& name, const std::map<std::string, T>& choices) {
  const auto choice = choices.find(name);
  if (choice != choices.end()) return choice->second;
  std::string all;
  for (const auto& [known, value] : choices) all += (all.empty() ? "'" : ", '") + known + "'";
  throw InvalidInput(std::string(argument) + " = '" + name + "', must be one of " + all);
}

/// How systems are solved: the members of SolverOptions that the package passes on.
struct Solving {
  std::string solver = "automatic";
  std::size_t memory_limit = 0;
  int threads = 0;

  SolverMethod method() const {
    return chosen<SolverMethod>("solver", solver,
                                {{"automatic", SolverMethod::automatic},
                                 {"cholesky", SolverMethod::cholesky},
                                 {"multigrid", SolverMethod::multigrid}});
  }
  SolverOptions options(const Progress& progress) const {
    return {.method = method(), .memory_limit = memory_limit, .threads = threads, .progress = progress};
  }
};

using Shared = std::shared_ptr<Laplacian>;

}  // namespace tufted::python

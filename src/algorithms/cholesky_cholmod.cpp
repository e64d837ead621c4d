#include <suitesparse/cholmod.h>

#include <algorithm>
#include <new>
#include <utility>

#include "algorithms/linear_backend.h"
#include "algorithms/serial_blas.h"

namespace tufted {
namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

/// CHOLMOD's parameters and workspace; one per solve, as solves may run in parallel.
class Common {
 public:
  Common() {
    cholmod_l_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.postorder = 1;
  }
  ~Common() { cholmod_l_finish(&common_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
  cholmod_common* get() { return &common_; }
  cholmod_common* operator->() { return &common_; }

 private:
  cholmod_common common_;
};

/// A view for CHOLMOD, which takes no pointers to const, but changes nothing.
cholmod_sparse viewOf(const LongMatrix& lower) {
  cholmod_sparse view = {};
  view.nrow = view.ncol = static_cast<std::size_t>(lower.rows());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  view.p = const_cast<std::int64_t*>(lower.outerIndexPtr());
  view.i = const_cast<std::int64_t*>(lower.innerIndexPtr());
  view.x = const_cast<double*>(lower.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

struct FreeFactor {
  void operator()(cholmod_factor* factor) const {
    Common common;
    cholmod_l_free_factor(&factor, common.get());
  }
};
using Factor = std::unique_ptr<cholmod_factor, FreeFactor>;

/// A dense matrix of CHOLMOD.
class DenseMatrix {
 public:
  DenseMatrix(std::size_t rows, std::size_t cols, Common& common)
      : common_(common), matrix_(cholmod_l_allocate_dense(rows, cols, rows, CHOLMOD_REAL, common.get())) {
    if (matrix_ == nullptr) throw std::bad_alloc();
  }
  ~DenseMatrix() { cholmod_l_free_dense(&matrix_, common_.get()); }
  DenseMatrix(const DenseMatrix&) = delete;
  DenseMatrix& operator=(const DenseMatrix&) = delete;
  cholmod_dense** handle() { return &matrix_; }
  const double* data() const { return static_cast<const double*>(matrix_->x); }

 private:
  Common& common_;
  cholmod_dense* matrix_;
};

/// Computes the numeric factor. False if the matrix is not positive definite.
bool computeFactor(cholmod_sparse& matrix, cholmod_factor& factor, Common& common) {
  const SerialBlas serial;
  cholmod_l_factorize(&matrix, &factor, common.get());
  if (common->status == CHOLMOD_OUT_OF_MEMORY || common->status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
  return common->status == CHOLMOD_OK && factor.minor == factor.n;
}

class CholmodBackend : public LinearBackend {
 public:
  explicit CholmodBackend(Factor factor) : factor_(std::move(factor)) {}

  int solve(Eigen::Ref<Eigen::MatrixXd> x, const Tick& /*tick*/) const override {
    const SerialBlas serial;
    Common common;
    cholmod_dense b = {};
    b.nrow = static_cast<std::size_t>(x.rows());
    b.ncol = static_cast<std::size_t>(x.cols());
    b.d = static_cast<std::size_t>(x.outerStride());
    b.nzmax = b.d * b.ncol;
    b.x = x.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    // The solution and the scratch memory of a supernodal solve. CHOLMOD would crash if it took the first scratch
    // itself and there was no memory, because its success with the second one clears the error.
    DenseMatrix solution(b.nrow, b.ncol, common), permuted(b.nrow, b.ncol, common);
    DenseMatrix rows_below(b.ncol, factor_->maxesize, common);
    const int is_solved = cholmod_l_solve2(CHOLMOD_A, factor_.get(), &b, nullptr, solution.handle(), nullptr,
                                           permuted.handle(), rows_below.handle(), common.get());
    if (is_solved == 0) throw std::bad_alloc();
    x = Eigen::Map<const Eigen::MatrixXd>(solution.data(), x.rows(), x.cols());
    return 0;
  }

  bool refactor(const LongMatrix& lower) override {
    Common common;
    cholmod_sparse matrix = viewOf(lower);
    return computeFactor(matrix, *factor_, common);
  }

 private:
  Factor factor_;
};

}  // namespace

struct Cholesky::Analysis {
  Common common;
  cholmod_sparse matrix;
  Factor factor;
  bool metis = false;
  double nonzeros = 0;
};

Cholesky::Cholesky(const LongMatrix& lower, std::size_t limit) : analysis_(std::make_unique<Analysis>()) {
  Analysis& a = *analysis_;
  a.matrix = viewOf(lower);
  const auto analyze = [&a](int ordering) {
    a.common->method[0].ordering = ordering;
    return Factor(cholmod_l_analyze(&a.matrix, a.common.get()));
  };
  // Minimum degree (AMD) at every size: nested dissection (METIS) saves only memory. Seconds on one processor for a
  // torus:
  //                            30,000 points        100,000              500,000
  //     AMD    analyse, factor   0.04 0.05  11 MB     0.24 0.22  43 MB     1.7 1.3  258 MB
  //     METIS                    0.14 0.05  10 MB     0.61 0.24  37 MB     3.9 1.1  207 MB
  // A solve takes as long with both: 2, 14 and 70 ms.
  a.factor = analyze(CHOLMOD_AMD);
  if (!a.factor) throw std::bad_alloc();
  a.nonzeros = a.common->lnz;
  if (bytes() <= limit) return;
  Factor other = analyze(CHOLMOD_METIS);  // null if SuiteSparse was built without METIS
  a.metis = other && other->xsize < a.factor->xsize;
  if (!a.metis) return;
  a.nonzeros = a.common->lnz;
  a.factor = std::move(other);
}

Cholesky::~Cholesky() = default;

std::size_t Cholesky::bytes() const {
  const cholmod_factor& factor = *analysis_->factor;
  return factor.xsize * sizeof(double) + (factor.ssize + 2 * factor.n) * sizeof(std::int64_t);
}

std::unique_ptr<LinearBackend> Cholesky::factor() {
  Analysis& a = *analysis_;
  if (!computeFactor(a.matrix, *a.factor, a.common)) return nullptr;
  auto backend = std::make_unique<CholmodBackend>(std::move(a.factor));
  backend->name = a.metis ? "Cholesky (CHOLMOD, METIS)" : "Cholesky (CHOLMOD, AMD)";
  backend->nonzeros = static_cast<std::int64_t>(a.nonzeros);
  return backend;
}

}  // namespace tufted

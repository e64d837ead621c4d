#include "io/mat.h"

#include <matio.h>

#include <cerrno>
#include <limits>
#include <memory>
#include <string>

#include "io/errors.h"

namespace tufted::io {
namespace {

/// A MATLAB 5 file being written. libmatio 1.5 ignores results of fwrite, but a failed one sets errno, which is
/// checked.
class MatFile {
 public:
  explicit MatFile(const OutputPath& to) : shown_(to.shown) {
    errno = 0;
    // libmatio's own header has the date; without it equal matrices give equal files.
    file_.reset(Mat_CreateVer(to.path.c_str(), "MATLAB 5.0 MAT-file, written by tufted; see the variable `conventions`",
                              MAT_FT_MAT5));
    check(file_ != nullptr);
  }

  /// Writes a variable.
  /// @param data an array, or a mat_sparse_t
  void write(const char* name, matio_classes kind, matio_types type, std::size_t rows, std::size_t columns,
             const void* data) {
    std::size_t dims[2] = {rows, columns};
    const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> variable(
        Mat_VarCreate(name, kind, type, 2, dims, const_cast<void*>(data), MAT_F_DONT_COPY_DATA), &Mat_VarFree);
    check(variable && Mat_VarWrite(file_.get(), variable.get(), MAT_COMPRESSION_NONE) == 0);
  }

  void close() { check(Mat_Close(file_.release()) == 0); }

 private:
  void check(bool done) const {
    if (errno != 0) refuseErrno(shown_, "write", errno);
    if (!done) refuse(shown_, "cannot write: libmatio refuses");
  }

  std::filesystem::path shown_;
  std::unique_ptr<mat_t, decltype(&Mat_Close)> file_ = {nullptr, &Mat_Close};
};

void checkSize(const OutputPath& to, const char* name, std::uint64_t bytes) {
  constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
  if (bytes > most)
    refuse(to.shown, std::string("cannot write: ") + name + " takes " + std::to_string(bytes) +
                         " bytes, and a MATLAB 5 file holds at most " + std::to_string(most) +
                         " per variable; other formats have room");
}

}  // namespace

void writeMat(const OutputPath& to, const SparseMatrix& L, const VectorXd& M, const Laplacian& laplacian,
              const std::vector<Convention>& conventions) {
  const std::size_t points = M.size();
  constexpr std::uint64_t framing = 256;  // upper bound of the bytes of the tags around a variable's values
  checkSize(to, "L",
            L.nonZeros() * (sizeof(double) + sizeof(int)) + (L.cols() + std::uint64_t{1}) * sizeof(int) + framing);
  checkSize(to, "M", points * sizeof(double) + framing);

  mat_sparse_t sparse = {};
  sparse.nzmax = sparse.nir = sparse.ndata = static_cast<mat_uint32_t>(L.nonZeros());
  sparse.njc = static_cast<mat_uint32_t>(L.cols() + 1);
  sparse.ir = reinterpret_cast<mat_uint32_t*>(const_cast<int*>(L.innerIndexPtr()));
  sparse.jc = reinterpret_cast<mat_uint32_t*>(const_cast<int*>(L.outerIndexPtr()));
  sparse.data = const_cast<double*>(L.valuePtr());
  const std::string text = conventionLines(conventions, "");

  MatFile file(to);
  file.write("L", MAT_C_SPARSE, MAT_T_DOUBLE, L.rows(), L.cols(), &sparse);
  file.write("M", MAT_C_DOUBLE, MAT_T_DOUBLE, points, 1, M.data());
  file.write("status", MAT_C_UINT8, MAT_T_UINT8, points, 1, laplacian.status.data());
  file.write("representative", MAT_C_INT32, MAT_T_INT32, points, 1, laplacian.representative.data());
  file.write("boundary", MAT_C_UINT8, MAT_T_UINT8, points, 1, laplacian.boundary.data());
  file.write("conventions", MAT_C_CHAR, MAT_T_UTF8, 1, text.size(), text.data());
  file.close();
}

}  // namespace tufted::io

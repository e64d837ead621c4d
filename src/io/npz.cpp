#include "io/npz.h"

#include <zip.h>

#include <array>
#include <deque>
#include <memory>
#include <string>

#include "io/errors.h"
#include "io/npy.h"

namespace tufted::io {
namespace {

/// One array: libzip takes a file from a single source, made of a header and values it does not copy.
struct Member {
  std::string header;
  std::array<zip_buffer_fragment_t, 2> fragments;
};

class NpzArchive {
 public:
  explicit NpzArchive(const OutputPath& to) : shown_(to.shown) {
    int error = 0;
    archive_.reset(zip_open(to.path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error));
    if (archive_) return;
    zip_error_t details;
    zip_error_init_with_code(&details, error);
    const std::string reason = zip_error_strerror(&details);
    zip_error_fini(&details);
    refuse(shown_, "cannot write: " + reason);
  }

  /// `values` is borrowed until close().
  void add(const char* name, const char* descr, std::int64_t length, const void* values, std::size_t bytes) {
    Member& member = members_.emplace_back();
    member.header = npyHeader(descr, length);
    member.fragments[0] = {reinterpret_cast<zip_uint8_t*>(member.header.data()), member.header.size()};
    member.fragments[1] = {static_cast<zip_uint8_t*>(const_cast<void*>(values)), bytes};
    zip_source_t* source = zip_source_buffer_fragment(archive_.get(), member.fragments.data(), bytes > 0 ? 2 : 1, 0);
    if (!source) fail();
    const zip_int64_t index = zip_file_add(archive_.get(), name, source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      fail();
    }
    // Stored: numpy's own default. Weights hardly shrink, and deflate would take longer than building the matrix.
    if (zip_set_file_compression(archive_.get(), index, ZIP_CM_STORE, 0) != 0) fail();
    // One date for all, 1 January 1980, so that equal matrices are equal files.
    constexpr zip_uint16_t first_day = (0 << 9) | (1 << 5) | 1;
    if (zip_file_set_dostime(archive_.get(), index, 0, first_day, 0) != 0) fail();
  }

  void close() {
    if (zip_close(archive_.get()) != 0) fail();
    archive_.release();
  }

 private:
  struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
  };

  [[noreturn]] void fail() const {
    refuse(shown_, "cannot write: " + std::string(zip_error_strerror(zip_get_error(archive_.get()))));
  }

  std::filesystem::path shown_;
  std::deque<Member> members_;
  std::unique_ptr<zip_t, Discard> archive_;  // before the members it borrows from
};

}  // namespace

void writeNpz(const OutputPath& to, const SparseMatrix& matrix) {
  static_assert(sizeof(SparseMatrix::StorageIndex) == 4 && !SparseMatrix::IsRowMajor);
  const std::int64_t shape[2] = {matrix.rows(), matrix.cols()};
  NpzArchive archive(to);
  archive.add("indices.npy", "<i4", matrix.nonZeros(), matrix.innerIndexPtr(), matrix.nonZeros() * sizeof(int));
  archive.add("indptr.npy", "<i4", matrix.cols() + 1, matrix.outerIndexPtr(), (matrix.cols() + 1) * sizeof(int));
  archive.add("format.npy", "|S3", -1, "csc", 3);
  archive.add("shape.npy", "<i8", 2, shape, sizeof(shape));
  archive.add("data.npy", "<f8", matrix.nonZeros(), matrix.valuePtr(), matrix.nonZeros() * sizeof(double));
  archive.close();
}

}  // namespace tufted::io

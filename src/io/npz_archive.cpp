#include "io/npz_archive.h"

#include "io/errors.h"
#include "io/npy.h"

namespace tufted::io {

NpzArchive::NpzArchive(const OutputPath& to) : shown_(to.shown) {
  int error = 0;
  archive_.reset(zip_open(to.path.c_str(), ZIP_CREATE | ZIP_EXCL, &error));
  if (archive_) return;
  zip_error_t details;
  zip_error_init_with_code(&details, error);
  const std::string reason = zip_error_strerror(&details);
  zip_error_fini(&details);
  refuse(shown_, "cannot write: " + reason);
}

void NpzArchive::add(const std::string& name, std::string_view descr, const std::vector<std::int64_t>& shape,
                     const void* values, std::size_t bytes) {
  Member& member = members_.emplace_back();
  member.header = npyHeader(descr, shape);
  member.fragments[0] = {reinterpret_cast<zip_uint8_t*>(member.header.data()), member.header.size()};
  member.fragments[1] = {static_cast<zip_uint8_t*>(const_cast<void*>(values)), bytes};
  zip_source_t* source = zip_source_buffer_fragment(archive_.get(), member.fragments.data(), bytes > 0 ? 2 : 1, 0);
  if (!source) fail();
  const zip_int64_t index = zip_file_add(archive_.get(), name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    fail();
  }
  // No compression, as by default in numpy: weights hardly shrink, and deflate would take longer than the build.
  if (zip_set_file_compression(archive_.get(), index, ZIP_CM_STORE, 0) != 0) fail();
  // The date is always 1 January 1980, so that equal arrays give equal files.
  constexpr zip_uint16_t first_day = (0 << 9) | (1 << 5) | 1;
  if (zip_file_set_dostime(archive_.get(), index, 0, first_day, 0) != 0) fail();
}

void NpzArchive::close() {
  if (zip_close(archive_.get()) != 0) fail();
  static_cast<void>(archive_.release());  // zip_close() has freed it
}

void NpzArchive::fail() const {
  refuse(shown_, "cannot write: " + std::string(zip_error_strerror(zip_get_error(archive_.get()))));
}

}  // namespace tufted::io

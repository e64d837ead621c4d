#include "io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "io/errors.h"

namespace tufted::io {

OutputFile::OutputFile(const OutputPath& to) : shown_(to.shown), file_(nullptr, &std::fclose) {
  const int file = ::open(to.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) refuseErrno(shown_, "write", errno);
  file_.reset(::fdopen(file, "wb"));
  if (file_) return;
  const int error = errno;
  ::close(file);
  refuseErrno(shown_, "write", error);
}

void OutputFile::write(const void* bytes, std::size_t size) {
  if (size > 0 && std::fwrite(bytes, 1, size, file_.get()) != size) refuseErrno(shown_, "write", errno);
}

void OutputFile::close() {
  if (std::fclose(file_.release()) != 0) refuseErrno(shown_, "write", errno);
}

}  // namespace tufted::io

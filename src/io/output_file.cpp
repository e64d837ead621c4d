#include "io/output_file.h"

#include <cerrno>

#include "io/errors.h"

namespace tufted::io {

OutputFile::OutputFile(const OutputPath& to)
    : shown_(to.shown), file_(std::fopen(to.path.c_str(), "wb"), &std::fclose) {
  if (!file_) refuseErrno(shown_, "write", errno);
}

void OutputFile::write(const void* bytes, std::size_t size) {
  if (size > 0 && std::fwrite(bytes, 1, size, file_.get()) != size) refuseErrno(shown_, "write", errno);
}

void OutputFile::close() {
  if (std::fclose(file_.release()) != 0) refuseErrno(shown_, "write", errno);
}

}  // namespace tufted::io

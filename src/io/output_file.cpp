#include "io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <limits>

#include "io/errors.h"

namespace tufted::io {
namespace {

/// Bytes that are collected before they are written.
constexpr std::size_t capacity = 1 << 20;
/// Upper bound of the characters of a number with 17 digits.
constexpr std::size_t longest_number = 32;

}  // namespace

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
  if (collected_.size() + size > capacity) flush();
  const auto* const begin = static_cast<const std::byte*>(bytes);
  if (size <= capacity)
    collected_.insert(collected_.end(), begin, begin + size);
  else if (std::fwrite(bytes, 1, size, file_.get()) != size)
    refuseErrno(shown_, "write", errno);
}

void OutputFile::writeInteger(std::int64_t value) {
  char text[longest_number];
  write(text, std::to_chars(text, text + longest_number, value).ptr - text);
}

void OutputFile::writeNumber(double value) {
  char text[longest_number];
  constexpr int digits = std::numeric_limits<double>::max_digits10;
  write(text, std::to_chars(text, text + longest_number, value, std::chars_format::general, digits).ptr - text);
}

void OutputFile::flush() {
  const std::size_t size = collected_.size();
  if (size > 0 && std::fwrite(collected_.data(), 1, size, file_.get()) != size) refuseErrno(shown_, "write", errno);
  collected_.clear();
}

void OutputFile::close() {
  flush();
  if (std::fclose(file_.release()) != 0) refuseErrno(shown_, "write", errno);
}

void writeText(const OutputPath& to, std::string_view text) {
  OutputFile file(to);
  file.write(text);
  file.close();
}

}  // namespace tufted::io

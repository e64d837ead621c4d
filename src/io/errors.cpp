#include "io/errors.h"

#include <system_error>

#include "tufted/errors.h"

namespace tufted::io {

void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw IoError(path.string() + ": " + reason);
}

void refuseLine(const std::filesystem::path& path, std::int64_t line, const std::string& reason) {
  refuse(path, "line " + std::to_string(line) + ": " + reason);
}

void refuseByte(const std::filesystem::path& path, std::size_t byte, const std::string& reason) {
  refuse(path, "byte " + std::to_string(byte) + ": " + reason);
}

void refuseErrno(const std::filesystem::path& path, const std::string& action, int error) {
  refuse(path, "cannot " + action + ": " + std::generic_category().message(error));
}

std::string quote(std::string_view text) {
  // Most characters of a file that an error quotes.
  constexpr std::size_t longest = 32;
  std::string quoted = "'";
  for (const char c : text.substr(0, longest)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (text.size() > longest ? "...'" : "'");
}

}  // namespace tufted::io

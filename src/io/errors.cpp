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

void refuseFurther(const std::filesystem::path& path, std::string_view bytes, std::size_t end, std::size_t item,
                   const std::string& what) {
  if (item == 0 || end > bytes.size() || bytes.size() - end < item) return;
  if (bytes.substr(end).find_first_not_of('\0') == std::string_view::npos) return;
  refuseByte(path, end, std::to_string(bytes.size() - end) + " bytes more than the " + what);
}

std::string quote(std::string_view text) {
  constexpr std::size_t longest = 32;
  std::string quoted = "'";
  for (const char c : text.substr(0, longest)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (text.size() > longest ? "...'" : "'");
}

}  // namespace tufted::io

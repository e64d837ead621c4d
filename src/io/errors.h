#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tufted::io {

/// Throws IoError: "path: reason"; the others "path: line 12: reason" and "path: byte 120: reason".
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason);
[[noreturn]] void refuseLine(const std::filesystem::path& path, std::int64_t line, const std::string& reason);
[[noreturn]] void refuseByte(const std::filesystem::path& path, std::size_t byte, const std::string& reason);
/// Throws IoError: "path: cannot <action>: <what errno says>".
[[noreturn]] void refuseErrno(const std::filesystem::path& path, const std::string& action, int error);

/// Quotes text of a file for an error message: its first 32 characters, unprintable ones as '?'.
std::string quote(std::string_view text);

}  // namespace tufted::io

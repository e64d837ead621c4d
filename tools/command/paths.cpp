#include "paths.h"

#include <CLI/CLI.hpp>
#include <system_error>

#include "tufted/errors.h"

namespace {

namespace fs = std::filesystem;

/// The absolute path, with links resolved as far as it exists.
fs::path wholePath(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path, error);
  return (error || whole.is_relative() ? fs::absolute(path) : whole).lexically_normal();
}

bool namesInput(const CLI::Option& option) {
  if (option.get_positional()) return true;
  const std::string type = option.get_type_name();
  return type == "TEXT" || type == "NPY" || type == "SOURCE" || (type == "DIR" && option.get_name() != "--out");
}

}  // namespace

std::vector<NamedInput> inputsOf(const CLI::App& command) {
  std::vector<NamedInput> inputs;
  for (const CLI::Option* const option : command.get_options())
    if (namesInput(*option))
      for (const std::string& path : option->results())
        if (path != "-") inputs.push_back({option->get_name(option->get_positional()), path});
  return inputs;
}

bool isSameFile(const fs::path& one, const fs::path& other) {
  if (one.empty() || other.empty()) return false;
  std::error_code error;
  return fs::equivalent(one, other, error) || wholePath(one) == wholePath(other);
}

bool isWithin(const fs::path& path, const fs::path& folder) {
  if (path.empty() || folder.empty()) return false;
  return *wholePath(path).lexically_relative(wholePath(folder)).begin() != "..";
}

fs::path behindLinks(fs::path file) {
  std::error_code error;
  while (fs::is_symlink(fs::symlink_status(file, error))) {
    const fs::path next = fs::read_symlink(file, error);
    if (error) break;
    file = file.parent_path() / next;
  }
  return file;
}

void refuseOverwriting(const std::string& option, const fs::path& output, const std::vector<NamedInput>& inputs) {
  for (const NamedInput& input : inputs) {
    if (!isSameFile(output, input.path)) continue;
    const bool has_option = input.option.starts_with('-');
    throw tufted::InvalidInput(input.path.string() + ": is the input" + (has_option ? " of " + input.option : "") +
                               ", and " + option + " would overwrite it");
  }
}

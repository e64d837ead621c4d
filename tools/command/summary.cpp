#include "summary.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "tufted/errors.h"

void Summary::add(const char* name, const char* format, ...) {
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  std::string line(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, values)) + 1, '\0');
  std::vsnprintf(line.data(), line.size(), format, again);
  va_end(again);
  va_end(values);
  line.back() = '\n';
  std::string padded = name;
  padded.resize(std::max<std::size_t>(padded.size(), 15), ' ');
  text_ += padded + ' ' + line;
}

void Summary::print() const {
  if (std::fputs(text_.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw tufted::IoError("standard output: cannot write the summary");
}

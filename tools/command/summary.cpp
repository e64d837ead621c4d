#include "summary.h"

#include <algorithm>
#include <cstdio>

void Summary::add(const char* name, const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  addLine(false, name, format, values);
  va_end(values);
}

void Summary::addDetail(const char* name, const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  addLine(true, name, format, values);
  va_end(values);
}

void Summary::append(const Summary& next) {
  lines_.insert(lines_.end(), next.lines_.begin(), next.lines_.end());
}

std::string Summary::text(bool with_details) const {
  std::string all;
  for (const Line& line : lines_)
    if (with_details || !line.is_detail) all += line.text;
  return all;
}

void Summary::addLine(bool is_detail, const char* name, const char* format, std::va_list values) {
  std::va_list again;
  va_copy(again, values);
  std::string line(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, values)) + 1, '\0');
  std::vsnprintf(line.data(), line.size(), format, again);
  va_end(again);
  line.back() = '\n';
  std::string padded = name;
  padded.resize(std::max<std::size_t>(padded.size(), 15), ' ');
  lines_.push_back({padded + ' ' + line, is_detail});
}

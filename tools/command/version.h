#pragma once

#include <string>

/// The output of --version: the version, the licence of this binary, and what it was built with.
std::string versionText();

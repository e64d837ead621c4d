#pragma once

#include <string>

/// What --version prints: the version, the licence of this binary, and what it was built with.
std::string versionText();

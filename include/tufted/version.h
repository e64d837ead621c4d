#pragma once

/// The version of the headers; CMake takes the version of the whole project from this line. While the first number is
/// zero, a change of the second one may change names, results and the binary interface; a change of the third may not.
#define TUFTED_VERSION "0.2.0"

#pragma once

/// The version of the headers; CMake takes the version of the whole project from this line. While the first number is
/// zero, a change of the second one may change names, results and the binary interface; a change of the third may not.
#define TUFTED_VERSION "0.2.0"
/// The same as one number that comparisons order: 10000 times the first, 100 times the second, and the third.
#define TUFTED_VERSION_NUMBER 200

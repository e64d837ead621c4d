#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"

/// Tests of what readLaplacian says of a folder.
class LaplacianFolder : public testing::Test {
 protected:
  /// What readLaplacian says, without the folder, or an empty string where it reads.
  std::string refusal() const {
    try {
      tufted::readLaplacian(dir_.path());
    } catch (const tufted::IoError& error) {
      const std::string message = error.what(), folder = dir_.path().string() + "/";
      EXPECT_TRUE(message.starts_with(folder)) << message;
      return message.substr(std::min(folder.size(), message.size()));
    }
    return "";
  }

  TemporaryDir dir_;
};

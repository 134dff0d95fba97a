#pragma once
#include "core/base/files.h"
#include "tests/support/program.h"
#include <gtest/gtest.h>
#include <regex>
#include <string>

/// scratch(name) with stand.toml, a lumped case with half a second of synthetic force.
inline std::string folder_with_short_stand(const std::string &name)
{
  const std::string path = scratch(name);
  EXPECT_EQ(millstand("new lumped -o " + path + "/stand.toml").exit_code, 0);
  const std::string text = mill::read_text(path + "/stand.toml");
  mill::write_atomically(
      path + "/stand.toml",
      std::regex_replace(text, std::regex("synthetic_duration = \"10 s\""), "synthetic_duration = \"0.5 s\""));
  return path;
}

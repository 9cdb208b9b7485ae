#pragma once
// Reads the #include lines of the sources and says which of them draw an arrow that the design does not have.
// The table of arrows is in include_rules.cpp and nowhere else.

#include <filesystem>
#include <string>
#include <vector>

namespace subdivd::layers {

struct Violation {
  std::string file;  // relative to the root, with forward slashes
  int line = 0;      // from 1
  std::string what;  // the include, and why it must not stand there
};

// Every violation in the C++ files below core/, proto/ and server/ of `root`, by file and line.
// A file in a folder that the table does not know is one violation at line 0.
std::vector<Violation> check_includes(const std::filesystem::path& root);

}  // namespace subdivd::layers

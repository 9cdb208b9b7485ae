// Writes sample.glb and vase.json into the folder named by the only argument.
#include <fstream>
#include <iostream>

#include "tests/shapes/sample.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: make_sample FOLDER\n";
    return 2;
  }
  const std::string folder = arguments[1];
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>{"sample.glb", subdivd::shapes::sample_glb()},
        {"vase.json", subdivd::shapes::sample_vase_json()}}) {
    std::ofstream file(folder + "/" + name, std::ios::binary);
    file << bytes;
    if (!file.flush()) {
      std::cerr << "cannot write " << folder << "/" << name << "\n";
      return 1;
    }
  }
}

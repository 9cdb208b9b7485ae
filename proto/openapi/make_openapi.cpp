// make_openapi PROTO VERSION DOCUMENT SOURCE: from the texts in PROTO/openapi/text, the requests in
// PROTO/examples and the tables of the code to DOCUMENT, OpenAPI in JSON, and to SOURCE, which holds it for
// proto/openapi.h. A fault in the texts ends the build.

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>

#include "proto/openapi/compose.h"
#include "proto/openapi/tables.h"

namespace {

namespace fs = std::filesystem;
using subdivd::proto::openapi::Json;

Json read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  try {
    return Json::parse(file);
  } catch (const Json::exception& fault) {
    throw std::runtime_error(path.string() + ": " + fault.what());
  }
}

// By name, so that the document does not depend on the order of a directory.
std::set<fs::path> json_files(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.insert(entry.path());
  return files;
}

// The members of all files of a folder in one object. Nothing may stand in two of them.
void add_files(Json& all, const fs::path& folder) {
  for (const fs::path& path : json_files(folder)) {
    const Json file = read(path);
    for (const auto& [name, value] : file.items()) {
      if (all.contains(name)) throw std::runtime_error(path.string() + ": there is already a " + name);
      all[name] = value;
    }
  }
}

void add_examples(Json& shared, const fs::path& folder) {
  shared["examples"] = Json::object();
  for (const fs::path& path : json_files(folder)) {
    const std::string name = path.stem().string();
    shared["examples"][name] = shared["examples." + name] = {{"value", read(path)}};
  }
}

Json document(const fs::path& proto, const std::string& version) {
  const fs::path text = proto / "openapi" / "text";
  Json shared = subdivd::proto::openapi::tables();
  shared["version"] = version;
  add_examples(shared, proto / "examples");
  add_files(shared, text / "shared");

  Json whole = read(text / "about.json");
  whole["paths"] = Json::object();
  add_files(whole["paths"], text / "paths");
  whole["components"] = {{"parameters", {{"$use", "parameters"}}},
                         {"responses", read(text / "responses.json")},
                         {"schemas", Json::object()}};
  add_files(whole["components"]["schemas"], text / "schemas");
  return subdivd::proto::openapi::compose(whole, shared);
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count != 5) throw std::runtime_error("usage: make_openapi PROTO VERSION DOCUMENT SOURCE");
    const std::string text = document(arguments[1], arguments[2]).dump() + '\n';
    write(arguments[3], text);
    write(arguments[4],
          "#include \"proto/openapi.h\"\n\nstd::string_view subdivd::proto::openapi_json() {\n"
          "  static constexpr std::string_view text = R\"openapi(" +
              text + ")openapi\";\n  return text;\n}\n");
    return 0;
  } catch (const std::exception& fault) {
    std::cerr << "make_openapi: " << fault.what() << '\n';
    return 1;
  }
}

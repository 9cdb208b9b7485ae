#include "tests/layers/include_rules.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <string_view>

namespace subdivd::layers {
namespace {

namespace fs = std::filesystem;

// What the files of one folder (and of folders inside it without a row of their own) may include.
struct Layer {
  std::string_view folder;
  std::vector<std::string_view> project;  // folders, or single headers
  std::vector<std::string_view> foreign;  // beginnings of <...> names, besides the standard library
};

// clang-format off
const std::vector<Layer> kLayers = {
  {"core/base",        {"core/base/"}, {"sys/mman.h"}},  // huge pages
  {"core/splines",     {"core/base/", "core/splines/"}, {}},
  {"core/curves",      {"core/base/", "core/splines/", "core/curves/"}, {}},
  {"core/surfaces",    {"core/base/", "core/curves/", "core/surfaces/"}, {}},
  {"core/mesh",        {"core/base/", "core/mesh/"}, {}},
  {"core/schemes",     {"core/base/", "core/mesh/", "core/schemes/"}, {}},
  {"core/lattice",     {"core/base/", "core/mesh/", "core/lattice/"}, {}},
  {"core/analysis",    {"core/base/", "core/mesh/", "core/schemes/", "core/splines/", "core/curves/", "core/analysis/"}, {}},
  {"core/limit",       {"core/base/", "core/mesh/", "core/schemes/", "core/limit/"}, {}},
  {"core/engine",      {"core/base/", "core/mesh/", "core/schemes/", "core/lattice/", "core/engine/net.h"}, {}},
  {"core/engine/plain", {"core/base/", "core/mesh/", "core/schemes/", "core/engine/plain/"}, {}},
  {"core/engine/grid", {"core/base/", "core/mesh/", "core/schemes/", "core/lattice/", "core/limit/", "core/engine/net.h", "core/engine/grid/"}, {}},
  {"core/engine/tri_grid", {"core/base/", "core/mesh/", "core/schemes/", "core/lattice/", "core/limit/", "core/engine/net.h", "core/engine/grid/", "core/engine/tri_grid/"}, {}},
  {"core/engine/quad_grid", {"core/base/", "core/mesh/", "core/schemes/", "core/lattice/", "core/limit/", "core/engine/net.h", "core/engine/grid/", "core/engine/quad_grid/"}, {}},
  {"core/refine",      {"core/base/", "core/mesh/", "core/schemes/", "core/lattice/", "core/engine/", "core/limit/", "core/refine/"}, {}},
  {"core/tessellate",  {"core/base/", "core/mesh/", "core/schemes/", "core/lattice/", "core/refine/", "core/limit/", "core/tessellate/"}, {}},
  {"core/oracle",      {"core/base/", "core/mesh/", "core/lattice/", "core/refine/", "core/curves/", "core/surfaces/", "core/oracle/"}, {"opensubdiv/"}},
  {"proto",            {"core/base/", "core/splines/", "core/curves/", "core/surfaces/", "core/mesh/", "core/schemes/", "core/lattice/", "core/refine/", "core/tessellate/",
                        "core/analysis/", "core/oracle/report.h", "proto/"}, {"nlohmann/", "tiny_gltf.h"}},
  {"server",           {"core/", "proto/", "server/"}, {"spdlog/", "CLI/", "openssl/", "malloc.h", "POSIX"}},
  {"server/tasks",     {"core/", "proto/", "server/tasks/"}, {}},
  {"server/http",      {"core/", "proto/", "server/config.h", "server/grants.h", "server/log.h", "server/web/", "server/transport/",
                        "server/tasks/", "server/http/"}, {}},
  {"server/transport", {"core/base/", "server/transport/"}, {"httplib.h", "POSIX"}},
};

const std::set<std::string_view> kStandardLibrary = {
  "algorithm", "any", "array", "atomic", "barrier", "bit", "bitset", "cassert", "cctype", "cerrno", "cfenv", "cfloat", "charconv",
  "chrono", "cinttypes", "climits", "clocale", "cmath", "compare", "complex", "concepts", "condition_variable", "coroutine",
  "csetjmp", "csignal", "cstdarg", "cstddef", "cstdint", "cstdio", "cstdlib", "cstring", "ctime", "cuchar", "cwchar", "cwctype",
  "deque", "exception", "execution", "filesystem", "forward_list", "fstream", "functional", "future", "initializer_list", "iomanip",
  "ios", "iosfwd", "iostream", "istream", "iterator", "latch", "limits", "list", "locale", "map", "memory", "memory_resource",
  "mutex", "new", "numbers", "numeric", "optional", "ostream", "queue", "random", "ranges", "ratio", "regex", "scoped_allocator",
  "semaphore", "set", "shared_mutex", "source_location", "span", "sstream", "stack", "stdexcept", "stop_token", "streambuf",
  "string", "string_view", "syncstream", "system_error", "thread", "tuple", "type_traits", "typeindex", "typeinfo", "unordered_map",
  "unordered_set", "utility", "valarray", "variant", "vector", "version",
};

const std::set<std::string_view> kPosix = {
  "arpa/inet.h", "fcntl.h", "netdb.h", "netinet/in.h", "netinet/tcp.h", "poll.h", "pthread.h", "signal.h", "sys/epoll.h", "sys/eventfd.h", "sys/resource.h", "sys/socket.h",
  "sys/stat.h", "sys/time.h", "sys/types.h", "sys/un.h", "sys/wait.h", "unistd.h",
};
// clang-format on

// What the list of schemes, and every scheme of it, looks like to others.
const std::set<std::string_view> kSchemesInGeneral = {"core/schemes/all.h", "core/schemes/mask.h",
                                                      "core/schemes/scheme.h", "core/schemes/tags.h"};

// House style is .h and .cpp; the others are read too, lest a stray arrow hide behind a name.
const std::set<std::string> kSourceExtensions = {".h", ".cpp", ".hpp", ".cc", ".cxx",
                                                 ".c", ".inc", ".inl", ".ipp"};

// The row with the longest folder that holds `file`; null when no row does.
const Layer* layer_of(std::string_view file) {
  const Layer* best = nullptr;
  for (const Layer& layer : kLayers) {
    const bool inside = file.starts_with(layer.folder) && file.substr(layer.folder.size()).starts_with('/');
    if (inside && (best == nullptr || layer.folder.size() > best->folder.size())) best = &layer;
  }
  return best;
}

// Empty when the arrow is drawn; otherwise why not.
std::string objection_to_project(const Layer& layer, const std::string& name, const fs::path& root) {
  if (name.find("..") != std::string::npos) return "goes through a parent folder";
  if (!fs::is_regular_file(root / name)) return "is no file counted from the root";
  if (name.starts_with("core/schemes/") && layer.folder != "core/schemes" &&
      !kSchemesInGeneral.contains(name))
    return "names one scheme: whoever needs them takes the list, core/schemes/all.h";
  for (const std::string_view allowed : layer.project)
    if (allowed.ends_with('/') ? name.starts_with(allowed) : name == allowed) return "";
  return "is an arrow that the design does not draw from " + std::string(layer.folder);
}

std::string objection_to_foreign(const Layer& layer, const std::string& name) {
  if (kStandardLibrary.contains(name)) return "";
  for (const std::string_view allowed : layer.foreign)
    if (allowed == "POSIX" ? kPosix.contains(name) : name.starts_with(allowed)) return "";
  return "is neither the C++ standard library nor allowed in " + std::string(layer.folder);
}

void check_file(const fs::path& root, const std::string& file, std::vector<Violation>& found) {
  const Layer* layer = layer_of(file);
  if (layer == nullptr) {
    found.push_back({file, 0, "lies in no folder that tests/layers/include_rules.cpp knows"});
    return;
  }
  static const std::regex kInclude(R"re(^\s*#\s*(include|include_next|import)\b\s*(.*)$)re");
  static const std::regex kName(R"re(^(?:"([^"]+)"|<([^>]+)>).*$)re");
  std::ifstream stream(root / file);
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    std::smatch include;
    if (!std::regex_match(text, include, kInclude)) continue;
    const std::string rest = include[2];
    std::smatch name;
    std::string objection;
    if (!std::regex_match(rest, name, kName))
      objection = "does not say its header in plain words";
    else if (name[1].matched)
      objection = objection_to_project(*layer, name[1], root);
    else
      objection = objection_to_foreign(*layer, name[2]);
    if (!objection.empty()) found.push_back({file, line, rest + " " + objection});
  }
}

}  // namespace

std::vector<Violation> check_includes(const fs::path& root) {
  std::vector<std::string> files;
  for (const char* top : {"core", "proto", "server"}) {
    if (!fs::is_directory(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.is_regular_file() && kSourceExtensions.contains(entry.path().extension().string()))
        files.push_back(entry.path().lexically_relative(root).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<Violation> found;
  for (const std::string& file : files) check_file(root, file, found);
  return found;
}

}  // namespace subdivd::layers

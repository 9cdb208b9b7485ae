#include "server/transport/health_check.h"

#include <httplib.h>

namespace subdivd::server {

bool is_healthy(const std::string& url) {
  constexpr std::string_view kScheme = "http://";
  constexpr int kSeconds = 3;
  if (!url.starts_with(kScheme)) return false;
  const std::size_t slash = url.find('/', kScheme.size());
  try {
    httplib::Client client(url.substr(0, slash));
    client.set_connection_timeout(kSeconds);
    client.set_read_timeout(kSeconds);
    const httplib::Result answer = client.Get(slash == std::string::npos ? "/" : url.substr(slash));
    return answer && answer->status == 200;
  } catch (...) {  // a URL that httplib cannot take apart
    return false;
  }
}

}  // namespace subdivd::server

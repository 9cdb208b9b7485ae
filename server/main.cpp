#include <iostream>

#include "server/config.h"
#include "server/daemon.h"
#include "server/transport/health_check.h"

int main(int argc, char** argv) {
  using namespace subdivd::server;
  const auto invocation = parse_command_line(argc, argv);
  if (!invocation) {
    std::cerr << "subdivd: " << invocation.error().message << '\n';
    return 2;
  }
  switch (invocation->action) {
    case Invocation::Action::print:
      std::cout << invocation->text;
      return 0;
    case Invocation::Action::health_check:
      return is_healthy(invocation->text) ? 0 : 1;
    case Invocation::Action::serve:
      break;
  }
  return run(invocation->config);
}

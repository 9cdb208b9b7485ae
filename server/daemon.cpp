#include "server/daemon.h"

#include <pthread.h>
#include <signal.h>

#include <chrono>
#include <iostream>
#include <string>

#include "server/application.h"
#include "server/log.h"
#include "server/transport/quota.h"
#include "server/transport/transport.h"

namespace subdivd::server {
namespace {

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<long long>(seconds * 1000));
}

TransportOptions transport_options(const Config& config) {
  TransportOptions options;
  options.host = config.host;
  options.port = config.port;
  options.threads = config.threads;
  options.max_connections = config.max_connections;
  options.max_body_bytes = config.max_body_bytes;
  options.read_timeout = milliseconds(config.read_timeout);
  options.idle_timeout = milliseconds(config.idle_timeout);
  return options;
}

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  return signals;
}

std::string url_of(const Config& config, int port) {
  const bool v6 = config.host.find(':') != std::string::npos;
  return "http://" + (v6 ? "[" + config.host + "]" : config.host) + ":" + std::to_string(port);
}

void drain(const Config& config, Application& application, Transport& transport) {
  log_info("draining");
  application.begin_drain();
  transport.begin_drain();
  if (!transport.wait_until_idle(milliseconds(config.drain_seconds)))
    log_warning("the time for draining is over: cancelling what still runs");
  transport.stop();
  log_info("ended");
}

}  // namespace

int run(const Config& config) {
  // Threads inherit the mask, so the signals wait for sigwait below and interrupt nothing.
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);  // a closed log must not end the process
  start_log(config.log_level);
  Quota memory(config.max_memory_bytes);
  Application application(config, memory);
  if (!application.prepare()) log_error("the self-test against OpenSubdiv failed: /readyz says no");
  Transport transport(transport_options(config), application, memory);
  if (auto started = transport.start(); !started) {
    std::cerr << "subdivd: " << started.error().message << std::endl;
    return 1;
  }
  std::cout << "subdivd listens on " << url_of(config, transport.port()) << std::endl;
  int received = 0;
  sigwait(&signals, &received);
  drain(config, application, transport);
  return 0;
}

}  // namespace subdivd::server

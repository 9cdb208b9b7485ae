#include "server/daemon.h"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "server/housekeeper.h"
#include "server/http/application.h"
#include "server/log.h"
#include "server/transport/body.h"
#include "server/transport/transport.h"

namespace subdivd::server {
namespace {

constexpr std::chrono::milliseconds kLogPatience{500}, kStopPatience{2000};

// Freed memory that the allocator may keep for the next request: small blocks, and of large ones a share of
// what all requests may take.
constexpr std::uint64_t kLeastSlack = std::uint64_t{16} << 20, kKeptShare = 8;

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

// What --max-memory-bytes is shared out to. Fixed shares: bodies that wait to be computed can never take what
// computing needs, nor the other way round.
struct MemoryShares {
  Count bodies = 0, work = 0;
};

// The program, its threads and what they read without asking, measured under load.
Count own_bytes(const Config& config) { return (Count{20} << 20) + config.threads * kFreeBody; }

MemoryShares share_out(const Config& config) {
  const Count bytes = config.max_memory_bytes;
  // Of very little memory, half is for requests.
  const Count shared = std::max(bytes / 2, bytes - std::min(bytes, own_bytes(config)));
  return {shared / 4, shared - shared / 4};
}

// Signals that this program answers; all others keep their meaning.
sigset_t handled_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2}) sigaddset(&signals, signal);
  return signals;
}

std::string url_of(const Config& config, int port) {
  const bool v6 = config.host.find(':') != std::string::npos;
  return "http://" + (v6 ? "[" + config.host + "]" : config.host) + ":" + std::to_string(port);
}

// Everything that is taken and given back, as SIGUSR1 puts it into the log: idle, all of it is free.
std::string state_line(const Application& application, const RequestMemory& bodies,
                       const Transport& transport) {
  const Grants::State work = application.grants().state();
  const Transport::State state = transport.state();
  std::string line = "state";
  const auto add = [&](const char* name, std::uint64_t value) {
    line += std::string(" ") + name + "=" + std::to_string(value);
  };
  add("memory_total", work.bytes + bodies.total());
  add("memory_free", work.free_bytes + bodies.free());
  add("places_total", work.places);
  add("places_free", work.free_places);
  add("waiting", work.waiting + state.waiting);
  add("connections", state.connections);
  add("busy", state.requests);
  add("log_dropped", dropped_log_lines());
  add("resident", resident_bytes());
  return line;
}

Housekeeper::Use use_of(const Application& application, const RequestMemory& bodies) {
  const Grants::State work = application.grants().state();
  return {(work.bytes - work.free_bytes) + (bodies.total() - bodies.free()), work.granted};
}

// Until SIGTERM or SIGINT. Whoever sends another signal means well: neither kill(1) by habit nor a closed
// terminal may end the daemon.
void wait_for_the_end(const sigset_t& signals, const Application& application, const RequestMemory& bodies,
                      const Transport& transport) {
  for (;;) {
    int received = 0;
    if (sigwait(&signals, &received) != 0) continue;
    if (received == SIGTERM || received == SIGINT) return;
    if (received == SIGUSR1) log_info(state_line(application, bodies, transport));
    if (received == SIGHUP) log_info("SIGHUP: settings are read at start only");
  }
}

// Until no request is in flight, the time for that is over, or a second SIGTERM or SIGINT wants it no longer.
bool wait_until_idle(Transport& transport, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kSlice{50};
  const auto deadline = std::chrono::steady_clock::now() + patience;
  sigset_t ending;
  sigemptyset(&ending);
  for (const int signal : {SIGTERM, SIGINT}) sigaddset(&ending, signal);
  const timespec at_once{};
  while (!transport.wait_until_idle(kSlice))
    if (std::chrono::steady_clock::now() >= deadline || sigtimedwait(&ending, nullptr, &at_once) > 0)
      return false;
  return true;
}

// False when a thread goes on that cannot be stopped: the process then has to end without it.
bool drain(const Config& config, Application& application, Transport& transport) {
  log_info("draining");
  application.begin_drain();
  transport.begin_drain();
  if (!wait_until_idle(transport, milliseconds(config.drain_seconds)))
    log_warning("not waiting any longer: cancelling what still runs");
  const bool stopped = transport.stop(kStopPatience);
  if (!stopped) log_warning("what still runs cannot be cancelled: ending without it");
  log_info("ended");
  return stopped;
}

}  // namespace

namespace {

int serve(const Config& config) {
  // Threads inherit the mask, so the signals wait for sigwait and interrupt nothing.
  const sigset_t signals = handled_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);  // a closed log must not end the process
  start_log(config.log_level);
  const MemoryShares shares = share_out(config);
  const std::uint64_t kept = shares.work / kKeptShare;
  tune_allocator(kept, shares.work);
  RequestMemory bodies(shares.bodies);
  Application application(config, shares.work);
  if (!application.prepare()) log_error("the self-test against OpenSubdiv failed: /readyz says no");
  Transport transport(transport_options(config), application, bodies);
  if (auto started = transport.start(); !started) {
    std::cerr << "subdivd: " << started.error().message << std::endl;
    return 1;
  }
  std::cout << "subdivd listens on " << url_of(config, transport.port()) << std::endl;
  const Housekeeper housekeeper(
      [&] { return use_of(application, bodies); },
      {own_bytes(config), kept + std::max(config.max_memory_bytes / 32, kLeastSlack), kLeastSlack});
  wait_for_the_end(signals, application, bodies, transport);
  const bool stopped = drain(config, application, transport);
  // A reader of the log that has stalled keeps the writing thread for ever: leave without it.
  if (!finish_log(kLogPatience) || !stopped) std::_Exit(0);
  return 0;
}

}  // namespace

int run(const Config& config) {
  try {
    return serve(config);
  } catch (const std::exception&) {  // while starting: later, every thread catches what it throws
    std::cerr << "subdivd: the system has no memory or no threads to start with" << std::endl;
    return 1;
  }
}

}  // namespace subdivd::server

#pragma once
// Clients at work: well-behaved ones, and those that no daemon likes.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/soak/connection.h"
#include "tests/soak/requests.h"
#include "tests/soak/tally.h"

namespace subdivd::soak {

using Random = std::mt19937_64;

// All numbers of a run come from one seed; the engine's words are the same everywhere, the standard's
// distributions are not.
inline std::size_t below(Random& random, std::size_t end) { return static_cast<std::size_t>(random() % end); }

// Requests by weight.
class Mix {
 public:
  explicit Mix(std::vector<Request> requests);
  const Request& any(Random& random) const;
  const std::vector<Request>& all() const { return requests_; }

 private:
  std::vector<Request> requests_;
  std::vector<std::size_t> tickets_;  // numbers of requests, each as often as its weight
};

struct Traffic {
  int port = 0;
  Tally& tally;
  std::atomic<bool> stop{false};
  // Well-behaved clients stop when nothing is left of it.
  std::atomic<std::int64_t> requests_left{INT64_MAX};
};

// Sends one request on an open connection and judges the answer. False: the connection is of no more use.
bool exchange(Traffic& traffic, Connection& connection, const Request& request);

// One of `refuse_every` requests is one that is refused; 0: none is.
void behave_well(Traffic& traffic, const Mix& good, const Mix& refused, std::size_t refuse_every,
                 std::uint64_t seed);

// Leaves early, drips, reads slowly, ends its half, speaks no HTTP, …
class BadClient {
 public:
  BadClient(Traffic& traffic, const std::string& sources, std::uint64_t seed);
  void misbehave();  // until the traffic stops

 private:
  void once();
  void leave_while_computing();
  void leave_within_the_body();
  void drip_a_head();
  void drip_a_body();
  void read_slowly();
  void end_its_half();
  void pipeline();
  void send_chunks_and_trailers();
  void wait_for_100_continue();
  void speak_tls();
  void send_noise();
  void keep_silent();
  void begin_and_stop();
  void pause_between_requests();

  void expect(const std::string& kind, std::uint64_t identity, const Answer& answer);
  void wait_up_to(std::size_t milliseconds);

  Traffic& traffic_;
  Random random_;
  std::vector<std::string> heavy_;  // requests of some hundred milliseconds
  std::string large_, mesh_;        // a request with a large answer; a body
};

}  // namespace subdivd::soak

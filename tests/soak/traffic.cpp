#include "tests/soak/traffic.h"

#include <algorithm>
#include <array>
#include <memory>
#include <thread>
#include <utility>

namespace subdivd::soak {
namespace {

constexpr std::size_t kMostPerConnection = 200;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Mix::Mix(std::vector<Request> requests) : requests_(std::move(requests)) {
  for (std::size_t i = 0; i < requests_.size(); ++i)
    tickets_.insert(tickets_.end(), static_cast<std::size_t>(requests_[i].weight), i);
}

const Request& Mix::any(Random& random) const { return requests_[tickets_[below(random, tickets_.size())]]; }

bool exchange(Traffic& traffic, Connection& connection, const Request& request) {
  const Clock::time_point start = Clock::now();
  connection.send(request.bytes);  // a refusal may come, and the connection end, before everything is sent
  const Answer answer = connection.receive();
  if (request.small) traffic.tally.small_took(request.kind, milliseconds_since(start));
  traffic.tally.answered(request.kind, answer, {request.status});
  if (answer.status == request.status) traffic.tally.compare(request.kind, request.identity(), answer);
  return answer.status != 0 && !answer.closes;
}

void behave_well(Traffic& traffic, const Mix& good, const Mix& refused, std::size_t refuse_every,
                 std::uint64_t seed) {
  Random random(seed);
  while (!traffic.stop) {
    Connection connection(traffic.port);
    const std::size_t most = 1 + below(random, kMostPerConnection);
    bool usable = connection.open();
    if (!usable) traffic.tally.fault("a connection was refused");
    for (std::size_t i = 0; usable && i < most && !traffic.stop; ++i) {
      if (--traffic.requests_left < 0) return;
      const bool good_one = refuse_every == 0 || below(random, refuse_every) != 0;
      usable = exchange(traffic, connection, (good_one ? good : refused).any(random));
    }
  }
}

BadClient::BadClient(Traffic& traffic, const std::string& sources, std::uint64_t seed)
    : traffic_(traffic), random_(seed), mesh_(sheet_json(6, 6)) {
  const std::string glb = file_text(sources + "/tests/shapes/sample.glb");
  const std::string type = "Content-Type: model/gltf-binary\r\n";
  heavy_ = {post("/v1/refine?level=5&limit=true&normals=true", glb, type),
            post("/v1/refine?level=5", sheet_json(20, 20)), post("/v1/verify?level=3", sheet_json(20, 20)),
            post("/v1/refine?level=0", sheet_json(200, 200))};
  large_ = post("/v1/refine?level=4", glb, type);
}

void BadClient::misbehave() {
  while (!traffic_.stop) once();
}

void BadClient::once() {
  using Habit = void (BadClient::*)();
  constexpr std::array kHabits = {
      &BadClient::leave_while_computing,
      &BadClient::leave_while_computing,
      &BadClient::leave_within_the_body,
      &BadClient::drip_a_head,
      &BadClient::drip_a_body,
      &BadClient::read_slowly,
      &BadClient::end_its_half,
      &BadClient::pipeline,
      &BadClient::send_chunks_and_trailers,
      &BadClient::wait_for_100_continue,
      &BadClient::speak_tls,
      &BadClient::send_noise,
      &BadClient::keep_silent,
      &BadClient::begin_and_stop,
      &BadClient::pause_between_requests,
  };
  const Habit habit = kHabits[below(random_, kHabits.size())];
  (this->*habit)();
}

void BadClient::expect(const std::string& kind, std::uint64_t identity, const Answer& answer) {
  traffic_.tally.answered(kind, answer, {200});
  if (answer.status == 200) traffic_.tally.compare(kind, identity, answer);
}

void BadClient::wait_up_to(std::size_t milliseconds_) {
  std::this_thread::sleep_for(milliseconds(below(random_, milliseconds_)));
}

// The daemon needs a moment to see it; clients that leave faster than that would fill the places of those who
// wait.
void BadClient::leave_while_computing() {
  const bool hard = below(random_, 2) == 0;
  {
    Connection connection(traffic_.port);
    connection.send(heavy_[below(random_, heavy_.size())]);
    wait_up_to(150);
    if (hard) connection.reset();
  }
  traffic_.tally.did(hard ? "leaves while computing, RST" : "leaves while computing, FIN");
  std::this_thread::sleep_for(milliseconds(200));
}

void BadClient::leave_within_the_body() {
  Connection connection(traffic_.port);
  const std::string& request = heavy_.front();
  connection.send(std::string_view(request).substr(0, below(random_, request.size())));
  wait_up_to(50);
  if (below(random_, 2) == 0) connection.reset();
  traffic_.tally.did("leaves within the body");
}

void BadClient::drip_a_head() {
  Connection connection(traffic_.port);
  const std::string request = get("/livez");
  connection.send_slowly(request, 1 + below(random_, 3), milliseconds(5 + below(random_, 40)));
  expect("drips a head", Request::identity_of(request), connection.receive());
}

void BadClient::drip_a_body() {
  Connection connection(traffic_.port);
  const std::string request = post("/v1/refine?level=2", mesh_);
  connection.send_slowly(request, 50 + below(random_, 200), milliseconds(5 + below(random_, 40)));
  expect("drips a body", Request::identity_of(request), connection.receive());
}

void BadClient::read_slowly() {
  Connection connection(traffic_.port, 16384);
  connection.send(large_);
  const ReadingPace pace{.piece = 16384 + below(random_, 65536),
                         .pause = milliseconds(1 + below(random_, 5))};
  expect("reads slowly", Request::identity_of(large_), connection.receive(pace, 3 * kPatience));
}

void BadClient::end_its_half() {
  Connection connection(traffic_.port);
  const std::string request = post("/v1/refine?level=4", mesh_);
  connection.send(request);
  connection.end_sending();
  expect("ends its half and waits", Request::identity_of(request), connection.receive());
}

void BadClient::pipeline() {
  Connection connection(traffic_.port);
  const std::array<std::string, 3> requests = {post("/v1/refine?level=2", mesh_), get("/livez"),
                                               post("/v1/refine?level=1", kTetrahedron)};
  std::string all;
  std::vector<std::size_t> order;
  for (std::size_t i = 2 + below(random_, 5); i > 0; --i) {
    order.push_back(below(random_, requests.size()));
    all += requests[order.back()];
  }
  connection.send(all);
  for (const std::size_t i : order)
    expect("pipelines", Request::identity_of(requests[i]), connection.receive());
}

void BadClient::send_chunks_and_trailers() {
  constexpr std::string_view kHexDigits = "0123456789abcdef";
  Connection connection(traffic_.port);
  std::string request = chunked_head("/v1/refine?level=2");
  for (std::string_view rest = mesh_; !rest.empty();) {
    const std::string_view chunk = rest.substr(0, 1 + below(random_, 255));
    request += {kHexDigits[chunk.size() / 16], kHexDigits[chunk.size() % 16], '\r', '\n'};
    request += std::string(chunk) + "\r\n";
    rest.remove_prefix(chunk.size());
  }
  connection.send(request + "0\r\nX-Checksum: none\r\nX-More: words\r\n\r\n");
  // The same body as others send whole, and the same answer.
  expect("sends chunks and trailers", Request::identity_of(post("/v1/refine?level=2", mesh_)),
         connection.receive());
}

void BadClient::wait_for_100_continue() {
  Connection connection(traffic_.port);
  const std::string request = post("/v1/refine?level=2", mesh_, "Expect: 100-continue\r\n");
  connection.send(std::string_view(request).substr(0, request.size() - mesh_.size()));
  wait_up_to(100);
  connection.send(mesh_);
  expect("waits for 100-continue", Request::identity_of(post("/v1/refine?level=2", mesh_)),
         connection.receive());
}

void BadClient::speak_tls() {
  Connection connection(traffic_.port);
  // A ClientHello as far as it matters: a handshake record, TLS 1.0 for compatibility, then anything.
  std::string hello{"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11};
  for (int i = 0; i < 506; ++i) hello += static_cast<char>(random_());
  connection.send(hello);
  traffic_.tally.answered("speaks TLS", connection.receive(), {400});
}

void BadClient::send_noise() {
  Connection connection(traffic_.port);
  std::string noise;
  for (std::size_t i = 1 + below(random_, 4000); i > 0; --i) noise += static_cast<char>(random_());
  connection.send(noise + "\r\n\r\n");
  traffic_.tally.answered("sends noise", connection.receive(), {400, 414, 431, 505});
}

void BadClient::keep_silent() {
  Connection connection(traffic_.port);
  wait_up_to(1500);
  traffic_.tally.did("keeps silent");
}

void BadClient::begin_and_stop() {
  Connection connection(traffic_.port);
  const std::string request = get("/livez");
  connection.send(std::string_view(request).substr(0, 1 + below(random_, request.size() - 1)));
  wait_up_to(300);
  traffic_.tally.did("stops within the head");
}

// Longer than a daemon in haste keeps a connection, shorter than any client does.
void BadClient::pause_between_requests() {
  Connection connection(traffic_.port);
  const std::string request = post("/v1/refine?level=2", mesh_);
  for (int i = 0; i < 2; ++i) {
    connection.send(request);
    expect("pauses between requests", Request::identity_of(request), connection.receive());
    if (i == 0) std::this_thread::sleep_for(milliseconds(500 + below(random_, 3000)));
  }
}

}  // namespace subdivd::soak

#include "server/transport/engine.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <ctime>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace subdivd::server {
namespace {

constexpr std::size_t kSendBytes = 640 * 1024;
// A small body travels with its head.
constexpr std::size_t kJoinedBytes = 16 * 1024;

// Reads the head that stands for the client's, writes to the client.
class EngineStream final : public httplib::Stream {
 public:
  EngineStream(ClientSocket& socket, std::string_view head, bool body_follows, TransferTime time)
      : socket_(socket), head_(head), body_follows_(body_follows), time_(time) {}

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  socket_t socket() const override { return 0; }  // compared with FD_SETSIZE only
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}

  ssize_t read(char* to, size_t size) override {
    const std::size_t count = head_.copy(to, size);
    head_.remove_prefix(count);
    return count == 0 ? -1 : static_cast<ssize_t>(count);
  }

  // httplib writes the response's head in one piece, then the body.
  ssize_t write(const char* data, size_t size) override {
    const std::string_view piece(data, size);
    if (!begun_ && body_follows_ && held_.empty()) {
      held_ = piece;
      return static_cast<ssize_t>(size);
    }
    begun_ = true;
    bool sent = true;
    if (!held_.empty() && size <= kJoinedBytes) {
      held_ += piece;
      sent = socket_.write(held_, time_);
    } else {
      sent = (held_.empty() || socket_.write(held_, time_, true)) && socket_.write(piece, time_);
    }
    held_.clear();
    return sent ? static_cast<ssize_t>(size) : -1;
  }

  bool begun() const { return begun_; }

 private:
  ClientSocket& socket_;
  std::string_view head_;
  std::string held_;
  const bool body_follows_;
  bool begun_ = false;
  TransferTime time_;
};

std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 64> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
  return {text.data(), length};
}

// Writes a body piece by piece. It knows where it stands, and puts small parts together: an answer may
// consist of hundreds of thousands of them. What is made while it is sent is made here.
class BodySender {
 public:
  explicit BodySender(std::shared_ptr<const Response> response) : response_(std::move(response)) {}

  bool send_next(httplib::DataSink& sink) {
    const std::span<const std::byte> first = take(kSendBytes);
    if (first.empty()) return false;
    if (first.size() >= kGatheredBytes || (rest_.empty() && part_ == parts().size()))
      return write(sink, first);
    gathered_.assign(text(first));
    while (gathered_.size() < kGatheredBytes) {
      const std::span<const std::byte> next = take(kGatheredBytes - gathered_.size());
      if (next.empty()) break;
      gathered_.append(text(next));
    }
    return sink.write(gathered_.data(), gathered_.size());
  }

 private:
  static constexpr std::size_t kGatheredBytes = 64 * 1024;

  static std::string_view text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  static bool write(httplib::DataSink& sink, std::span<const std::byte> bytes) {
    return sink.write(text(bytes).data(), bytes.size());
  }
  const std::vector<Bytes>& parts() const { return response_->body; }

  // The next bytes, at most so many and of one part; none: that was all.
  std::span<const std::byte> take(std::size_t most) {
    while (rest_.empty()) {
      if (part_ == parts().size()) return {};
      const Bytes& part = parts()[part_];
      rest_ = !part.maker ? part.bytes : part.maker->next();
      if (!part.maker || rest_.empty()) ++part_;
    }
    const std::span<const std::byte> taken = rest_.first(std::min(rest_.size(), most));
    rest_ = rest_.subspan(taken.size());
    return taken;
  }

  std::shared_ptr<const Response> response_;
  std::size_t part_ = 0;             // that comes after `rest_`, or makes more
  std::span<const std::byte> rest_;  // of what was taken up
  std::string gathered_;
};

}  // namespace

Engine::Engine(long long keep_alive_seconds) : keep_alive_seconds_(keep_alive_seconds) {
  svr_sock_ = 0;  // any valid number: content is sent only while httplib believes it listens
  set_pre_routing_handler([this](const httplib::Request&, httplib::Response& out) {
    try {
      describe(std::move(*response_), out);
    } catch (...) {  // out of memory; httplib would put what() into a header
      failed_ = true;
    }
    return HandlerResponse::Handled;
  });
  set_post_routing_handler([this](const httplib::Request&, httplib::Response& out) {
    if (failed_) throw std::bad_alloc();  // before a byte is written
    out.headers.erase("Keep-Alive");
    out.headers.erase("Connection");
    out.set_header("Connection", close_ ? "close" : "keep-alive");
    if (!close_ && keep_alive_seconds_ > 0)
      out.set_header("Keep-Alive", "timeout=" + std::to_string(keep_alive_seconds_));
    if (out.status == 204) out.headers.erase("Content-Length");
    out.headers.erase("Accept-Ranges");
    out.set_header("Accept-Ranges", "none");
    out.set_header("Date", http_date());
  });
}

Engine::Sent Engine::send(ClientSocket& socket, Response response, bool head_only, TransferTime time) {
  const bool body_follows = !head_only && response.size() > 0;
  EngineStream stream(socket, head_only ? "HEAD / HTTP/1.1\r\n\r\n" : "GET / HTTP/1.1\r\n\r\n", body_follows,
                      time);
  response_ = &response;
  failed_ = false;
  bool client_closed = false, whole = false;
  try {
    whole = process_request(stream, false, client_closed, {});
  } catch (...) {  // out of memory
  }
  return whole ? Sent::whole : stream.begun() ? Sent::partly : Sent::nothing;
}

void Engine::describe(Response response, httplib::Response& out) {
  close_ = response.close;
  out.status = response.status;
  for (const auto& [name, value] : response.headers) out.set_header(name, value);
  const std::uint64_t size = response.size();
  if (size == 0) return;
  const std::string content_type = response.content_type;
  // httplib asks for the body from its beginning to its end, once.
  auto sender = std::make_shared<BodySender>(std::make_shared<const Response>(std::move(response)));
  out.set_content_provider(size, content_type, [sender](size_t, size_t, httplib::DataSink& sink) {
    return sender->send_next(sink);
  });
}

}  // namespace subdivd::server

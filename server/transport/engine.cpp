#include "server/transport/engine.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <memory>
#include <utility>

namespace subdivd::server {
namespace {

// A chunk's size line is read byte by byte into memory; nobody needs one longer than this.
constexpr std::size_t kMaxChunkLine = 256;
constexpr std::size_t kSendBytes = 1 << 20;

// The head that httplib reads in place of the client's.
std::string plain_head(const Head& head, bool with_body) {
  std::string text = with_body ? "POST" : head.method == "HEAD" ? "HEAD" : "GET";
  text += " / HTTP/1.1\r\n";
  if (with_body) {
    if (head.framing == Head::Framing::chunked)
      text += "Transfer-Encoding: chunked\r\n";
    else
      text += "Content-Length: " + std::to_string(head.content_length) + "\r\n";
    if (head.expects_continue) text += "Expect: 100-continue\r\n";
  }
  return text + "\r\n";
}

// First the plain head, then the connection.
class EngineStream final : public httplib::Stream {
 public:
  EngineStream(ClientSocket& socket, std::string head, std::chrono::milliseconds patience)
      : socket_(socket), head_(std::move(head)), patience_(patience), in_(patience), out_(patience) {}

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  socket_t socket() const override { return 0; }  // compared with FD_SETSIZE only
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}

  ssize_t read(char* to, size_t size) override {
    if (given_ < head_.size()) {
      const std::size_t count = head_.copy(to, size, given_);
      given_ += count;
      return static_cast<ssize_t>(count);
    }
    if (!started_) in_ = Pace(patience_);
    started_ = true;
    const std::size_t count = socket_.read(to, size, in_.deadline());
    in_.moved(count);
    return count == 0 || endless_line(*to, size) ? -1 : static_cast<ssize_t>(count);
  }

  ssize_t write(const char* data, size_t size) override {
    if (!answering_) out_ = Pace(patience_);
    answering_ = true;
    return socket_.write(data, size, out_) ? static_cast<ssize_t>(size) : -1;
  }

  // The time for sending starts with the response, not with "100 Continue".
  void begin_answer() { answering_ = false; }

 private:
  // httplib asks for single bytes while it reads a chunk's size line, which has no limit in it: "1;aaaa…"
  // would grow its buffer for as long as the client cares to send.
  bool endless_line(char byte, std::size_t asked) {
    line_bytes_ = asked == 1 && byte != '\n' ? line_bytes_ + 1 : 0;
    return line_bytes_ > kMaxChunkLine;
  }

  ClientSocket& socket_;
  const std::string head_;
  const std::chrono::milliseconds patience_;
  std::size_t given_ = 0;
  std::size_t line_bytes_ = 0;
  bool started_ = false, answering_ = false;
  Pace in_, out_;
};

std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 64> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
  return {text.data(), length};
}

// Writes the part of the body at `offset`, at most kSendBytes of it.
bool send_part(const std::vector<Bytes>& body, std::size_t offset, httplib::DataSink& sink) {
  for (const Bytes& part : body) {
    if (offset >= part.bytes.size()) {
      offset -= part.bytes.size();
      continue;
    }
    const std::size_t count = std::min(part.bytes.size() - offset, kSendBytes);
    return sink.write(reinterpret_cast<const char*>(part.bytes.data()) + offset, count);
  }
  return false;
}

}  // namespace

Engine::Engine() {
  svr_sock_ = 0;  // any valid number: content is sent only while httplib believes it listens
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& out) {
    if (request.method == "POST") return HandlerResponse::Unhandled;
    send((*answer_)([](const auto&) { return true; }), out);
    return HandlerResponse::Handled;
  });
  Post("/", [this](const httplib::Request&, httplib::Response& out, const httplib::ContentReader& content) {
    const BodyReader reader = [&](const std::function<bool(std::string_view)>& receiver) {
      return content([&](const char* data, size_t size) { return receiver({data, size}); });
    };
    send((*answer_)(reader), out);
  });
  set_post_routing_handler([this](const httplib::Request&, httplib::Response& out) {
    out.headers.erase("Keep-Alive");
    out.headers.erase("Connection");
    if (close_) out.set_header("Connection", "close");
    if (out.status == 204) out.headers.erase("Content-Length");
    out.headers.erase("Accept-Ranges");
    out.set_header("Accept-Ranges", "none");
    out.set_header("Date", http_date());
  });
}

bool Engine::exchange(ClientSocket& socket, const Head& head, bool with_body,
                      std::chrono::milliseconds patience,
                      const std::function<Response(const BodyReader&)>& answer) {
  EngineStream stream(socket, plain_head(head, with_body), patience);
  const std::function<Response(const BodyReader&)> timed = [&](const BodyReader& reader) {
    Response response = answer(reader);
    stream.begin_answer();
    return response;
  };
  answer_ = &timed;
  bool client_closed = false;
  return process_request(stream, false, client_closed, {});
}

void Engine::send(Response response, httplib::Response& out) {
  close_ = response.close;
  out.status = response.status;
  for (const auto& [name, value] : response.headers) out.set_header(name, value);
  const std::uint64_t size = response.size();
  if (size == 0) return;
  const std::string content_type = response.content_type;
  auto kept = std::make_shared<const Response>(std::move(response));
  out.set_content_provider(size, content_type, [kept](size_t offset, size_t, httplib::DataSink& sink) {
    return send_part(kept->body, offset, sink);
  });
}

}  // namespace subdivd::server

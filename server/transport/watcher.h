#pragma once
// Knows every open connection and notices when a client leaves while its request is being worked on.
//
// A client that closes and one that only ends its sending side look the same (a FIN) until something is
// written, so the latter counts as gone too, as with nginx and Go's net/http.

#include <atomic>
#include <condition_variable>
#include <list>
#include <mutex>
#include <thread>

namespace subdivd::server {

class Watcher {
 public:
  Watcher();
  ~Watcher();  // every Entry must be gone
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;

  // Lists a connection as long as it lives. Must die before its descriptor is closed.
  class Entry {
   public:
    Entry(Watcher& watcher, int fd);
    ~Entry();
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

    void watch(bool on);  // while on, cancelled() turns true within 100 ms of the client's leaving
    const std::atomic<bool>& cancelled() const { return cancelled_; }

   private:
    friend class Watcher;
    void cut();

    Watcher& watcher_;
    const int fd_;
    bool watched_ = false;  // guarded by Watcher::mutex_
    std::atomic<bool> cancelled_ = false;
    std::list<Entry*>::iterator place_;
  };

  // Cancels all work and shuts every connection down, both ways, and those that still come.
  void cut_all();

 private:
  void run();
  void look();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Entry*> entries_;
  int watched_count_ = 0;
  bool ended_ = false, cut_ = false;
  std::thread thread_;
};

}  // namespace subdivd::server

#pragma once
// Notices, while a request is being answered, that its client has left.
//
// A client that closes and one that only ends its sending side, and waits for the answer, look the same: a
// FIN. They differ in what they do with bytes that come: a closed socket answers with a reset. So the watcher
// sends some that mean nothing, an interim response "100 Continue", which clients skip wherever it comes [RFC
// 9110, 15.2], and looks again. HTTP/1.0 knows no interim responses: there only a reset tells.

#include <poll.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

namespace subdivd::server {

class Watcher {
 public:
  Watcher();
  ~Watcher();  // every Post must be gone
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;

  // Where a thread hangs out the connection that it works on, one after the other.
  class Post {
   public:
    explicit Post(Watcher& watcher);
    ~Post();
    Post(const Post&) = delete;
    Post& operator=(const Post&) = delete;

    // The descriptor stays open until detach(). Cancelled until then means: by cut_all, or while watched.
    void attach(int fd);
    void detach();
    // From here to unwatch(), cancelled() turns true within 100 ms of the client's leaving. The watcher may
    // write to the connection meanwhile, if `may_probe`; when unwatch() has returned it does not.
    void watch(bool may_probe);
    void unwatch();
    const std::atomic<bool>& cancelled() const { return cancelled_; }

   private:
    friend class Watcher;
    void cut();

    Watcher& watcher_;
    std::list<Post*>::iterator place_;
    std::atomic<bool> cancelled_ = false;
    // Guarded by Watcher::mutex_.
    int fd_ = -1;
    bool watched_ = false, may_probe_ = false;
    std::chrono::steady_clock::time_point since_{};
  };

  // Cancels all work and shuts every connection down, both ways, and those that still come.
  void cut_all();

 private:
  void run();
  void look();
  static void probe(Post& post);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Post*> posts_;
  int watched_count_ = 0;
  bool ended_ = false, cut_ = false, asleep_ = false;
  std::vector<pollfd> polled_;  // with room for all posts: a look allocates nothing
  std::vector<Post*> asked_;
  std::thread thread_;
};

}  // namespace subdivd::server

#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace isojam {

/// Values made by several threads and handed out in the order of their indices, from a ring of slots: nobody makes one
/// that has no slot yet, so that few are in memory at once.
template <class Make>
class InOrder {
 public:
  using Value = decltype(std::declval<const Make&>()(std::size_t{}));

  InOrder(std::size_t count, const Make& make)
      : make_(make), count_(count), slots_(4 * std::max(1U, std::thread::hardware_concurrency())) {
    // The calling thread makes values too: a machine that has no further thread to give, or no memory for one, makes it
    // slower, not impossible. Nothing may be thrown from here once a thread waits, for it would wait for good.
    try {
      for (std::size_t k = 1; k < slots_.size() / 4; ++k) threads_.emplace_back([this] { work(); });
    } catch (const std::exception&) {
      return;
    }
  }
  ~InOrder() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
  }
  InOrder(const InOrder&) = delete;
  InOrder& operator=(const InOrder&) = delete;

  /// The next value; what `make` threw for it is thrown from here. nullopt after the last.
  std::optional<Value> next() {
    std::unique_lock lock(mutex_);
    if (used_ == count_) return std::nullopt;
    Slot& slot = slots_[used_ % slots_.size()];
    while (!slot.made) {
      if (room()) {
        make_next(lock);
      } else {
        changed_.wait(lock);
      }
    }
    Slot taken = std::exchange(slot, {});
    ++used_;
    changed_.notify_all();
    if (taken.error) std::rethrow_exception(taken.error);
    return std::move(taken.value);
  }

 private:
  struct Slot {
    std::optional<Value> value;
    std::exception_ptr error;
    bool made = false;
  };

  bool room() const { return begun_ < count_ && begun_ < used_ + slots_.size(); }

  void make_next(std::unique_lock<std::mutex>& lock) {
    const std::size_t index = begun_++;
    lock.unlock();
    Slot slot;
    try {
      slot.value.emplace(make_(index));
    } catch (...) {
      slot.error = std::current_exception();
    }
    slot.made = true;
    lock.lock();
    slots_[index % slots_.size()] = std::move(slot);
    changed_.notify_all();
  }

  void work() {
    std::unique_lock lock(mutex_);
    while (!stopped_ && begun_ < count_) {
      if (room()) {
        make_next(lock);
      } else {
        changed_.wait(lock);
      }
    }
  }

  const Make& make_;
  std::size_t count_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Slot> slots_;
  std::size_t begun_ = 0, used_ = 0;
  bool stopped_ = false;
  std::vector<std::jthread> threads_;  // last: they end before what they use does
};

/// Makes `count` values on all threads and gives them to `use` on the calling one, in the order of their indices; few
/// are in memory at once. An exception of `make` is thrown from here once all earlier values were used, so that the
/// failure of the lowest index is reported on any number of threads. An exception of `use` ends the loop too.
template <class Make, class Use>
void in_order(std::size_t count, const Make& make, const Use& use) {
  InOrder<Make> values(count, make);
  while (auto value = values.next()) use(*std::move(value));
}

}  // namespace isojam

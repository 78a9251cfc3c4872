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

/// Makes values with several threads and returns them in the order of their indices. Finished values wait in a ring of
/// slots. A value is made only when a slot is free, so that at most four values for each processor thread are in
/// memory.
template <class Make>
class InOrder {
 public:
  using Value = decltype(std::declval<const Make&>()(std::size_t{}));

  InOrder(std::size_t count, const Make& make)
      : make_(make), count_(count), slots_(4 * std::max(1U, std::thread::hardware_concurrency())) {
    // The calling thread makes values too. If the system cannot start another thread, the existing threads make all
    // values. After a thread has started, no exception may leave this constructor, because the destructor would not run
    // and the thread would wait forever.
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

  /// Returns the next value, or nullopt after the last one. If `make` threw an exception for this value, next() throws
  /// it.
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

  bool room() const { return started_ < count_ && started_ < used_ + slots_.size(); }

  void make_next(std::unique_lock<std::mutex>& lock) {
    const std::size_t index = started_++;
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
    while (!stopped_ && started_ < count_) {
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
  std::size_t started_ = 0, used_ = 0;
  bool stopped_ = false;
  // declared last, so that the threads end before the members that they use are destroyed
  std::vector<std::jthread> threads_;
};

/// Makes `count` values with all threads and passes them to `use` on the calling thread, in the order of their indices.
/// At most four values for each processor thread are in memory at the same time. If `make` throws an exception for a
/// value, it is thrown from here after `use` has received all earlier values. The exception is therefore that of the
/// lowest index, for any number of threads. If `use` throws an exception, the loop ends and the exception is thrown
/// from here.
template <class Make, class Use>
void in_order(std::size_t count, const Make& make, const Use& use) {
  InOrder<Make> values(count, make);
  while (auto value = values.next()) use(*std::move(value));
}

}  // namespace isojam

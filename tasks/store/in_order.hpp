#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

namespace isojam {

/// Makes `count` values on several threads and gives them to `use` on the calling one, in the order of their indices;
/// few are in memory at once. What `make` throws for the first index that fails is thrown from here, after all before
/// it were used: which of several failures is reported does not depend on who was first. What `use` throws ends it too.
/// A machine that has no further thread to give makes it slower, not impossible.
template <class Make, class Use>
void in_order(std::size_t count, const Make& make, const Use& use) {
  using Value = decltype(make(std::size_t{}));
  struct Slot {
    std::optional<Value> value;
    std::exception_ptr error;
    bool made = false;
  };
  const std::size_t workers = std::max(1U, std::thread::hardware_concurrency());
  std::vector<Slot> slots(4 * workers);
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t next = 0, used = 0;  // the first index that nobody makes, and that was not used
  bool stopped = false;

  const auto make_next = [&](std::unique_lock<std::mutex>& lock) {
    const std::size_t index = next++;
    lock.unlock();
    Slot slot;
    try {
      slot.value.emplace(make(index));
    } catch (...) {
      slot.error = std::current_exception();
    }
    slot.made = true;
    lock.lock();
    slots[index % slots.size()] = std::move(slot);
    changed.notify_all();
  };
  const auto room = [&] { return next < count && next < used + slots.size(); };
  const auto work = [&] {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [&] { return stopped || next >= count || room(); });
      if (stopped || next >= count) return;
      make_next(lock);
    }
  };

  std::vector<std::jthread> threads;
  const struct Stop {
    std::mutex& mutex;
    std::condition_variable& changed;
    bool& stopped;
    ~Stop() {
      const std::lock_guard lock(mutex);
      stopped = true;
      changed.notify_all();
    }
  } stop{mutex, changed, stopped};
  for (std::size_t k = 1; k < workers; ++k) {
    try {
      threads.emplace_back(work);
    } catch (const std::system_error&) {
      break;
    }
  }

  std::unique_lock lock(mutex);
  while (used < count) {
    Slot& slot = slots[used % slots.size()];
    if (!slot.made && room()) {
      make_next(lock);
      continue;
    }
    changed.wait(lock, [&] { return slot.made || room(); });
    if (!slot.made) continue;
    Slot taken = std::exchange(slot, {});
    lock.unlock();
    if (taken.error) std::rethrow_exception(taken.error);
    use(*taken.value);
    lock.lock();
    ++used;
    changed.notify_all();
  }
}

}  // namespace isojam

#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <thread>

namespace isojam {

/// Requests a stop after a given time, or when another stop token requests a stop.
class Deadline {
 public:
  Deadline(double seconds, const std::stop_token& outer);
  std::stop_token token() const { return source_.get_token(); }
  bool over() const { return source_.stop_requested(); }

 private:
  std::stop_source source_;
  std::stop_callback<std::function<void()>> on_outer_;
  std::jthread timer_;  // last, so that it ends before the members that it uses
};

}  // namespace isojam

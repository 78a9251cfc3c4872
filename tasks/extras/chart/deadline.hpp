#pragma once

#include <functional>
#include <stop_token>
#include <thread>

namespace isojam {

/// Requests a stop after a given time, or when the stop token `outer` requests a stop.
class Deadline {
 public:
  Deadline(double seconds, const std::stop_token& outer);
  std::stop_token token() const { return source_.get_token(); }
  bool over() const { return source_.stop_requested(); }

 private:
  std::stop_source source_;
  std::stop_callback<std::function<void()>> on_outer_;
  std::jthread timer_;  // declared last, so that its thread ends before the members that it uses are destroyed
};

}  // namespace isojam

#pragma once

#include <array>
#include <chrono>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/names/enum_names.hpp"

namespace isojam {

enum class Colour { automatic, always, never };
template <>
inline constexpr std::array enum_names<Colour>{EnumName{Colour::automatic, "auto"}, EnumName{Colour::always, "always"},
                                               EnumName{Colour::never, "never"}};

enum class MessageForm { text, json };
template <>
inline constexpr std::array enum_names<MessageForm>{EnumName{MessageForm::text, "text"},
                                                    EnumName{MessageForm::json, "json"}};

struct ConsoleOptions {
  bool quiet = false;    ///< print errors only
  bool verbose = false;  ///< also print a line for each replicate
  Colour colour = Colour::automatic;
  MessageForm form = MessageForm::text;
};

/// Additional members of a message in JSON, as pairs of a name and a text. Messages as text do not contain them.
using MessageParts = std::vector<std::pair<std::string_view, std::string_view>>;

/// Prints messages and progress to stderr. Several threads may use it at the same time.
class Console {
 public:
  explicit Console(const ConsoleOptions& options);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void error(std::string_view message, const MessageParts& parts = {});
  void warn(std::string_view message);
  void info(std::string_view message);
  void detail(std::string_view message);  ///< printed only if `verbose` is true

  /// Begins a round of `total` replicates. `work` is their total cost in any unit; the remaining time is estimated from
  /// it.
  void begin(int total, double work);
  /// Adds a replicate to the round.
  void add(double work);
  /// Counts a replicate as finished, with its cost in the same unit.
  void finished(double work, bool failed);
  /// Shows the progress of the round, or the text `what` before the first begin(). On a terminal it redraws a progress
  /// bar that is not wider than the terminal. Otherwise it prints a line with the progress and `what`. It does nothing
  /// if the last output was less than 0.1 s ago. For lines of text, this time is 5 s.
  void tick(std::string_view what);
  /// Ends the round: removes the progress bar, or prints the final progress as JSON.
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  void line(std::string_view kind, std::string_view style, std::string_view message, const MessageParts& parts = {});
  void put_progress(std::string_view text);
  void clear_bar();
  void show_bar(std::string_view what);
  std::string status() const;

  ConsoleOptions options_;
  bool terminal_, colour_, bar_shown_ = false;
  std::mutex mutex_;
  int total_ = 0, done_ = 0, failed_ = 0;
  double work_total_ = 0, work_done_ = 0;
  Clock::time_point started_, shown_;
};

/// Text of a duration, such as "1 h 02 min", "3 min 20 s" or "12 s".
std::string duration_text(double seconds);

/// Text of an approximate duration, such as "about 12 s" or "less than 1 s".
std::string about_text(double seconds);

}  // namespace isojam

#include "tasks/io/console.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tasks/io/standard_streams.hpp"

namespace isojam {
namespace {

constexpr auto bar_interval = std::chrono::milliseconds(100);
constexpr auto line_interval = std::chrono::seconds(5);
constexpr int bar_width = 24;
constexpr std::string_view red = "\033[1;31m", yellow = "\033[1;33m", plain, info_kind = "info";

/// Width of the terminal in characters. If it is unknown, a width that every terminal has.
std::size_t terminal_width() {
  constexpr std::size_t unknown = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : unknown;
}

bool uses_colour(Colour colour, bool terminal) {
  if (colour != Colour::automatic) return colour == Colour::always;
  const char* no_colour = std::getenv("NO_COLOR");
  return terminal && !(no_colour && *no_colour);
}

/// Writes a text whose control characters were already escaped.
void put(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// Prints a message as JSON. File names need not be UTF-8, which JSON requires, so invalid bytes are replaced.
void put_object(const nlohmann::ordered_json& message) {
  put(message.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
}

}  // namespace

Console::Console(const ConsoleOptions& options)
    : options_(options), terminal_(isatty(STDERR_FILENO) == 1), colour_(uses_colour(options.colour, terminal_)) {}

Console::~Console() { clear_bar(); }

void Console::error(std::string_view message, const MessageParts& parts) { line("error", red, message, parts); }
void Console::warn(std::string_view message) {
  if (!options_.quiet) line("warning", yellow, message);
}
void Console::info(std::string_view message) {
  if (!options_.quiet) line(info_kind, plain, message);
}
void Console::detail(std::string_view message) {
  if (options_.verbose && !options_.quiet) line(info_kind, plain, message);
}

void Console::begin(int total, double work) {
  const std::lock_guard lock(mutex_);
  total_ = total;
  done_ = failed_ = 0;
  work_total_ = work;
  work_done_ = 0;
  started_ = shown_ = Clock::now();
  if (options_.form == MessageForm::json && !options_.quiet) put_progress(status());
}

void Console::add(double work) {
  const std::lock_guard lock(mutex_);
  ++total_;
  work_total_ += work;
}

void Console::finished(double work, bool failed) {
  const std::lock_guard lock(mutex_);
  ++done_;
  failed_ += failed;
  work_done_ += work;
}

void Console::tick(std::string_view what) {
  if (options_.quiet) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  const bool often = terminal_ || options_.form == MessageForm::json;
  if (now - shown_ < (often ? Clock::duration(bar_interval) : Clock::duration(line_interval))) return;
  shown_ = now;
  const auto text = total_ ? fmt::format("{}; {}", status(), what) : std::string(what);
  if (options_.form == MessageForm::json) {
    put_progress(text);
  } else if (terminal_) {
    show_bar(what);
  } else {
    put(fmt::format("isojam: {}\n", printable(text)));
  }
}

void Console::put_progress(std::string_view text) {
  nlohmann::ordered_json message;
  message["kind"] = "progress";
  if (total_ > 0) message.update({{"done", done_}, {"total", total_}, {"failed", failed_}});
  message["text"] = text;
  put_object(message);
}

void Console::show_bar(std::string_view what) {
  const auto width = terminal_width();
  auto text = total_ > 0 ? status() : printable(what);
  // A text that is longer than a line could not be erased again. If it is too long, omit the bar, then shorten the
  // text.
  if (total_ > 0 && text.size() + bar_width + 3 < width) {
    const int filled = bar_width * std::min(done_, total_) / total_;
    text = fmt::format("[{}{}] {}", std::string(static_cast<std::size_t>(filled), '#'),
                       std::string(static_cast<std::size_t>(bar_width - filled), '.'), text);
  }
  put(fmt::format("\r\033[K{}", text.substr(0, width - 1)));
  bar_shown_ = true;
}

void Console::end() {
  const std::lock_guard lock(mutex_);
  clear_bar();
  if (options_.form == MessageForm::json && !options_.quiet && total_ > 0) put_progress(status());
}

void Console::line(std::string_view kind, std::string_view style, std::string_view message, const MessageParts& parts) {
  const std::lock_guard lock(mutex_);
  if (options_.form == MessageForm::json) {
    nlohmann::ordered_json whole;
    whole["kind"] = kind;
    whole["text"] = message;
    for (const auto& [name, part] : parts) whole[std::string(name)] = part;
    put_object(whole);
    return;
  }
  clear_bar();
  const bool styled = colour_ && !style.empty();
  const auto label = kind == info_kind ? "" : fmt::format("{}: ", kind);
  put(fmt::format("isojam: {}{}{}{}\n", styled ? style : plain, label, styled ? "\033[0m" : "", printable(message)));
}

void Console::clear_bar() {
  if (bar_shown_) put("\r\033[K");
  bar_shown_ = false;
}

std::string Console::status() const {
  auto text = fmt::format("{} of {} replicate{}", done_, total_, total_ == 1 ? "" : "s");
  if (failed_) text += fmt::format(", {} failed", failed_);
  if (work_done_ > 0 && work_done_ < work_total_ && done_ < total_) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - started_).count();
    text += fmt::format(", {} left", about_text(elapsed * (work_total_ - work_done_) / work_done_));
  }
  return text;
}

std::string duration_text(double seconds) {
  const auto s = std::lround(seconds);
  if (s >= 3600) return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
  if (s >= 60) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} s", s);
}

std::string about_text(double seconds) {
  return seconds < 0.5 ? "less than 1 s" : fmt::format("about {}", duration_text(seconds));
}

}  // namespace isojam

#include "tasks/io/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/texts.hpp"

namespace isojam {
namespace {

constexpr std::size_t deepest = 16;

struct LineColumn {
  std::size_t line, column;
};

LineColumn locate(std::string_view text, std::size_t position) {
  const auto before = text.substr(0, std::min(position, text.size()));
  const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const auto start = before.rfind('\n');
  return {line + 1, start == std::string_view::npos ? before.size() + 1 : before.size() - start};
}

/// True if the text begins like a comment in another language. JSON has no comments.
bool is_comment(std::string_view text) {
  return text.starts_with("//") || text.starts_with("/*") || text.starts_with('#');
}

/// The beginning of the word at this position.
std::string_view word_at(std::string_view text, std::size_t position) {
  constexpr std::string_view separators = " \t\r\n,:[]{}";
  constexpr std::size_t longest = 20;
  const auto before = position == 0 ? std::string_view::npos : text.find_last_of(separators, position - 1);
  const auto begin = before == std::string_view::npos ? 0 : before + 1;
  return text.substr(begin, std::min(text.find_first_of(separators, begin) - begin, longest));
}

struct Syntax {
  std::string problem, remedy;
};

/// Explains a syntax error at `position`. `message` is the text of nlohmann, and `closing` the bracket that closes the
/// innermost list or object.
Syntax explained(std::string_view text, std::size_t position, std::string_view message, char closing) {
  const auto has = [&](std::string_view part) { return message.find(part) != std::string_view::npos; };
  if (has("ill-formed UTF-8")) return {"the text is not valid UTF-8", "save the file in UTF-8"};
  if (has("unexpected end of input"))
    return {fmt::format("not valid JSON: the text ends, but a '{}' is missing", closing), "add it"};
  if (has("expected end of input"))
    return {"not valid JSON: the document ends before this place", "remove the text after its end"};
  if (has("invalid literal"))
    return {fmt::format("not valid JSON: \"{}\" is not a value", word_at(text, position)),
            "write a number, true, false, null, or a text in double quotes"};
  const auto bracket = text.substr(position, 1), before = text.substr(0, position);
  const auto last = before.find_last_not_of(" \t\r\n");
  if ((bracket == "}" || bracket == "]") && last != std::string_view::npos && before[last] == ',')
    return {fmt::format("not valid JSON: comma before '{}'", bracket), "remove the comma"};
  if (has("expected '}'") || has("expected ']'"))
    return {fmt::format("not valid JSON: ',' or '{}' is missing before this place", closing), "add it"};
  return {fmt::format("not valid JSON: {}", message), "check the commas, brackets and double quotes before this place"};
}

/// Makes the document. Unlike nlohmann's own builder, it reports duplicate keys and deep nesting, and states the
/// position of an error. Its time is in proportion to the number of keys.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Json take() { return std::move(document_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(false); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    auto& level = levels_.back();
    level.step = name;
    if (!level.keys.insert(name).second) refuse(file_, "duplicate key", "", "give each key once");
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) override {
    const auto start = std::min(position == 0 ? 0 : position - 1, text_.size());
    const auto at = locate(text_, start);
    const auto file = fmt::format("{}:{}:{}", file_, at.line, at.column);
    if (error.id == 406) {
      if (!levels_.empty() && levels_.back().array) levels_.back().step = std::to_string(levels_.back().size);
      refuse(file, fmt::format("{} is too large", token), "a number below 1.8e308");
    }
    const std::string_view what = error.what();
    const bool in_string = what.find("invalid string") != std::string_view::npos;
    if (!in_string && is_comment(text_.substr(start))) refuse(file, "JSON has no comments", "", "remove the comment");
    const auto detail = what.rfind(" - ");
    auto syntax = explained(text_, start, detail == std::string_view::npos ? what : what.substr(detail + 3),
                            !levels_.empty() && levels_.back().array ? ']' : '}');
    refuse(file, std::move(syntax.problem), "", std::move(syntax.remedy));
  }

 private:
  struct Level {
    bool array = false;
    std::size_t size = 0;
    std::string step;
    std::set<std::string> keys;
    Json* value = nullptr;  ///< the list or the object
  };

  [[noreturn]] void refuse(const std::string& file, std::string problem, std::string allowed,
                           std::string remedy = "") const {
    std::string pointer;
    for (const auto& level : levels_) {
      if (!level.step.empty()) pointer += pointer_step(level.step);
    }
    throw InputError({file, pointer, std::move(problem), std::move(allowed), "", std::move(remedy)});
  }

  /// Adds a value to the innermost list or object.
  bool add(Json value) {
    if (levels_.empty()) {
      document_ = std::move(value);
      added_ = &document_;
    } else if (auto& level = levels_.back(); level.array) {
      level.step = std::to_string(level.size++);
      added_ = &level.value->emplace_back(std::move(value));
    } else {
      // The key is new, so it need not be compared with the other keys again.
      added_ = &level.value->get_ref<Json::object_t&>().emplace_back(level.step, std::move(value)).second;
    }
    return true;
  }

  bool open(bool array) {
    add(array ? Json::array() : Json::object());
    if (levels_.size() == deepest)
      refuse(file_, std::string(nested_too_deeply), fmt::format("at most {} levels", deepest));
    levels_.push_back({array, 0, "", {}, added_});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  std::vector<Level> levels_;
  Json document_;
  Json* added_ = nullptr;  ///< the last value that was added
};

}  // namespace

Json parse_json(std::string_view text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw InputError({file, "", "the file is empty", "a JSON document", ""});
  }
  Builder builder(text, file);
  Json::sax_parse(text, &builder);
  return builder.take();
}

Json read_json(const std::string& file) { return parse_json(read_text(file), file); }

}  // namespace isojam

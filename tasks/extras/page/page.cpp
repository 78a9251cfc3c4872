#include "tasks/extras/page/page.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>
#include <vector>

namespace isojam {
namespace {

using Kind = PagePart::Kind;
using Parts = std::vector<PagePart>;

std::string joined(const Parts& parts, Kind kind) {
  std::string text;
  for (const auto& part : parts) {
    if (part.kind == kind) text += part.text;
  }
  return text;
}

std::string modules(const Parts& parts) {
  std::string text = "<script>\nconst modules = {};\n";
  for (const auto& part : parts) {
    if (part.kind != Kind::module) continue;
    text += fmt::format("modules[\"{}\"] = (exports, module, require, define) => {{\n", part.name);
    text += part.text;
    text += "\n};\n";
  }
  return text + "</script>\n";
}

std::string scripts(const Parts& parts) {
  std::string text;
  for (const auto& part : parts) {
    if (part.kind != Kind::script && part.kind != Kind::constant) continue;
    text += "<script>\n";
    if (part.kind == Kind::constant) text += fmt::format("const {} =\n", part.name);
    text += part.text;
    text += "\n</script>\n";
  }
  return text;
}

/// JSON in which "<" is escaped, so that it cannot end the HTML element that contains it.
std::string embedded(std::string_view data) {
  std::string text;
  text.reserve(data.size());
  for (const char c : data) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string page_text(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string assembled_page(std::span<const PagePart> own, std::string_view data) {
  const auto common = common_parts();
  Parts parts(common.begin(), common.end());
  parts.insert(parts.end(), own.begin(), own.end());
  const std::pair<std::string_view, std::string> places[] = {{"@notices@", joined(parts, Kind::notice)},
                                                             {"@style@", joined(parts, Kind::style)},
                                                             {"@modules@", modules(parts)},
                                                             {"@data@", embedded(data)},
                                                             {"@scripts@", scripts(parts)}};
  const auto frame = joined(parts, Kind::frame);
  std::string page;
  std::size_t done = 0;
  // The places were found in the original text and are in order. Inserted text is not searched again.
  for (const auto& [place, text] : places) {
    const auto at = frame.find(place, done);
    assert(at != std::string::npos);
    page.append(frame, done, at - done);
    page += text;
    done = at + place.size();
  }
  return page.append(frame, done);
}

}  // namespace isojam

#include "tasks/packings/content_error.hpp"

#include <fmt/format.h>

#include "tasks/io/file.hpp"

namespace isojam {

void refuse_content(const JsonPlace& place, const std::string& path, const ContentError& error,
                    std::string_view allowed) {
  const auto problem = error.line() == 0 ? fmt::format("{}: {}", path, error.what())
                                         : fmt::format("{}:{}: {}", path, error.line(), error.what());
  if (error.remedy().empty()) place.refuse(problem, std::string(allowed));
  place.refuse_with_remedy(problem, error.remedy());
}

std::string read_named_file(const JsonPlace& place, const std::string& path, std::string_view allowed) {
  try {
    return read_file(path);
  } catch (const FileError& error) {
    if (error.reason() == FileError::Reason::resource_failure) throw;
    if (place.value().is_string() && place.value().get<std::string>().starts_with('~'))
      place.refuse_with_remedy(
          fmt::format("{}: ~ is not the home folder here, because only the shell replaces it", error.what()),
          "write the path of the home folder, or a path relative to the manifest");
    place.refuse(error.what(), std::string(allowed));
  }
}

}  // namespace isojam

#include "tasks/system/file.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace isojam {

std::string read_text(const std::string& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw FileError(file + ": is a directory, not a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file + ": cannot be opened for reading");
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) throw FileError(file + ": cannot be read");
  return std::move(text).str();
}

}  // namespace isojam

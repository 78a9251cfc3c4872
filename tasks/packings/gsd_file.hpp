#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/packings/content_error.hpp"
#include "tasks/packings/gsd_layer.hpp"

namespace isojam {

/// A GSD file of any program, with version 1 or 2 of the file layer. It contains chunks of data, which are identified
/// by their frame and name. All contents are checked.
class GsdFile {
 public:
  /// Throws ContentError if the bytes are not a GSD file.
  explicit GsdFile(std::string bytes);

  std::uint64_t frames() const { return frames_; }
  const std::string& schema() const { return schema_; }
  /// The numbers of a chunk, row by row; they may have any type. If the frame does not contain the chunk, the chunk of
  /// frame 0 is returned; nullopt if that does not exist either. Throws ContentError if the chunk has a different
  /// number of columns, or a number that is not finite.
  std::optional<std::vector<double>> numbers(std::uint64_t frame, std::string_view name, std::uint32_t columns) const;
  /// The rows of a chunk that contains text.
  std::optional<std::vector<std::string>> texts(std::uint64_t frame, std::string_view name) const;

 private:
  struct Entry {
    std::uint64_t rows = 0, location = 0;
    std::uint32_t columns = 0;
    std::uint8_t type = 0;
  };
  void read_index(std::uint64_t location, std::uint64_t entries, const std::vector<std::string>& names);
  const Entry* find(std::uint64_t frame, std::string_view name) const;
  std::string_view data(const Entry& entry, std::string_view name) const;

  std::string bytes_, schema_;
  std::uint64_t frames_ = 0;
  std::map<std::pair<std::uint64_t, std::string>, Entry, std::less<>> entries_;
};

}  // namespace isojam

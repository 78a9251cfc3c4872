#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/packings/gsd_layer.hpp"

namespace isojam {

/// The file contains no packing in a readable format. what() gives the reason.
class NoPackingFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A GSD file, layer version 1 or 2, written by any program: chunks by frame and name. All contents are checked.
class GsdFile {
 public:
  /// Throws NoPackingFile if this is no GSD file.
  explicit GsdFile(std::string bytes);

  std::uint64_t frames() const { return frames_; }
  const std::string& schema() const { return schema_; }
  /// Numbers of a chunk by rows, of any type. If the frame lacks the chunk, that of frame 0; nullopt if both lack it.
  /// Throws NoPackingFile if it has a different number of columns.
  std::optional<std::vector<double>> numbers(std::uint64_t frame, std::string_view name, std::uint32_t columns) const;
  /// Rows of text.
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

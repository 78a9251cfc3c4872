#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tasks/json/json.hpp"

namespace isojam {

/// The record that a packing or a path belongs to, as these files say in their heads: one that is whole but of another
/// replicate, or of another run of this one, is told from its own.
struct Owner {
  std::string replicate;  ///< name
  std::string manifest_digest, result_digest;
};

/// The head of a packing or path, before what it holds.
Json companion(std::string_view schema, const Owner& owner);

/// Reads as much of the file as it takes. Throws FileError if it is not there or cannot be read now, InputError if it
/// is damaged, of another schema or belongs to another record. `owners`: the record as it is, and before that as it was
/// until something was added to it.
void check_companion(const std::string& file, std::string_view schema, std::span<const Owner> owners);

/// Reads it all, with the same checks.
Json read_companion(const std::string& file, std::string_view schema, std::span<const Owner> owners);

}  // namespace isojam

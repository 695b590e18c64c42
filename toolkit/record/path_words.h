// toolkit/record/path_words.h: paths within texts, for their removal.
#pragma once

#include <functional>
#include <string>

namespace softscope {

/// The text with each part that looks like a path or a file replaced by what `instead` makes of it.
/// Names may hold blanks: what stands before the colon of "Jane Doe.ply: is empty" is one name, and
/// so is an absolute path up to its last part. Where a name's end can't be known, more is taken
/// rather than less. Units (mm/s) and the files that softscope itself names (model.ply) stay.
std::string replacePaths(const std::string& text,
                         const std::function<std::string(const std::string&)>& instead);

/// Absolute paths become their last part, those in `folder` become relative to it.
std::string withoutFolders(std::string text, const std::string& folder);

}  // namespace softscope

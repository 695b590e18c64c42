// toolkit/record/path_words.h: removal of paths from texts.
#pragma once

#include <functional>
#include <string>

namespace softscope {

/// Replaces each part of a text that resembles a path or file by the result of `instead`.
/// Names may contain blanks: the text before the colon of "Jane Doe.ply: is empty" is one
/// name, and so is an absolute path up to its last part. If the end of a name is ambiguous,
/// the longer part is replaced. Units (mm/s) and file names of softscope (model.ply) are kept.
std::string replacePaths(const std::string& text,
                         const std::function<std::string(const std::string&)>& instead);

/// Absolute paths become their last part, paths in `folder` become relative to it.
std::string withoutFolders(std::string text, const std::string& folder);

}  // namespace softscope

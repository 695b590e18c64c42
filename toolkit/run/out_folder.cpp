#include "toolkit/run/out_folder.h"

#include <algorithm>

#include "core/error.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// Without links and dots; for a missing path, of its existing part.
fs::path canonicalPath(const fs::path& path) {
  std::error_code problem;
  const fs::path found = fs::weakly_canonical(fs::absolute(path), problem);
  const fs::path plain = problem ? path.lexically_normal() : found;
  return plain.has_filename() ? plain : plain.parent_path();
}

bool isInside(const fs::path& path, const fs::path& folder) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end();
}

[[noreturn]] void refuseInput(const fs::path& out, const char* what) {
  throw OptionError("`out=` " + out.string() + ": " + what +
                    "; choose a separate folder for the results");
}

}  // namespace

void makeFolder(const fs::path& out) {
  std::error_code failure;
  fs::create_directories(out, failure);
  if (failure)
    throw InputError("`out=` " + shown(out) + ": can't be made: " + failure.message() +
                     ". Choose a folder that you may write to");
}

void requireApart(const fs::path& out, const SequencePaths& sequence) {
  std::error_code ignored;
  for (const fs::path& part :
       {sequence.left, sequence.right, sequence.stereo, sequence.mask, sequence.depth})
    if (!part.empty() && fs::is_directory(part, ignored) &&
        isInside(canonicalPath(out), canonicalPath(part)))
      refuseInput(out,
                  "is, or is inside, a folder of the sequence, whose frames would be mixed with "
                  "the results");
}

void requireOutside(const fs::path& out, const SequencePaths& sequence) {
  requireApart(out, sequence);
  const fs::path& view = !sequence.left.empty()     ? sequence.left
                         : !sequence.stereo.empty() ? sequence.stereo
                                                    : sequence.depth;
  if (canonicalPath(out) == canonicalPath(view).parent_path())
    refuseInput(out, "is the folder of the sequence, whose own files would be replaced");
}

}  // namespace softscope

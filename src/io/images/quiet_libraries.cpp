#include "io/images/quiet_libraries.h"

#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>

namespace softscope {

std::FILE* ownErrors() {
  static std::FILE* const own = stderr;
  return own;
}

void quietLibraries() {
  namespace logging = cv::utils::logging;
  if (std::getenv("OPENCV_LOG_LEVEL") == nullptr) {
    logging::setLogLevel(logging::LOG_LEVEL_SILENT);
    static std::FILE* const nowhere = std::fopen("/dev/null", "we");
    ownErrors();
    if (nowhere != nullptr) stderr = nowhere;  // the C library allows assignment
  }
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", /*overwrite=*/0);  // AV_LOG_QUIET; read at the first video
}

}  // namespace softscope

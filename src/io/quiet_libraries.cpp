#include "io/quiet_libraries.h"

#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>

namespace softscope {

void quietLibraries() {
  namespace logging = cv::utils::logging;
  if (std::getenv("OPENCV_LOG_LEVEL") == nullptr) logging::setLogLevel(logging::LOG_LEVEL_SILENT);
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", /*overwrite=*/0);  // AV_LOG_QUIET; read at the first video
}

}  // namespace softscope

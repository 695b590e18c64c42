// apps/log.cpp: spdlog, set up once.
#include "apps/log.h"

#include <spdlog/sinks/ansicolor_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "io/quiet_libraries.h"

namespace softscope {

bool stderrIsTerminal() { return isatty(STDERR_FILENO) == 1; }

void setUpLog(const CommonOptions& common) {
  using Sink = spdlog::sinks::ansicolor_sink<spdlog::details::console_mutex>;
  auto logger = std::make_shared<spdlog::logger>(
      "softscope", std::make_shared<Sink>(ownErrors(), spdlog::color_mode::automatic));
  const std::string clear_line = stderrIsTerminal() ? "\r\033[K" : "";
  logger->set_pattern(clear_line + "%^%l%$: %v");
  logger->set_level(common.quiet     ? spdlog::level::warn
                    : common.verbose ? spdlog::level::debug
                                     : spdlog::level::info);
  logger->flush_on(spdlog::level::debug);
  spdlog::set_default_logger(logger);
}

}  // namespace softscope

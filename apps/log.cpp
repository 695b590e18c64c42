// apps/log.cpp: spdlog, set up once.
#include "apps/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/ansicolor_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "io/images/quiet_libraries.h"
#include "io/text/message.h"

namespace softscope {
namespace {

/// The text of a message; names of files and texts from them can't command the terminal.
class PrintableText : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/,
              spdlog::memory_buf_t& out) override {
    const std::string text = printable({message.payload.data(), message.payload.size()});
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<PrintableText>();
  }
};

}  // namespace

bool stderrIsTerminal() { return isatty(STDERR_FILENO) == 1; }

void setUpLog(const CommonOptions& common) {
  using Sink = spdlog::sinks::ansicolor_sink<spdlog::details::console_mutex>;
  auto logger = std::make_shared<spdlog::logger>(
      "softscope", std::make_shared<Sink>(ownErrors(), spdlog::color_mode::automatic));
  const std::string clear_line = stderrIsTerminal() ? "\r\033[K" : "";
  auto lines = std::make_unique<spdlog::pattern_formatter>();
  lines->add_flag<PrintableText>('*').set_pattern(clear_line + "%^%l%$: %*");
  logger->set_formatter(std::move(lines));
  logger->set_level(common.quiet     ? spdlog::level::warn
                    : common.verbose ? spdlog::level::debug
                                     : spdlog::level::info);
  logger->flush_on(spdlog::level::debug);
  spdlog::set_default_logger(logger);
}

}  // namespace softscope

// apps/log.cpp: configuration of spdlog.
#include "apps/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/ansicolor_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdlib>

#include "apps/option_names.h"
#include "io/images/quiet_libraries.h"
#include "io/text/message.h"

namespace softscope {
namespace {

/// Text of a message with option names for settings; control characters
/// in it are replaced, so that they do not reach the terminal.
class PrintableText : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/,
              spdlog::memory_buf_t& out) override {
    const std::string text =
        printable(withOptions({message.payload.data(), message.payload.size()}));
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<PrintableText>();
  }
};

/// NO_COLOR: environment variable, https://no-color.org.
spdlog::color_mode colorMode(const std::string& color) {
  const char* no_color = std::getenv("NO_COLOR");
  if (color == "always") return spdlog::color_mode::always;
  if (color == "never" || (no_color != nullptr && *no_color != '\0'))
    return spdlog::color_mode::never;
  return spdlog::color_mode::automatic;
}

}  // namespace

bool stderrIsTerminal() { return isatty(STDERR_FILENO) == 1; }

void setUpLog(const CommonOptions& common) {
  using Sink = spdlog::sinks::ansicolor_sink<spdlog::details::console_mutex>;
  auto logger = std::make_shared<spdlog::logger>(
      "softscope", std::make_shared<Sink>(ownErrors(), colorMode(common.color)));
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

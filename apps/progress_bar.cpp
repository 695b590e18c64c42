// apps/progress_bar.cpp: "depth [=====>     ] 12/63, 3.1/s, 0:16 left".
#include "apps/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "apps/log.h"

namespace softscope {
namespace {

constexpr int kBarCells = 24;
constexpr double kTerminalPause_s = 0.1, kPlainPause_s = 10;

std::string duration(double seconds) {
  const long whole = std::lround(std::max(0.0, seconds));
  char text[64];
  if (whole >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}

}  // namespace

ProgressBar::ProgressBar(std::string what, int total, Style style, std::ostream& out,
                         std::function<Clock::time_point()> now)
    : what_(std::move(what)),
      total_(total),
      style_(style),
      out_(out),
      now_(std::move(now)),
      start_(now_()),
      last_shown_(start_) {
  if (style_ == Style::kTerminal) show();
}

ProgressBar::~ProgressBar() {
  if (style_ == Style::kSilent) return;
  if (done_ != shown_) show();
  if (style_ == Style::kTerminal) out_ << "\n" << std::flush;
}

void ProgressBar::advance() {
  ++done_;
  const double pause_s = style_ == Style::kTerminal ? kTerminalPause_s : kPlainPause_s;
  if (style_ != Style::kSilent && secondsSince(last_shown_) >= pause_s) show();
}

double ProgressBar::secondsSince(Clock::time_point start) const {
  return std::chrono::duration<double>(now_() - start).count();
}

void ProgressBar::show() {
  last_shown_ = now_();
  shown_ = done_;
  if (style_ == Style::kTerminal)
    out_ << "\r\033[K" << line() << std::flush;
  else
    out_ << line() << "\n" << std::flush;
}

std::string ProgressBar::bar() const {
  const int full = std::min(kBarCells, kBarCells * done_ / total_);
  return "[" + std::string(std::size_t(full), '=') +
         std::string(std::size_t(kBarCells - full), ' ') + "] ";
}

std::string ProgressBar::line() const {
  const double elapsed_s = secondsSince(start_);
  const double rate = elapsed_s > 0 ? done_ / elapsed_s : 0;
  std::string text = what_ + " ";
  if (total_ > 0 && style_ == Style::kTerminal) text += bar();
  text += std::to_string(done_);
  if (total_ > 0) text += "/" + std::to_string(total_);
  char speed[32];
  std::snprintf(speed, sizeof speed, ", %.1f/s", rate);
  if (done_ > 0) text += speed;
  if (total_ > 0 && done_ >= total_) return text + ", took " + duration(elapsed_s);
  if (total_ > 0 && rate > 0) text += ", " + duration((total_ - done_) / rate) + " left";
  return text;
}

ProgressBar::Style progressStyle(bool quiet) {
  if (quiet) return ProgressBar::Style::kSilent;
  return stderrIsTerminal() ? ProgressBar::Style::kTerminal : ProgressBar::Style::kPlain;
}

}  // namespace softscope

// tests/apps/forked_program.h: softscope without its start.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace softscope::test {

/// Runs `softscope words` to its end in a process of its own: everything but main(), in a fork of a
/// process that was set aside before the first test, loaded and with no thread but its first. So it
/// begins at once, where the dynamic linker takes 0.2 s to load 270 libraries (1 s under
/// sanitizers). The environment is the test's but for DISPLAY. Returns what waitpid() says.
int runForked(const std::vector<std::string>& words, const std::filesystem::path& out_file,
              const std::filesystem::path& err_file);

}  // namespace softscope::test

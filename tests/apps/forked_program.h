// tests/apps/forked_program.h: softscope without its start.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace softscope::test {

/// Runs `softscope words` in a separate process: everything but main(), in a fork of a process
/// that was created before the first test, loaded and with a single thread. It therefore
/// starts at once; the dynamic linker needs 0.2 s to load 270 libraries (1 s with sanitizers).
/// The environment is that of the test except DISPLAY. Returns the status of waitpid().
int runForked(const std::vector<std::string>& words, const std::filesystem::path& out_file,
              const std::filesystem::path& err_file);

}  // namespace softscope::test

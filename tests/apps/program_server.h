// tests/apps/program_server.h: softscope without its start.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace softscope::test {

/// Runs `softscope words` in a separate process: everything but main(), in a process that stays
/// for the next call, as a program does that calls softscope's functions. It starts at once; the
/// dynamic linker needs 0.2 s to load 270 libraries (1 s with sanitizers). It ends with the tests,
/// and fails them if it leaked memory; after a crash the next call gets a new process.
/// The environment is that of the test except DISPLAY. Returns a status as waitpid() does.
int runOnServer(const std::vector<std::string>& words, const std::filesystem::path& out_file,
                const std::filesystem::path& err_file);

}  // namespace softscope::test

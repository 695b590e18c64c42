// src/core/guarded_read.h: file readers of other libraries, run in a child process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace softscope {

/// Throws InputError if `file` is missing, a folder, a
/// pipe or a device: opening a pipe waits for its writer.
void requireRegularFile(const std::filesystem::path& file);

/// Additions to the limits of the input.
struct GuardAllowance {
  int seconds = 0;  // of processor time
  std::uintmax_t memory_bytes = 0;
};

/// Runs `read` in a child process with limits and returns the bytes that it returns. Readers of
/// other libraries crash or hang on some damaged files: the child's death is an InputError that
/// names `source`, what the library prints goes nowhere, and an Error that `read` throws is thrown
/// here again. Limits: processor time of 10 s and 1 s per MB of input, twice that on the clock, and
/// memory of 2 GiB and 16 times the input beyond what this process has, and what `allowance` adds.
/// `read` must not share work among threads: the child has only its own.
std::string guardedRead(const std::string& source, std::uintmax_t input_bytes,
                        const std::function<std::string()>& read,
                        const GuardAllowance& allowance = {});

/// True in the child of guardedRead() only.
bool insideGuardedRead();

}  // namespace softscope

// src/core/background_work.h: parallel loops that give way to others.
#pragma once

#include <functional>

namespace softscope {

/// Calls `work` on this thread; its loops (core/parallel.h) get those threads that no other loop
/// asks for. Same results.
void runInBackground(const std::function<void()>& work);

}  // namespace softscope

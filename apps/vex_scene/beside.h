// Work that does not look whether it is interrupted, on a thread beside the one that does.
#pragma once

#include <chrono>
#include <functional>

namespace vex {

/// Does `work` on a thread of its own, which no signal reaches, nor the threads that it starts; calls `meanwhile` every
/// twentieth of a second. Rethrows what `work` throws. False where the program was interrupted first (interrupt.h,
/// which must be catching): the work then may go on, and whoever called ends the program with what it wants to say, by
/// std::_Exit, so that nothing the work uses is destroyed before. `grace`: so long an interrupt waits for work that
/// looks at the signal itself.
bool done_before_an_interrupt(const std::function<void()>& work, const std::function<void()>& meanwhile,
                              std::chrono::milliseconds grace = {});

}  // namespace vex

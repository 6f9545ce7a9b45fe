#pragma once

#include <cstdint>
#include <functional>

namespace seam {

/// Does work(0) … work(count − 1), each once, on several threads; in which order and by which thread is open. Whatever
/// the work throws first ends it: nothing more is begun, and it is thrown again when all threads have ended.
/// @param jobs  threads, the calling one included, ≥ 1
void for_each_index(std::int64_t count, int jobs, const std::function<void(std::int64_t)>& work);

}  // namespace seam

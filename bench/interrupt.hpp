#pragma once

namespace seam {

/// From now on SIGINT, SIGTERM and SIGHUP end the process as ever, but what it has not finished to write is removed first. To
/// be called before there are other threads.
void clear_up_when_interrupted();

}  // namespace seam

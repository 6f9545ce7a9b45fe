#pragma once

/// Stands before the name of the namespace in public headers: what they declare is offered by the shared libraries, and
/// everything else in them is hidden.
#if defined(__GNUC__)
#define SEAM_API [[gnu::visibility("default")]]
#else
#define SEAM_API
#endif

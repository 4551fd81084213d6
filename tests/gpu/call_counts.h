#pragma once

#include <map>
#include <string>

namespace rowland::test {

/// Calls of OpenGL, counted between the program and the driver while one of these lives. One at a time, on a thread
/// whose context is current.
class CallCounts {
 public:
    struct Counts {
        int draws = 0;
        int waits = 0;                          ///< calls that may wait for the GPU
        int made = 0;                           ///< buffers, textures, framebuffers, vertex arrays
        int compiled = 0;                       ///< shaders compiled and programs linked
        int copied = 0;                         ///< calls that copy into buffers and textures
        int set = 0;                            ///< calls that set state, bind an object or set a uniform
        int redundant = 0;                      ///< of these, those that set what was set
        std::map<std::string, int> which = {};  ///< names of those that are not draws, or redundant
    };

    CallCounts();
    ~CallCounts();
    CallCounts(const CallCounts&) = delete;
    CallCounts& operator=(const CallCounts&) = delete;

    /// Since the last call.
    Counts take();
};

}  // namespace rowland::test

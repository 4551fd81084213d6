#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rowland::test {

/// All that goes to the GPU while one of these lives, as the driver is told: it stands between the program and OpenGL.
/// One at a time, on a thread whose context is current.
class UploadLog {
 public:
    UploadLog();
    ~UploadLog();
    UploadLog(const UploadLog&) = delete;
    UploadLog& operator=(const UploadLog&) = delete;

    /// Bytes of buffers and texels.
    std::size_t bytes() const;
    /// Sources of the shaders that were compiled.
    const std::vector<std::string>& shaders() const;
};

}  // namespace rowland::test

#pragma once

#include <epoxy/gl.h>

#include <memory>
#include <type_traits>

namespace rowland::gpu {

/// A point in the GPU's work: after all commands so far.
class Fence {
 public:
    Fence();

    /// Whether the GPU is past it. Does not wait.
    bool passed() const;
    /// Waits until the GPU is past it.
    void wait() const;

 private:
    struct Release {
        void operator()(GLsync sync) const;
    };
    std::unique_ptr<std::remove_pointer_t<GLsync>, Release> sync_;
};

}  // namespace rowland::gpu

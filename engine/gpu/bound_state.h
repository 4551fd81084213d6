#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <map>
#include <utility>

namespace rowland::gpu {

/// What is set in a context, so that nothing is set twice.
class BoundState {
 public:
    enum class Slot {
        Program,
        Texture,
        UniformBuffer,
        StorageBuffer,
        VertexArray,
        Framebuffer,
        Viewport,
        Capability,
        DepthWrite,
        DepthFunction,
        CulledFace,
        FrontFace,
        BlendFactors,
        SlopeBias,
        Scissor,
        ColourMask,
    };
    /// Of an object its name first.
    using Value = std::array<std::int64_t, 4>;

    /// Whether the slot may hold another value than this. Then the caller sets it, and it counts as set.
    bool changes(Slot slot, unsigned index, const Value& value);
    /// To be called when an object is deleted: OpenGL unbinds it, and may give its name to a new one.
    void forget(Slot slot, GLuint name);
    void forget_all() { values_.clear(); }

 private:
    std::map<std::pair<Slot, unsigned>, Value> values_;  ///< those that are known
};

/// That of the current context. One per thread, as a thread has one current context.
BoundState& bound_state();

/// To be called when another context becomes current (platform::HeadlessContext and platform::Window do) and after
/// state was set by other means than rowland::gpu.
void forget_bound_state();

}  // namespace rowland::gpu

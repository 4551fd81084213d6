#pragma once

#include <epoxy/gl.h>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace rowland::gpu {

/// The state that is known to be set in a context, so that redundant calls are skipped.
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
    /// The first number is the name where the slot holds an object.
    using Value = std::array<std::int64_t, 4>;

    /// Whether the slot may hold another value. If so, `value` is recorded, and the caller must set it.
    bool changes(Slot slot, unsigned index, const Value& value);
    /// To be called when an object is deleted: OpenGL unbinds it, and may give its name to a new one.
    void forget(Slot slot, GLuint name);
    void forget_all() { values_.clear(); }

 private:
    std::map<std::pair<Slot, unsigned>, Value> values_;  ///< those that are known
};

/// The state of the current context. There is one per thread, as a thread has one current context.
BoundState& bound_state();

/// To be called when another context becomes current (platform::HeadlessContext and platform::Window do) and after
/// state was set by other means than rowland::gpu.
void forget_bound_state();

enum class DepthTest { Off, Less, LessEqual, Equal };
enum class Cull { None, Back, Front };
/// Add: source + target, whose alpha stays. AddOver: source·alpha + target, likewise. Over: source·alpha + target·(1 −
/// alpha). Premultiplied: source + target·(1 − alpha). Filter: source + target·second output (index 1), each component
/// by itself.
enum class Blend { Off, Add, AddOver, Over, Premultiplied, Filter };

enum class FrontFace { CounterClockwise, Clockwise };

/// The pixels that a draw may change, from the lower left of the target.
struct Scissor {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    friend bool operator==(const Scissor&, const Scissor&) = default;
};

/// All fixed-function state a draw depends on.
struct PipelineState {
    DepthTest depth_test = DepthTest::Less;
    bool depth_write = true;
    Cull cull = Cull::Back;
    Blend blend = Blend::Off;
    FrontFace front = FrontFace::CounterClockwise;  ///< clockwise behind a mirroring transform
    float slope_bias = 0.0F;  ///< for shadow maps: depth added, in units of the surface's depth slope per pixel
    std::optional<Scissor> scissor = std::nullopt;  ///< none: the whole target

    friend bool operator==(const PipelineState&, const PipelineState&) = default;
};

void apply(const PipelineState& state);

/// Sets PipelineState::depth_write alone. Clears of depth depend on it as well.
void set_depth_write(bool on);

}  // namespace rowland::gpu

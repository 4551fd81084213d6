#pragma once

#include <optional>

namespace rowland::gpu {

enum class DepthTest { Off, Less, LessEqual, Equal };
enum class Cull { None, Back, Front };
/// Add: source + target. Over: source·alpha + target·(1 − alpha). Premultiplied: source + target·(1 − alpha).
/// Filter: source + target·second output (index 1), each component by itself.
enum class Blend { Off, Add, Over, Premultiplied, Filter };

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
    float slope_bias = 0.0F;  ///< depth added for each depth step of the surface from pixel to pixel: shadow maps
    std::optional<Scissor> scissor = std::nullopt;  ///< none: the whole target

    friend bool operator==(const PipelineState&, const PipelineState&) = default;
};

void apply(const PipelineState& state);

/// That part of it alone, which clears obey as well.
void set_depth_write(bool on);

}  // namespace rowland::gpu

#pragma once

namespace rowland::gpu {

enum class DepthTest { Off, Less, LessEqual, Equal };
enum class Cull { None, Back, Front };
/// Add: source + target. Over: source·alpha + target·(1 − alpha). Premultiplied: source + target·(1 − alpha).
enum class Blend { Off, Add, Over, Premultiplied };

enum class FrontFace { CounterClockwise, Clockwise };

/// All fixed-function state a draw depends on.
struct PipelineState {
    DepthTest depth_test = DepthTest::Less;
    bool depth_write = true;
    Cull cull = Cull::Back;
    Blend blend = Blend::Off;
    FrontFace front = FrontFace::CounterClockwise;  ///< clockwise behind a mirroring transform
    float slope_bias = 0.0F;  ///< depth added for each depth step of the surface from pixel to pixel: shadow maps

    friend bool operator==(const PipelineState&, const PipelineState&) = default;
};

/// Sets all of it, whatever was set before.
void apply(const PipelineState& state);

}  // namespace rowland::gpu

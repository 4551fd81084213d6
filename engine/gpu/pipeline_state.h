#pragma once

namespace rowland::gpu {

enum class DepthTest { Off, Less, LessEqual, Equal };
enum class Cull { None, Back, Front };
/// Add: source + target. Over: source·alpha + target·(1 − alpha). Premultiplied: source + target·(1 − alpha).
enum class Blend { Off, Add, Over, Premultiplied };

/// All fixed-function state a draw depends on. Counter-clockwise triangles are front faces.
struct PipelineState {
    DepthTest depth_test = DepthTest::Less;
    bool depth_write = true;
    Cull cull = Cull::Back;
    Blend blend = Blend::Off;
};

/// Sets all of it, whatever was set before.
void apply(const PipelineState& state);

}  // namespace rowland::gpu

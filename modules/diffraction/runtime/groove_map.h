#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "engine/gpu/program.h"
#include "engine/image/byte_image.h"
#include "engine/render/material.h"
#include "engine/render/surface_textures.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// A texture that varies the grating over a surface. R: rotation / π, on top of the surface's own; G: the pitch as a
/// factor of the material's, halved; 0: no grating there.
class GrooveMap {
 public:
    /// The texture that the glTF extension at `place` of `file` names. Throws Error (input) if there is none.
    GrooveMap(const GrooveTexture& use, render::SurfaceTextures& textures, const std::string& file,
              const std::string& place);

    /// The factors that occur, those of 0 left out: 1 if there are none.
    double smallest_pitch() const { return smallest_pitch_; }
    double largest_pitch() const { return largest_pitch_; }

    /// Radians at a vertex's texture coordinates, bilinear where the texture is.
    double rotation(const glm::vec2& uv) const;
    int uv_set() const { return texture_.uv_set; }

    void add_defines(gpu::ProgramDesc& desc) const;
    void bind(const gpu::Program& program) const;

 private:
    double red(int column, int row) const;

    render::SurfaceTexture texture_;
    std::shared_ptr<const image::ByteImage> image_;
    scene::ImportedTexture sampling_;
    double smallest_pitch_ = 1.0;
    double largest_pitch_ = 1.0;
};

/// Why a material cannot be drawn under a map: representations that have one direction or one pitch only. Nothing if it
/// can. The key is a JSON pointer below the glTF extension, without its first slash.
std::optional<Refusal> groove_refusal(const Material& material, const GrooveMap& grooves);

/// The material with the pitches of a map that groove_refusal() has nothing against; arc, where nothing is pinned.
Material suited_to_grooves(Material material, const GrooveMap& grooves);

/// The mesh with its tangents turned as the map says at the vertices.
scene::Mesh turned_by(const GrooveMap& grooves, const scene::Mesh& mesh);

}  // namespace rowland::diffraction

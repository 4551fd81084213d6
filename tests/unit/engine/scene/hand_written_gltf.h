#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_import.h"

namespace rowland::scene::test {

/// A base64 data URI.
std::string data_uri(std::span<const std::byte> bytes, const std::string& type = "application/octet-stream");

/// A file with one primitive of five vertices, a strip of unit squares' corners in the XY plane, drawn as `mode`:
/// (0,0), (1,0), (0,1), (1,1), (0,2).
nlohmann::json document(int mode);
/// The same with an index accessor of unsigned shorts.
nlohmann::json indexed(int mode, const std::vector<std::uint16_t>& indices);

/// Adds a buffer and a view of `bytes`; the view's index.
std::size_t add_view(nlohmann::json& file, std::span<const std::byte> bytes);
/// Adds an accessor to all of `values` with its own buffer; the accessor's index.
std::size_t add_floats(nlohmann::json& file, const std::string& type, const std::vector<float>& values);
/// The same for raw components of `component_type`, `count` elements.
std::size_t add_accessor(nlohmann::json& file, const std::string& type, int component_type, std::size_t count,
                         std::span<const std::byte> bytes, bool normalised = false);

/// Adds accessors to a mesh's positions, normals, tangents, uvs and indices; the primitive that uses them.
nlohmann::json primitive_of(nlohmann::json& file, const Mesh& mesh);

/// Adds an attribute to the first primitive.
void set_attribute(nlohmann::json& file, const std::string& name, std::size_t accessor);

/// A .glb without a binary chunk.
std::vector<std::byte> glb_of(const nlohmann::json& file);

ImportedScene load(const nlohmann::json& file, std::span<const std::string> handled = {});

/// What loading says; "no error" if it loads.
std::string error_of(const nlohmann::json& file);

}  // namespace rowland::scene::test

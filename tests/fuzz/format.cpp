#include "tests/fuzz/format.h"

#include <algorithm>
#include <stdexcept>

#include "content/demo/play/recording.h"
#include "editor/cooker/jobs.h"
#include "engine/asset/container.h"
#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/image/exr.h"
#include "engine/image/image.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/scene/draco_decode.h"
#include "engine/scene/editable_gltf.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/asset/gltf_iridescence.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::fuzz {

namespace {

using Input = std::span<const std::byte>;

std::string_view text(Input bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const std::vector<std::string>& handled_extensions() {
    static const std::vector<std::string> names{diffraction::kGltfExtension};
    return names;
}

void read_glb(Input bytes) {
    const auto sane = scene::test::is_sane(scene::load_glb(bytes, "input.glb", handled_extensions()));
    ROWLAND_CHECK(sane, sane.message());
}

/// What may be edited need not be a scene that is drawn.
void edit_glb(Input bytes) {
    scene::EditableGltf gltf({bytes.begin(), bytes.end()}, "input.glb");
    constexpr std::size_t kMost = 3;  // an edit costs as much as the text is long
    for (std::size_t i = 0; i < std::min(gltf.outline().materials.size(), kMost); ++i) {
        const nlohmann::ordered_json value = {{"a", {1, 2}}};
        const nlohmann::ordered_json before = gltf.material_extension(i, diffraction::kGltfExtension);
        gltf.set_material_extension(i, diffraction::kGltfExtension, value);
        ROWLAND_CHECK(gltf.material_extension(i, diffraction::kGltfExtension) == value, "it is what was set");
        gltf.set_material_extension(i, diffraction::kGltfExtension, before);
        ROWLAND_CHECK(gltf.material_extension(i, diffraction::kGltfExtension) == before, "and again");
    }
    const scene::EditableGltf again(gltf.bytes(), "again.glb");
    ROWLAND_CHECK(again.outline().materials == gltf.outline().materials, "what is written can be opened");
}

/// The JSON of a .gltf, as the one chunk of a .glb: nothing outside of it can be read.
void read_gltf(Input bytes) {
    read_glb(scene::glb_beginning(std::string(text(bytes)), std::nullopt, 0, "input.glb"));
}

void read_draco(Input bytes) {
    scene::MemoryBudget budget("input.drc");
    scene::DracoProcess decoder;
    const scene::DracoMesh mesh(bytes, "input.drc", "stream", decoder, budget);
    const std::vector<std::uint32_t> indices = mesh.indices();
    const std::vector<glm::vec3> positions = mesh.vectors<glm::vec3>(0, "POSITION");
    for (const std::uint32_t index : indices) ROWLAND_CHECK_OP(index, <, positions.size());
}

void require_whole(const image::Image& image) {
    ROWLAND_CHECK_OP(image.texels.size(), ==,
                     static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
}

void read_hdr(Input bytes) {
    require_whole(image::read_radiance_hdr(bytes, "input.hdr"));
}

void read_exr(Input bytes) {
    require_whole(image::read_exr(bytes, "input.exr"));
}

nlohmann::json parsed(Input bytes) {
    return parse_json(text(bytes), "input.json");
}

/// Files that a material names are there, and the same for all.
diffraction::NamedText named(const std::string& name) {
    return {"wavelength_nm,R-1,R+0,R+1\n380,.2,.3,.2\n780,.1,.4,.1\n", name};
}

void read_material(Input bytes) {
    diffraction::parse_material(parsed(bytes), "input.json", named);
}

void read_recording(Input bytes) {
    const demo::Recording recording = demo::parse_recording(std::string(text(bytes)), "input.jsonl");
    for (const demo::Recording::Step& step : recording.steps) ROWLAND_CHECK_OP(step.step, <, recording.step_count);
}

void read_plan(Input bytes) {
    const std::vector<editor::Job> jobs = editor::parse_plan(std::string(text(bytes)), "input.jsonl");
    ROWLAND_CHECK_OP(editor::parse_plan(editor::write_plan(jobs), "again.jsonl").size(), ==, jobs.size());
}

void read_cooked(Input bytes) {
    const asset::CookedAsset cooked = asset::unpack(bytes, "input.cooked");
    if (cooked.header.type == diffraction::kMaterialAssetType)
        diffraction::describe(diffraction::read_cooked_material(cooked.payload, "input.cooked"));
    else if (cooked.header.type == thin_film::kFilmAssetType)
        thin_film::describe(thin_film::read_cooked_film(cooked.payload, "input.cooked"));
    else
        lighting::deserialise(cooked.payload, "input.cooked");
}

/// Payloads alone: behind the container's checksum few mutations would be seen.
void read_cooked_material(Input bytes) {
    diffraction::describe(diffraction::read_cooked_material(bytes, "input.material"));
}

void read_cooked_film(Input bytes) {
    thin_film::describe(thin_film::read_cooked_film(bytes, "input.film"));
}

void read_cooked_probe(Input bytes) {
    lighting::deserialise(bytes, "input.probe");
}

}  // namespace

const std::vector<Format>& formats() {
    static const std::vector<Format> all = {
        {"glb", read_glb, {".glb"}},
        {"gltf", read_gltf, {".gltf"}},
        {"editable-glb", edit_glb, {".glb"}},
        {"draco", read_draco, {".drc"}},
        {"hdr", read_hdr, {".hdr"}},
        {"exr", read_exr, {".exr"}},
        {"byte-image", [](Input bytes) { image::decode_byte_image(bytes, "input.png"); }, {".png", ".jpg"}},
        {"material", read_material, {".json"}},
        {"film", [](Input bytes) { thin_film::parse_film_material(parsed(bytes), "input.json"); }, {}},
        {"iridescence",
         [](Input bytes) { thin_film::describe(thin_film::parse_gltf_iridescence(parsed(bytes), "input.json", "")); },
         {}},
        {"probe-recipe", [](Input bytes) { lighting::parse_probe_recipe(parsed(bytes), "input.json"); }, {".json"}},
        {"mesh-recipe", [](Input bytes) { scene::parse_mesh_recipe(parsed(bytes), "input.json"); }, {".json"}},
        {"efficiency", [](Input bytes) { diffraction::parse_efficiency_csv(text(bytes), "input.csv"); }, {".csv"}},
        {"illuminant", [](Input bytes) { colour::parse_illuminant(text(bytes), "input.csv"); }, {".csv"}},
        {"recording", read_recording, {".jsonl"}},
        {"plan", read_plan, {}},
        {"cooked", read_cooked, {".material", ".probe"}},
        {"cooked-material", read_cooked_material, {}},
        {"cooked-film", read_cooked_film, {}},
        {"cooked-probe", read_cooked_probe, {}},
    };
    return all;
}

const Format& format(const std::string& name) {
    for (const Format& format : formats())
        if (format.name == name) return format;
    throw std::out_of_range("no format " + name);
}

bool accepts(const Format& format, std::span<const std::byte> bytes) {
    try {
        format.read(bytes);
        return true;
    } catch (const Error& error) {
        ROWLAND_CHECK(error.info().fault == Fault::Input, "a refusal for what the file holds");
        ROWLAND_CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos, "one line");
        return false;
    }
}

}  // namespace rowland::fuzz

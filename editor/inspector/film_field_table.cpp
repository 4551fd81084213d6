#include <fmt/format.h>

#include <algorithm>

#include "editor/inspector/field_parts.h"
#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "modules/thin_film/asset/gltf_iridescence.h"

namespace rowland::inspector {

namespace {

using thin_film::kIridescenceExtension;

const char* const kAiry = "Airy's sum; Born & Wolf, Principles of Optics, ch. 7.6";
const char* const kFilmFresnel = "Fresnel's equations";
constexpr int kMostLayersShown = 8;

Json initial_layer(int i) {
    return i % 2 == 0 ? Json{{"ior", 1.33}, {"thickness_nm", 400}} : Json{{"ior", 1.5}, {"thickness_nm", 100}};
}

std::vector<Field> layer_fields(const std::string& pointer, const std::string& prefix) {
    return {required(slider(FieldKind::Number, pointer + "/ior", prefix + "Index", {1.0, 4.0}, 1.33,
                            "Index of refraction n of the layer; 1 to 10. Water 1.33, oil 1.47, titanium dioxide 2.4.",
                            kAiry)),
            required(slider(FieldKind::Number, pointer + "/thickness_nm", prefix + "Thickness", {0.0, 1000.0, "nm"},
                            400, "Thickness of the layer; 0 to 100 000 nm. Colours are strongest below 600.", kAiry)),
            slider(FieldKind::Number, pointer + "/k", prefix + "k", {0.0, 2.0}, 0.0,
                   "Imaginary part of the index: absorption of the layer; 0 to 100. A glTF file holds 0 only.", kAiry)};
}

/// The layers, from the outermost down.
std::vector<Field> stack_fields() {
    std::vector<Field> all = {required(choice("/film", "Layers", initial_layer(0), {{"1", initial_layer(0)}},
                                              "Number of layers, the outermost first. A glTF file holds one.", kAiry))};
    std::vector<Field> layers = shown_for("/film", "1", layer_fields("/film", ""));
    all.insert(all.end(), layers.begin(), layers.end());
    Json list = Json::array({initial_layer(0)});
    for (int count = 2; count <= kMostLayersShown; ++count) {
        list.push_back(initial_layer(count - 1));
        all.front().choices.push_back({fmt::format("{}", count), list});
    }
    for (int i = 0; i < kMostLayersShown; ++i)
        for (Field& field :
             shown_for("/film", "", layer_fields(fmt::format("/film/{}", i), fmt::format("{}: ", i + 1)))) {
            field.only_for.clear();
            for (int count = std::max(2, i + 1); count <= kMostLayersShown; ++count)
                field.only_for.push_back(fmt::format("{}", count));
            all.push_back(std::move(field));
        }
    return all;
}

/// The fields of the base under a film, which are members of `parent`: a metal, or index and k. In a scene the base may
/// also be the surface as it is.
std::vector<Field> base_fields(const std::string& parent, bool in_scene) {
    const Json index = {{"ior", 1.5}};
    std::vector<Choice> metals = {{"none", nullptr}};
    for (const std::string& name : colour::metal_names()) metals.push_back({name, name});
    Field metal = choice(parent + "/metal", "Base metal", nullptr, std::move(metals),
                         "The metal under the film; none: an index, or a scene's surface.", "measured n and k");
    metal.alternative = parent + "/base";
    std::vector<Field> of_surface;
    if (in_scene)
        of_surface = shown_for(parent + "/metal", "none",
                               {choice(parent + "/base", "Base", nullptr, {{"the surface", nullptr}, {"index", index}},
                                       "the surface: KHR_materials_ior of a dielectric, or a metal of the surface's "
                                       "colour. index: exactly this one.",
                                       kFilmFresnel)});
    else
        metal.alternative_value = index;
    return joined(
        {{metal},
         of_surface,
         shown_for(in_scene ? parent + "/base" : parent + "/metal", in_scene ? "index" : "none",
                   {required(slider(FieldKind::Number, parent + "/base/ior", "Base index", {0.1, 5.0}, 1.5,
                                    "Index of refraction n under the film; 0.01 to 100. Air 1, water 1.33, glass 1.5.",
                                    kFilmFresnel)),
                    slider(FieldKind::Number, parent + "/base/k", "Base k", {0.0, 10.0}, 0.0,
                           "Imaginary part of the index under the film; 0 to 100. Titanium 3.3.", kFilmFresnel)})});
}

Field illuminant_field(const std::string& pointer) {
    std::vector<Choice> names;
    for (const std::string& name : colour::illuminant_names()) names.push_back({name, name});
    return choice(pointer, "Illuminant", "D65", std::move(names), "Spectrum of white light.", "CIE 15, Colorimetry");
}

Choice texture() {
    return {"texture", {{"index", 0}}};
}

}  // namespace

std::span<const Field> film_fields() {
    static const std::vector<Field> all =
        joined({stack_fields(),
                base_fields("", false),
                {slider(FieldKind::Number, "/roughness", "Roughness", {}, 0.0,
                        "Perceptual roughness of the surface; 0 to 1. In a glTF file it is the material's own.",
                        "GGX; glTF 2.0, metallic-roughness"),
                 illuminant_field("/illuminant")}});
    return all;
}

std::span<const Field> iridescence_fields() {
    static const std::vector<Field> all = joined(
        {{slider(FieldKind::Number, "/iridescenceFactor", "Factor", {}, 0.0,
                 "Fraction of the surface under the film; 0 to 1. At 0 the film is not drawn.", kIridescenceExtension),
          choice("/iridescenceTexture", "Factor map", nullptr, {{"none", nullptr}, texture()},
                 "R multiplies the factor.", kIridescenceExtension)},
         shown_for("/iridescenceTexture", "texture", texture_fields("/iridescenceTexture", kIridescenceExtension)),
         {slider(FieldKind::Number, "/iridescenceIor", "Index", {1.0, 4.0}, 1.3,
                 "Index of refraction n of the film; 1 to 10. Water 1.33, oil 1.47, titanium dioxide 2.4.", kAiry),
          slider(FieldKind::Number, "/iridescenceThicknessMaximum", "Thickness", {0.0, 1000.0, "nm"}, 400.0,
                 "Thickness of the film; 0 to 100 000 nm. With a thickness map: where its G is 1.",
                 kIridescenceExtension),
          choice("/iridescenceThicknessTexture", "Thickness map", nullptr, {{"none", nullptr}, texture()},
                 "G varies the thickness over the mesh, from the least to the greatest. Drop a picture to use it.",
                 kIridescenceExtension)},
         shown_for(
             "/iridescenceThicknessTexture", "texture",
             joined({{slider(FieldKind::Number, "/iridescenceThicknessMinimum", "Least thickness", {0.0, 1000.0, "nm"},
                             100.0, "Thickness where the texture's G is 0; 0 to 100 000 nm. It may be the greater one.",
                             kIridescenceExtension)},
                     texture_fields("/iridescenceThicknessTexture", kIridescenceExtension)})),
         base_fields("/extras", true),
         {illuminant_field("/extras/illuminant")}});
    return all;
}

}  // namespace rowland::inspector

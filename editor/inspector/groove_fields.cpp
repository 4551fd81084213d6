#include <numbers>
#include <vector>

#include "editor/inspector/field.h"
#include "modules/diffraction/asset/gltf_extension.h"

namespace rowland::inspector {

namespace {

const char* const kTransform = "KHR_texture_transform";
const char* const kTransformPointer = "/grooveTexture/extensions/KHR_texture_transform/";

Field of_texture(Field field) {
    field.only_with = "/grooveTexture";
    field.only_for = {"texture"};
    return field;
}

std::vector<Field> transform_fields() {
    const std::string parent = kTransformPointer;
    return {of_texture({.pointer = parent + "offset",
                        .label = "Offset",
                        .kind = FieldKind::Pair,
                        .minimum = -1.0,
                        .maximum = 1.0,
                        .default_value = {0.0, 0.0},
                        .help = "Of the texture on the mesh, in texture coordinates.",
                        .source = kTransform}),
            of_texture({.pointer = parent + "scale",
                        .label = "Repeats",
                        .kind = FieldKind::Pair,
                        .minimum = 0.0,
                        .maximum = 10.0,
                        .default_value = {1.0, 1.0},
                        .help = "How often the texture repeats over one unit of u and of v.",
                        .source = kTransform}),
            of_texture({.pointer = parent + "rotation",
                        .label = "Turned by",
                        .unit = "rad",
                        .minimum = -std::numbers::pi,
                        .maximum = std::numbers::pi,
                        .default_value = 0.0,
                        .help = "Rotation of the texture about the origin of its coordinates. The grooves in it do not "
                                "turn with it.",
                        .source = kTransform})};
}

std::vector<Field> make_groove_fields() {
    std::vector<Field> all = {
        {.pointer = "/grooveRotation",
         .label = "Groove rotation",
         .unit = "rad",
         .minimum = -std::numbers::pi,
         .maximum = std::numbers::pi,
         .default_value = 0.0,
         .help =
             "Turns the grooves in the surface, from the mesh's tangent toward its bitangent. Or drag the handle in "
             "the preview (G).",
         .source = diffraction::kGltfExtension},
        {.pointer = "/grooveTexture",
         .label = "Groove texture",
         .kind = FieldKind::Choice,
         .choices = {{"none", nullptr}, {"texture", {{"index", 0}}}},
         .help = "Varies the grooves over the mesh. R: rotation / 180 degrees, G: pitch / (2 pitch_nm), 0 where there "
                 "is no grating.",
         .source = diffraction::kGltfExtension},
        of_texture({.pointer = "/grooveTexture/index",
                    .label = "Texture",
                    .kind = FieldKind::Count,
                    .maximum = 1e9,
                    .default_value = 0,
                    .required = true,
                    .help = "Number of the texture in the file, from 0. A picture that is not saved yet has a number "
                            "from 1000000 on.",
                    .source = diffraction::kGltfExtension}),
        of_texture({.pointer = "/grooveTexture/texCoord",
                    .label = "UV set",
                    .kind = FieldKind::Count,
                    .default_value = 0,
                    .help = "Which set of the mesh's texture coordinates it uses; 0 or 1.",
                    .source = "glTF 2.0, textureInfo"}),
        of_texture({.pointer = "/grooveTexture/sparkle",
                    .label = "Sparkle",
                    .kind = FieldKind::Choice,
                    .choices = {{"off", nullptr}, {"on", true}},
                    .help = "on: a pixel shows the grooves of one texel, so that small cells sparkle. off: the mean of "
                            "what it covers.",
                    .source = diffraction::kGltfExtension})};
    for (Field& field : transform_fields()) all.push_back(std::move(field));
    return all;
}

}  // namespace

std::span<const Field> groove_fields() {
    static const std::vector<Field> all = make_groove_fields();
    return all;
}

}  // namespace rowland::inspector

// Gratings on a GPU that allows little.
#include <gmock/gmock.h>

#include <fstream>
#include <regex>

#include "modules/diffraction/shaders/shader_files.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/support/grating_programs.h"
#include "tests/support/replaced_function.h"

namespace rowland::diffraction {
namespace {

using rowland::test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

template <auto Pointer>
using Replaced = rowland::test::ReplacedFunction<Pointer>;

std::map<GLenum, std::int64_t> lowered;

void APIENTRY get_integer(GLenum name, GLint* values) {
    if (const auto limit = lowered.find(name); limit != lowered.end())
        *values = static_cast<GLint>(limit->second);
    else
        Replaced<&epoxy_glGetIntegerv>::driver(name, values);
}

void APIENTRY get_long_integer(GLenum name, GLint64* values) {
    if (const auto limit = lowered.find(name); limit != lowered.end())
        *values = limit->second;
    else
        Replaced<&epoxy_glGetInteger64v>::driver(name, values);
}

/// While it lives, the driver reports other limits. One at a time.
class LoweredLimit {
 public:
    LoweredLimit(std::initializer_list<std::pair<const GLenum, std::int64_t>> values) { lowered = values; }
    ~LoweredLimit() { lowered.clear(); }
    LoweredLimit(const LoweredLimit&) = delete;
    LoweredLimit& operator=(const LoweredLimit&) = delete;

 private:
    Replaced<&epoxy_glGetIntegerv> integer_{"glGetIntegerv", get_integer};
    Replaced<&epoxy_glGetInteger64v> long_integer_{"glGetInteger64v", get_long_integer};
};

class GratingLimits : public GratingPicture {
 protected:
    std::string refusal(const std::string& representation) {
        const CookedMaterial cooked = cook(kSlitCd, "{\"representation\": \"" + representation + "\"}");
        show(cooked);
        return message_of([&] { draw(); }, Fault::System);
    }
};

/// Three vertices: 25 coefficients, or two layers of three vectors.
TEST_F(GratingLimits, LightOfMoreThanABufferHoldsIsRefused) {
    {
        const LoweredLimit limit{{GL_MAX_TEXTURE_BUFFER_SIZE, 74}};
        EXPECT_THAT(refusal("spikes"), AllOf(HasSubstr("representation spikes on 3 vertices"), HasSubstr("75 texels"),
                                             HasSubstr("at most 74"), HasSubstr("fewer bands")));
    }
    const LoweredLimit limit{{GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 287}};
    EXPECT_THAT(refusal("arc"), HasSubstr("288 bytes"));
}

TEST_F(GratingLimits, AVertexStageWithoutStorageDrawsWhatNeedsNone) {
    const LoweredLimit limit{{GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 0}};
    for (const char* representation : {"spikes", "arc"})
        EXPECT_THAT(refusal(representation), HasSubstr("1 storage buffers")) << representation;
    for (const char* quality :
         {R"({"representation": "direct"})", R"({"representation": "circle", "map_resolution": 8})"}) {
        use(cook(kSlitCd, quality));
        EXPECT_NO_THROW(draw()) << quality;
    }
}

/// What a fragment stage reads.
struct StageUse {
    int samplers = 0;
    int components = 0;  ///< of the vertex stage's outputs
};

int property(GLuint program, GLenum interface, GLuint index, GLenum name) {
    GLint value = 0;
    glGetProgramResourceiv(program, interface, index, 1, &name, 1, nullptr, &value);
    return value;
}

int components_of(GLenum type) {
    switch (type) {
        case GL_FLOAT:
            return 1;
        case GL_FLOAT_VEC2:
            return 2;
        case GL_FLOAT_VEC3:
            return 3;
        default:
            return 4;
    }
}

bool is_number(GLenum type) {
    for (const GLenum number : std::initializer_list<GLenum>{GL_FLOAT, GL_FLOAT_VEC2, GL_FLOAT_VEC3, GL_FLOAT_VEC4,
                                                             GL_INT, GL_FLOAT_MAT3, GL_FLOAT_MAT4})
        if (type == number) return true;
    return false;
}

std::string name_of_input(GLuint program, GLuint index) {
    std::array<char, 128> name{};
    glGetProgramResourceName(program, GL_PROGRAM_INPUT, index, name.size(), nullptr, name.data());
    return name.data();
}

/// Of a stage that is linked alone, so that what it reads is known without the other.
StageUse use_of(const std::string& text) {
    const char* source = text.c_str();
    const GLuint program = glCreateShaderProgramv(GL_FRAGMENT_SHADER, 1, &source);
    StageUse use;
    GLint inputs = 0;
    glGetProgramInterfaceiv(program, GL_PROGRAM_INPUT, GL_ACTIVE_RESOURCES, &inputs);
    for (GLuint i = 0; i < static_cast<GLuint>(inputs); ++i)
        if (!name_of_input(program, i).starts_with("gl_"))
            use.components += components_of(static_cast<GLenum>(property(program, GL_PROGRAM_INPUT, i, GL_TYPE))) *
                              property(program, GL_PROGRAM_INPUT, i, GL_ARRAY_SIZE);
    GLint uniforms = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &uniforms);
    for (GLuint i = 0; i < static_cast<GLuint>(uniforms); ++i)
        if (property(program, GL_UNIFORM, i, GL_BLOCK_INDEX) < 0 &&
            !is_number(static_cast<GLenum>(property(program, GL_UNIFORM, i, GL_TYPE))))
            ++use.samplers;
    glDeleteProgram(program);
    return use;
}

std::vector<std::string> fragment_stages;  ///< of gratings
void APIENTRY shader_source(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
    Replaced<&epoxy_glShaderSource>::driver(shader, count, texts, lengths);
    std::string source = rowland::test::whole_source(count, texts, lengths);
    GLint type = 0;
    glGetShaderiv(shader, GL_SHADER_TYPE, &type);
    if (type == GL_FRAGMENT_SHADER && source.find("in vec3 world_grating") != std::string::npos)
        fragment_stages.push_back(std::move(source));
}

/// An arc table of rank 16 with a groove texture on a surface with every map, under every effect and kind of light.
class LargestGrating : public GratingLimits {
 protected:
    LargestGrating() {
        light_ = light_of(smooth_probe(), three_keys());
        const ecs::Entity sun = world_.create();
        world_.add(sun, scene::DirectionalLight{
                            .direction = {0.0F, 0.6F, 0.8F}, .irradiance = glm::vec3(1.0F), .casts_shadow = true});
        const ecs::Entity lamp = world_.create();
        world_.add(lamp, scene::Transform{.translation = {0.3F, 0.4F, 1.0F}});
        world_.add(lamp, scene::PunctualLight{.intensity = glm::vec3(0.5F)});
        white_->upload(std::span<const glm::vec4>(std::array{glm::vec4(0.5F, 0.5F, 1.0F, 1.0F)}));
        const ecs::Entity floor = world_.create();
        world_.add(floor, scene::Transform{.translation = {0.0F, 0.0F, -2.0F}});
        world_.add(floor, render::make_mesh_instance(flat_triangle()));
        world_.add(floor, render::StandardMaterial{.base_colour_texture = {.texture = white_, .transform = {}}});
        world_.add(floor, render::ReflectedTop{.half = {1.0F, 1.0F}});
    }

    std::vector<glm::vec4> draw_on(scene::Mesh mesh) {
        mesh.uvs1 = mesh.uvs;
        mesh.colours.assign(mesh.positions.size(), glm::vec4(0.9F, 0.8F, 0.7F, 1.0F));
        mesh_ = std::move(mesh);
        if (renderer_) world_.destroy(entity_);
        auto picture = std::make_shared<image::ByteImage>();
        *picture = {.width = 1, .height = 1, .rgba = {20, 128, 0, 255}};
        scene::ImportedScene pictures;
        pictures.images = {picture};
        pictures.textures.resize(1);
        render::SurfaceTextures textures(pictures);
        const auto grooves = std::make_shared<const GrooveMap>(GrooveTexture{}, textures, "scene.gltf", "");
        const nlohmann::json json =
            nlohmann::json::parse(std::string("{\"grating\": ") + kSlitCd +
                                  R"(, "cover": {"ior": 1.5}, "quality": {"representation": "arc", "rank": 16}})");
        show(bake_material(suited_to_grooves(parse_material(json, "test"), grooves->pitches())));
        world_.add(entity_, DiffractionSurface{material_, 0.3F, grooves});
        render::StandardMaterial surface = material_->base();
        for (const render::SurfaceMap& map : render::kSurfaceMaps)
            surface.*map.texture = {.texture = white_, .uv_set = 1, .transform = {.offset = {0.1F, 0.2F}}};
        surface.alpha_mode = scene::AlphaMode::Mask;
        world_.add(entity_, std::move(surface));
        world_.add(entity_, render::ReflectsObjects{entity_});
        renderer_->set_probe(with_even_environment(*light_.probe, 0.0F));
        renderer_->use_key_lights(true);
        renderer_->set_effects({.ambient_occlusion = render::AmbientOcclusionSettings{},
                                .soft_shadows = render::SoftShadowSettings{},
                                .local_reflections = true,
                                .object_reflections = true,
                                .rough_reflections = true});
        return draw();
    }

    std::shared_ptr<gpu::Texture> white_ = std::make_shared<gpu::Texture>(gpu::TextureDesc{});
};

/// A driver that allows no more than OpenGL 4.5 guarantees shows the same picture: 16 samplers in a stage and 60
/// components between two are not exceeded on any other.
TEST_F(LargestGrating, IsDrawnByWhatOpenGlGuarantees) {
    const Replaced<&epoxy_glShaderSource> recorded("glShaderSource", shader_source);
    const std::vector<glm::vec4> unlimited = draw_on(crooked_triangle());
    EXPECT_GT(unlimited[DrawnTriangle::kSize * DrawnTriangle::kSize / 2 + DrawnTriangle::kSize / 2].y, 0.01F);
    fragment_stages.clear();
    const LoweredLimit limits{{GL_MAX_TEXTURE_IMAGE_UNITS, render::kGuaranteedSamplers},
                              {GL_MAX_VARYING_COMPONENTS, 60}};
    EXPECT_EQ(draw_on(crooked_triangle()), unlimited);
    draw_on(flat_triangle());
    ASSERT_GE(fragment_stages.size(), 2U);
    for (const std::string& stage : fragment_stages) {
        const StageUse use = use_of(stage);
        EXPECT_LE(use.samplers, render::kGuaranteedSamplers);
        EXPECT_GE(use.samplers, 13);
        EXPECT_LE(use.components, 60);
    }
}

class ProgramLimits : public rowland::test::GlTest {};

/// With every map, attribute and effect, with a normal map and without. OpenGL 4.5 guarantees 16 samplers in a stage
/// and 60 components between two.
TEST_F(ProgramLimits, TheLargestProgramsKeepToWhatOpenGlGuarantees) {
    using namespace render::feature;
    constexpr render::SurfaceFeatures kAllMaps = kBaseColourMap | kMetallicRoughnessMap | kOcclusionMap | kEmissiveMap |
                                                 kWearMap | kScratches | (kEmissiveMap << kSecondUvShift);
    constexpr render::SurfaceFeatures kAll = kAllMaps | kColours | kTextureTransformExtension | kAlphaMask | kLights;
    gpu::ShaderLibrary library;
    library.add_embedded(render::shader_files());
    library.add_embedded(shader_files());
    int most_samplers = 0;
    int most_components = 0;
    const auto link = [&](gpu::ProgramDesc desc, render::SurfaceFeatures features, const std::string& name) {
        render::add_defines(features, desc);
        const gpu::ShaderText fragment = library.assemble(desc.fragment, desc.defines);
        EXPECT_NO_THROW(gpu::Program(library.assemble(desc.vertex, desc.defines), fragment)) << name;
        const StageUse use = use_of(fragment.text);
        EXPECT_LE(use.samplers, render::fragment_samplers(desc)) << name;
        EXPECT_LE(use.samplers, render::kGuaranteedSamplers) << name;
        EXPECT_LE(use.components, 60) << name;
        most_samplers = std::max(most_samplers, use.samplers);
        most_components = std::max(most_components, use.components);
    };
    for (const render::SurfaceFeatures others : {kNormalMap | kDoubleSided, kUnlit, kSkinned | kInstanced})
        link({.vertex = "modules/diffraction/shaders/mean.vert.glsl",
              .fragment = "modules/diffraction/shaders/mean.frag.glsl"},
             kAll | others, "mean colour");
    for (const rowland::test::GratingProgram& program : rowland::test::grating_programs())
        for (const rowland::test::Defines& lights : rowland::test::grating_lights())
            for (const render::SurfaceFeatures normals : {kNormalMap, render::SurfaceFeatures{0}}) {
                if (!rowland::test::exists(program, lights)) continue;
                gpu::ProgramDesc desc{.vertex = "modules/diffraction/shaders/grating.vert.glsl",
                                      .fragment = "modules/diffraction/shaders/grating.frag.glsl",
                                      .defines = program.defines};
                desc.defines.insert(desc.defines.end(), lights.begin(), lights.end());
                desc.defines.emplace_back("AMBIENT_AT_VERTICES", "1");
                if (program.name == "circle") desc.defines.emplace_back("MATERIAL_CURVED_MIRROR", "1");
                desc.defines.emplace_back(render::kMaterialSamplers, std::to_string(program.samplers));
                link(desc, kAll | normals, program.name);
            }
    EXPECT_GE(most_samplers, 15);  // the counts are not of empty programs
    EXPECT_GE(most_components, 50);
}

/// Words in capitals of the lines that `keep` takes.
std::set<std::string> macros_of(const std::filesystem::path& file,
                                const std::function<bool(const std::string&)>& keep) {
    static const std::regex kMacro(R"(\b[A-Z][A-Z0-9_]+\b)");
    std::set<std::string> macros;
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);)
        if (keep(line))
            for (auto it = std::sregex_iterator(line.begin(), line.end(), kMacro); it != std::sregex_iterator(); ++it)
                macros.insert(it->str());
    return macros;
}

TEST(ShaderDefines, EachThatAConditionReadsIsInThePages) {
    std::set<std::string> known;
    for (const char* page : {"engine/render/shaders/README.md", "modules/diffraction/shaders/README.md"})
        known.merge(macros_of(rowland::test::source_path(page), [](const std::string&) { return true; }));
    std::size_t read = 0;
    for (const char* folder :
         {"engine/render/shaders", "modules/diffraction/shaders", "modules/diffraction/representations"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(rowland::test::source_path(folder))) {
            if (entry.path().extension() != ".glsl") continue;
            const auto is_condition = [](const std::string& line) {
                return line.starts_with("#if") || line.starts_with("#elif");
            };
            for (const std::string& macro : macros_of(entry.path(), is_condition)) {
                EXPECT_TRUE(known.contains(macro) || macro.starts_with("FILM_")) << entry.path() << ": " << macro;
                ++read;
            }
        }
    EXPECT_GT(read, 50U);
}

}  // namespace
}  // namespace rowland::diffraction

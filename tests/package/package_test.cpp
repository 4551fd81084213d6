// Installs into a fresh prefix, and builds and runs the examples of content/examples against it; the pages about them.
// With ROWLAND_TEST_WINDOWS=build/windows, examples are built for Windows against what that folder installs, and run by
// Wine.
#include <gmock/gmock.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <sstream>

#include "engine/core/file.h"
#include "engine/core/system.h"
#include "engine/core/text.h"
#include "engine/image/exr.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "tests/support/folder_test.h"
#include "tests/support/program.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Compilers run in it; CTest's limit is the one that counts.
const test::Surroundings kBuild{.limit = std::chrono::minutes(10)};

constexpr const char* kFrameColumns = "vx,vy,vz,nx,ny,nz,gx,gy,gz";
constexpr const char* kPixelColumns =
    "vx,vy,vz,nx,ny,nz,gx,gy,gz,footprint,probe_X,probe_Y,probe_Z,lamp_X,lamp_Y,lamp_Z";
constexpr const char* kMaterial = R"({
  "grating": { "pitch_nm": 1600, "profile": { "type": "slit", "width_nm": 800 } },
  "quality": { "representation": "direct" }
})";

class PackageTest : public test::FolderTest {
 protected:
    /// The build for Windows; nullopt where this system is tested.
    const std::optional<std::string> windows_ = environment_variable("ROWLAND_TEST_WINDOWS");

    static std::filesystem::path for_windows(const std::string& tool) {
        return test::content_path("package/windows/" + tool);
    }

    void SetUp() override {
        if (!std::filesystem::exists(ROWLAND_TEST_COMPILER)) GTEST_SKIP() << "no compiler " << ROWLAND_TEST_COMPILER;
        install("library");
        write_probe();
        write_file_atomic(path("cd.json"), std::string_view(kMaterial));
    }

    /// What a program prints; it must succeed.
    static std::string run(const std::vector<std::string>& command) {
        const test::Ended result = test::run(command, kBuild);
        EXPECT_EQ(result.code, 0) << command[0] << ' ' << command[1] << '\n' << result.out << result.err;
        return result.out;
    }

    void install(const std::string& component) const {
        run({ROWLAND_TEST_CMAKE, "--install", windows_.value_or(ROWLAND_BUILD_FOLDER), "--prefix", path("prefix"),
             "--component", component});
    }

    test::Ended configure(const std::string& project) const {
        const std::string compiler = windows_ ? "-DCMAKE_TOOLCHAIN_FILE=" + for_windows("toolchain.cmake").string()
                                              : std::string("-DCMAKE_CXX_COMPILER=") + ROWLAND_TEST_COMPILER;
        return test::run({ROWLAND_TEST_CMAKE, "-S", project, "-B", path("build"), "-G", ROWLAND_TEST_GENERATOR,
                          std::string("-DCMAKE_MAKE_PROGRAM=") + ROWLAND_TEST_BUILD_TOOL,
                          std::string("-DCMAKE_CXX_COMPILER_LAUNCHER=") + ROWLAND_TEST_LAUNCHER, compiler,
                          "-DCMAKE_PREFIX_PATH=" + path("prefix").string()},
                         kBuild);
    }

    /// Builds an example; returns the command that starts its program.
    test::Command build_example(const std::string& name) const {
        const auto configured = configure(test::content_path(std::string("examples/") + name).string());
        EXPECT_EQ(configured.code, 0) << configured.out << configured.err;
        run({ROWLAND_TEST_CMAKE, "--build", path("build")});
        if (windows_) return {for_windows("wine.sh"), path("build") / (name + ".exe")};
        return {path("build") / name};
    }
    static std::string run(test::Command program, const std::vector<std::filesystem::path>& files) {
        program.insert(program.end(), files.begin(), files.end());
        return run(program);
    }

    /// A sky with a warm lamp, in the equirectangular mapping.
    void write_probe() const {
        image::Image probe{.width = 64, .height = 32, .texels = {}};
        for (int row = 0; row < probe.height; ++row) {
            for (int column = 0; column < probe.width; ++column) {
                const double sky = 1.0 - static_cast<double>(row) / probe.height;
                const double lamp = std::exp(-0.2 * (std::pow(column - 40.0, 2) + std::pow(row - 9.0, 2)));
                probe.texels.emplace_back(glm::dvec3(0.2, 0.3, 0.5) * sky + glm::dvec3(5.0, 4.0, 3.0) * lamp);
            }
        }
        image::write_exr(path("probe.exr"), probe);
    }

    /// Radiances by rowland-trade evaluate.
    Rows evaluate(const Rows& frames, std::vector<std::string> options) const {
        std::string text = std::string(kFrameColumns) + "\n";
        for (const std::vector<double>& row : frames) {
            text += fmt::format("{:.9g}\n", fmt::join(row.begin(), row.begin() + 9, ","));
        }
        write_file_atomic(path("frames.csv"), text);
        std::vector<std::string> command = {ROWLAND_TRADE, "evaluate",        "--material", path("cd.json"),
                                            "--probe",     path("probe.exr"), "--frames",   path("frames.csv")};
        command.insert(command.end(), options.begin(), options.end());
        return rows(run(command), "X,Y,Z");
    }

    static Rows rows(const std::string& text, const std::string& columns) {
        return parse_number_table(text, "a program's results", columns).rows;
    }

    /// A plane seen from above, black but for what `extensions` put on it, drawn by the engine example: the picture's
    /// middle.
    glm::ivec3 middle_of_card(const test::Command& program, const std::string& extensions) const {
        const glm::vec3 eye(0.4F, 1.0F, 1.0F);
        const glm::quat toward = glm::quatLookAt(-glm::normalize(eye), glm::vec3(0.0F, 1.0F, 0.0F));
        nlohmann::json file = {
            {"asset", {{"version", "2.0"}}},
            {"scenes", {{{"nodes", {0, 1}}}}},
            {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 0.52}, {"znear", 0.01}}}}}},
            {"nodes",
             {{{"name", "card"}, {"mesh", 0}},
              {{"name", "view"},
               {"camera", 0},
               {"translation", {eye.x, eye.y, eye.z}},
               {"rotation", {toward.x, toward.y, toward.z, toward.w}}}}},
            {"materials",
             {{{"name", "foil"},
               {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}}},
               {"extensions", nlohmann::json::parse(extensions)}}}}};
        nlohmann::json primitive =
            scene::test::primitive_of(file, scene::build_mesh(scene::PlaneRecipe{.width = 1.0, .depth = 1.0}));
        primitive["material"] = 0;
        file["meshes"] = {{{"name", "card"}, {"primitives", {primitive}}}};
        write_file_atomic(path("card.glb"), scene::test::glb_of(file));
        run(program, {path("card.glb"), path("probe.exr"), path("card.png")});
        const auto picture = image::decode_byte_image(read_file(path("card.png"), std::uint64_t{1} << 24), "card.png");
        const auto middle = static_cast<std::size_t>(4 * (picture.height / 2 * picture.width + picture.width / 2));
        return {picture.rgba[middle], picture.rgba[middle + 1], picture.rgba[middle + 2]};
    }
};

/// Largest difference of XYZ over the largest component of the expected.
double error_of(const double* xyz, const double* expected) {
    double error = 0.0;
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) {
        error = std::max(error, std::abs(xyz[i] - expected[i]));
        largest = std::max(largest, std::abs(expected[i]));
    }
    return largest > 0.0 ? error / largest : error;
}

TEST_F(PackageTest, OnePixelOfTheExampleIsWhatTradeEvaluates) {
    const test::Command program = build_example("one_pixel");
    const Rows shaded = rows("X,Y,Z\n" + run(program, {path("probe.exr")}), "X,Y,Z");
    const Rows expected =
        evaluate({{0.36, 0.48, 0.8, 0, 0, 1, 1, 0, 0}}, {"--method", "arc", "--rank", "16", "--storage", "fp16"});
    ASSERT_EQ(shaded.size(), 1U);
    EXPECT_GT(expected[0][1], 0.01);
    EXPECT_LE(error_of(shaded[0].data(), expected[0].data()), 1e-6);  // the same sums, printed with nine digits
}

/// The lamp of the example's shader, by the CPU's direct term.
glm::dvec3 lamp_radiance(const diffraction::CookedMaterial& material, const diffraction::BlurredKernel& kernel,
                         const std::vector<double>& pixel) {
    const diffraction::DirectLight lamp{
        .direction = {-0.36, 0.80, -0.48}, .flux = glm::dvec3(0.06), .angular_radius = 0.01};
    const diffraction::ShadingPoint frame{.view = {pixel[0], pixel[1], pixel[2]},
                                          .normal = {pixel[3], pixel[4], pixel[5]},
                                          .grating = {pixel[6], pixel[7], pixel[8]}};
    const glm::dmat3 to_tangent = diffraction::world_to_tangent(frame);
    const glm::dvec3 view = to_tangent * frame.view;
    return direct_radiance(kernel, {.pitch_nm = material.material.grating.pitch_nm}, light_spot(lamp, to_tangent),
                           {.v_g = view.x, .v_h = view.y, .footprint = pixel[9]});
}

TEST_F(PackageTest, PixelsOfTheBareGlExampleAreWhatTheCpuEvaluates) {
    // Texture units interpolate with 8 bits (1/512 of what neighbours differ by). A software rasteriser is 7e-5 off for
    // the probe and, on the flanks of a rainbow, 3e-4 of its brightest for the lamp.
    constexpr double tolerance = 2e-3;
    const test::Command program = build_example("bare_gl");
    run({ROWLAND_COOK, "cook", path("cd.json"), "-o", path("cd.material")});
    const Rows pixels = rows(run(program, {path("cd.material"), path("probe.exr"), path("disc.png")}), kPixelColumns);
    ASSERT_GT(pixels.size(), 50U);
    const Rows expected = evaluate(pixels, {"--method", "planar", "--resolution", "256"});
    const auto material = diffraction::load_cooked_material(path("cd.material"));
    const auto kernel = diffraction::blur_for_lights(material.kernel, material.material.grating.pitch_nm);
    int lit = 0;
    double brightest = 0.0;
    for (const auto& pixel : pixels) brightest = std::max(brightest, pixel[14]);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        EXPECT_LE(error_of(&pixels[i][10], expected[i].data()), tolerance) << "pixel " << i;
        const glm::dvec3 lamp = lamp_radiance(material, kernel, pixels[i]);
        if (lamp.y > 0.01 * brightest) ++lit;
        EXPECT_LE(std::abs(pixels[i][14] - lamp.y), tolerance * brightest) << "pixel " << i;
    }
    EXPECT_GT(lit, 5) << "pixels that the lamp's light reaches";
}

TEST_F(PackageTest, EngineExampleDrawsAGltfSceneWithAGratingAndAFilm) {
    install("runtime");
    const test::Command program = build_example("engine_scene");
    const glm::ivec3 plain = middle_of_card(program, "{}");
    const glm::ivec3 grating = middle_of_card(program, R"({ "ROWLAND_materials_diffraction": {
        "grating": { "pitch_nm": 1600, "profile": { "type": "slit", "width_nm": 800 } },
        "quality": { "representation": "arc" } } })");
    const glm::ivec3 film = middle_of_card(program, R"({ "KHR_materials_iridescence": {
        "iridescenceFactor": 1, "iridescenceIor": 2.4, "extras": { "metal": "Al" } } })");
    for (const glm::ivec3& drawn : {grating, film}) {
        const glm::ivec3 difference = glm::abs(drawn - plain);
        EXPECT_GT(difference.x + difference.y + difference.z, 20);
    }
}

TEST_F(PackageTest, AModuleOfAnotherProjectChangesHowLightIsReflected) {
    install("runtime");
    const test::Command program = build_example("own_module");
    const glm::ivec3 grey =
        middle_of_card(program, R"({ "EXAMPLE_materials_metal": { "n": [0.18, 0.18, 0.18], "k": [3.4, 3.4, 3.4] } })");
    const glm::ivec3 gold = middle_of_card(
        program, R"({ "EXAMPLE_materials_metal": { "n": [0.18, 0.42, 1.37], "k": [3.4, 2.35, 1.77] } })");
    EXPECT_GT(grey.b, grey.r);  // the probe's sky is blue
    EXPECT_LT(gold.b, grey.b - 20);
    EXPECT_LT(std::abs(gold.r - grey.r), std::abs(gold.b - grey.b) / 3);  // of one index at red
}

/// A shared library of every header and of all that the libraries hold. One translation unit: headers for themselves
/// would take two minutes.
constexpr const char* kSharedLibrary = R"(cmake_minimum_required(VERSION 3.25)
project(everything CXX)
find_package(Rowland REQUIRED)
get_target_property(folder Rowland::Core INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER folder INCLUDE REGEX "/rowland$")
file(GLOB_RECURSE headers RELATIVE ${folder} ${folder}/*.h)
foreach(header IN LISTS headers)
  file(CONFIGURE OUTPUT ${header}.cpp CONTENT "#include <${header}>\n")
  list(APPEND sources ${CMAKE_BINARY_DIR}/${header}.cpp)
endforeach()
get_property(targets DIRECTORY PROPERTY IMPORTED_TARGETS)
list(FILTER targets INCLUDE REGEX "^Rowland::")
add_library(everything SHARED ${sources})
set_target_properties(everything PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
list(TRANSFORM targets REPLACE ".+" "$<TARGET_FILE:\\0>" OUTPUT_VARIABLE archives)
target_link_libraries(everything PRIVATE -Wl,--whole-archive ${archives} -Wl,--no-whole-archive ${targets})
)";

TEST_F(PackageTest, EveryHeaderCompilesAndSharedLibrariesMayHoldEverything) {
    write_file_atomic(path("all/CMakeLists.txt"), std::string_view(kSharedLibrary));
    for (const std::string component : {"library", "runtime"}) {
        install(component);
        const auto configured = configure(path("all"));
        ASSERT_EQ(configured.code, 0) << configured.out << configured.err;
        run({ROWLAND_TEST_CMAKE, "--build", path("build")});
    }
}

TEST_F(PackageTest, ARuntimeThatIsNotInstalledIsSaid) {
    const auto configured = configure(test::content_path("examples/engine_scene").string());
    EXPECT_NE(configured.code, 0);
    EXPECT_THAT(configured.err, testing::HasSubstr("runtime"));
}

/// The comments of what is installed, as Doxygen reads them.
TEST(ApiReference, IsMadeWithoutAWarning) {
    if (test::run({"/bin/sh", "-c", "command -v doxygen"}).code != 0) GTEST_SKIP() << "no doxygen";
    const test::TemporaryFolder folder;
    const std::string command = "cd '" + test::source_path("").string() +
                                "' && (cat content/api/Doxyfile; echo 'OUTPUT_DIRECTORY = " + folder.path().string() +
                                "') | doxygen -";
    const test::Ended result = test::run({"/bin/sh", "-c", command});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "html" / "index.html"));
}

constexpr std::uint64_t kMostBytes = 1 << 20;

/// All files of a folder, one after the other.
std::string source_of(const char* folder) {
    std::string text;
    for (const auto& entry : std::filesystem::directory_iterator(test::content_path(folder)))
        if (entry.is_regular_file()) text += read_text_file(entry.path(), kMostBytes);
    return text;
}

/// The page that explains how to port shows the code of its examples as it is: C++ and GLSL of bare_gl, TypeScript of
/// the package for three.js.
TEST(PortingPage, EveryLineOfItsCodeIsTheExamples) {
    const std::string bare_gl = source_of("examples/bare_gl");
    const std::string three = source_of("web/three/src");
    std::istringstream page(read_text_file(test::source_path("modules/diffraction/PORTING.md"), kMostBytes));
    const std::string* source = nullptr;  // of the code that the line is of
    int lines = 0;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```")) {
            source = line == "```cpp" || line == "```glsl" ? &bare_gl : line == "```ts" ? &three : nullptr;
        } else if (source != nullptr && !line.empty()) {
            EXPECT_NE(source->find(line + "\n"), std::string::npos) << line;
            ++lines;
        }
    }
    EXPECT_GT(lines, 30);
}

}  // namespace
}  // namespace rowland

// The scenes that the demo shows, content/scenes/*.glb.
#include <gmock/gmock.h>

#include <algorithm>
#include <glm/common.hpp>
#include <set>

#include "tests/support/files.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

const char* const kExtension = "ROWLAND_materials_diffraction";

ImportedScene shipped(const std::string& name, const std::vector<std::string>& handled = {
                                                   kExtension, "KHR_materials_iridescence", "KHR_materials_ior"}) {
    return load_gltf(rowland::test::content_path("scenes/" + name + ".glb"), handled);
}

TEST(ShippedScene, LoadsWithoutWarnings) {
    for (const char* name : {"bench", "cabinet", "films", "lattices", "rooms", "sheets"}) {
        SCOPED_TRACE(name);
        const ImportedScene scene = shipped(name);
        EXPECT_TRUE(test::is_sane(scene));
        EXPECT_THAT(scene.warnings, testing::IsEmpty());
        EXPECT_FALSE(scene.cameras.empty());
    }
}

class Cabinet : public testing::Test {
 protected:
    ImportedScene scene_ = shipped("cabinet");
};

TEST_F(Cabinet, LoadsWhereTheGratingsAreUnknown) {
    const ImportedScene plain = shipped("cabinet", {});
    EXPECT_TRUE(test::is_sane(plain));
    EXPECT_THAT(plain.warnings, testing::ElementsAre(std::string("the extension ") + kExtension + " is ignored"));
}

TEST_F(Cabinet, HasFewEnoughVerticesForAFrame) {
    std::size_t vertices = 0;
    for (const ImportedInstance& instance : scene_.instances) vertices += scene_.meshes[instance.mesh].positions.size();
    EXPECT_GT(vertices, 60000U);
    EXPECT_LT(vertices, 120000U);
}

TEST_F(Cabinet, ObjectsHaveTheirRealSizes) {
    // Across an object as it lies in its own axes, in millimetres.
    const auto across = [&](const std::string& name) {
        glm::vec3 least(1e9F);
        glm::vec3 most(-1e9F);
        for (const ImportedInstance& instance : scene_.instances) {
            if (instance.name != name) continue;
            const Bounds box = bounds(scene_.meshes[instance.mesh]);
            least = glm::min(least, box.minimum);
            most = glm::max(most, box.maximum);
        }
        return 1000.0F * (most - least);
    };
    // Float rounding and 16 bits of quantisation, 2.3 µm on the record.
    EXPECT_NEAR(across("CD").x, 120.0F, 0.01F);
    EXPECT_NEAR(across("DVD").x, 120.0F, 0.01F);
    EXPECT_NEAR(across("record").x, 301.0F, 0.01F);
    EXPECT_NEAR(across("foil card").x, 85.6F, 0.01F);
    EXPECT_NEAR(across("foil card").z, 54.0F, 0.01F);
    EXPECT_NEAR(across("grating rule").x, 200.0F, 0.01F);
    EXPECT_NEAR(across("grating rule").z, 30.0F, 0.01F);
}

TEST_F(Cabinet, FoilVariesDirectionAndPitchByItsTexture) {
    const auto foil = std::find_if(scene_.materials.begin(), scene_.materials.end(), [](const MaterialDescription& m) {
        return m.extensions.contains(kExtension) && m.extensions.at(kExtension).contains("grooveTexture");
    });
    ASSERT_NE(foil, scene_.materials.end());
    const nlohmann::json& extension = foil->extensions.at(kExtension);
    const double pitch_nm = extension["grating"]["pitch_nm"].get<double>();
    const auto texture = extension["grooveTexture"]["index"].get<std::size_t>();
    const image::ByteImage& image = *scene_.images.at(scene_.textures.at(texture).image);
    std::set<int> directions;
    double finest = 1e9;
    double coarsest = 0.0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        directions.insert(image.rgba[i]);
        const double pitch = image.rgba[i + 1] / 255.0 * 2.0 * pitch_nm;
        finest = std::min(finest, pitch);
        coarsest = std::max(coarsest, pitch);
    }
    EXPECT_GT(directions.size(), 200U);
    EXPECT_GE(finest, 600.0);
    EXPECT_LE(finest, 650.0);
    EXPECT_GE(coarsest, 1450.0);
    EXPECT_LE(coarsest, 1550.0);
}

}  // namespace
}  // namespace rowland::scene

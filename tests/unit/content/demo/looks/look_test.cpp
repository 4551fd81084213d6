#include "content/demo/looks/look.h"

#include <gmock/gmock.h>

namespace rowland::demo {
namespace {

using testing::Contains;
using testing::Not;

LookSubject subject(const std::string& groove_lobe, bool flat) {
    const auto json = nlohmann::json::parse(
        R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}, "groove_lobe": )" +
        groove_lobe + R"(}, "quality": {"representation": "arc", "bands": 4, "illuminant": "A"}})");
    return {.material = diffraction::parse_material(json, "test"), .flat = flat};
}

std::vector<std::string> names(const LookSubject& subject) {
    std::vector<std::string> result;
    for (const Look& look : suitable_looks(subject, Detail::Medium)) result.push_back(look_name(look));
    return result;
}

TEST(Look, MapsAreOfferedToTheSurfacesTheySuit) {
    const auto flat = names(subject(R"("flat")", true));
    EXPECT_THAT(flat, Contains("planar, medium"));
    EXPECT_THAT(flat, Contains("circle, medium"));
    const auto curved = names(subject(R"("flat")", false));
    EXPECT_THAT(curved, Not(Contains("planar, medium")));
    EXPECT_THAT(curved, Contains("circle, medium"));
}

TEST(Look, NarrowLobesAreStreaksAndOnFlatSurfacesMaps) {
    const auto narrow = names(subject(R"({"sigma": 0.05})", true));
    EXPECT_THAT(narrow, Contains("streak, medium"));
    EXPECT_THAT(narrow, Contains("planar, medium"));
    EXPECT_THAT(narrow, Not(Contains("circle, medium")));
    EXPECT_THAT(names(subject(R"({"sigma": 0.05})", false)), Not(Contains("planar, medium")));
    EXPECT_THAT(names(subject(R"("flat")", true)), Not(Contains("streak, medium")));
}

TEST(Look, TheNextOneGoesRoundAllThatSuitAndComesBack) {
    const LookSubject cd = subject(R"("flat")", true);
    const std::vector<Look> all = suitable_looks(cd, Detail::Fine);
    ASSERT_GT(all.size(), 4U);
    Look look = all.front();
    EXPECT_TRUE(look.own());
    for (std::size_t i = 1; i <= all.size(); ++i) {
        look = next_representation(cd, look);
        EXPECT_EQ(look, all[i % all.size()]);
    }
}

TEST(Look, IsFoundByItsName) {
    for (const Detail detail : {Detail::Coarse, Detail::Medium, Detail::Fine})
        for (const bool flat : {false, true})
            for (const Look& look : suitable_looks(subject(R"("flat")", flat), detail)) {
                const auto found = parse_look(look_name(look));
                ASSERT_TRUE(found) << look_name(look);
                EXPECT_EQ(look_name(*found), look_name(look));
                EXPECT_EQ(found->representation, look.representation);
            }
    EXPECT_EQ(parse_look("arc, usual"), parse_look("arc, medium"));  // as recordings of earlier versions have it
    EXPECT_EQ(parse_look("arc"), std::nullopt);
    EXPECT_EQ(parse_look(""), std::nullopt);
}

TEST(Look, DetailGoesUpAndRound) {
    Look look{.representation = "arc", .detail = Detail::Coarse};
    EXPECT_EQ((look = next_detail(look)).detail, Detail::Medium);
    EXPECT_EQ((look = next_detail(look)).detail, Detail::Fine);
    EXPECT_EQ(next_detail(look).detail, Detail::Coarse);
}

TEST(Look, MoreDetailCostsMoreTables) {
    const LookSubject cd = subject(R"("flat")", true);
    for (const char* name : {"spikes", "arc", "planar", "circle"}) {
        std::size_t bytes = 0;
        for (const Detail detail : {Detail::Coarse, Detail::Medium, Detail::Fine}) {
            const auto material = apply_look(cd, {.representation = name, .detail = detail});
            ASSERT_TRUE(material) << name;
            const std::size_t now = diffraction::shading_cost(diffraction::bake_material(*material).tables).table_bytes;
            EXPECT_GT(now, bytes) << name << detail_name(detail);
            bytes = now;
        }
    }
}

TEST(Look, TakesTheRepresentationAndLeavesGratingAndIlluminant) {
    const LookSubject cd = subject(R"("flat")", true);
    const auto material = apply_look(cd, {.representation = "spikes"});
    ASSERT_TRUE(material);
    EXPECT_EQ(material->grating.pitch_nm, 1600.0);
    EXPECT_EQ(material->quality.illuminant.name, "A");
    EXPECT_TRUE(std::holds_alternative<diffraction::SpikeTableSettings>(diffraction::representation(*material)));
    EXPECT_TRUE(std::holds_alternative<diffraction::ArcSettings>(diffraction::representation(*apply_look(cd, Look{}))));
}

}  // namespace
}  // namespace rowland::demo

#include <numbers>

#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/representations/spikes/spikes.h"
#include "tests/support/files.h"
#include "tests/support/threads.h"
#include "tests/unit/modules/diffraction/gratings.h"
#include "tests/unit/modules/diffraction/representations/baked_views.h"

namespace rowland::diffraction {
namespace {

using test::compact_disc;
using test::foil;
using test::OracleCase;

SpikeSettings settings(int spikes, int bands = 5) {
    SpikeSettings result;
    result.spikes = spikes;
    result.bands = bands;
    return result;
}

/// PHYSICS §6: largest component error over largest component.
double largest_error(const OracleCase& one, const lighting::ShLight& light, int spikes) {
    const SpikeBaker baker(one.grating, settings(spikes));
    const std::vector<test::TangentView> views = test::tangent_views(light, one.frames);
    double error = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::dvec3 xyz = evaluate_spikes(baker.bake(views[i].view.x, views[i].view.y), views[i].light);
        for (int c = 0; c < 3; ++c) {
            error = std::max(error, std::abs(xyz[c] - one.xyz[i][c]));
            scale = std::max(scale, std::abs(one.xyz[i][c]));
        }
    }
    return error / scale;
}

/// What the method gives with these rules is 9.5 / 0.3 / 0.03 % (MEASUREMENTS §6, independently); held to 12 / 1 /
/// 0.1.
TEST(Spikes, ConvergeToTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    for (const OracleCase& one : test::read_cases(path)) {
        if (!one.name.starts_with("slit")) continue;
        EXPECT_LT(largest_error(one, light, 4), 0.12) << one.name;
        EXPECT_LT(largest_error(one, light, 16), 0.01) << one.name;
        EXPECT_LT(largest_error(one, light, 64), 0.001) << one.name;
    }
}

/// The intervals divide ∫ c q exactly: Σ_k c_k,i = ∫ c_i q dλ, whatever K.
TEST(Spikes, KeepTheIntegralOfEveryCoefficient) {
    const Grating grating = compact_disc();
    const ViewSpectrum spectrum(grating, 5);
    const auto q = [](double wavelength_nm) {
        const glm::dvec3 cmf = colour::cie_xyz(wavelength_nm);
        return colour::d65().power(wavelength_nm) * (cmf.x + cmf.y + cmf.z) / colour::luminous_power(colour::d65());
    };
    const std::vector<double> c = spectrum.coefficients(0.4, 0.1);
    for (const int count : {1, 4, 7, 64}) {
        const SpikeSet spikes = bake_spikes(grating, 0.4, 0.1, settings(count));
        ASSERT_EQ(spikes.wavelengths_nm.size(), static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < 25; ++i) {
            double integral = 0.0;
            for (std::size_t j = 0; j < kWavelengths; ++j)
                integral +=
                    (j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) * c[j * 25 + i] * q(380.0 + static_cast<double>(j));
            double sum = 0.0;
            for (std::size_t k = 0; k < spikes.wavelengths_nm.size(); ++k) sum += spikes.coefficients[k * 25 + i];
            EXPECT_NEAR(sum, integral, 1e-14) << "K " << count << " i " << i;  // ∫ q is 3, rounding of 400 terms of it
        }
    }
}

TEST(Spikes, WavelengthsAscendWithinTheVisibleRange) {
    for (const double v_g : {-0.99, -0.3, 0.0, 0.5, 1.0}) {
        const SpikeSet spikes = bake_spikes(compact_disc(), v_g, 0.0, settings(64));
        EXPECT_TRUE(std::is_sorted(spikes.wavelengths_nm.begin(), spikes.wavelengths_nm.end()));
        EXPECT_GE(spikes.wavelengths_nm.front(), 380.0);
        EXPECT_LE(spikes.wavelengths_nm.back(), 780.0);
    }
}

/// A step of 1e-9 in v_g moves arcs by as much; their ends turn with the square root, 3e-5. A wavelength that jumped
/// between whole nanometres would move by 1.
TEST(Spikes, AreContinuousInTheView) {
    for (const double v_g : {0.0, 0.1234, 0.5125, 0.7625}) {
        const SpikeSet here = bake_spikes(compact_disc(), v_g, 0.0, settings(4));
        const SpikeSet there = bake_spikes(compact_disc(), v_g + 1e-9, 0.0, settings(4));
        const double scale = std::abs(*std::max_element(here.coefficients.begin(), here.coefficients.end()));
        for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(here.wavelengths_nm[k], there.wavelengths_nm[k], 1e-3) << v_g;
        for (std::size_t i = 0; i < here.coefficients.size(); ++i)
            EXPECT_NEAR(here.coefficients[i], there.coefficients[i], 1e-4 * scale) << v_g;
    }
}

TEST(Spikes, ViewWithoutVisibleOrdersIsZeroWithFiniteWavelengths) {
    Grating blu_ray = compact_disc();
    blu_ray.pitch_nm = 320.0;
    blu_ray.profile = SlitProfile{160.0};
    blu_ray.orders = {-1, 1};
    Grating no_orders = compact_disc();
    no_orders.pitch_nm = 150.0;
    no_orders.orders = all_orders(no_orders.pitch_nm);
    for (const Grating& grating : {blu_ray, no_orders}) {
        const SpikeSet nothing = bake_spikes(grating, 0.0, 0.0, settings(4));
        for (const double c : nothing.coefficients) EXPECT_EQ(c, 0.0);
        for (const double wavelength_nm : nothing.wavelengths_nm) EXPECT_TRUE(std::isfinite(wavelength_nm));
    }
    // Where order 1 first shows violet (380/320 − v_g = 1), wavelengths come from there without a jump.
    const double edge = 380.0 / 320.0 - 1.0;
    const SpikeSet before = bake_spikes(blu_ray, edge - 1e-12, 0.0, settings(4));
    const SpikeSet after = bake_spikes(blu_ray, edge + 1e-12, 0.0, settings(4));
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(before.wavelengths_nm[k], after.wavelengths_nm[k], 2.0);
}

/// Lines of a lamp: a spike must not land in the dark between them, whose colour the lamp has not.
TEST(Spikes, FollowALampOfTwoLines) {
    SpikeSettings two_lines = settings(3);
    two_lines.illuminant = colour::parse_illuminant(
        "wavelength_nm,relative_power\n449,0\n450,1\n451,0\n649,0\n650,1\n651,0\n", "two lines");
    const SpikeSet spikes = bake_spikes(compact_disc(), 0.2, 0.0, two_lines);
    for (const double wavelength_nm : spikes.wavelengths_nm) EXPECT_GT(two_lines.illuminant.power(wavelength_nm), 0.0);
}

/// Low-pressure sodium's D lines, as a meter of 1 nm sees them.
colour::Illuminant sodium() {
    return colour::parse_illuminant("wavelength_nm,relative_power\n588,0\n589,1\n590,0\n", "sodium");
}

glm::dvec2 chromaticity(const glm::dvec3& xyz) {
    return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

/// One wavelength has one colour, from whatever view: 1e-3 in xy is what an eye might see. And it is dark where no
/// order sends 589 nm.
TEST(Spikes, UnderSodiumAreSodiumYellowOrBlack) {
    SpikeSettings lamp = settings(4);
    lamp.illuminant = sodium();
    const SpikeBaker baker(compact_disc(), lamp);
    // A lobe of light about n, so that some views see an order of it and others none.
    lighting::ShLight light{5, std::vector<glm::dvec3>(25, glm::dvec3(0.0))};
    for (int l = 0; l < 5; ++l)
        light.coefficients[static_cast<std::size_t>(math::sh_index(l, 0))] = glm::dvec3(1.0, 0.9, 0.8);
    const glm::dvec2 yellow = chromaticity(colour::cie_xyz(589.0));
    Grating first_only = compact_disc();
    first_only.orders = {1};
    first_only.pitch_nm = 400.0;  // order 1 comes from s_g = 589/400 − v_g: for v_g < .47 from nowhere
    first_only.profile = SlitProfile{200.0};
    const SpikeBaker narrow(first_only, lamp);
    for (int i = 0; i < 40; ++i) {
        const double v_g = -0.975 + 0.05 * i;
        const glm::dvec3 xyz = evaluate_spikes(baker.bake(v_g, 0.0), light);
        ASSERT_GT(std::abs(xyz.y), 0.0) << v_g;
        EXPECT_NEAR(chromaticity(xyz).x, yellow.x, 1e-3) << v_g;
        EXPECT_NEAR(chromaticity(xyz).y, yellow.y, 1e-3) << v_g;
        const glm::dvec3 one = evaluate_spikes(narrow.bake(v_g, 0.0), light);
        if (v_g < 0.47) {
            EXPECT_EQ(one, glm::dvec3(0.0)) << v_g;
        } else if (v_g > 0.5) {
            EXPECT_GT(std::abs(one.x), 1e-5) << v_g;
        }
    }
}

TEST(Spikes, FewGroovesAreRefused) {
    Grating few = compact_disc();
    few.grooves = 20.0;
    EXPECT_THROW(bake_spikes(few, 0.0, 0.0, settings(4)), Error);
}

/// Uniform light sees Y_00 alone: more bands of it change nothing.
TEST(Spikes, LightWithFewerBandsThanTheMaterialIsTheSameLight) {
    const SpikeSet spikes = bake_spikes(compact_disc(), 0.3, 0.0, settings(4));
    lighting::ShLight narrow{1, {glm::dvec3(1.0, 2.0, 3.0)}};
    lighting::ShLight wide{5, std::vector<glm::dvec3>(25, glm::dvec3(0.0))};
    wide.coefficients[0] = narrow.coefficients[0];
    EXPECT_EQ(evaluate_spikes(spikes, narrow), evaluate_spikes(spikes, wide));
}

using std::numbers::pi;

SpikeTableSettings small(Storage storage) {
    SpikeTableSettings settings;
    settings.grid.rows = 5;
    settings.grid.columns = 8;
    settings.spikes.spikes = 3;
    settings.spikes.bands = 4;
    settings.storage = storage;
    return settings;
}

/// Half a step of 16 bits over the component's range; a half float in [−1, 1] has 11 bits, so half a step is 2⁻¹² of
/// half the range.
double largest_storage_error(const SpikeTable& table, std::size_t layer, glm::vec4::length_type component) {
    const double scale = static_cast<double>(table.scale[layer][component]);
    const double bias = std::abs(static_cast<double>(table.bias[layer][component]));
    const double float_rounding = 1e-6 * (scale + bias);
    return (table.storage == Storage::Half ? scale / 4096.0 : 0.5 * scale / 65535.0) + float_rounding;
}

TEST(SpikeTable, HasTheLayoutTheShaderReads) {
    const SpikeTableSettings settings = small(Storage::Unorm16);
    const SpikeTable table = bake(foil(), settings);
    EXPECT_EQ(table.layers_per_spike(), 5);  // 16 coefficients and a wavelength: 17 entries in fours
    EXPECT_EQ(table.layers(), 15);
    EXPECT_EQ(table.texels.size(), 15U * 5U * 8U * 4U);
    EXPECT_EQ(table.scale.size(), 15U);
    // Spike 2, coefficient 6, row 3, column 1: layer 2·5 + 1, component 2.
    const double theta = 0.5 * pi * 3 / 4;
    const double phi = 2.0 * pi / 8;
    const SpikeSet exact =
        bake_spikes(foil(), std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), settings.spikes);
    const std::size_t layer = 11;
    const double stored = table.texels[((layer * 5 + 3) * 8 + 1) * 4 + 2] / 65535.0;
    EXPECT_NEAR(stored * static_cast<double>(table.scale[layer][2]) + static_cast<double>(table.bias[layer][2]),
                exact.coefficients[2 * 16 + 6], largest_storage_error(table, layer, 2));
}

TEST(SpikeTable, FiltersLinearlyBetweenNodesAndAcrossTheSeam) {
    const SpikeTable table = bake(foil(), small(Storage::Unorm16));
    const double theta = 0.5 * pi * 2 / 4;
    const auto at = [&](double phi) {
        return sample(table, std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    };
    // A quarter of the way from column 7 to column 0, across φ = 2π.
    const double step = 2.0 * pi / 8;
    const SpikeSet between = at(7.25 * step);
    const SpikeSet left = at(7.0 * step);
    const SpikeSet right = at(0.0);
    for (std::size_t i = 0; i < between.coefficients.size(); ++i)
        EXPECT_NEAR(between.coefficients[i], 0.75 * left.coefficients[i] + 0.25 * right.coefficients[i], 1e-12);
}

TEST(SpikeTable, ViewBelowTheHorizonIsBlack) {
    const SpikeTable table = bake(foil(), small(Storage::Unorm16));
    const SpikeSet spikes = sample(table, 0.6, 0.0, -0.8);
    for (const double c : spikes.coefficients) EXPECT_EQ(c, 0.0);
    for (const double wavelength_nm : spikes.wavelengths_nm) EXPECT_TRUE(std::isfinite(wavelength_nm));
}

TEST(SpikeTable, BytesDoNotDependOnTheNumberOfThreads) {
    rowland::test::expect_same_on_any_threads([] { return test::written(bake(foil(), small(Storage::Unorm16))); });
}

/// The default table on the named frames, under the oracle's light: 0.05 % on real probes (measured), 0.5 % allowed.
TEST(SpikeTable, DefaultResolutionKeepsTheNamedFrames) {
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const SpikeTable table = bake(compact_disc(), SpikeTableSettings());
    const SpikeBaker baker(compact_disc(), SpikeSettings());
    std::vector<glm::dvec3> exact;
    std::vector<glm::dvec3> sampled;
    for (const test::TangentView& at :
         test::tangent_views(light, test::read_frames(rowland::test::read_csv(frames_path)))) {
        exact.push_back(evaluate_spikes(baker.bake(at.view.x, at.view.y), at.light));
        sampled.push_back(evaluate_spikes(sample(table, at.view.x, at.view.y, at.view.z), at.light));
    }
    EXPECT_LT(test::relative_rms(sampled, exact), 0.005);
}

/// The other mappings and storages, with one test's words: a node is its own view, a row of v_g for the flat lobe.
TEST(SpikeTable, TakesEveryMappingAndStorage) {
    for (const Storage storage : {Storage::Unorm16, Storage::Half, Storage::Float, Storage::Unorm8}) {
        SpikeTableSettings settings = small(storage);
        settings.grid.mapping = ViewMapping::Parabolic;
        const SpikeTable table = bake(foil(), settings);
        const glm::dvec2 v = node_view(table.grid, 5, 1);
        const SpikeSet exact = bake_spikes(foil(), v.x, v.y, settings.spikes);
        const SpikeSet stored = sample(table, v.x, v.y, std::sqrt(1.0 - glm::dot(v, v)));
        for (std::size_t i = 0; i < exact.coefficients.size(); ++i) {
            const auto layer = i / 16 * static_cast<std::size_t>(table.layers_per_spike()) + i % 16 / 4;
            const double range = static_cast<double>(table.scale[layer][static_cast<int>(i % 4)]);
            EXPECT_NEAR(stored.coefficients[i], exact.coefficients[i],
                        storage == Storage::Unorm8  ? 0.51 / 255.0 * range
                        : storage == Storage::Float ? 1e-7
                                                    : 3e-4 * range);
        }
        for (std::size_t k = 0; k < exact.wavelengths_nm.size(); ++k)
            EXPECT_NEAR(stored.wavelengths_nm[k], exact.wavelengths_nm[k], storage == Storage::Unorm8 ? 0.8 : 0.1);
        const auto bytes = test::written(table);
        ByteReader reader(bytes, "table");
        const SpikeTable back = read_spike_table(reader);
        EXPECT_EQ(back.grid.mapping, ViewMapping::Parabolic);
        EXPECT_EQ(back.storage, storage);
        EXPECT_EQ(back.texels, table.texels);
    }
    SpikeTableSettings line = small(Storage::Float);
    line.grid.mapping = ViewMapping::OneDimensional;
    line.grid.rows = 1;
    EXPECT_THROW(bake(foil(), line), Error);
}

TEST(SpikeTable, HasSoundBytes) {
    for (const Storage storage : {Storage::Half, Storage::Unorm16})
        test::expect_sound_bytes(bake(foil(), small(storage)), read_spike_table);
}

TEST(SpikeTable, RefusesScalesThatAreNotFinite) {
    SpikeTable table = bake(foil(), small(Storage::Unorm16));
    table.scale[3].y = std::numeric_limits<float>::infinity();
    const auto bytes = test::written(table);
    ByteReader reader(bytes, "table");
    EXPECT_THROW(read_spike_table(reader), Error);
}

}  // namespace
}  // namespace rowland::diffraction

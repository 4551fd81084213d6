#include "modules/diffraction/asset/cooked_material.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "engine/asset/container.h"
#include "engine/colour/illuminant.h"
#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/rigorous/efficiencies.h"

namespace rowland::diffraction {

namespace {

/// In place of an index of tables: the rung has the material's own.
constexpr std::uint32_t kOwnTables = 0xffffffff;

/// More files than a material can name.
constexpr std::uint32_t kMostNamedTexts = 16;

}  // namespace

NamedTexts named_texts(const nlohmann::json& json, const Material& material) {
    NamedTexts texts;
    if (const auto* efficiencies = std::get_if<EfficiencyTable>(&material.grating.profile))
        texts[json["grating"]["profile"]["file"].get<std::string>()] = write_efficiency_csv(*efficiencies);
    if (const auto& lattice = material.grating.lattice)
        if (const auto* heights = std::get_if<HeightMap>(&lattice->profile))
            texts[json["grating"]["profile"]["file"].get<std::string>()] = write_height_map(*heights);
    const colour::Illuminant& illuminant = material.quality.illuminant;
    if (illuminant.name.ends_with(".csv")) texts[illuminant.name] = write_illuminant_csv(illuminant);
    return texts;
}

namespace {

void write_named(const NamedTexts& texts, ByteWriter& writer) {
    writer.value(static_cast<std::uint32_t>(texts.size()));
    for (const auto& [name, text] : texts) {
        writer.text(name);
        writer.text(text);
    }
}

NamedTexts read_named(ByteReader& reader) {
    const auto count = reader.value<std::uint32_t>();
    if (count > kMostNamedTexts)
        reader.fail(fmt::format("{} files", count), fmt::format("at most {}", kMostNamedTexts));
    NamedTexts texts;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string name = reader.text();
        texts[std::move(name)] = reader.text();
    }
    return texts;
}

ReadNamed read_among(NamedTexts texts, const std::string& file) {
    return [texts = std::move(texts), file](const std::string& name) {
        const auto found = texts.find(name);
        if (found == texts.end())
            refuse_input(file, name, "nothing", "the file that the material names", "cook the material again");
        return NamedText{.text = found->second, .file = fmt::format("{}: {}", file, name)};
    };
}

constexpr std::size_t kMostKernelEntries = 1 << 16;
/// Larger than the path differences of all orders that a material may list.
constexpr double kFarthestKernel_nm = 1e9;

void write_kernel(const KernelTable& kernel, ByteWriter& writer) {
    writer.value(kernel.begin_nm);
    writer.value(kernel.end_nm);
    writer.value(kernel.error);
    write_matrices(kernel.antiderivative, writer);
}

KernelTable read_kernel(ByteReader& reader) {
    KernelTable kernel;
    kernel.begin_nm = reader.value<double>();
    kernel.end_nm = reader.value<double>();
    kernel.error = reader.value<double>();
    // Written so that a NaN fails.
    if (!(kernel.begin_nm >= -kFarthestKernel_nm && kernel.begin_nm <= kernel.end_nm &&
          kernel.end_nm <= kFarthestKernel_nm && std::isfinite(kernel.error)))
        reader.fail(fmt::format("a kernel from {} to {} nm", kernel.begin_nm, kernel.end_nm),
                    fmt::format("an ascending interval within {} nm", kFarthestKernel_nm));
    kernel.antiderivative = read_matrices(reader, "kernel entries", 2, kMostKernelEntries);
    return kernel;
}

/// More orders than visible light has at the coarsest pitch that is solved.
constexpr std::size_t kMostGridOrders = 256;

/// Writes the efficiencies of rigorous theory; those of a table follow from the table.
void write_efficiencies(const Grating& grating, ByteWriter& writer) {
    if (grating.theory == Theory::Scalar) return;
    const EfficiencyGrid& grid = *grating.efficiencies;
    writer.value(static_cast<std::uint32_t>(grid.orders.size()));
    writer.value(static_cast<std::int32_t>(grid.orders.front()));
    for (const float value : grid.values) writer.value(value);
}

void read_efficiencies(ByteReader& reader, Grating& grating) {
    if (grating.theory == Theory::Scalar) return;
    const auto count = reader.value<std::uint32_t>();
    const auto first = reader.value<std::int32_t>();
    if (count == 0 || count > kMostGridOrders || first < -kHighestOrder || first > 0)
        reader.fail(fmt::format("{} orders from {}", count, first), fmt::format("1 to {}", kMostGridOrders));
    std::vector<int> orders(count);
    std::iota(orders.begin(), orders.end(), first);
    EfficiencyGrid grid = empty_grid(grating.pitch_nm, std::move(orders));
    for (float& value : grid.values) {
        value = reader.value<float>();
        if (!(value >= 0.0F && value <= 1.0F + kRowSumTolerance))
            reader.fail(fmt::format("an efficiency of {}", value), "0 to 1");
    }
    grating.efficiencies = std::make_shared<const EfficiencyGrid>(std::move(grid));
}

void write_baked(const CookedMaterial& cooked, ByteWriter& writer) {
    // A kernel of several views takes a hundred times the memory of the efficiencies from which it follows.
    if (!depends_on_direction(cooked.material.grating)) write_kernel(cooked.kernel, writer);
    const glm::mat3 zero_order(cooked.zero_order_xyz);
    write_matrices({&zero_order, 1}, writer);
    write_tables(cooked.tables, writer);
}

/// What write_baked() writes, for cooked.material.
void read_baked(ByteReader& reader, CookedMaterial& cooked) {
    cooked.kernel =
        depends_on_direction(cooked.material.grating)
            ? kernel_table(cooked.material.grating, colour::LightSpectra(cooked.material.quality.illuminant))
            : read_kernel(reader);
    cooked.zero_order_xyz = glm::dmat3(read_matrices(reader, "zero order", 1, 1)[0]);
    cooked.tables = read_tables(reader, representation(cooked.material));
}

}  // namespace

Material with_efficiencies(Material material, const std::string& file) {
    if (!is_solved(material.grating)) material.grating.efficiencies = rigorous_efficiencies(material.grating, file);
    return material;
}

void require_baked_grooves(const Grating& grating, const std::string& file) {
    if (const auto refused = baked_refusal(grating))
        refuse_input(file, refused->key, refused->found, refused->expected, refused->remedy);
}

CookedMaterial bake_kernel(const Material& material) {
    const colour::LightSpectra spectra(material.quality.illuminant);
    const ColourKernel kernel(material.grating, spectra);
    CookedMaterial cooked{.material = material,
                          .tables = DirectTables{},
                          .kernel = kernel_table(material.grating, spectra),
                          .zero_order_xyz = kernel.zero_order_xyz()};
    if (cooked.kernel.views == 1) cooked.kernel.error = interpolation_error(cooked.kernel, kernel);
    return cooked;
}

CookedMaterial bake_material(const Material& material) {
    CookedMaterial cooked = bake_kernel(material);
    cooked.tables = bake_tables(material.grating, representation(material));
    cooked.reflected = bake_reflected_side(material);
    return cooked;
}

CookedMaterial as_rung(const CookedMaterial& cooked, const CookedRung& rung) {
    CookedMaterial drawn = cooked;
    drawn.cheaper.clear();
    drawn.material.quality = rung.quality;
    drawn.measured = rung.measured;
    if (rung.baked) drawn.tables = rung.baked->tables;
    if (!drawn.reflected) return drawn;
    auto side = std::make_shared<CookedMaterial>(*drawn.reflected);
    side->material.quality = rung.quality;
    if (rung.baked) side->tables = rung.baked->reflected->tables;
    drawn.reflected = std::move(side);
    return drawn;
}

std::shared_ptr<const CookedMaterial> bake_reflected_side(const Material& material) {
    const std::optional<Grating> side = reflected_side(material.grating);
    if (!side) return nullptr;
    Material reflecting = material;
    reflecting.grating = *side;
    return std::make_shared<const CookedMaterial>(bake_material(reflecting));
}

CookedMaterial cook_material(const nlohmann::json& json, const std::string& file, const ReadNamed& read) {
    const Material material = with_efficiencies(parse_material(json, file, read), file);
    require_baked_grooves(material.grating, file);
    return bake_material(material);
}

CookedMaterial cook_material(const nlohmann::json& json, const std::string& file) {
    return cook_material(json, file, read_beside(std::filesystem::path(file).parent_path()));
}

void check_method(const nlohmann::json& json, const std::string& file, const Method& method) {
    require_baked_grooves(parse_material(with_method(json, method), file).grating, file);
}

CookedMaterial cook(const nlohmann::json& json, const std::string& file, const Method& method) {
    return cook_material(with_method(json, method), file);
}

namespace {

/// Tables that several rungs share are written with the first of them.
void write_rungs(const CookedMaterial& cooked, ByteWriter& writer) {
    std::vector<const CookedMaterial*> written;
    writer.value(static_cast<std::uint32_t>(cooked.cheaper.size()));
    for (const CookedRung& rung : cooked.cheaper) {
        writer.text(rung.settings.dump());
        writer.text(write_budget_record(rung.measured));
        const auto found = std::ranges::find(written, rung.baked.get());
        writer.value(rung.baked ? static_cast<std::uint32_t>(found - written.begin()) : kOwnTables);
        if (!rung.baked || found != written.end()) continue;
        written.push_back(rung.baked.get());
        write_tables(rung.baked->tables, writer);
        if (rung.baked->reflected) write_tables(rung.baked->reflected->tables, writer);
    }
}

/// A rung's tables, for the material and the other side of `like`. The kernels are left empty.
std::shared_ptr<const CookedMaterial> read_rung_tables(ByteReader& reader, const Quality& quality,
                                                       const CookedMaterial& like) {
    const auto read = [&](const Material& material) {
        auto side = std::make_shared<CookedMaterial>();
        side->material = material;
        side->material.quality = quality;
        side->tables = read_tables(reader, representation(side->material));
        return side;
    };
    const auto baked = read(like.material);
    if (like.reflected) baked->reflected = read(like.reflected->material);
    return baked;
}

void read_rungs(ByteReader& reader, const nlohmann::json& json, const ReadNamed& read, CookedMaterial& cooked) {
    const auto count = reader.value<std::uint32_t>();
    if (count >= kMostRungs) reader.fail(fmt::format("{} rungs", count + 1), fmt::format("at most {}", kMostRungs));
    std::vector<std::shared_ptr<const CookedMaterial>> tables;
    for (std::uint32_t i = 0; i < count; ++i) {
        CookedRung rung{
            .settings = parse_json(reader.text(), reader.file()), .quality = {}, .baked = {}, .measured = {}};
        nlohmann::json with = json;
        with["quality"] = rung.settings;
        rung.quality = parse_material(with, reader.file(), read).quality;
        if (!rung.quality.pinned) reader.fail(rung.settings.dump(), "a representation");
        rung.quality.illuminant = cooked.material.quality.illuminant;
        rung.measured = parse_budget_record(reader.text(), reader.file());
        const auto index = reader.value<std::uint32_t>();
        if (index > tables.size() && index != kOwnTables)
            reader.fail(fmt::format("tables {}", index), fmt::format("at most {}", tables.size()));
        if (index == tables.size()) tables.push_back(read_rung_tables(reader, rung.quality, cooked));
        if (index != kOwnTables) rung.baked = tables[index];
        const BakedTables& drawn = rung.baked ? rung.baked->tables : cooked.tables;
        if (&info(drawn) != &info(*rung.quality.pinned))
            reader.fail(fmt::format("tables of {}", info(drawn).name), "those of the rung's representation");
        cooked.cheaper.push_back(std::move(rung));
    }
}

void write_material(const nlohmann::json& json, const CookedMaterial& cooked, ByteWriter& writer) {
    writer.text(json.dump());
    write_named(named_texts(json, cooked.material), writer);
    write_efficiencies(cooked.material.grating, writer);
    write_baked(cooked, writer);
    if (cooked.reflected) write_baked(*cooked.reflected, writer);
    writer.text(cooked.measured ? write_budget_record(*cooked.measured) : std::string());
    write_rungs(cooked, writer);
}

/// `pitches`: of the groove texture that the tables are for; null: none.
CookedMaterial read_material(ByteReader& reader, const GroovePitches* pitches) {
    const std::string& file = reader.file();
    CookedMaterial cooked;
    const nlohmann::json json = parse_json(reader.text(), file);
    const ReadNamed named = read_among(read_named(reader), file);
    cooked.material = parse_material(json, file, named);
    read_efficiencies(reader, cooked.material.grating);
    if (pitches != nullptr) {
        if (groove_refusal(cooked.material, *pitches)) reader.fail("a groove texture", "none for this representation");
        cooked.material = suited_to_grooves(std::move(cooked.material), *pitches);
    }
    read_baked(reader, cooked);
    if (const auto side = reflected_side(cooked.material.grating)) {
        auto reflected = std::make_shared<CookedMaterial>();
        reflected->material = cooked.material;
        reflected->material.grating = *side;
        read_baked(reader, *reflected);
        cooked.reflected = std::move(reflected);
    }
    if (const std::string record = reader.text(); !record.empty()) cooked.measured = parse_budget_record(record, file);
    read_rungs(reader, json, named, cooked);
    if (reader.remaining() != 0) reader.fail(fmt::format("{} bytes too many", reader.remaining()), "the end");
    return cooked;
}

}  // namespace

std::vector<std::byte> write_cooked_material(const nlohmann::json& json, const CookedMaterial& cooked) {
    ByteWriter writer;
    write_material(json, cooked, writer);
    return writer.take();
}

CookedMaterial read_cooked_material(std::span<const std::byte> payload, const std::string& file) {
    ByteReader reader(payload, file);
    return read_material(reader, nullptr);
}

std::vector<std::byte> write_gltf_tables(const nlohmann::json& json, const CookedMaterial& cooked,
                                         const GroovePitches& pitches) {
    ByteWriter writer;
    writer.value(pitches.smallest);
    writer.value(pitches.largest);
    write_material(json, cooked, writer);
    return writer.take();
}

CookedMaterial read_gltf_tables(std::span<const std::byte> tables, const std::string& file) {
    ByteReader reader(tables, file);
    GroovePitches pitches;
    pitches.smallest = reader.value<double>();
    pitches.largest = reader.value<double>();
    if (!(pitches.smallest > 0.0 && pitches.smallest <= pitches.largest && pitches.largest <= 2.0))
        reader.fail(fmt::format("pitches from {} to {}", pitches.smallest, pitches.largest), "0 < ascending <= 2");
    return read_material(reader, pitches.vary() ? &pitches : nullptr);
}

CookedMaterial load_cooked_material(const std::filesystem::path& path) {
    return read_cooked_material(asset::load(path, kMaterialAssetType, kMaterialAssetVersion).payload, path.string());
}

namespace {

/// "name: value" lines.
class Lines {
 public:
    template <typename Value>
    void add(const char* name, const Value& value) {
        fmt::format_to(std::back_inserter(text_), "{}: {}\n", name, value);
    }
    std::string take() { return std::move(text_); }

 private:
    std::string text_;
};

void add_cost(const ShadingCost& cost, Lines& lines) {
    lines.add("table_bytes", cost.table_bytes);
    lines.add("fetches_per_vertex", cost.fetches_per_vertex);
    lines.add("multiply_adds_per_vertex", cost.multiply_adds_per_vertex);
    lines.add("fetches_per_pixel", cost.fetches_per_pixel);
    lines.add("multiply_adds_per_pixel", cost.multiply_adds_per_pixel);
    lines.add("fetches_per_pixel_and_light", cost.fetches_per_light);
    lines.add("multiply_adds_per_pixel_and_light", cost.multiply_adds_per_light);
}

void add_record(const BudgetRecord& record, Lines& lines) {
    const double largest = record.largest_error();
    if (!record.has_budget())
        lines.add("max_error", "none: the representation is pinned");
    else if (largest > record.max_error)
        lines.add("max_error", fmt::format("{}, missed: this is the best that can be reached", record.max_error));
    else
        lines.add("max_error", record.max_error);
    lines.add("measure", error_measure_name(record.measure));
    lines.add("measured_on", fmt::format("{} surface, {} frames", surface_shape_name(record.surface), record.frames));
    for (const BudgetRecord::OfProbe& probe : record.probes)
        lines.add("measured_error",
                  fmt::format("{:.5f} under {} with {} key lights", probe.error, probe.probe, probe.key_lights));
    lines.add("largest_error", fmt::format("{:.5f}", largest));
    lines.add("price", fmt::format("{:.4g} fetches per pixel", record.price));
}

}  // namespace

std::string describe(const CookedMaterial& cooked) {
    const Grating& grating = cooked.material.grating;
    const LayerWeights weights = layer_weights(grating, cooked.material.quality.illuminant);
    Lines lines;
    if (const auto& lattice = grating.lattice) {
        lines.add("a_nm", fmt::format("{} {}", lattice->a_nm.x, lattice->a_nm.y));
        lines.add("b_nm", fmt::format("{} {}", lattice->b_nm.x, lattice->b_nm.y));
        lines.add("orders", lattice->orders);
    } else {
        lines.add("pitch_nm", grating.pitch_nm);
        lines.add("orders", fmt::format("{}", fmt::join(grating.orders, " ")));
    }
    lines.add("representation", info(cooked.tables).name);
    lines.add("illuminant", cooked.material.quality.illuminant.name);
    if (const int most = cooked.material.quality.key_lights; most == lighting::kMaximumKeyLights)
        lines.add("key_lights", "all");
    else
        lines.add("key_lights", fmt::format("{} at most", most));
    for (const auto& [name, value] : std::visit([](const auto& tables) { return facts(tables); }, cooked.tables))
        lines.add(name.c_str(), value);
    add_cost(shading_cost(cooked.tables, cooked.material.quality.map_at_vertices), lines);
    if (cooked.measured) add_record(*cooked.measured, lines);
    for (const CookedRung& rung : cooked.cheaper)
        lines.add("cheaper", fmt::format("{:.4g} fetches per pixel, error {:.5f}: {}", rung.measured.price,
                                         rung.measured.largest_error(), rung.settings.dump()));
    lines.add("zero_order_luminance", fmt::format("{:.4f}", weights.mirror.y));
    lines.add("base_luminance", fmt::format("{:.4f}", weights.base.y));
    return lines.take();
}

}  // namespace rowland::diffraction

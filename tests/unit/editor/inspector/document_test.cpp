#include "editor/inspector/document.h"

#include <gmock/gmock.h>

#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"

namespace rowland::inspector {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::filesystem::path kMaterials = test::content_path("materials");

const Field& pitch() {
    return field_at("/grating/pitch_nm");
}

class DocumentTest : public test::FolderTest {
 protected:
    Document opened() const {
        std::filesystem::copy_file(kMaterials / "cd.json", path("cd.json"));
        return Document::open(path("cd.json"));
    }
};

TEST_F(DocumentTest, OpeningAndSavingChangesNoByte) {
    Document document = opened();
    EXPECT_FALSE(document.dirty());
    const std::string before = text("cd.json");
    document.save();
    EXPECT_EQ(text("cd.json"), before);
}

TEST_F(DocumentTest, AnEditIsInTheFileAfterSavingAndNotBefore) {
    Document document = opened();
    document.set_value(pitch(), 740);
    document.set_choice(field_at("/grating/profile"), "blazed");
    EXPECT_TRUE(document.dirty());
    EXPECT_EQ(diffraction::load_material(path("cd.json")).grating.pitch_nm, 1600.0);
    document.save();
    EXPECT_FALSE(document.dirty());
    const diffraction::Material material = diffraction::load_material(path("cd.json"));
    EXPECT_EQ(material.grating.pitch_nm, 740.0);
    EXPECT_TRUE(std::holds_alternative<diffraction::BlazedProfile>(material.grating.profile));
    EXPECT_EQ(Document::open(path("cd.json")).json(), document.json());
}

TEST_F(DocumentTest, AFilmIsEditedTakenBackRefusedAndSaved) {
    std::filesystem::copy_file(kMaterials / "anodised_titanium.json", path("film.json"));
    Document document = Document::open(path("film.json"));
    EXPECT_TRUE(document.has_film() && !document.has_grating());
    const auto thickness_nm = [](const Document& of) {
        return std::get<thin_film::FilmMaterial>(of.accepted()->parsed).range.thickest_nm;
    };
    EXPECT_EQ(thickness_nm(document), 45.0);
    document.set_value(field_at("/film/thickness_nm"), 60);
    document.finish_edit();
    document.set_choice(*shown_field("/metal", document.json()), "Al");
    document.set_value(*shown_field("/roughness", document.json()), 2);
    ASSERT_TRUE(document.refusal());
    EXPECT_EQ(document.refusal()->field, shown_field("/roughness", document.json()));
    EXPECT_THROW(document.save(), Error);
    document.undo();
    document.save();
    const Document again = Document::open(path("film.json"));
    EXPECT_EQ(again.json(), document.json());
    EXPECT_EQ(again.json()["metal"], "Al");
    EXPECT_EQ(thickness_nm(again), 60.0);
}

TEST_F(DocumentTest, ALatticeIsEditedTakenBackRefusedAndSaved) {
    for (const char* name : {"butterfly_wing.json", "wing_cell.png"})
        std::filesystem::copy_file(kMaterials / name, path(name));
    Document document = Document::open(path("butterfly_wing.json"));
    const Json start = document.json();
    const auto field = [&](const char* pointer) -> const Field& {
        const Field* shown = shown_field(pointer, document.json());
        return shown != nullptr ? *shown : field_at(pointer);
    };
    EXPECT_EQ(value_of(field("/grating/profile/file"), document.json()), "wing_cell.png");
    document.set_value(field("/grating/profile/depth_nm"), 250);
    document.set_value(field("/grating/lattice/a_nm"), {600.0, 12.5});
    EXPECT_EQ(document.json()["grating"]["lattice"].dump(), R"({"a_nm":[600,12.5],"b_nm":[250,1300]})");
    EXPECT_EQ(document.material().grating.lattice->a_nm, glm::dvec2(600.0, 12.5));
    document.finish_edit();

    document.set_value(field("/grating/lattice/a_nm"), {500.0, 2600.0});  // along b
    ASSERT_TRUE(document.refusal());
    EXPECT_EQ(document.refusal()->field, &field("/grating/lattice/b_nm"));
    EXPECT_THAT(document.refusal()->message, HasSubstr("degrees between a and b"));
    document.undo();
    document.set_value(field("/grating/profile/file"), "missing.png");
    ASSERT_TRUE(document.refusal());
    EXPECT_EQ(document.refusal()->field, &field("/grating/profile/file"));
    document.undo();

    document.set_choice(field("/grating/profile"), "crossed");
    document.set_choice(field("/grating/profile/along_b"), "lamellar");
    document.set_value(field("/grating/profile/along_b/duty"), 0.25);
    document.set_value(field("/grating/orders"), 4);
    EXPECT_FALSE(document.refusal());
    document.save();
    const diffraction::Material saved = diffraction::load_material(path("butterfly_wing.json"));
    const auto& crossed = std::get<diffraction::CrossedProfile>(saved.grating.lattice->profile);
    EXPECT_EQ(std::get<diffraction::LamellarProfile>(crossed.along_b).duty, 0.25);
    EXPECT_EQ(saved.grating.lattice->orders, 4);
    while (document.can_undo()) document.undo();
    EXPECT_EQ(document.json(), start);
}

TEST_F(DocumentTest, EveryEditIsTakenBackInTurn) {
    Document document = opened();
    const Json start = document.json();
    document.set_value(pitch(), 900);
    document.finish_edit();
    document.set_value(pitch(), 1200);
    document.set_choice(field_at("/metal"), "Au");
    const Json end = document.json();
    document.undo();
    document.undo();
    EXPECT_EQ(document.material().grating.pitch_nm, 900.0);
    document.undo();
    EXPECT_EQ(document.json(), start);
    EXPECT_FALSE(document.can_undo());
    document.undo();
    EXPECT_EQ(document.json(), start);
    for (int i = 0; i < 3; ++i) document.redo();
    EXPECT_EQ(document.json(), end);
    EXPECT_FALSE(document.can_redo());
    document.undo();
    document.set_value(pitch(), 1000);
    EXPECT_FALSE(document.can_redo()) << "an edit drops the undone steps";
}

TEST_F(DocumentTest, ADragIsOneStep) {
    Document document = opened();
    for (int nm = 1600; nm >= 740; nm -= 20) document.set_value(pitch(), nm);
    document.finish_edit();
    document.undo();
    EXPECT_EQ(document.material().grating.pitch_nm, 1600.0);
    EXPECT_FALSE(document.dirty());
}

TEST_F(DocumentTest, ABadValueIsReportedAtItsFieldAndTheLastGoodMaterialStays) {
    Document document = opened();
    document.set_value(pitch(), 740);
    const auto accepted = document.accepted();
    document.set_value(field_at("/grating/orders"), parse_orders("1 x"));
    ASSERT_TRUE(document.refusal());
    EXPECT_EQ(document.refusal()->field, &field_at("/grating/orders"));
    EXPECT_THAT(document.refusal()->message, HasSubstr("list of whole numbers"));
    EXPECT_EQ(document.material().grating.orders, (std::vector<int>{-2, -1, 1, 2}));
    EXPECT_EQ(document.accepted(), accepted);
    document.undo();
    EXPECT_FALSE(document.refusal());
    EXPECT_EQ(document.accepted(), accepted);
}

TEST_F(DocumentTest, ASlitStaysTheSameFractionOfThePitch) {
    Document document = opened();
    document.set_value(pitch(), 740);
    EXPECT_EQ(document.json()["grating"]["profile"].dump(), R"({"type":"slit","width_nm":370})");
    EXPECT_EQ(document.json()["grating"]["pitch_nm"].dump(), "740");
}

TEST_F(DocumentTest, ARefusalNamesTheFieldThatIsTooLargeForAnother) {
    Document document = opened();
    document.set_value(field_at("/grating/profile/width_nm"), 1700);  // of a pitch of 1600
    ASSERT_TRUE(document.refusal());
    EXPECT_EQ(document.refusal()->field, &field_at("/grating/profile/width_nm"));
}

TEST_F(DocumentTest, ABadTableIsReportedAtItsName) {
    Document document = opened();
    write_file_atomic(path("bad.csv"), "wavelength_nm,R+1\n500,two\n");
    Json table = {{"type", "table"}, {"file", "bad.csv"}};
    document.set_value(field_at("/metal"), nullptr);
    document.set_value(field_at("/grating/profile"), table);
    ASSERT_TRUE(document.refusal());
    EXPECT_EQ(document.refusal()->field, &field_at("/grating/profile/file"));
    EXPECT_THAT(document.refusal()->message, HasSubstr("bad.csv"));
}

TEST_F(DocumentTest, ARefusedMaterialIsNotSaved) {
    Document document = opened();
    document.set_value(pitch(), -1);
    EXPECT_THAT(test::message_of([&] { document.save(); }),
                AllOf(HasSubstr("pitch_nm"), HasSubstr("nothing was written")));
    EXPECT_EQ(diffraction::load_material(path("cd.json")).grating.pitch_nm, 1600.0);
    EXPECT_TRUE(document.dirty());
}

TEST_F(DocumentTest, PresetsAreNeverWrittenOver) {
    Document document = Document::open_as_new(kMaterials / "cd.json");
    EXPECT_TRUE(document.dirty());
    EXPECT_THAT(test::message_of([&] { document.save(); }), HasSubstr("under a name"));
    const std::filesystem::path mine = path(test::has_posix_files() ? "min\xe9.json" : "mine.json");  // not UTF-8
    document.save_as(mine);
    EXPECT_FALSE(document.dirty());
    EXPECT_EQ(document.path(), mine);
    document.set_value(pitch(), 740);
    document.save();
    EXPECT_EQ(diffraction::load_material(mine).grating.pitch_nm, 740.0);
}

TEST_F(DocumentTest, FilesThatAMaterialNamesAreFoundFromItsNewFolder) {
    Document document = Document::open_as_new(kMaterials / "vinyl.json");
    document.save_as(path("deep/down/mine.json"));
    EXPECT_FALSE(document.refusal());
    EXPECT_FALSE(document.dirty());
    EXPECT_NO_THROW(diffraction::load_material(path("deep/down/mine.json")));
}

TEST_F(DocumentTest, AFileThatCannotBeWrittenLosesNothing) {
    Document document = opened();
    document.set_value(pitch(), 740);
    std::filesystem::create_directory(path("folder"));
    EXPECT_THROW(document.save_as(path("folder")), Error);
    EXPECT_THROW(document.save_as("/proc/nowhere/mine.json"), Error);
    EXPECT_EQ(document.path(), path("cd.json"));
    EXPECT_EQ(document.material().grating.pitch_nm, 740.0);
    EXPECT_TRUE(document.dirty());
    document.save();
    EXPECT_FALSE(document.dirty());
}

TEST_F(DocumentTest, AMaterialMovedSoThatJsonCannotNameItsFilesIsNotSaved) {
    if (!test::has_posix_files()) GTEST_SKIP() << "names of files are Unicode here";
    std::filesystem::create_directory(path("a\xff"));
    write_file_atomic(path("a\xff/table.csv"), "wavelength_nm,R-1,R+0,R+1\n380,.2,.3,.2\n780,.1,.4,.1\n");
    write_file_atomic(path("a\xff/m.json"),
                      R"({"grating": {"pitch_nm": 1600, "profile": {"type": "table", "file": "table.csv"}}})");
    Document document = Document::open(path("a\xff/m.json"));
    EXPECT_THAT(test::message_of([&] { document.save_as(path("m.json")); }), HasSubstr("not UTF-8"));
    EXPECT_FALSE(std::filesystem::exists(path("m.json")));
}

TEST_F(DocumentTest, EditsAreRescuedToANewFile) {
    Document document = opened();
    EXPECT_EQ(document.rescue(), std::nullopt);
    document.set_value(pitch(), -5);  // refused
    ASSERT_TRUE(document.refusal());
    EXPECT_EQ(document.rescue(), path("cd.unsaved.json"));
    EXPECT_EQ(document.rescue(), path("cd.unsaved-2.json"));
    EXPECT_EQ(parse_ordered(text("cd.unsaved.json"), "cd"), document.json());
    EXPECT_EQ(Document::open(path("cd.json")).json()["grating"]["pitch_nm"], 1600);
    document.undo();
    EXPECT_EQ(document.rescue(), std::nullopt);
    EXPECT_EQ(Document::open_as_new(path("cd.json")).rescue(), std::nullopt) << "the start of a new material";
}

TEST_F(DocumentTest, EditsAreInAFileOfTheirOwnAMinuteLaterAndNotOnceTheyAreSaved) {
    using namespace std::chrono_literals;
    Autosave autosave;
    Document document = opened();
    Autosave::Clock::time_point now{};
    EXPECT_FALSE(autosave.update(document, 1, now));
    const auto pitch_after = [&](int pitch_nm, std::chrono::seconds wait) {
        document.set_value(pitch(), pitch_nm);
        autosave.update(document, 1, now);
        autosave.update(document, 1, now += wait);
        std::error_code none;
        if (!std::filesystem::exists(path("cd.unsaved.json"), none)) return 0;
        return Document::open(path("cd.unsaved.json")).json()["grating"]["pitch_nm"].get<int>();
    };
    EXPECT_EQ(pitch_after(900, 59s), 0);
    EXPECT_EQ(pitch_after(910, 1s), 910) << "a minute after the first edit";
    EXPECT_EQ(pitch_after(920, 59s), 910);
    EXPECT_EQ(pitch_after(930, 1s), 930) << "in the same file";
    EXPECT_FALSE(std::filesystem::exists(path("cd.unsaved-2.json")));
    document.save();
    EXPECT_TRUE(autosave.update(document, 1, now));
    EXPECT_FALSE(std::filesystem::exists(path("cd.unsaved.json")));
    EXPECT_EQ(pitch_after(940, 60s), 940);
    EXPECT_TRUE(autosave.update(document, 2, now)) << "another document";
    EXPECT_FALSE(std::filesystem::exists(path("cd.unsaved.json")));
}

TEST_F(DocumentTest, EditsAreRescuedIfTheFolderWasRemoved) {
    std::filesystem::create_directory(path("here"));
    std::filesystem::copy_file(kMaterials / "cd.json", path("here/cd.json"));
    Document document = Document::open(path("here/cd.json"));
    document.set_value(pitch(), 740);
    std::filesystem::remove_all(path("here"));
    write_file_atomic(path("here"), "a file");
    std::filesystem::create_directory(path("temporary").string());
    const char* const variable = test::has_posix_files() ? "TMPDIR" : "TMP";
    test::set_variable(variable, path("temporary").string());
    EXPECT_EQ(document.rescue(), path("temporary/cd.unsaved.json"));
    test::set_variable(variable, std::nullopt);
    EXPECT_EQ(Document::open(path("temporary/cd.unsaved.json")).json(), document.json());
}

}  // namespace
}  // namespace rowland::inspector

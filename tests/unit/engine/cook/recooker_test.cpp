#include "engine/cook/recooker.h"

#include <gmock/gmock.h>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "tests/support/files.h"
#include "tests/unit/engine/cook/tile_type.h"

namespace rowland::cook {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RecookerTest : public testing::Test {
 protected:
    RecookerTest() { test::register_tile_types(registry_); }

    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    void write(const std::string& name, std::string_view text) {
        write_file_atomic(path(name), text);
        // Two writes within one tick of the file system's clock must also differ.
        std::filesystem::last_write_time(path(name), std::filesystem::last_write_time(path(name)) -
                                                         std::chrono::hours(1) + std::chrono::seconds(++writes_));
    }
    std::size_t cooked_size() const { return asset::load_any(path("a.cooked")).payload.size(); }
    static void settle(Recooker& recooker) {
        for (int i = 0; i < 3; ++i) {
            recooker.poll();
            recooker.wait();
        }
        recooker.poll();
    }
    Recooker make() { return Recooker(registry_, {{path("a.tiles"), path("a.cooked")}}, std::chrono::milliseconds(0)); }

    test::TemporaryFolder folder_;
    Registry registry_;
    int writes_ = 0;
};

TEST_F(RecookerTest, CooksNothingThatHasNotChanged) {
    write("a.tiles", "size 10");
    Recooker recooker = make();
    settle(recooker);
    EXPECT_FALSE(std::filesystem::exists(path("a.cooked")));
}

TEST_F(RecookerTest, CooksAChangedSourceAndEveryFileItNames) {
    write("a.tiles", "size 10\ninclude b.txt");
    write("b.txt", "x");
    Recooker recooker = make();
    settle(recooker);
    write("b.txt", "y");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 10U);
    write("a.tiles", "size 20\ninclude c.txt");
    write("c.txt", "x");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 20U);
    std::filesystem::remove(path("a.cooked"));
    write("c.txt", "y");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 20U);
}

TEST_F(RecookerTest, ARefusedSourceLeavesTheCookedFileAndSaysWhyUntilItIsMended) {
    write("a.tiles", "size 10");
    Recooker recooker = make();
    settle(recooker);
    write("a.tiles", "size 11");
    settle(recooker);
    write("a.tiles", "refuse");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 11U);
    EXPECT_THAT(recooker.failures(), ElementsAre(HasSubstr("a.tiles")));
    write("a.tiles", "size 12");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 12U);
    EXPECT_THAT(recooker.failures(), IsEmpty());
}

}  // namespace
}  // namespace rowland::cook

// When maps are filled, and which is shown meanwhile.
#include "modules/diffraction/runtime/map_cache.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stdexcept>

#include "engine/core/error.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/replaced_function.h"

namespace rowland::diffraction {
namespace {

using namespace std::chrono_literals;

/// std::counting_semaphore of GCC 12.2 may sleep for ever (GCC bug 104928).
class Semaphore {
 public:
    void release(int count = 1) {
        const std::scoped_lock guard(lock_);
        count_ += count;
        changed_.notify_all();
    }
    void acquire() {
        std::unique_lock guard(lock_);
        changed_.wait(guard, [&] { return count_ > 0; });
        --count_;
    }

 private:
    std::mutex lock_;
    std::condition_variable changed_;
    int count_ = 0;
};

/// Maps of one texel; a test says when a full one may be filled.
class MapFillingTest : public rowland::test::GlTest {
 public:
    ~MapFillingTest() override { full_maps_.release(1000); }

 protected:
    /// A frame with one object.
    void update(double normal) {
        cache_->begin_frame();
        add(object_, normal);
    }
    void add(ObjectMap& object, double normal) {
        object.update(fill_, {.texels = texels_, .normal = {normal, 0.0, 0.0}}, *cache_, true);
    }
    void update_until_complete(double normal) {
        for (update(normal); object_.is_filling();) update(normal);
    }

    std::shared_ptr<const lighting::LightSamples> texels_ = std::make_shared<const lighting::LightSamples>();
    std::atomic<int> coarse_count_ = 0;
    std::atomic<int> full_count_ = 0;
    Semaphore full_maps_;
    std::shared_ptr<const FillMap> fill_ =
        std::make_shared<const FillMap>([this](const MapInput&, MapDetail detail, const std::stop_token&) -> FilledMap {
            if (detail == MapDetail::Full) {
                full_maps_.acquire();
                ++full_count_;
            } else {
                ++coarse_count_;
            }
            const std::array<std::vector<glm::vec3>, 1> levels{std::vector<glm::vec3>{glm::vec3(1.0F)}};
            return {.texels = pack(levels, {}, {}), .set_uniforms = nullptr};
        });
    ObjectMap object_;
    /// Last member: it waits for its threads.
    std::unique_ptr<MapCache> cache_ = std::make_unique<MapCache>(MapPace::Incremental, 1h);
};

TEST_F(MapFillingTest, TheFirstFrameHasACoarseMapAndDoesNotWaitForTheFullOne) {
    update(1.0);
    const auto first = object_.shown();
    ASSERT_NE(first, nullptr);
    for (int frame = 0; frame < 10; ++frame) update(1.0);
    EXPECT_EQ(first->shown, MapDetail::Coarse);
    full_maps_.release();
    update_until_complete(1.0);
    EXPECT_EQ(object_.shown(), first);
    EXPECT_EQ(coarse_count_, 1);
    EXPECT_EQ(full_count_, 1);
}

TEST_F(MapFillingTest, ObjectsThatAreLitAlikeShareAMap) {
    std::array<ObjectMap, 3> others;
    update(1.0);
    add(others[0], 1.0 + 1e-6);
    add(others[1], 1.0 + 1e-4);
    EXPECT_EQ(others[0].shown(), object_.shown());
    EXPECT_NE(others[1].shown(), object_.shown());
    fill_ = std::make_shared<const FillMap>(*fill_);  // another material
    add(others[2], 1.0);
    EXPECT_NE(others[2].shown(), object_.shown());
    EXPECT_EQ(coarse_count_, 3);
}

/// Many objects' maps come one after the other, however long that takes.
TEST_F(MapFillingTest, AFrameThatMayNotWaitHasNoMapAndOthersComeInTheOrderOfRequests) {
    std::vector<double> filled;
    fill_ = std::make_shared<const FillMap>(
        [&filled, inner = fill_](const MapInput& input, MapDetail detail, const std::stop_token& stop) {
            if (detail == MapDetail::Coarse) filled.push_back(input.normal.x);
            return (*inner)(input, detail, stop);
        });
    cache_ = std::make_unique<MapCache>(MapPace::Incremental, 0ms);
    std::vector<ObjectMap> objects(50);
    while (std::ranges::any_of(objects, [](const ObjectMap& object) { return !object.shown(); })) {
        cache_->begin_frame();
        for (std::size_t i = 0; i < objects.size(); ++i) add(objects[i], static_cast<double>(i));
    }
    EXPECT_EQ(filled.size(), objects.size());
    EXPECT_TRUE(std::ranges::is_sorted(filled));
}

/// What is no longer seen keeps its map, and no other is filled for it.
TEST_F(MapFillingTest, NothingIsFilledForWhatIsNotSeen) {
    update(1.0);
    const auto first = object_.shown();
    cache_->begin_frame();  // begins the full map
    cache_->begin_frame();  // gives it up
    full_maps_.release(3);  // the given-up one takes one if its thread had begun
    ObjectMap other;
    for (add(other, 2.0); other.is_filling(); add(other, 2.0)) cache_->begin_frame();
    EXPECT_EQ(first->shown, MapDetail::Coarse);
    update_until_complete(1.0);
    EXPECT_EQ(object_.shown(), first);
    EXPECT_EQ(coarse_count_, 2);
}

TEST_F(MapFillingTest, CoarseMapsFollowAnObjectThatTurnsInEveryFrame) {
    full_maps_.release(1000);
    update(0.0);
    double normal = 0.0;
    while (coarse_count_ < 10) {
        update(normal += 1.0);
        EXPECT_NE(object_.shown(), nullptr);
    }
    update_until_complete(normal);
    EXPECT_EQ(object_.shown()->input.normal.x, normal);
}

/// If each frame began another map, an object whose frames are shorter than a fill would never get one.
TEST_F(MapFillingTest, AnObjectThatTurnsInEveryFrameWaitsForTheMapThatWasBegun) {
    Semaphore begun;
    Semaphore coarse_maps;
    std::atomic<int> coarse = 0;
    std::atomic<bool> given_up = false;
    fill_ = std::make_shared<const FillMap>(
        [&, inner = fill_](const MapInput& input, MapDetail detail, const std::stop_token& stop) {
            if (detail == MapDetail::Coarse) {
                begun.release();
                coarse_maps.acquire();
                if (coarse++ == 0) given_up = stop.stop_requested();
            }
            return (*inner)(input, detail, stop);
        });
    cache_ = std::make_unique<MapCache>(MapPace::Incremental, 0ms);
    double normal = 1.0;
    update(normal);
    begun.acquire();
    for (int frame = 0; frame < 5; ++frame) update(normal += 1.0);
    EXPECT_EQ(object_.shown(), nullptr);
    coarse_maps.release(1 << 20);
    while (!object_.shown()) update(normal += 1.0);
    EXPECT_FALSE(given_up);
    full_maps_.release(1000);
    cache_.reset();  // its threads use the semaphore
}

int textures_created = 0;
void APIENTRY create_textures(GLenum target, GLsizei count, GLuint* names) {
    textures_created += count;
    rowland::test::ReplacedFunction<&epoxy_glCreateTextures>::driver(target, count, names);
}

/// The one that is shown, the one that the next map goes to, and one that is given up when the next frame begins.
TEST_F(MapFillingTest, MapsOfOneSizeTakeTurnsInThreeTextures) {
    const rowland::test::ReplacedFunction<&epoxy_glCreateTextures> counted("glCreateTextures", create_textures);
    textures_created = 0;
    update(0.0);
    for (double normal = 1.0; coarse_count_ < 10; normal += 1.0) update(normal);
    EXPECT_LE(textures_created, 3);
}

TEST_F(MapFillingTest, UnderNewLightNoFrameShowsTheOldOneNorWaitsForTheFullMap) {
    update(1.0);
    const auto old = object_.shown();
    texels_ = std::make_shared<const lighting::LightSamples>();
    update(1.0);  // the old light's full map is still being filled
    EXPECT_EQ(coarse_count_, 2);
    EXPECT_NE(object_.shown(), old);
    EXPECT_EQ(object_.shown()->shown, MapDetail::Coarse);
    full_maps_.release(2);
    update_until_complete(1.0);
    EXPECT_EQ(coarse_count_, 2);
}

TEST_F(MapFillingTest, AStillWaitsForTheFullMapOfEveryInput) {
    cache_ = std::make_unique<MapCache>(MapPace::Whole, 0ms);
    for (const double normal : {1.0, 2.0, 2.0}) {
        full_maps_.release();
        update(normal);
        EXPECT_FALSE(object_.is_filling());
        EXPECT_EQ(object_.shown()->input.normal.x, normal);
    }
    EXPECT_EQ(full_count_, 2);
    EXPECT_EQ(coarse_count_, 0);
}

TEST_F(MapFillingTest, AMapThatCannotBeFilledIsAnError) {
    fill_ = std::make_shared<const FillMap>(
        [inner = fill_](const MapInput& input, MapDetail detail, const std::stop_token& stop) {
            if (detail == MapDetail::Full) throw std::runtime_error("no room");
            return (*inner)(input, detail, stop);
        });
    EXPECT_THROW(update_until_complete(1.0), Error);
}

}  // namespace
}  // namespace rowland::diffraction

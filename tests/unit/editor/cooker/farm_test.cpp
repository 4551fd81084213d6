// plan and run: many sources, many workers.
#include <gmock/gmock.h>

#include <thread>

#include "editor/cooker/jobs.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"
#include "tests/support/program.h"
#include "tests/unit/engine/cook/tile_type.h"

namespace rowland::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class FarmTest : public test::FolderTest {
 protected:
    FarmTest() { test::register_tile_types(registry_); }

    std::vector<Job> plan() const {
        const std::vector<std::filesystem::path> sources = {path("sources")};
        return plan_jobs(registry_, sources, path("cooked"));
    }

    /// What became of jobs, by their outputs' names.
    std::map<std::string, std::string> run(const std::vector<Job>& jobs) const {
        std::map<std::string, std::string> results;
        run_jobs(registry_, jobs, path("state"), [&](const Job& job, JobResult result, const std::string&) {
            results[job.output.filename().string()] = job_result_name(result);
        });
        return results;
    }

    cook::Registry registry_;
};

std::vector<std::string> outputs_of(const std::vector<Job>& jobs, const std::filesystem::path& below) {
    std::vector<std::string> names;
    for (const Job& job : jobs) names.push_back(job.output.lexically_relative(below).generic_string());
    return names;
}

TEST_F(FarmTest, APlanHasAJobForAllThatCanBeCookedBelowAFolder) {
    write("sources/b.tiles", "size 1\n");
    write("sources/deep/a.plain", "x");
    write("sources/only_checked.notes", "x");
    write("sources/of_no_type.txt", "x");
    write("sources/.hidden.tiles", "size 1\n");
    write("sources/.hidden/c.tiles", "size 1\n");
    EXPECT_THAT(outputs_of(plan(), path("cooked")), ElementsAre("b.cooked", "deep/a.flat"));
}

TEST_F(FarmTest, IdsStayWhenOtherSourcesComeAndTheFoldersMove) {
    write("sources/b.tiles", "size 1\n");
    const std::string id = plan()[0].id;
    write("sources/a.tiles", "size 1\n");
    const std::vector<Job> grown = plan();
    EXPECT_EQ(grown[1].id, id);
    EXPECT_NE(grown[0].id, id);
    std::filesystem::rename(path("sources"), path("moved"));
    const std::vector<std::filesystem::path> moved = {path("moved")};
    EXPECT_EQ(plan_jobs(registry_, moved, path("elsewhere"))[1].id, id);
}

TEST_F(FarmTest, AWrittenPlanIsReadBack) {
    write(test::has_posix_files() ? "sources/a \"name\".tiles" : "sources/a name.tiles", "size 1\n");
    write("sources/b.plain", "x");
    const std::vector<Job> jobs = plan();
    const std::vector<Job> again = parse_plan(write_plan(jobs), "plan.jsonl");
    ASSERT_EQ(again.size(), jobs.size());
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        EXPECT_EQ(again[i].id, jobs[i].id);
        EXPECT_EQ(again[i].kind, jobs[i].kind);
        EXPECT_EQ(again[i].source, jobs[i].source);
        EXPECT_EQ(again[i].output, jobs[i].output);
    }
}

TEST_F(FarmTest, AJobWhoseNameJsonCannotHoldIsRefused) {
    if (!test::has_posix_files()) GTEST_SKIP() << "names of files are Unicode here";
    write("sources/b\xff.tiles", "size 1\n");
    EXPECT_THAT(test::message_of([&] { write_plan(plan()); }), HasSubstr("not UTF-8"));
}

TEST_F(FarmTest, BadPlansAreRefusedByTheirLine) {
    const auto refusal = [](const std::string& text) {
        return test::message_of([&] { parse_plan(text, "plan.jsonl"); });
    };
    const std::string good = R"({"id":"0123456789ab","kind":"tiles","source":"a","output":"b"})";
    EXPECT_THAT(refusal(""), HasSubstr("no jobs"));
    EXPECT_THAT(refusal("id\tkind\tsource\toutput\n"), HasSubstr("plan --json"));
    EXPECT_THAT(refusal(good + "\n" + good), HasSubstr("line 2"));
    EXPECT_THAT(refusal(R"({"id":"../0123456789","kind":"tiles","source":"a","output":"b"})"),
                HasSubstr("hexadecimal"));
    EXPECT_THAT(refusal(R"({"id":"0123456789ab","kind":"tiles","source":"a"})"), HasSubstr("output"));
}

TEST_F(FarmTest, TwoSourcesOfOneOutputAreRefused) {
    write("sources/a.tiles", "size 1\n");
    write("sources/b/a.tiles", "size 1\n");
    const std::vector<std::filesystem::path> sources = {path("sources/a.tiles"), path("sources/b/a.tiles")};
    EXPECT_THAT(test::message_of([&] { plan_jobs(registry_, sources, path("cooked")); }), HasSubstr("so does"));
}

TEST_F(FarmTest, ASourceThatIsNotThereIsRefusedByName) {
    const std::vector<std::filesystem::path> sources = {path("nothing.tiles")};
    EXPECT_THAT(test::message_of([&] { plan_jobs(registry_, sources, path("cooked")); }), HasSubstr("nothing.tiles"));
    if (!test::make_link("loop", path("loop"))) return;
    EXPECT_THAT(test::message_of(
                    [&] { plan_jobs(registry_, std::vector<std::filesystem::path>{path("loop")}, path("cooked")); }),
                HasSubstr("expected a readable file"));
}

TEST_F(FarmTest, AJobIsDoneOnceUntilSomethingOfItChanges) {
    write("sources/a.tiles", "include part.txt\nsize 100\n");
    write("sources/part.txt", "size 1\n");
    const std::vector<Job> jobs = plan();
    EXPECT_EQ(run(jobs)["a.cooked"], "cooked");
    EXPECT_EQ(run(jobs)["a.cooked"], "up to date");
    write("sources/part.txt", "size 2\n");
    EXPECT_EQ(run(jobs)["a.cooked"], "cooked") << "after a change of what it includes";
    write("cooked/a.cooked", "damaged");
    EXPECT_EQ(run(jobs)["a.cooked"], "cooked") << "after a change of the output";
    std::filesystem::remove(path("cooked/a.cooked"));
    EXPECT_EQ(run(jobs)["a.cooked"], "cooked") << "after the loss of the output";
    write("state/" + jobs[0].id + ".json", "{");
    EXPECT_EQ(run(jobs)["a.cooked"], "cooked") << "after the loss of the record";
    EXPECT_EQ(run(jobs)["a.cooked"], "up to date");
}

TEST_F(FarmTest, ARefusedJobLeavesTheOthersDone) {
    write("sources/a.tiles", "refuse\n");
    write("sources/b.tiles", "size 1\n");
    auto results = run(plan());
    EXPECT_EQ(results["a.cooked"], "refused");
    EXPECT_EQ(results["b.cooked"], "cooked");
}

/// Workers as processes of their own on one folder.
class WorkerTest : public FarmTest {
 protected:
    void write_sources() const {
        for (const char name : std::string("abcdefgh"))
            write(std::string("sources/") + name + ".tiles", "size 300" + std::to_string(name % 10) + "\n");
    }

    void write_plan_file() const { write("plan.jsonl", write_plan(plan())); }

    std::vector<std::string> worker() const {
        return {ROWLAND_TEST_COOKER, "run", "--plan", path("plan.jsonl").string(), "--all", "--threads", "1"};
    }

    /// All outputs of the plan, by name.
    std::map<std::string, std::string> cooked() const {
        std::map<std::string, std::string> bytes;
        for (const Job& job : plan())
            bytes[job.output.filename().string()] = read_text_file(job.output, std::uint64_t{1} << 20);
        return bytes;
    }

    /// The same, made by one process from nothing.
    std::map<std::string, std::string> cooked_by_one() const {
        std::filesystem::remove_all(path("cooked"));
        std::filesystem::remove_all(path("plan.jsonl.state"));
        EXPECT_EQ(test::run(worker()).code, 0);
        return cooked();
    }
};

/// Lines that end a job that way.
int count(const std::string& table, const std::string& result) {
    int found = 0;
    const std::string field = "\t" + result + "\t";
    for (auto at = table.find(field); at != std::string::npos; at = table.find(field, at + 1)) ++found;
    return found;
}

TEST_F(WorkerTest, WorkersTogetherDoEveryJobOnceAndMakeTheBytesOfOne) {
    write_sources();
    write_plan_file();
    test::Running first(worker());
    test::Running second(worker());
    const test::Ended a = first.wait();
    const test::Ended b = second.wait();
    EXPECT_EQ(a.code, 0) << a.err;
    EXPECT_EQ(b.code, 0) << b.err;
    EXPECT_EQ(count(a.out, "cooked") + count(b.out, "cooked"), 8);
    const auto bytes = cooked();
    EXPECT_EQ(bytes.size(), 8U);
    EXPECT_TRUE(bytes == cooked_by_one());
}

TEST_F(WorkerTest, AKilledWorkerCostsTheJobItWasAtAlone) {
    write_sources();
    write("sources/d.tiles", "hold gate\nsize 3000\n");
    write("sources/gate", "");
    write_plan_file();
    test::Running killed(worker());
    while (!std::filesystem::exists(path("sources/gate.reached")))
        std::this_thread::sleep_for(std::chrono::milliseconds(5));

    test::Running survivor(worker());
    // The survivor does all but the job that is held, and waits for that.
    while (!std::filesystem::exists(path("cooked/h.cooked"))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_FALSE(std::filesystem::exists(path("cooked/d.cooked")));
    killed.kill();
    const test::Ended dead = killed.wait();
    EXPECT_EQ(dead.code, 128 + 9);
    EXPECT_EQ(count(dead.out, "cooked"), 3);

    std::filesystem::remove(path("sources/gate"));
    const test::Ended result = survivor.wait();
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(count(result.out, "up to date"), 3) << "what the killed one had finished is not done again";
    EXPECT_EQ(count(result.out, "cooked"), 5) << "its job, and those it had not begun";
    const auto bytes = cooked();
    EXPECT_TRUE(bytes == cooked_by_one());
}

TEST_F(WorkerTest, AnUnknownJobIsRefusedAndAnyKnownOneCanBeDoneAlone) {
    write_sources();
    write_plan_file();
    const std::vector<std::string> command = {ROWLAND_TEST_COOKER, "run", "--plan", path("plan.jsonl").string(),
                                              "--job"};
    std::vector<std::string> unknown = command;
    unknown.emplace_back("ffffffffffff");
    EXPECT_EQ(test::run(unknown).code, 2);
    std::vector<std::string> third = command;
    third.push_back(plan()[2].id);
    EXPECT_EQ(test::run(third).code, 0);
    EXPECT_TRUE(std::filesystem::exists(path("cooked/c.cooked")));
    EXPECT_FALSE(std::filesystem::exists(path("cooked/a.cooked")));
}

TEST_F(WorkerTest, AJobThatWouldOverwriteAnInputOrAnotherOutputIsRefusedBeforeAnyIsDone) {
    write_sources();
    const std::vector<Job> good = plan();
    const auto refusal = [&](std::size_t job, const std::filesystem::path& output) {
        std::vector<Job> jobs = good;
        jobs[job].output = output;
        write("plan.jsonl", write_plan(jobs));
        const test::Ended ended = test::run(worker());
        EXPECT_EQ(ended.code, 2) << output;
        EXPECT_FALSE(std::filesystem::exists(path("cooked"))) << output;
        return ended.err;
    };
    EXPECT_THAT(refusal(1, path("sources/c.tiles")), HasSubstr("the same file as an input"));
    EXPECT_THAT(refusal(1, path("plan.jsonl")), HasSubstr("the same file as an input"));
    EXPECT_THAT(refusal(1, good[0].output), HasSubstr("the output of job " + good[0].id));
    EXPECT_THAT(refusal(1, "/dev/full"), HasSubstr("/dev/full"));
    EXPECT_EQ(text("sources/c.tiles"), "size 3009\n");
}

}  // namespace
}  // namespace rowland::editor

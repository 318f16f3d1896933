// A corpus as a user has it: planned, measured, interrupted, resumed and gathered.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "bench/site.hpp"
#include "tests/support/child.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/input_error.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

constexpr const char* kQuad = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n";
constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class CorpusTest : public testing::Test {
 protected:
  /// Two good models and a bad one.
  void make_models() const {
    dir_.write("corpus/RWT1/quad.obj", kQuad);
    dir_.write("corpus/RWT1/metadata.json",
               "{\"name\": \"Quad\", \"tags\": [\"flat\", \"small\"], \"year\": 2019.0}");
    dir_.write("corpus/RWT2/triangle.obj", std::string(kTriangle) + "f 1 2 9\n");
    dir_.write("corpus/RWT3/broken.obj", "v 0 0 zero\nf 1 1 1\n");
  }
  /// A model that takes some seconds.
  void make_long_model() const {
    SiteOptions options;
    options.faces = 2'000'000;
    options.image_format = ImageFormat::kNone;
    fs::create_directories(path("corpus/long"));
    write_site(Site(options), path("corpus/long"));
  }

  std::string path(const std::string& name) const { return (dir_.path() / name).string(); }
  std::string job(const std::string& name = "") const { return path("job") + name; }

  static ProgramResult corpus(Words words) {
    words.insert(words.begin(), "corpus");
    return run_program(ATLASGAUGE_PROGRAM, words);
  }
  ProgramResult plan(Words more = {}) const {
    more.insert(more.begin(), {"plan", path("corpus"), "--out", job()});
    return corpus(more);
  }
  ProgramResult run(Words more = {}) const {
    more.insert(more.begin(), {"run", job()});
    return corpus(more);
  }
  ProgramResult status() const { return corpus({"status", job()}); }
  ProgramResult gather(Words more = {}) const {
    more.insert(more.begin(), {"gather", job()});
    return corpus(more);
  }

  std::vector<Json> rows() const {
    std::vector<Json> rows;
    std::ifstream lines(job("/corpus.jsonl"));
    for (std::string line; std::getline(lines, line);) rows.push_back(Json::parse(line));
    return rows;
  }
  /// Bytes of all results by their names.
  std::map<std::string, std::string> results() const {
    std::map<std::string, std::string> results;
    for (const auto& entry : fs::recursive_directory_iterator(job("/results"))) {
      if (entry.is_regular_file()) results[entry.path().filename()] = content_of(entry.path());
    }
    return results;
  }
  std::set<fs::file_time_type> result_times() const {
    std::set<fs::file_time_type> times;
    for (const auto& entry : fs::recursive_directory_iterator(job("/results"))) {
      if (entry.is_regular_file()) times.insert(entry.last_write_time());
    }
    return times;
  }

  TempDir dir_;
};

TEST_F(CorpusTest, ABadModelIsARowWithItsReason) {
  make_models();
  ASSERT_EQ(plan().exit_code, 0);
  const ProgramResult ran = run();
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.out, "2 measured, 1 failed, 0 missing; 0 had a result already\n");
  EXPECT_EQ(gather().exit_code, 0);
  const std::vector<Json> all = rows();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[2].at("model"), "RWT3/broken.obj");
  EXPECT_EQ(all[2].at("status"), "failed");
  EXPECT_TRUE(says(all[2].at("reason"), "RWT3/broken.obj:1: found \"zero\""));
  EXPECT_TRUE(all[2].at("report").is_null());
}

TEST_F(CorpusTest, ReportsAreThoseOfMeasure) {
  make_models();
  plan();
  run();
  EXPECT_EQ(gather({"--reports", path("corpus")}).exit_code, 0);
  const ProgramResult alone =
      run_program(ATLASGAUGE_PROGRAM, {path("corpus/RWT1/quad.obj"), "--json", "-"});
  EXPECT_EQ(content_of(path("corpus/RWT1/quad.obj.json")), alone.out);
  EXPECT_EQ(rows()[0].at("report"), Json::parse(alone.out));
  EXPECT_FALSE(fs::exists(path("corpus/RWT3/broken.obj.json")));
}

TEST_F(CorpusTest, WarningsAreCountedByKind) {
  make_models();
  plan();
  run();
  gather();
  const Json warnings = rows()[1].at("warnings");
  EXPECT_EQ(warnings.at("faces invalid"), 1) << warnings;
}

TEST_F(CorpusTest, MetadataIsCarriedThrough) {
  make_models();
  dir_.write("corpus/RWT2/metadata.json", "{\"name\": broken");
  plan();
  run();
  const ProgramResult gathered = gather();
  EXPECT_TRUE(says(gathered.err, "RWT2/metadata.json"));
  EXPECT_TRUE(says(content_of(job("/corpus.jsonl")),
                   R"("metadata":{"name":"Quad","tags":["flat","small"],"year":2019.0},)"));
  EXPECT_TRUE(rows()[1].at("metadata").is_null());
  const std::string csv = content_of(job("/corpus.csv"));
  EXPECT_TRUE(says(csv, ",metadata.name,metadata.tags,metadata.year\n"));
  EXPECT_TRUE(says(csv, ",Quad,\"[\"\"flat\"\",\"\"small\"\"]\",2019.0\n"));
}

TEST_F(CorpusTest, WhatHasAResultIsPassedOver) {
  make_models();
  plan();
  run();
  const auto times = result_times();
  const ProgramResult again = run();
  EXPECT_EQ(again.out, "0 measured, 0 failed, 0 missing; 3 had a result already\n");
  EXPECT_EQ(result_times(), times);
}

TEST_F(CorpusTest, AChangedInputIsMeasuredAgainAndNothingElse) {
  make_models();
  plan();
  run();
  dir_.write("corpus/RWT1/quad.obj", kTriangle);
  const ProgramResult missing = gather();
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_EQ(missing.err, "missing: RWT1/quad.obj\n");
  EXPECT_EQ(run().out, "1 measured, 0 failed, 0 missing; 2 had a result already\n");
  EXPECT_EQ(gather().exit_code, 0);
  EXPECT_EQ(rows()[0].at("report").at("fn"), 1);
}

TEST_F(CorpusTest, ATouchedInputIsNotMeasuredAgain) {
  make_models();
  plan();
  run();
  fs::last_write_time(path("corpus/RWT1/quad.obj"), fs::file_time_type::clock::now());
  EXPECT_EQ(run().out, "0 measured, 0 failed, 0 missing; 3 had a result already\n");
}

TEST_F(CorpusTest, OtherArgumentsAreOtherResults) {
  make_models();
  plan();
  run();
  plan({"-t", "64x32", "--strict"});
  EXPECT_EQ(run().out, "1 measured, 2 failed, 0 missing; 0 had a result already\n");
  gather();
  EXPECT_TRUE(says(rows()[1].at("reason"), "names a vertex")) << "which --strict makes an error";
  plan();
  EXPECT_EQ(run().out, "0 measured, 0 failed, 0 missing; 3 had a result already\n");
}

TEST_F(CorpusTest, SlicesTogetherAreTheWhole) {
  make_models();
  plan();
  run({"--jobs", "1"});
  gather();
  const std::string csv = content_of(job("/corpus.csv"));
  const auto whole = results();
  fs::remove_all(job());
  plan({"--tasks", "3"});
  EXPECT_EQ(run({"--slice", "2"}).exit_code, 0);
  EXPECT_EQ(results().size(), 1U);
  EXPECT_EQ(run({"--slice", "0"}).exit_code, 0);
  EXPECT_EQ(gather().exit_code, 1);
  EXPECT_EQ(run({"--slice", "1"}).exit_code, 0);
  EXPECT_EQ(gather().exit_code, 0);
  EXPECT_EQ(results(), whole);
  EXPECT_EQ(content_of(job("/corpus.csv")), csv);
}

TEST_F(CorpusTest, TheCorpusMayMove) {
  make_models();
  plan();
  run();
  const auto before = results();
  fs::rename(path("corpus"), path("elsewhere"));
  fs::remove_all(job());
  ASSERT_EQ(corpus({"plan", path("elsewhere") + "/.", "--out", job()}).exit_code, 0);
  run();
  EXPECT_EQ(results(), before);
}

TEST_F(CorpusTest, StatusSaysWhatToSubmitAgain) {
  make_models();
  plan({"--tasks", "3"});
  EXPECT_EQ(run({"--slice", "1"}).exit_code, 0);
  const ProgramResult open = status();
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_TRUE(says(open.out, "3 models in 3 slices: "));
  EXPECT_TRUE(says(open.out, ", 2 missing\n"));
  EXPECT_TRUE(says(open.out, ": not begun\n"));
  EXPECT_TRUE(says(open.out, "\nsbatch --array=0,2 " + job() + "/corpus.sbatch\n"));
  run();
  const ProgramResult done = status();
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_TRUE(says(done.out, "2 measured, 1 failed, 0 missing\nfailed   RWT3/broken.obj: "));
  EXPECT_EQ(done.out.find("sbatch"), std::string::npos);
}

TEST_F(CorpusTest, ATaskWithTooLittleMemoryFindsOutAtItsStart) {
  make_models();
  plan();
  const ProgramResult ran = run({"--memory", "600M", "--jobs", "3"});
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_TRUE(says(ran.err, "fewer --jobs"));
  EXPECT_TRUE(results().empty());
}

TEST_F(CorpusTest, WithoutATerminalThereIsALineAModel) {
  make_models();
  plan();
  const ProgramResult ran = run({"--jobs", "1"});
  EXPECT_TRUE(says(ran.err, "[3/3] "));
  EXPECT_TRUE(says(ran.err, "] measured RWT1/quad.obj ("));
  EXPECT_TRUE(says(ran.err, "] failed RWT3/broken.obj: "));
  EXPECT_EQ(run({"-q"}).err, "");
}

TEST_F(CorpusTest, AFileThatWouldBeFoundBeforeAnotherChangesTheModel) {
  const std::string library = "newmtl a\nmap_Kd t.png\n";
  dir_.write("corpus/m/a.mtl", library);
  dir_.write("corpus/a.obj", "mtllib m/a.mtl\n" + std::string(kTriangle));
  dir_.write("corpus/t.png", "no image");
  plan();
  run();
  dir_.write("corpus/m/t.png", "another");
  EXPECT_EQ(run().out, "1 measured, 0 failed, 0 missing; 0 had a result already\n");
}

TEST_F(CorpusTest, AnEndlessNameInOneModelHarmsNoOther) {
  make_models();
  dir_.write("corpus/RWT4/long.mtl", "newmtl a\nmap_Kd " + std::string(20'000, 'x') + ".png\n");
  dir_.write("corpus/RWT4/long.obj", "mtllib long.mtl\n" + std::string(kTriangle));
  plan();
  EXPECT_EQ(run().out, "3 measured, 1 failed, 0 missing; 0 had a result already\n");
}

TEST_F(CorpusTest, PipesAndDevicesThatAModelNamesAreNotRead) {
  dir_.write("corpus/a.obj", "mtllib a.mtl\nmtllib /dev/zero\n" + std::string(kTriangle));
  dir_.write("corpus/b.obj", "mtllib b.mtl\n" + std::string(kTriangle));
  dir_.write("corpus/b.mtl", "newmtl a\nmap_Kd b.png\n");
  ASSERT_EQ(::mkfifo(path("corpus/a.mtl").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo(path("corpus/b.png").c_str(), 0600), 0);
  plan();
  EXPECT_EQ(run().out, "2 measured, 0 failed, 0 missing; 0 had a result already\n");
}

TEST_F(CorpusTest, WithoutTheModelsNothingIsFailed) {
  make_models();
  plan();
  fs::rename(path("corpus"), path("away"));
  for (const ProgramResult& ended : {run(), status(), gather()}) {
    EXPECT_EQ(ended.exit_code, 4);
    EXPECT_TRUE(says(ended.err, "the folder of the models is not there"));
  }
  fs::create_directory(path("corpus"));
  EXPECT_EQ(run().out, "0 measured, 0 failed, 3 missing; 0 had a result already\n");
  EXPECT_TRUE(results().empty());
}

TEST_F(CorpusTest, AModelThatIsGoneIsNoPatternForOthers) {
  dir_.write("corpus/a[1].obj", kQuad);
  dir_.write("corpus/a1.obj", kTriangle);
  plan();
  fs::remove(path("corpus/a[1].obj"));
  EXPECT_EQ(run().out, "1 measured, 0 failed, 1 missing; 0 had a result already\n");
  EXPECT_TRUE(says(status().out, "missing  a[1].obj (slice 0): its file is not there\n"));
}

TEST_F(CorpusTest, AModelWhoseFilesCannotBeListedIsLookedAtEachTime) {
  make_models();
  plan();
  run();
  // As where its probe was killed: no files, and a digest that is not that of all of them.
  std::string manifest = content_of(job("/manifest.tsv"));
  const std::size_t line = manifest.find("RWT2");
  const std::size_t files = manifest.rfind('\t', manifest.rfind('\t', line - 2) - 1);
  manifest.replace(files, manifest.rfind('\t', line - 2) - files, "\t0");
  std::string inputs = content_of(job("/inputs.tsv"));
  const std::size_t first = inputs.rfind('\n', inputs.find("RWT2/")) + 1;
  inputs.erase(first, inputs.rfind('\n', inputs.find("RWT3/")) + 1 - first);
  dir_.write("job/manifest.tsv", manifest);
  dir_.write("job/inputs.tsv", inputs);
  EXPECT_EQ(run().out, "0 measured, 0 failed, 0 missing; 3 had a result already\n");
  dir_.write("corpus/RWT2/triangle.mtl", "newmtl a\n");
  EXPECT_EQ(run().out, "1 measured, 0 failed, 0 missing; 2 had a result already\n");
}

TEST_F(CorpusTest, FilesOfDifferentPlansAreRefused) {
  make_models();
  plan();
  const std::string older = content_of(job("/manifest.tsv"));
  fs::rename(path("corpus/RWT1"), path("corpus/RWT4"));
  plan();
  dir_.write("job/manifest.tsv", older);
  const ProgramResult ran = run();
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_TRUE(says(ran.err, "of different plans"));
}

TEST_F(CorpusTest, AResultThatWasCutIsMadeAnew) {
  make_models();
  plan();
  run();
  for (const auto& entry : fs::recursive_directory_iterator(job("/results"))) {
    if (entry.is_regular_file()) fs::resize_file(entry.path(), entry.file_size() - 2);
  }
  EXPECT_EQ(gather().exit_code, 1);
  EXPECT_EQ(run().out, "2 measured, 1 failed, 0 missing; 0 had a result already\n");
}

TEST_F(CorpusTest, ReportsAreNotWrittenThroughLinks) {
  make_models();
  const std::string victim = dir_.write("victim", "mine");
  fs::create_symlink(victim, path("corpus/RWT1/quad.obj.json"));
  plan();
  run();
  EXPECT_EQ(gather({"--reports", path("corpus")}).exit_code, 4);
  EXPECT_EQ(content_of(victim), "mine");
}

TEST_F(CorpusTest, MoreJobsThanModelsGetTheMemoryOfTheModels) {
  make_models();
  plan();
  EXPECT_EQ(run({"--jobs", "50", "--memory", "1G"}).exit_code, 0);
}

TEST_F(CorpusTest, ASliceThatThereIsNotIsAnError) {
  make_models();
  plan();
  const ProgramResult ran = run({"--slice", "1"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_TRUE(says(ran.err, "there is no slice 1; the job has 0 to 0"));
  EXPECT_TRUE(fs::is_empty(job("/attempts")));
}

TEST_F(CorpusTest, StrangeNamesAreNamesToo) {
  dir_.write("corpus/-v.obj", kQuad);
  dir_.write("corpus/a\tb\n'\"\xFF*.obj", kTriangle);
  plan();
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(gather({"--reports", path("reports")}).exit_code, 0);
  EXPECT_EQ(rows()[1].at("report").at("fn"), 1);
  EXPECT_TRUE(fs::exists(path("reports/a\tb\n'\"\xFF*.obj.json")));
}

TEST_F(CorpusTest, AFolderWithoutModelsIsAnError) {
  dir_.write("corpus/readme.txt", "");
  EXPECT_EQ(plan().exit_code, 3);
  EXPECT_FALSE(fs::exists(job()));
}

TEST_F(CorpusTest, AManifestThatLeadsOutOfTheCorpusIsRefused) {
  make_models();
  plan();
  dir_.write("job/manifest.tsv", "0\t1\t1\t0\tff\t../../x.obj\n");
  EXPECT_EQ(run().exit_code, 3);
  EXPECT_EQ(gather({"--reports", path("reports")}).exit_code, 3);
  EXPECT_FALSE(fs::exists(path("reports")));
}

/// The process that measures the one model of a run, once there is one that is not `before`.
pid_t child_of(pid_t run, pid_t before = 0) {
  const std::string file =
      "/proc/" + std::to_string(run) + "/task/" + std::to_string(run) + "/children";
  pid_t child = 0;
  while (!(std::ifstream(file) >> child) || child == before) std::this_thread::yield();
  return child;
}

bool is_running(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return (file >> number >> name >> state) && state != "Z" && state != "X";
}

class InterruptedCorpusTest : public CorpusTest {
 protected:
  InterruptedCorpusTest() {
    make_long_model();
    plan();
  }

  /// Sends a signal to a run, once a child of it is at work.
  int exit_code_after(int signal) {
    Child process({ATLASGAUGE_PROGRAM, {"corpus", "run", job()}, {}, {}, {}, {}, {}});
    const pid_t child = child_of(process.pid());
    process.send(signal);
    const int code = process.wait().exit_code;
    while (is_running(child)) std::this_thread::yield();
    return code;
  }
};

TEST_F(InterruptedCorpusTest, ACancelledRunEndsWithItsChildrenAndLeavesNothing) {
  for (const int signal : {SIGTERM, SIGINT}) {
    EXPECT_EQ(exit_code_after(signal), 128 + signal);
    EXPECT_TRUE(results().empty());
  }
  EXPECT_TRUE(says(status().out, "begun 2 times, not ended"));
}

TEST_F(InterruptedCorpusTest, AKilledRunTakesItsChildrenAlong) {
  EXPECT_EQ(exit_code_after(SIGKILL), 128 + SIGKILL);
  EXPECT_TRUE(results().empty());
  EXPECT_EQ(run().out, "1 measured, 0 failed, 0 missing; 0 had a result already\n");
}

TEST_F(InterruptedCorpusTest, AKilledModelIsTriedAgain) {
  Child process({ATLASGAUGE_PROGRAM, {"corpus", "run", job()}, {}, {}, {}, {}, {}});
  ::kill(child_of(process.pid()), SIGKILL);
  const ProgramResult ran = process.wait();
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_TRUE(says(ran.err, "put off long/site.obj: killed by signal 9 (Killed)\n"));
  EXPECT_EQ(ran.out, "1 measured, 0 failed, 0 missing; 0 had a result already\n");
}

TEST_F(InterruptedCorpusTest, AModelThatIsKilledThriceIsMissing) {
  Child process({ATLASGAUGE_PROGRAM, {"corpus", "run", job()}, {}, {}, {}, {}, {}});
  pid_t child = 0;
  for (int i = 0; i < 3; ++i) {
    child = child_of(process.pid(), child);
    ::kill(child, SIGKILL);
  }
  const ProgramResult ran = process.wait();
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_TRUE(says(ran.err, "missing long/site.obj: killed by signal 9 (Killed), 3 times\n"));
  EXPECT_TRUE(says(status().out, "(slice 0): killed by signal 9 (Killed), 3 times\n"));
}

TEST_F(InterruptedCorpusTest, WhatTheTaskCannotGiveIsMissingAndNotTheModelsFault) {
  dir_.write("corpus/small/quad.obj", kQuad);
  plan();
  const ProgramResult ran = run({"--memory", "512M", "--jobs", "2", "--tmp-dir", path("none")});
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_EQ(ran.out, "1 measured, 0 failed, 1 missing; 0 had a result already\n");
  EXPECT_TRUE(says(ran.err, "put off long/site.obj: ")) << "to be alone";
  EXPECT_TRUE(says(status().out, "missing  long/site.obj (slice 0): " + path("none")));
  EXPECT_EQ(run().out, "1 measured, 0 failed, 0 missing; 1 had a result already\n");
}

TEST_F(InterruptedCorpusTest, AModelThatChangesWhileItIsMeasuredIsTriedAgain) {
  Child process({ATLASGAUGE_PROGRAM, {"corpus", "run", job()}, {}, {}, {}, {}, {}});
  child_of(process.pid());
  dir_.write("corpus/long/site.obj", kQuad);
  const ProgramResult ran = process.wait();
  EXPECT_TRUE(says(ran.err, "its files changed"));
  EXPECT_EQ(run().exit_code, 0);
  gather();
  EXPECT_EQ(rows()[0].at("report").at("fn"), 2);
}

}  // namespace
}  // namespace atlasgauge

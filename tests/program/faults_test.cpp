// What may go wrong around a run: full disks, failing and short system calls, signals, lost
// folders, no memory. Always the same claims: the exit code says whose fault it is, one message
// says what to do, the scratch folder is empty, and the report is the old one, or the right new
// one.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "bench/site.hpp"
#include "tests/support/child.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOld = "old report\n";
constexpr uid_t kNobody = 65534;

bool thorough() {
  return std::getenv("ATLASGAUGE_THOROUGH") != nullptr;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// The first two, the last two, and some between.
std::vector<std::uint64_t> moments(std::uint64_t calls, std::uint32_t seed) {
  std::vector<std::uint64_t> chosen{1, 2, calls - 1, calls};
  std::mt19937 random(seed);
  for (int i = 0; i < (thorough() ? 60 : 5); ++i) chosen.push_back(1 + random() % calls);
  return chosen;
}

/// A measurement. What is empty is taken from the site and the fixture.
struct Trial {
  std::string faults = {};
  std::vector<std::string> environment = {};
  std::vector<std::string> more = {};  ///< arguments
  std::string model = {}, report = {}, tmp_dir = {};
  std::string threads = "2";
};

/// A program within limits of the shell.
ProgramResult run_under(const std::string& limits, const ChildSetup& setup) {
  std::string command = limits + "; exec " + setup.program;
  for (const std::string& argument : setup.arguments) command += " " + argument;
  return run_program("/bin/bash", {"-c", command});
}

class FaultsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    site_ = std::make_unique<TempDir>();
    SiteOptions options;
    options.faces = 20'000;
    options.image_format = ImageFormat::kNone;
    write_site(Site(options), site_->path().string());
    const FaultsTest fixture;
    const ProgramResult result = fixture.measure({});
    if (result.exit_code == 0) wanted_ = content_of(fixture.report_);
  }
  static void TearDownTestSuite() { site_.reset(); }

  FaultsTest() {
    // So that others than root get there.
    for (const fs::path& folder : {dir_.path(), site_->path()}) {
      fs::permissions(folder, fs::perms(0755));
    }
    for (const char* name : {"scratch", "reports"}) {
      fs::create_directory(dir_.path() / name);
      fs::permissions(dir_.path() / name, fs::perms(0777));
    }
    dir_.write("reports/report.json", kOld);
  }
  void SetUp() override { ASSERT_NE(wanted_, "") << "the site cannot be measured at all"; }
  void TestBody() override {}

  static std::string model() { return (site_->path() / "site.obj").string(); }
  std::string file(const std::string& name) const { return (dir_.path() / name).string(); }

  ChildSetup setup(const Trial& trial) const {
    ChildSetup child;
    child.program = ATLASGAUGE_PROGRAM;
    child.arguments = {trial.model.empty() ? model() : trial.model,
                       "--json",
                       trial.report.empty() ? report_ : trial.report,
                       "-t",
                       "1024x1024",
                       "-q",
                       "--engine-memory",
                       "3M",
                       "--block-bytes",
                       "4096",
                       "--threads",
                       trial.threads,
                       "--tmp-dir",
                       trial.tmp_dir.empty() ? scratch_ : trial.tmp_dir};
    child.arguments.insert(child.arguments.end(), trial.more.begin(), trial.more.end());
    child.environment = trial.environment;
    if (!trial.faults.empty()) {
      child.environment.insert(
          child.environment.end(),
          {std::string("LD_PRELOAD=") + ATLASGAUGE_FAULTY_IO, "FAULTY_IO=" + trial.faults,
           "FAULTY_IO_COUNTS=" + file("counts"), "ASAN_OPTIONS=verify_asan_link_order=0"});
    }
    return child;
  }

  ProgramResult measure(const Trial& trial) const {
    fs::remove(file("counts"));
    return Child(setup(trial)).wait();
  }

  /// Calls that the last run made, by the first rule.
  std::uint64_t calls() const {
    std::istringstream counts(content_of(file("counts")));
    std::string call;
    std::uint64_t number = 0;
    counts >> call >> number;
    return number;
  }

  std::uint64_t calls_of(const std::string& call) const {
    measure({.faults = call + ":1000000000:EIO", .threads = "1"});
    return calls();
  }

  void renew_old_report() const { dir_.write("reports/report.json", kOld); }

  void expect_nothing_left() const {
    EXPECT_EQ(names_in(scratch_), std::vector<std::string>{});
    EXPECT_EQ(names_in(file("reports")), std::vector<std::string>{"report.json"});
  }

  void expect_refusal(const ProgramResult& result, int exit_code, const std::string& told) const {
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_NE(result.err.find(told), std::string::npos) << result.err;
    EXPECT_EQ(lines_of(result.err), 1U) << result.err;
    EXPECT_EQ(content_of(report_), kOld);
    expect_nothing_left();
  }

  void expect_right_report(const ProgramResult& result) const {
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(content_of(report_), wanted_);
    expect_nothing_left();
  }

  /// A fault at many moments of a run, each of them fatal.
  void expect_refusals(const std::string& call, const std::string& fault, int exit_code,
                       const std::string& told) const {
    const std::uint64_t all = calls_of(call);
    ASSERT_GT(all, 4U);
    for (const std::uint64_t moment : moments(all, 7)) {
      SCOPED_TRACE(call + " " + std::to_string(moment) + " of " + std::to_string(all));
      renew_old_report();
      const ProgramResult result =
          measure({.faults = call + ":" + std::to_string(moment) + ":" + fault, .threads = "1"});
      expect_refusal(result, exit_code, told);
    }
  }

  /// Ended by a signal during one of the calls.
  void expect_end_by(int signal, const std::string& call, std::uint64_t moment) const {
    SCOPED_TRACE(call + " " + std::to_string(moment) + ", signal " + std::to_string(signal));
    renew_old_report();
    const ProgramResult result = measure(
        {.faults = call + ":" + std::to_string(moment) + ":signal" + std::to_string(signal)});
    EXPECT_EQ(result.exit_code, 128 + signal) << result.err;
    expect_nothing_left();
  }

  static std::unique_ptr<TempDir> site_;
  static std::string wanted_;
  TempDir dir_;
  const std::string scratch_ = file("scratch");
  const std::string report_ = file("reports/report.json");
};

std::unique_ptr<TempDir> FaultsTest::site_;
std::string FaultsTest::wanted_;

// Scratch.

TEST_F(FaultsTest, FullScratchDiskEndsTheRunAtAnyMoment) {
  expect_refusals("pwrite", "ENOSPC", 4,
                  "No space left on device; free space there or give another");
}

TEST_F(FaultsTest, FullScratchDiskIsToldWithTheFolderAndTheOption) {
  for (const char* threads : {"1", "2", "5"}) {
    renew_old_report();
    const ProgramResult result = measure({.faults = "pwrite:20+:ENOSPC", .threads = threads});
    expect_refusal(result, 4, scratch_ + ": cannot write scratch");
    EXPECT_NE(result.err.find("--tmp-dir"), std::string::npos) << result.err;
  }
}

TEST_F(FaultsTest, QuotaOfScratchIsToldAsSuch) {
  expect_refusal(measure({.faults = "pwrite:9+:EDQUOT"}), 4, "Disk quota exceeded");
}

TEST_F(FaultsTest, FailingReadOfScratchEndsTheRunAtAnyMoment) {
  expect_refusals("pread", "EIO", 4, "cannot read scratch back");
}

TEST_F(FaultsTest, ScratchCutShortIsNeverAWrongReport) {
  expect_refusals("pread", "zero", 4, "it is cut short");
}

TEST_F(FaultsTest, ShortTransfersOfScratchChangeNothing) {
  for (const char* faults : {"pwrite:every3:short1000", "pread:every3:short1000",
                             "pread:1+:short512", "pwrite:1+:short100 pread:every2:short4000"}) {
    SCOPED_TRACE(faults);
    renew_old_report();
    expect_right_report(measure({.faults = faults}));
    EXPECT_GT(calls(), 100U);
  }
}

TEST_F(FaultsTest, InterruptedCallsChangeNothing) {
  expect_right_report(measure(
      {.faults = "pread:every2:EINTR pwrite:every2:EINTR read:every2:EINTR write:1:EINTR"}));
  EXPECT_GT(calls(), 100U);
}

TEST_F(FaultsTest, FileSystemWithoutDirectInputOutputGivesTheSameReport) {
  expect_right_report(measure({.faults = "direct:1+:EINVAL"}));
  EXPECT_GE(calls(), 1U);
}

TEST_F(FaultsTest, FileSystemThatRefusesDirectTransfersOnlyGivesTheSameReport) {
  expect_right_report(measure({.faults = "pwrite:1:EINVAL pread:1:EINVAL"}));
}

TEST_F(FaultsTest, FileSystemWithoutUnnamedFilesGivesTheSameReport) {
  for (const char* faults : {"unnamed:1+:EOPNOTSUPP", "unnamed:1+:EOPNOTSUPP direct:1+:EINVAL"}) {
    SCOPED_TRACE(faults);
    renew_old_report();
    expect_right_report(measure({.faults = faults}));
    EXPECT_GE(calls(), 2U);
  }
}

TEST_F(FaultsTest, UnwritableScratchFolderIsRefused) {
  const Trial trial{.tmp_dir = report_};
  expect_refusal(measure(trial), 4, "give a writable directory with --tmp-dir");
}

TEST_F(FaultsTest, FileSizeLimitIsAnErrorAndNoSignal) {
  expect_refusal(run_under("ulimit -f 1000", setup({})), 4, "File too large");
}

TEST_F(FaultsTest, TwoRunsShareAScratchFolderAndAReport) {
  for (int i = 0; i < (thorough() ? 30 : 3); ++i) {
    renew_old_report();
    Child first(setup({})), second(setup({}));
    expect_right_report(first.wait());
    expect_right_report(second.wait());
  }
}

// The model.

TEST_F(FaultsTest, ShortReadsOfTheModelChangeNothing) {
  for (const char* faults : {"read@site.obj:1+:short1000", "read@site.obj:every2:short1"}) {
    SCOPED_TRACE(faults);
    renew_old_report();
    expect_right_report(measure({.faults = faults}));
    EXPECT_GT(calls(), 10U);
  }
}

TEST_F(FaultsTest, FailingReadOfTheModelNamesTheModel) {
  expect_refusals("read@site.obj", "EIO", 3, "site.obj: cannot read: Input/output error");
}

TEST_F(FaultsTest, ModelThatShrinksWhileItIsReadIsRefused) {
  for (const char* faults : {"read@copy.obj:2:shrink", "read@copy.obj:5:shrink"}) {
    SCOPED_TRACE(faults);
    fs::copy_file(model(), file("copy.obj"), fs::copy_options::overwrite_existing);
    expect_refusal(measure({.faults = faults, .model = file("copy.obj")}), 3, "copy.obj: it had ");
  }
}

TEST_F(FaultsTest, ModelThatEndsTooSoonIsRefused) {
  expect_refusal(measure({.faults = "read@site.obj:4+:zero"}), 3, "site.obj: it had ");
}

TEST_F(FaultsTest, FifoAsModelIsReadAsAStream) {
  ASSERT_EQ(::mkfifo(file("site.obj").c_str(), 0600), 0);
  ChildSetup feed;
  feed.program = "/bin/cat";
  feed.arguments = {model()};
  feed.out = file("site.obj");
  Child feeder(feed);
  expect_right_report(measure({.model = file("site.obj")}));
  EXPECT_EQ(feeder.wait().exit_code, 0);
}

TEST_F(FaultsTest, EmptyModelsAreRefused) {
  for (const std::string& empty : {std::string("/dev/null"), dir_.write("empty.obj", "")}) {
    expect_refusal(measure({.model = empty}), 3, "no statement of a Wavefront OBJ");
  }
}

TEST_F(FaultsTest, DirectoryAsModelIsRefused) {
  expect_refusal(measure({.model = scratch_}), 3, "found a directory");
}

// The report.

TEST_F(FaultsTest, FailingReportLeavesTheOldOne) {
  for (const char* call : {"write@/reports/", "fsync", "rename"}) {
    for (const char* more : {"", " unnamed@reports:1+:EOPNOTSUPP", " linkat:1+:EPERM"}) {
      SCOPED_TRACE(std::string(call) + more);
      expect_refusal(measure({.faults = std::string(call) + ":1+:ENOSPC" + more}), 4,
                     "report.json: cannot write: No space left on device");
      EXPECT_GE(calls(), 1U);
    }
  }
}

TEST_F(FaultsTest, ShortWritesOfTheReportChangeNothing) {
  expect_right_report(measure({.faults = "write@/reports/:1+:short7"}));
  EXPECT_GT(calls(), 100U);
}

TEST_F(FaultsTest, FileSystemWithoutLinksGivesTheSameReport) {
  expect_right_report(measure({.faults = "linkat:1+:EPERM"}));
  EXPECT_EQ(calls(), 1U);
}

TEST_F(FaultsTest, ReportFolderThatVanishesIsToldAtTheEnd) {
  const ProgramResult result = measure(
      {.faults = "pwrite:9:remove_folder", .environment = {"FAULTY_FOLDER=" + file("reports")}});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("report.json: cannot write: No such file"), std::string::npos)
      << result.err;
  EXPECT_EQ(names_in(scratch_), std::vector<std::string>{});
}

TEST_F(FaultsTest, ReportFollowsSymbolicLinks) {
  for (const char* target : {"report.json", "fresh.json"}) {
    SCOPED_TRACE(target);
    fs::remove(file("link.json"));
    fs::create_symlink("reports/" + std::string(target), file("link.json"));
    EXPECT_EQ(measure({.report = file("link.json")}).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(file("link.json")));
    EXPECT_EQ(content_of(file("reports") + "/" + target), wanted_);
  }
}

TEST_F(FaultsTest, SymbolicLinksInACircleAreRefused) {
  fs::create_symlink("b.json", file("a.json"));
  fs::create_symlink("a.json", file("b.json"));
  expect_refusal(measure({.report = file("a.json")}), 4, "in a circle");
}

TEST_F(FaultsTest, ReportKeepsThePermissionsOfTheOldOne) {
  fs::permissions(report_, fs::perms(0640));
  expect_right_report(measure({}));
  EXPECT_EQ(fs::status(report_).permissions(), fs::perms(0640));
}

TEST_F(FaultsTest, ReportOfTheLongestNameIsWritten) {
  const std::string report = file("reports/" + std::string(255, 'r'));
  EXPECT_EQ(measure({.report = report}).exit_code, 0);
  EXPECT_EQ(content_of(report), wanted_);
}

TEST_F(FaultsTest, ReportGoesThroughAFifo) {
  ASSERT_EQ(::mkfifo(file("fifo").c_str(), 0600), 0);
  ChildSetup drain;
  drain.program = "/bin/cat";
  drain.arguments = {file("fifo")};
  Child drainer(drain);
  EXPECT_EQ(measure({.report = file("fifo")}).exit_code, 0);
  EXPECT_EQ(drainer.wait().out, wanted_);
}

TEST_F(FaultsTest, ReportToAFullDeviceIsAnError) {
  expect_refusal(measure({.report = "/dev/full"}), 4, "/dev/full: cannot write: No space left");
}

TEST_F(FaultsTest, DirectoryAsReportIsRefused) {
  expect_refusal(measure({.report = file("reports")}), 4, "it is a directory");
}

// Standard streams.

TEST_F(FaultsTest, FullStandardOutputIsAnError) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{model(), "--json", "-", "-q"},
        {model(), "-t", "8x8"},
        {"--help"}}) {
    ChildSetup child;
    child.program = ATLASGAUGE_PROGRAM;
    child.arguments = arguments;
    child.out = "/dev/full";
    const ProgramResult result = Child(child).wait();
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_NE(result.err.find("standard output: cannot write: No space left"), std::string::npos)
        << result.err;
  }
}

TEST_F(FaultsTest, ClosedStandardOutputIsAnErrorAndNoFileTakesItsPlace) {
  ChildSetup child = setup({.report = "-"});
  child.closed = {STDIN_FILENO, STDOUT_FILENO};  // the model's number and the scratch file's
  expect_refusal(Child(child).wait(), 4, "standard output: cannot write: Bad file descriptor");
}

TEST_F(FaultsTest, ClosedStandardInputAndErrorDoNoHarm) {
  ChildSetup child = setup({});
  child.closed = {STDIN_FILENO, STDERR_FILENO};
  expect_right_report(Child(child).wait());
}

TEST_F(FaultsTest, FullStandardErrorDoesNoHarm) {
  ChildSetup child = setup({.more = {"-v", "--progress", "always"}});
  std::erase(child.arguments, "-q");
  child.err = "/dev/full";
  expect_right_report(Child(child).wait());
}

TEST_F(FaultsTest, FullStandardErrorKeepsTheExitCode) {
  ChildSetup child = setup({.more = {"--progress", "always"}, .model = file("none.obj")});
  child.err = "/dev/full";
  EXPECT_EQ(Child(child).wait().exit_code, 3);
}

TEST_F(FaultsTest, BrokenPipeIsNoSuccess) {
  const std::string command =
      std::string(ATLASGAUGE_PROGRAM) + " " + model() + " -t 8x8 -q --json - | true";
  EXPECT_EQ(run_program("/bin/bash", {"-o", "pipefail", "-c", command}).exit_code, 128 + SIGPIPE);
  const ProgramResult deaf =
      run_program("/bin/bash", {"-o", "pipefail", "-c", "trap '' PIPE; " + command});
  EXPECT_EQ(deaf.exit_code, 4);
  EXPECT_NE(deaf.err.find("Broken pipe"), std::string::npos) << deaf.err;
}

// Signals.

TEST_F(FaultsTest, SignalsEndTheRunAtAnyMomentAndLeaveTheOldReport) {
  const std::map<std::string, std::uint64_t> all = {
      {"read@site.obj", calls_of("read@site.obj")}, {"pwrite", 600}, {"pread", 600}};
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGKILL}) {
    for (const auto& [call, count] : all) {
      std::mt19937 random(static_cast<std::uint32_t>(signal));
      for (int i = 0; i < (thorough() ? 20 : 2); ++i) {
        expect_end_by(signal, call, 1 + random() % count);
        EXPECT_EQ(content_of(report_), kOld);
      }
    }
  }
}

TEST_F(FaultsTest, SignalWhileTheReportIsWrittenLeavesAWholeOne) {
  const std::map<std::string, std::string> left = {
      {"write@/reports/", kOld}, {"fsync", kOld}, {"linkat", wanted_}, {"rename", wanted_}};
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    for (const auto& [call, report] : left) {
      expect_end_by(signal, call, 1);
      EXPECT_EQ(content_of(report_), report);
    }
  }
}

TEST_F(FaultsTest, SignalWhileTheReportIsCopiedLeavesNoOtherFile) {
  // First into a file that lost its name, then into the one that is renamed.
  const std::map<std::string, std::string> left = {{"write@/reports/:1", kOld},
                                                   {"write@/reports/:2", kOld},
                                                   {"fsync:1", wanted_},
                                                   {"rename:1", wanted_}};
  for (const auto& [call, report] : left) {
    SCOPED_TRACE(call);
    renew_old_report();
    const ProgramResult result =
        measure({.faults = call + ":signal15 unnamed@reports:1+:EOPNOTSUPP"});
    EXPECT_EQ(result.exit_code, 128 + SIGTERM);
    EXPECT_EQ(content_of(report_), report);
    expect_nothing_left();
  }
}

TEST_F(FaultsTest, IgnoredSignalWhileTheReportIsCopiedChangesNothing) {
  const std::string command =
      "trap '' HUP; exec " ATLASGAUGE_PROGRAM " " + model() + " -t 1024x1024 -q --json " + report_;
  const ProgramResult result =
      run_program("/bin/bash", {"-c", command},
                  {std::string("LD_PRELOAD=") + ATLASGAUGE_FAULTY_IO,
                   "FAULTY_IO=write@/reports/:2:signal1 unnamed@reports:1+:EOPNOTSUPP",
                   "FAULTY_IO_COUNTS=" + file("counts"), "ASAN_OPTIONS=verify_asan_link_order=0"});
  expect_right_report(result);
  EXPECT_EQ(calls(), 2U);
}

// Without privileges. Root may write everywhere.

class UnprivilegedFaultsTest : public FaultsTest {
 protected:
  void SetUp() override {
    FaultsTest::SetUp();
    if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
    const std::vector<std::string> help{"--help"};
    ChildSetup child;
    child.program = ATLASGAUGE_PROGRAM;
    child.arguments = help;
    child.user = kNobody;
    if (Child(child).wait().exit_code != 0) GTEST_SKIP() << "others cannot run the program";
  }

  ProgramResult measure_as_nobody(const Trial& trial) const {
    ChildSetup child = setup(trial);
    child.user = kNobody;
    return Child(child).wait();
  }
};

TEST_F(UnprivilegedFaultsTest, ModelThatMayNotBeReadIsRefused) {
  ASSERT_EQ(::chown(report_.c_str(), kNobody, kNobody), 0);
  fs::copy_file(model(), file("secret.obj"));
  fs::permissions(file("secret.obj"), fs::perms(0600));
  expect_refusal(measure_as_nobody({.model = file("secret.obj")}), 3,
                 "secret.obj: cannot open: Permission denied");
}

TEST_F(UnprivilegedFaultsTest, ReportInAFolderOfOthersIsRefusedBeforeWork) {
  fs::permissions(file("reports"), fs::perms(0755));
  expect_refusal(measure_as_nobody({.faults = "read@site.obj:1:EIO"}), 4,
                 "report.json: cannot write: Permission denied");
}

TEST_F(UnprivilegedFaultsTest, ReportThatMayNotBeWrittenIsRefused) {
  expect_refusal(measure_as_nobody({}), 4, "report.json: cannot write: Permission denied");
}

TEST_F(UnprivilegedFaultsTest, ReportInAFolderThatMayNotBeEnteredIsRefused) {
  fs::create_directory(file("locked"));
  fs::permissions(file("locked"), fs::perms(0700));
  expect_refusal(measure_as_nobody({.report = file("locked/report.json")}), 4,
                 "cannot write: Permission denied");
}

TEST_F(UnprivilegedFaultsTest, ScratchFolderOfOthersIsRefused) {
  fs::remove(report_);
  fs::permissions(scratch_, fs::perms(0755));
  const ProgramResult result = measure_as_nobody({});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("cannot make a scratch file: Permission denied"), std::string::npos)
      << result.err;
}

TEST_F(UnprivilegedFaultsTest, OwnReportIsReplaced) {
  ASSERT_EQ(::chown(report_.c_str(), kNobody, kNobody), 0);
  expect_right_report(measure_as_nobody({}));
}

TEST_F(UnprivilegedFaultsTest, RootLeavesAReportItsOwner) {
  ASSERT_EQ(::chown(report_.c_str(), kNobody, kNobody), 0);
  expect_right_report(measure({}));
  struct stat status {};
  ASSERT_EQ(::stat(report_.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, kNobody);
}

// Memory.

class MemoryFaultsTest : public FaultsTest {
 protected:
  void SetUp() override {
    FaultsTest::SetUp();
    if (ATLASGAUGE_SANITIZED) GTEST_SKIP() << "a sanitizer has an allocator of its own";
  }

  /// Allocations `first` and the `count` - 1 after it are refused, of those of at least so many
  /// bytes.
  ProgramResult measure_without(std::uint64_t first, std::uint64_t count, std::uint64_t bytes,
                                const std::string& threads) const {
    Trial trial;
    trial.threads = threads;
    trial.environment = {std::string("LD_PRELOAD=") + ATLASGAUGE_FAULTY_MEMORY,
                         "FAULTY_MEMORY_AFTER=site.obj",
                         "FAULTY_MEMORY_FIRST=" + std::to_string(first),
                         "FAULTY_MEMORY_COUNT=" + std::to_string(count),
                         "FAULTY_MEMORY_BYTES=" + std::to_string(bytes)};
    return measure(trial);
  }

  /// True if the run got to the refusals, and felt them.
  bool ends_well(const ProgramResult& result) const {
    if (result.exit_code == 0) {
      expect_right_report(result);
      return false;
    }
    expect_refusal(result, 4, "the system gives no more memory");
    return true;
  }
};

TEST_F(MemoryFaultsTest, RefusedAllocationsEndTheRunAtAnyMoment) {
  for (const char* threads : {"1", "3"}) {
    int felt = 0, tried = 0;
    for (std::uint64_t first = 1; first < 20'000; first = first * (thorough() ? 11 : 30) / 10 + 1) {
      for (const std::uint64_t count : {std::uint64_t{1}, ~std::uint64_t{0}}) {
        SCOPED_TRACE(std::to_string(first) + " " + std::to_string(count) + " " + threads);
        renew_old_report();
        felt += ends_well(measure_without(first, count, 1, threads)) ? 1 : 0;
        ++tried;
      }
    }
    EXPECT_GT(felt, tried / 2);
  }
}

TEST_F(MemoryFaultsTest, RefusedLargeBuffersEndTheRunAtAnyMoment) {
  int felt = 0;
  for (std::uint64_t first = 1; first < 300; first = first * (thorough() ? 11 : 30) / 10 + 1) {
    SCOPED_TRACE(first);
    renew_old_report();
    felt += ends_well(measure_without(first, 1, 4096, "2")) ? 1 : 0;
  }
  EXPECT_GT(felt, 3);
}

TEST_F(MemoryFaultsTest, MoreThreadsThanTheSystemGivesAreRefused) {
  ChildSetup child = setup({.threads = "100"});
  std::ranges::replace(child.arguments, std::string("3M"), std::string("100M"));
  expect_refusal(run_under("ulimit -v 600000", child), 4, "give fewer with --threads");
}

}  // namespace
}  // namespace atlasgauge

#include "quoll/base/file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "quoll/base/random.hpp"

// The calls below stand before those of the C library in this program, so that a test can make them
// fail.
namespace {

struct Faults {
  int fsync_call = 0;  ///< this call of fsync fails (1 = the file's, 2 = the folder's)
  int fsync_error = EIO;
  std::size_t write_limit = 0;  ///< a write takes at most this many bytes; 0 = all
  int write_error = 0;          ///< a write fails with this once `writes_before` have succeeded
  int writes_before = 0;
  int interruptions = 0;  ///< so many writes fail with EINTR first
};
Faults faults;
int fsync_calls = 0;
int write_calls = 0;

int failed(int code) {
  errno = code;
  return -1;
}

}  // namespace

extern "C" int fsync(int file) {
  if (++fsync_calls == faults.fsync_call) return failed(faults.fsync_error);
  return static_cast<int>(syscall(SYS_fsync, file));
}

extern "C" ssize_t write(int file, const void* data, size_t size) {
  ++write_calls;
  if (faults.interruptions > 0) {
    --faults.interruptions;
    return failed(EINTR);
  }
  if (faults.write_error != 0 && faults.writes_before-- <= 0) return failed(faults.write_error);
  if (faults.write_limit != 0) size = std::min(size, faults.write_limit);
  return syscall(SYS_write, file, data, size);
}

namespace quoll {
namespace {

namespace fs = std::filesystem;

class FileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / ("quoll-test-" + std::string(6, 'X'))).string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    path_ = folder_ + "/file";
    restore();
  }
  void TearDown() override {
    restore();
    fs::remove_all(folder_);
  }
  static void restore() {
    faults = {};
    fsync_calls = 0;
    write_calls = 0;
  }
  static std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void put(const std::string& path, std::string_view content) {
    std::ofstream(path, std::ios::binary) << content;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  /// Does something as a user who is not root, whom no permission stops.
  template <class Action>
  auto unprivileged(Action action) {
    const uid_t user = geteuid();
    if (user == 0) {
      fs::permissions(folder_, fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
      EXPECT_EQ(seteuid(65534), 0);
    }
    auto result = action();
    EXPECT_EQ(seteuid(user), 0);
    return result;
  }
  /// Writes "new" over "old" with the faults set, and sees that nothing happened.
  std::string refused_write() {
    const Faults wanted = faults;
    restore();
    put(path_, "old");
    faults = wanted;
    const auto result = write_file(path_, "new content");
    restore();
    EXPECT_EQ(content_of(path_), "old");
    EXPECT_EQ(files(), 1u) << "the temporary file is gone";
    return result ? "written" : result.error().expected;
  }

  std::string folder_, path_;
};

TEST_F(FileTest, ReadsWhatIsThere) {
  const std::string content("a\0b\r\n", 5);
  put(path_, content);
  EXPECT_EQ(*read_file(path_), content);
  put(path_, "");
  EXPECT_EQ(*read_file(path_), "");
  put(path_, std::string(3'000'000, 'x'));
  EXPECT_EQ(read_file(path_)->size(), 3'000'000u);
}

TEST_F(FileTest, ReadsAPipe) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  std::thread writer([&] { put(path_, std::string(200'000, 'p')); });
  EXPECT_EQ(*read_file(path_), std::string(200'000, 'p'));
  writer.join();
}

TEST_F(FileTest, RefusesToReadOtherThings) {
  EXPECT_EQ(message(read_file("adventur.toml").error()), "adventur.toml: no such file");
  EXPECT_EQ(message(read_file(folder_).error()), folder_ + ": a folder, not a file");
  EXPECT_EQ(message(read_file("").error()), "no such file");
  EXPECT_EQ(message(read_file("/dev/null").error()), "/dev/null: not a regular file");
  put(path_, "x");
  EXPECT_EQ(message(read_file(path_ + "/y").error()),
            path_ + "/y: cannot be read: Not a directory");
  fs::permissions(path_, fs::perms::none);
  const auto result = unprivileged([&] { return read_file(path_); });
  ASSERT_FALSE(result);
  EXPECT_EQ(message(result.error()), path_ + ": cannot be read: Permission denied");
}

TEST_F(FileTest, AFileLargerThanTheMemoryIsAnError) {
  put(path_, "");
  std::error_code unsupported;
  fs::resize_file(path_, std::uintmax_t{1} << 42, unsupported);  // sparse: no disk is used
  if (unsupported) GTEST_SKIP() << "no file of 4 TiB here";
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
#if defined(QUOLL_SANITIZED)
  GTEST_SKIP() << "sanitizers need the address space";
#endif
  rlimit small = before;
  small.rlim_cur = rlim_t{1} << 40;
  ASSERT_EQ(setrlimit(RLIMIT_AS, &small), 0);
  const auto result = read_file(path_);
  setrlimit(RLIMIT_AS, &before);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().expected, "too large for the memory: 4398046511105 bytes");
}

TEST_F(FileTest, WritesNewAndReplacesOld) {
  ASSERT_TRUE(write_file(path_, "one"));
  EXPECT_EQ(content_of(path_), "one");
  ASSERT_TRUE(write_file(path_, std::string("two\0", 4)));
  EXPECT_EQ(content_of(path_), std::string("two\0", 4));
  ASSERT_TRUE(write_file(path_, ""));
  EXPECT_EQ(content_of(path_), "");
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(fsync_calls, 6) << "the file and its folder, each time";
}

TEST_F(FileTest, ANameWithoutFolderIsHere) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_TRUE(write_file("plain", "x"));
  fs::current_path(before);
  EXPECT_EQ(content_of(folder_ + "/plain"), "x");
}

TEST_F(FileTest, KeepsPermissionsAndFollowsLinks) {
  put(path_, "old");
  fs::permissions(path_, fs::perms(0640));
  fs::create_symlink("file", folder_ + "/link");
  ASSERT_TRUE(write_file(folder_ + "/link", "new"));
  EXPECT_TRUE(fs::is_symlink(folder_ + "/link"));
  EXPECT_EQ(content_of(path_), "new");
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms(0640));
}

TEST_F(FileTest, ANewFileFollowsTheMask) {
  const mode_t before = umask(027);
  const bool written = static_cast<bool>(write_file(path_, "x"));
  umask(before);
  EXPECT_TRUE(written);
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms(0640));
}

TEST_F(FileTest, RefusesImpossibleTargets) {
  const auto refusal = [](const std::string& path) {
    const auto result = write_file(path, "x");
    return result ? "written" : result.error().expected;
  };
  EXPECT_EQ(refusal(folder_), "cannot be written: a folder");
  EXPECT_EQ(refusal(folder_ + "/no/file"), "cannot be written: open: No such file or directory");
  EXPECT_EQ(refusal(""), "a file name expected");
  EXPECT_EQ(refusal(folder_ + "/" + std::string(300, 'a')),
            "cannot be written: stat: File name too long");
  put(path_, "x");
  EXPECT_EQ(refusal(path_ + "/y"), "cannot be written: stat: Not a directory");
  fs::create_symlink("nowhere", folder_ + "/link");
  EXPECT_EQ(refusal(folder_ + "/link"), "cannot be written: a link that leads nowhere");
  EXPECT_EQ(files(), 2u);
}

TEST_F(FileTest, ADeviceIsWrittenAndNotReplaced) {
  EXPECT_TRUE(write_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const auto full = write_file("/dev/full", "x");
  ASSERT_FALSE(full);
  EXPECT_EQ(message(full.error()), "/dev/full: cannot be written: write: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(FileTest, ShortAndInterruptedWritesAreContinued) {
  faults.write_limit = 3;
  faults.interruptions = 2;
  ASSERT_TRUE(write_file(path_, "0123456789"));
  EXPECT_EQ(write_calls, 6);  // 2 interruptions, then 3 + 3 + 3 + 1 bytes
  restore();
  EXPECT_EQ(content_of(path_), "0123456789");
}

TEST_F(FileTest, AFullDiskLeavesTheOldFile) {
  faults.write_limit = 4;
  faults.write_error = ENOSPC;
  faults.writes_before = 1;
  EXPECT_EQ(refused_write(), "cannot be written: write: No space left on device");
}

TEST_F(FileTest, AFailingFsyncLeavesTheOldFile) {
  faults.fsync_call = 1;
  EXPECT_EQ(refused_write(), "cannot be written: fsync: Input/output error");
}

TEST_F(FileTest, AFailingFsyncOfTheFolderIsReported) {
  faults.fsync_call = 2;
  const auto result = write_file(path_, "new");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().expected, "written, but fsync of its folder: Input/output error");
  EXPECT_EQ(content_of(path_), "new");
  restore();
  faults.fsync_call = 2;
  faults.fsync_error = EINVAL;  // a file system whose folders cannot be synchronised
  EXPECT_TRUE(write_file(path_, "newer"));
}

// A real limit of the system rather than a simulated one.
TEST_F(FileTest, ALimitOnFileSizesLeavesTheOldFile) {
  put(path_, "old");
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 1000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto result = write_file(path_, std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().expected, "cannot be written: write: File too large");
  EXPECT_EQ(content_of(path_), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, AReadOnlyFolderIsNamed) {
  put(path_, "old");
  fs::permissions(folder_, fs::perms(0555));
  const auto result = unprivileged([&] { return write_file(path_, "new"); });
  fs::permissions(folder_, fs::perms(0700));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().expected, "cannot be written: open: Permission denied");
  EXPECT_EQ(content_of(path_), "old");
}

class ContainerTest : public FileTest {
 protected:
  static std::vector<std::byte> bytes(std::string_view text) {
    const auto* const first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
  }
  std::string load(std::string_view kind = "run") {
    const auto result = load_archive(path_, kind);
    return result ? "taken" : result.error().expected;
  }
  std::string save(std::string_view kind = "run") {
    const auto result = save_archive(path_, kind, bytes("content"));
    return result ? "written" : result.error().expected;
  }
};

TEST_F(ContainerTest, GivesBackTheContent) {
  ASSERT_TRUE(save_archive(path_, "run", bytes("content")));
  EXPECT_EQ(*load_archive(path_, "run"), bytes("content"));
  ASSERT_TRUE(save_archive(path_, "run", {}));
  EXPECT_EQ(load_archive(path_, "run")->size(), 0u);
}

// docs/formats.md. The checksum of these 28 bytes was computed with the xxhsum program (xxhsum
// -H3).
TEST_F(ContainerTest, TheBytesAreAsSpecified) {
  ASSERT_TRUE(save_archive(path_, "run", bytes("abcd")));
  const std::string head("QUOLL\r\n\x1a\1\0\0\0\3run\4\0\0\0\0\0\0\0abcd", 28);
  EXPECT_EQ(content_of(path_).substr(0, 28), head);
  EXPECT_EQ(content_of(path_).substr(28), "\x96\xbc\x79\x77\x62\x08\x50\xb8");
}

TEST_F(ContainerTest, EveryTruncationIsRefused) {
  ASSERT_EQ(save(), "written");
  const std::string whole = content_of(path_);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put(path_, whole.substr(0, size));
    const std::string text = load();
    EXPECT_TRUE(text.starts_with(size == 0 ? "not a Quoll file" : "truncated: ")) << text;
    if (size > 0) {
      EXPECT_NE(save(), "written") << "a damaged file is kept";
    }
  }
  put(path_, whole.substr(0, 30));
  EXPECT_EQ(load(), "truncated: 30 of 39 bytes");
  put(path_, whole + "x");
  EXPECT_EQ(load(), "damaged: 1 bytes follow its end");
}

TEST_F(ContainerTest, EveryFlippedBitIsRefused) {
  ASSERT_EQ(save(), "written");
  const std::string whole = content_of(path_);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      put(path_, damaged);
      EXPECT_NE(load(), "taken") << at;
      if (bit == 0) {
        EXPECT_NE(save(), "written") << at;
      }
      EXPECT_EQ(content_of(path_), damaged);
    }
  }
  std::string damaged = whole;
  damaged[25] = 'X';
  put(path_, damaged);
  EXPECT_EQ(load(), "damaged: checksum differs");
  damaged = whole;
  damaged[8] = 2;
  put(path_, damaged);
  EXPECT_EQ(load(), "written by a newer Quoll (format 2, this program reads 1)");
}

TEST_F(ContainerTest, AnotherKindIsNamed) {
  ASSERT_EQ(save("policy"), "written");
  EXPECT_EQ(load(), "holds a policy, not a run");
  EXPECT_EQ(save(), "holds a policy, not a run; it is kept, choose another name or remove it");
  EXPECT_EQ(load("policy"), "taken");
}

TEST_F(ContainerTest, AForeignFileIsNeverOverwritten) {
  put(path_, "my thesis");
  EXPECT_EQ(load(), "not a Quoll file");
  EXPECT_EQ(save(), "not a Quoll file; it is kept, choose another name or remove it");
  EXPECT_EQ(content_of(path_), "my thesis");
  put(path_, "");
  EXPECT_EQ(save(), "written") << "an empty file has nothing to lose";
  EXPECT_EQ(save(), "written");
}

TEST_F(ContainerTest, RandomBytesAreRefused) {
  Rng rng = stream(9, "foreign");
  for (int round = 0; round < 300; ++round) {
    std::string content = "QUOLL\r\n\x1a";
    for (std::uint32_t size = rng.below(80); size > 0; --size) {
      const bool zero = rng.below(4) != 0;
      const std::uint32_t value = rng.below(256);
      content += static_cast<char>(zero ? 0 : value);
    }
    put(path_, content);
    EXPECT_NE(load(), "taken") << round;
  }
}

}  // namespace
}  // namespace quoll

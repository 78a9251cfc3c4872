#include "tasks/io/file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <future>

#include "tasks/io/atomic_file.hpp"
#include "tasks/io/process.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tests/tasks/run/failing.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using test::files_below;
using test::TemporaryDirectory;

TEST(AtomicFile, AFailedWriteLeavesNothing) {
  const TemporaryDirectory directory;
  EXPECT_THROW(write_atomically(directory / "absent" / "f.json", "x"), FileError);
  std::filesystem::create_directories(directory / "taken" / "inside");
  EXPECT_THROW(write_atomically(directory / "taken", "x"), FileError);
  EXPECT_TRUE(files_below(directory.path()).empty());
}

TEST(Output, RefusesALinkOfAnotherUserInASharedFolder) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make a link of another user";
  const TemporaryDirectory directory;
  const auto target = directory / "target", shared = directory / "shared", link = shared / "link";
  test::write_text(target, "before");
  fs::create_directory(shared);
  fs::create_symlink(target, link);
  constexpr uid_t other = 65534;
  ASSERT_EQ(lchown(link.c_str(), other, other), 0);
  ASSERT_EQ(chmod(shared.c_str(), 01777), 0);
  EXPECT_THROW(write_output(link, "after"), FileError);
  EXPECT_EQ(read_text(target), "before");
  const auto ended = test::shell("$ISOJAM manual -o shared/link", directory.path());
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_NE(ended.err.find("shared/link: is a symbolic link of another user"), std::string::npos) << ended.err;
  EXPECT_EQ(read_text(target), "before");
  // The kernel follows links of the owner of the folder, and all links in a folder that is not shared.
  ASSERT_EQ(chown(shared.c_str(), other, other), 0);
  EXPECT_NO_THROW(write_output(link, "of the owner"));
  ASSERT_EQ(chown(shared.c_str(), 0, 0), 0);
  ASSERT_EQ(chmod(shared.c_str(), 0755), 0);
  EXPECT_NO_THROW(write_output(link, "after"));
  EXPECT_EQ(read_text(target), "after");
}

FileError::Reason reason_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const FileError& error) {
    return error.reason();
  }
  ADD_FAILURE() << "no error";
  return FileError::Reason::refused;
}

TEST(ReadFile, AResultIsARegularFile) {
  const TemporaryDirectory directory;
  const auto pipe = directory / "pipe", device = directory / "device";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", device);
  fs::create_symlink("circle", directory / "circle");
  for (const auto& path : {pipe, device, directory.path(), directory / "circle"})
    EXPECT_EQ(reason_of([&] { read_file(path); }), FileError::Reason::no_file) << path;
  EXPECT_EQ(reason_of([&] { read_file(directory / "absent"); }), FileError::Reason::missing);
  EXPECT_EQ(reason_of([&] { read_text("/dev/zero"); }), FileError::Reason::resource_failure) << "endless";
  EXPECT_EQ(read_text("/dev/null"), "");
#if !defined(__SANITIZE_ADDRESS__)
  // This file is larger than any memory, but uses no disk space.
  test::write_text(directory / "huge", "{");
  fs::resize_file(directory / "huge", std::uintmax_t{1} << 42);
  try {
    read_file(directory / "huge");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.reason(), FileError::Reason::resource_failure);
    EXPECT_NE(std::string(error.what()).find("huge: cannot be read: Cannot allocate memory"), std::string::npos);
  }
#endif
}

TEST(StandardStreams, PrintedTextCannotControlTheTerminal) {
  EXPECT_EQ(printable("a\x1b[2J\tb\r\nφ\x7f\xc2\x9b\xc2\xa0"), "a\\x1b[2J\tb\\x0d\nφ\\x7f\\x9b\xc2\xa0");
  const auto [seen, status] = test::on_a_terminal([] { print("d\x1b[31m\n"); });
  EXPECT_EQ(seen, "d\\x1b[31m\r\n");
}

}  // namespace
}  // namespace isojam

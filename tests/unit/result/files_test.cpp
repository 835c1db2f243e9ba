#include "scabo/result/files.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "unit/result/solutions.hpp"

namespace scabo::result {
namespace {

using namespace scabo::test;
using testing::HasSubstr;

template <typename Function>
std::string write_error(Function function) {
  try {
    function();
  } catch (const WriteError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Files, AFullDiskIsNamedWithTheFile) {
  const std::string message = write_error([] { GrowingFile("/dev/full").append("data"); });
  EXPECT_EQ(message, "cannot write /dev/full: No space left on device");
  EXPECT_EQ(write_error([] { write_file("/dev/full", "data"); }), message);
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

TEST(Files, AMissingDirectoryIsNamedWithTheFile) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "gone" / "file";
  EXPECT_EQ(write_error([&] { write_file(file, "data"); }),
            "cannot write " + file.string() + ": No such file or directory");
}

TEST(Files, NothingIsLeftOfAFileThatDoesNotFit) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "file";
  const SmallDisk disk(1000);
  EXPECT_THAT(write_error([&] { write_file(file, std::string(1500, 'x')); }), HasSubstr(file.string()));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Files, ReplacingKeepsTheOldContentWhenItFails) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "file";
  replace_file(file, "old");
  {
    const SmallDisk disk(1000);
    EXPECT_THAT(write_error([&] { replace_file(file, std::string(1500, 'x')); }), HasSubstr("cannot write"));
  }
  EXPECT_EQ(content_of(file), "old");
  replace_file(file, "new");
  EXPECT_EQ(content_of(file), "new");
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "file.part"));
}

TEST(Files, ReplacingWritesIntoAPipe) {
  const TemporaryDirectory directory;
  const auto pipe = directory.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  replace_file(pipe, "content");
  std::string read(7, ' ');
  EXPECT_EQ(::read(reader, read.data(), read.size()), 7);
  ::close(reader);
  EXPECT_EQ(read, "content");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(GrowingFile, IsCompleteAfterEveryWrite) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "file";
  GrowingFile file(path);
  file.append_before_footer("begin ", "end");
  EXPECT_EQ(content_of(path), "begin end");
  file.append_before_footer("a ", "end");
  file.append_before_footer("b ", "end");
  EXPECT_EQ(content_of(path), "begin a b end");
}

TEST(GrowingFile, KeepsWhatItHadWhenAWriteFails) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "file";
  GrowingFile file(path);
  file.append_before_footer(std::string(900, 'a'), "end");
  {
    const SmallDisk disk(1000);
    EXPECT_THAT(write_error([&] { file.append_before_footer(std::string(500, 'b'), "end"); }),
                HasSubstr(path.string()));
  }
  EXPECT_EQ(content_of(path), std::string(900, 'a') + "end");
  file.append_before_footer("c", "end");
  EXPECT_EQ(content_of(path), std::string(900, 'a') + "cend");
}

TEST(GrowingFile, CutsBackToWhatItHadBefore) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "file";
  GrowingFile file(path);
  file.append_before_footer("begin ", "end");
  const long long before = file.size();
  file.append_before_footer(std::string(900, 'a'), "end");
  {
    const SmallDisk disk(100);
    file.cut_back(before);
  }
  EXPECT_EQ(content_of(path), "begin end");
  file.append_before_footer("b ", "end");
  EXPECT_EQ(content_of(path), "begin b end");
}

}  // namespace
}  // namespace scabo::result

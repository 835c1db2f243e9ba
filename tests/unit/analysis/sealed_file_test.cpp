#include "scabo/analysis/state/sealed_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace scabo::analysis {
namespace {

struct Content {
  std::string version = "9";
  std::vector<std::string> names{"lower", "", std::string("a\0b", 3)};
  std::vector<double> numbers{0.1, -0.0, std::numeric_limits<double>::infinity(), 5e-324};
  std::vector<double> none;
  std::vector<int> states{0, -7, 2};
};

template <typename Io>
void exchange(Io& io, Content& of) {
  io.text("version", of.version);
  exchange_texts(io, "names", of.names);
  io.numbers("numbers", of.numbers);
  io.numbers("none", of.none);
  io.integers("states", of.states);
}

class SealedFile : public testing::Test {
 protected:
  SealedFile() {
    Content content;
    Sealing io("mark\n");
    exchange(io, content);
    io.write(file_);
    std::ifstream stream(file_, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(stream), {});
  }
  ~SealedFile() override { std::filesystem::remove(file_); }
  void put(const std::string& bytes) { std::ofstream(file_, std::ios::binary) << bytes; }
  Content read() {
    Content content{"", {}, {}, {1.0}, {}};
    Unsealing io(file_, "mark\n");
    exchange(io, content);
    io.finish();
    return content;
  }
  std::filesystem::path file_ = testing::TempDir() + "sealed_file";
  std::string bytes_;
};

TEST_F(SealedFile, GivesBackEveryBit) {
  const Content written, read = this->read();
  EXPECT_EQ(Unsealing(file_, "mark\n").first_text(), "9");
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.names, written.names);
  EXPECT_EQ(read.numbers, written.numbers);
  EXPECT_TRUE(std::signbit(read.numbers[1]));
  EXPECT_TRUE(read.none.empty());
  EXPECT_EQ(read.states, written.states);
}

TEST_F(SealedFile, IsRefusedWhereverABitHasChangedOrItIsCutOff) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    put(bytes_.substr(0, at));
    EXPECT_THROW(read(), std::exception) << "the first " << at << " bytes";
    std::string changed = bytes_;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    put(changed);
    EXPECT_THROW(read(), std::exception) << "byte " << at;
  }
  put(bytes_ + "more");
  EXPECT_THROW(read(), std::out_of_range);
}

TEST_F(SealedFile, IsRefusedAsAnotherOne) {
  EXPECT_THROW(Unsealing(file_, "other\n"), std::out_of_range);
  EXPECT_THROW(Unsealing(file_ / "missing", "mark\n"), InputError);
  std::string text;
  Unsealing io(file_, "mark\n");
  EXPECT_THROW(io.text("origin", text), std::out_of_range);
}

TEST_F(SealedFile, LeavesNothingWhereItCannotBeWritten) {
  EXPECT_THROW(Sealing("mark\n").write(file_ / "below"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(file_ / "below"));
}

}  // namespace
}  // namespace scabo::analysis

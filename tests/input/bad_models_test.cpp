// Every file of tests/input/bad leads to exactly the messages it says: in comment lines at its start,
//     # expect: 5:13: materials.concrete.young: must be greater than 0, not -10e9
// or in a file beside it (`name.yaml.expect`) where a comment would spoil the mistake. Files with
// `expect-later` are sound for the reader; what is wrong with them is found by later stages
// (bad_models_cli_test.py).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scabo/input/space/read_solid_model.hpp"

namespace scabo::model {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct Expectation {
  std::vector<std::string> messages;
  bool later = false;
};

Expectation expectation_of(const fs::path& file) {
  const fs::path sidecar = file.string() + ".expect";
  if (fs::exists(sidecar)) return {lines_of(sidecar), false};
  Expectation expectation;
  const std::string mark = "# expect: ";
  for (const std::string& line : lines_of(file)) {
    if (line.rfind("# expect-later: ", 0) == 0) expectation.later = true;
    if (line.rfind(mark, 0) == 0) expectation.messages.push_back(line.substr(mark.size()));
  }
  return expectation;
}

std::vector<fs::path> bad_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(SCABO_BAD_MODELS)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The messages without the name of the file and the separator after it.
std::vector<std::string> messages_of(const fs::path& file) {
  std::vector<std::string> messages;
  try {
    input::read_any_model(file.string());
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      const std::string text = format_diagnostic("", diagnostic).substr(1);
      messages.push_back(text.substr(text.find_first_not_of(' ')));
    }
  }
  return messages;
}

class BadModel : public testing::TestWithParam<fs::path> {};

TEST_P(BadModel, LeadsToTheMessagesItSays) {
  const Expectation expectation = expectation_of(GetParam());
  if (expectation.later) {
    EXPECT_THAT(messages_of(GetParam()), testing::IsEmpty()) << "what is wrong here is found after the reader";
    return;
  }
  ASSERT_FALSE(expectation.messages.empty()) << "no '# expect: ' line";
  EXPECT_THAT(messages_of(GetParam()), testing::ElementsAreArray(expectation.messages));
}

INSTANTIATE_TEST_SUITE_P(Files, BadModel, testing::ValuesIn(bad_files()),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

TEST(BadModels, AreManyAndOfEveryKind) { EXPECT_GE(bad_files().size(), 80u); }

}  // namespace
}  // namespace scabo::model

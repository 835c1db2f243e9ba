#include "support/recorded_checks.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

namespace scabo::test {
namespace {

constexpr std::size_t models_kept = 3;  // of one test: the manual draws the first that needs no file

/// One comparison, the worst of all that one line of a test makes: the largest error over its bound.
struct Check {
  double value = 0.0, reference = 0.0, bound = 0.0;
  bool below = false;  // value < bound, without a reference
  long times = 0;

  double share() const {  // of the bound
    const double error = below ? value : std::abs(value - reference);
    return bound > 0.0 ? error / bound : (error == 0.0 ? 0.0 : INFINITY);
  }
};

struct Test {
  std::string file;
  int line = 0;
  std::vector<std::pair<std::string, std::string>> order;  // expressions, in the sequence of the test
  std::map<std::pair<std::string, std::string>, Check> checks;
  std::vector<nlohmann::json> models;
};

/// Everything of this program, written when it ends.
class Record {
 public:
  static Record* get() {
    static Record record;
    return record.directory_.empty() ? nullptr : &record;
  }

  void add(const char* value_text, const char* reference_text, Check check) {
    const std::lock_guard lock(mutex_);
    Test* test = current();
    if (!test) return;
    const std::pair<std::string, std::string> texts(value_text, reference_text);
    const auto [place, is_new] = test->checks.try_emplace(texts, check);
    if (is_new) {
      test->order.push_back(texts);
      return;
    }
    check.times = place->second.times + 1;
    if (check.share() > place->second.share())
      place->second = check;
    else
      place->second.times = check.times;
  }

  void add_model(const std::string& text, const std::vector<std::string>& settings) {
    const std::lock_guard lock(mutex_);
    Test* test = current();
    if (test && test->models.size() < models_kept) test->models.push_back({{"text", text}, {"settings", settings}});
  }

  ~Record() {
    if (directory_.empty() || tests_.empty()) return;
    std::ofstream file(directory_ + "/" + std::to_string(getpid()) + ".jsonl");
    for (const auto& [name, test] : tests_) {
      nlohmann::json checks = nlohmann::json::array();
      for (const auto& texts : test.order) {
        const Check& check = test.checks.at(texts);
        nlohmann::json entry = {
            {"of", texts.first}, {"value", check.value}, {"bound", check.bound}, {"times", check.times}};
        if (!check.below) entry["reference"] = check.reference, entry["exact"] = texts.second;
        checks.push_back(entry);
      }
      file << nlohmann::json{{"suite", name.first}, {"test", name.second}, {"file", test.file},
                             {"line", test.line},   {"checks", checks},    {"models", test.models}}
           << "\n";
    }
  }

 private:
  Record() {
    if (const char* directory = std::getenv("SCABO_RECORDED_CHECKS")) directory_ = directory;
  }

  Test* current() {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    if (!info) return nullptr;
    Test& test = tests_[{info->test_suite_name(), info->name()}];
    test.file = info->file();
    test.line = info->line();
    return &test;
  }

  std::mutex mutex_;
  std::string directory_;
  std::map<std::pair<std::string, std::string>, Test> tests_;
};

}  // namespace

void record_difference(const char* value_text, const char* reference_text, double value, double reference,
                       double bound) {
  if (Record* record = Record::get()) record->add(value_text, reference_text, {value, reference, bound, false, 1});
}

void record_below(const char* value_text, double value, double bound) {
  if (Record* record = Record::get()) record->add(value_text, "", {value, 0.0, bound, true, 1});
}

void record_model(const std::string& text, const std::vector<std::string>& settings) {
  if (Record* record = Record::get()) record->add_model(text, settings);
}

}  // namespace scabo::test

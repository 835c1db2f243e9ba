#include "scabo/files/record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace scabo::files {
namespace {

class Records : public ::testing::Test {
 protected:
  std::string file(const std::string& content) const {
    const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "record_of_a_test.txt";
    std::ofstream(path) << content;
    return path.string();
  }
  /// `line: message` of the mistake.
  std::string mistake(const std::string& content, int column = 2) const {
    try {
      read_record(file(content), column);
    } catch (const InputError& error) {
      const Diagnostic& first = error.diagnostics().front();
      return std::to_string(first.at.line) + ": " + first.message;
    }
    return "none";
  }
};

TEST_F(Records, OfPeer) {
  for (const char* header : {"NPTS=   5, DT=   .0100 SEC", "5    0.0100    NPTS, DT"}) {
    const Record record = read_record(
        file(std::string("PEER\nTest\nACCELERATION IN UNITS OF G\n") + header + "\n .1E+00 -2.5E-01 3e-1\n 0.0 .05\n"));
    EXPECT_EQ(record.values, (std::vector<double>{0.1, -0.25, 0.3, 0.0, 0.05}));
    EXPECT_EQ(record.step, 0.01);
    EXPECT_EQ(record.unit, "g");
  }
  const auto unit = [&](const std::string& third) {
    return read_record(file("PEER\nTest\n" + third + "\nNPTS= 2, DT= .01 SEC\n1 2\n")).unit.value_or("");
  };
  EXPECT_EQ(unit("VELOCITY TIME SERIES IN UNITS OF CM/S"), "cm/s");
  EXPECT_EQ(unit("DISPLACEMENT TIME SERIES IN UNITS OF CM"), "cm");
  EXPECT_EQ(unit("ACCELERATION TIME SERIES IN UNITS OF CM/S/S"), "cm/s2");
  EXPECT_EQ(mistake("P\nT\nA\nNPTS= 3, DT= .01 SEC\n1 2\n"), "4: says that 3 values follow, but 2 do");
}

TEST_F(Records, OfKNet) {
  const Record record = read_record(
      file("Origin Time       2011/03/11 14:46:00\nSampling Freq(Hz) 100Hz\nScale Factor      2000(gal)/8000\nMemo.\n"
           "  4  -8 12\n 16\n"));
  EXPECT_EQ(record.values, (std::vector<double>{1.0, -2.0, 3.0, 4.0}));
  EXPECT_EQ(record.step, 0.01);
  EXPECT_EQ(record.unit, "cm/s2");
}

TEST_F(Records, InTables) {
  const Record plain = read_record(file("# a remark\n2.0 1\n2.5 -3\n3.0 2\n"));
  EXPECT_EQ(plain.begin, 2.0);
  EXPECT_EQ(plain.step, 0.5);
  EXPECT_EQ(plain.values, (std::vector<double>{1.0, -3.0, 2.0}));
  EXPECT_FALSE(plain.unit);
  EXPECT_EQ(read_record(file("t;x;y\r\n0;1;7\r\n1;2;8\r\n"), 3).values, (std::vector<double>{7.0, 8.0}));
}

// A motion of two seconds, u = s^3 with s = t (2 - t): its acceleration from its displacement, its velocity and itself.
TEST_F(Records, AsAccelerations) {
  constexpr double h = 0.01;
  const auto record = [&](const auto& value) {
    Record made{0.5, h, {}, {}};
    for (int i = 0; i <= 200; ++i) made.values.push_back(value(h * i, h * i * (2.0 - h * i)));
    return made;
  };
  const auto exact = [](double t, double s) { return 24.0 * s * (1.0 - t) * (1.0 - t) - 6.0 * s * s; };
  const Acceleration of_u = acceleration_of(record([](double, double s) { return s * s * s; }),
                                            MotionKind::displacement, 2.0),
                     of_v = acceleration_of(record([](double t, double s) { return 6.0 * s * s * (1.0 - t); }),
                                            MotionKind::velocity, 2.0),
                     of_a = acceleration_of(record(exact), MotionKind::acceleration, 2.0);
  for (const Acceleration* of : {&of_u, &of_v, &of_a}) {
    EXPECT_NEAR(of->velocity(), 0.0, 0.01);
    EXPECT_NEAR(of->displacement(), 0.0, 0.01);
  }
  EXPECT_NEAR(of_v.velocity(), 0.0, 1e-12);  // that of the record, exactly
  EXPECT_NEAR(of_u.times[100], 1.5, 1e-12);
  EXPECT_NEAR(of_u.values[100], -12.0, 5e-3);
  EXPECT_NEAR(of_v.values[200], 2.0 * exact(1.005, 1.005 * 0.995), 5e-3);  // the mean from 1.00 to 1.01
  EXPECT_EQ(of_a.values[100], -12.0);
}

// With what a correction leaves, the ground stands still at the end.
TEST_F(Records, WithABaselineTakenOff) {
  const Record record{1.0, 0.5, {1.0, -3.0, 2.0, 5.0, -1.0}, {}};
  const Acceleration before = acceleration_of(record, MotionKind::acceleration, 1.0);
  EXPECT_DOUBLE_EQ(before.velocity(), 2.0);
  Acceleration mean = before, line = before;
  subtract(baseline_of(before, false), mean);
  subtract(baseline_of(before, true), line);
  EXPECT_NEAR(mean.velocity(), 0.0, 1e-14);
  EXPECT_GT(std::abs(mean.displacement()), 0.1);
  EXPECT_NEAR(line.velocity(), 0.0, 1e-14);
  EXPECT_NEAR(line.displacement(), 0.0, 1e-14);
  EXPECT_NEAR(line.values[1] - line.values[0], -4.0 - 0.5 * baseline_of(before, true).slope, 1e-14);
}

TEST_F(Records, WithMistakes) {
  EXPECT_EQ(mistake("0 1\n0.01 1\n0.03 1\n"),
            "3: the time step is 0.02 here and 0.01 before: a record has equal steps and no gaps");
  EXPECT_EQ(mistake("0 1\n0.01 1\n0.01 1\n"), "3: times must be ascending");
  EXPECT_EQ(mistake("0 1\n0.01 nan\n"), "2: must have 2 numbers or more: the time and, in column 2, the value");
  EXPECT_EQ(mistake("0 1\n1 2\n", 3), "1: must have 3 numbers or more: the time and, in column 3, the value");
  EXPECT_EQ(mistake("nothing\n"), "0: has no record: two values or more are needed");
}

}  // namespace
}  // namespace scabo::files

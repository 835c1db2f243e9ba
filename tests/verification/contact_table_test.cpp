// Signs of contact.csv: displacements of both sides along n and t, gap and slip, from motions that are known.
#include "scabo/result/contact_table.hpp"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// Rows of contact.csv by the names of its columns; `state` and `contact` are left out.
std::vector<std::map<std::string, double>> contact_rows(const analysis::IncrementResult& increment) {
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::string header(result::contact_table_header);
  header.pop_back();
  const std::vector<std::string> names = cells_of(header);
  std::vector<std::map<std::string, double>> rows;
  std::istringstream text(result::contact_table_rows(increment, {}));
  for (std::string line; std::getline(text, line);) {
    const std::vector<std::string> cells = cells_of(line);
    EXPECT_EQ(cells.size(), names.size());
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < std::min(cells.size(), names.size()); ++k)
      if (names[k] != "contact" && names[k] != "state") row[names[k]] = std::stod(cells[k]);
  }
  return rows;
}

/// A block without Poisson's ratio pressed down by 1e-3 and moved by 3e-3 on another like it, without friction, all
/// turned by `degrees` of 0 or 90 counter-clockwise: then it lies on the left.
std::string sliding_blocks(bool turned, const std::string& between) {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies:
  still: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}, mesh: {{size: 0.5}}}}
  moved: {{material: m, shape: {{rectangle: {{corner: {}, size: [1, 1]}}}}, mesh: {{size: 0.5}}}}
supports:
  - {{on: still.{}, fix: [x, y]}}
  - {{on: moved.{}, displacement: {}}}
contacts: {{joint: {{between: {}, friction: 0}}}}
)",
                     turned ? "[-1, 0]" : "[0, 1]", turned ? "right" : "bottom", turned ? "left" : "top",
                     turned ? "[1e-3, 3e-3]" : "[3e-3, -1e-3]", between);
}

// Each block is compressed by half of 1e-3 and sides of blocks stay straight. t is n turned by -90 degrees, so that
// with the other block as A both n and t are reversed, and with them every displacement, while gap and slip are not.
TEST(ContactTable, DisplacementsOfBothSidesAlongTheNormalAndTheTangent) {
  const struct {
    bool turned;
    const char* between;
    bool still_is_a;
    double along_t;                                                 // of the moved block
  } cases[] = {{false, "[still.top, moved.bottom]", true, 3e-3},    // n = +y, t = +x
               {false, "[moved.bottom, still.top]", false, -3e-3},  // n = -y, t = -x
               {true, "[still.left, moved.right]", true, 3e-3},     // n = -x, t = +y
               {true, "[moved.right, still.left]", false, -3e-3}};  // n = +x, t = -y
  for (const auto& [turned, between, still_is_a, along_t] : cases) {
    const auto rows = contact_rows(last(run(sliding_blocks(turned, between))));
    ASSERT_EQ(rows.size(), 5u);
    const std::string still = still_is_a ? "a" : "b", moved = still_is_a ? "b" : "a";
    const double along_n = still_is_a ? -5e-4 : 5e-4;  // the joint gives way towards the block that stands still
    for (const auto& row : rows) {
      EXPECT_NEAR(row.at("normal_displacement_" + still), along_n, 1e-12) << between;
      EXPECT_NEAR(row.at("normal_displacement_" + moved), along_n, 1e-12) << between;
      EXPECT_NEAR(row.at("tangential_displacement_" + still), 0.0, 1e-12) << between;
      EXPECT_NEAR(row.at("tangential_displacement_" + moved), along_t, 1e-12) << between;
      EXPECT_NEAR(row.at("slip"), 3e-3, 1e-12) << between;
      EXPECT_NEAR(row.at("gap"), 0.0, 1e-15) << between;
      EXPECT_GT(row.at("normal_force"), 0.0) << between;
    }
  }
}

// gap = gap at the start + (u_B - u_A).n and slip = (u_B - u_A).t, on pairs that are open, stick and slip; a rigid side
// is moved and turned as a whole.
TEST(ContactTable, GapAndSlipAreTheDifferencesOfTheDisplacements) {
  for (const char* between : {"[block.bottom, floor.top]", "[floor.top, block.bottom]"}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.2}}}}
bodies:
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [3, 1]}}}}, mesh: {{size: 0.25}}}}
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [5, 1]}}}}}}
supports:
  - {{on: block.left, fix: [x, y]}}
  - {{on: floor.top_left, displacement: [1e-4, -1e-3]}}
  - {{on: floor.top_right, displacement: [null, 2e-3]}}
loads: {{push: {{on: block.top, pressure: 1e5}}}}
contacts: {{joint: {{between: {}, friction: 0.2, gap: 2e-4}}}}
)",
                                          between));
    int open = 0, closed = 0;
    for (const auto& row : contact_rows(last(solution))) {
      EXPECT_NEAR(row.at("gap"), 2e-4 + row.at("normal_displacement_b") - row.at("normal_displacement_a"), 1e-12);
      EXPECT_NEAR(row.at("slip"), row.at("tangential_displacement_b") - row.at("tangential_displacement_a"), 1e-12);
      ++(row.at("gap") > 1e-9 ? open : closed);
    }
    EXPECT_GT(open, 3);
    EXPECT_GT(closed, 3);
  }
}

}  // namespace
}  // namespace scabo::verification

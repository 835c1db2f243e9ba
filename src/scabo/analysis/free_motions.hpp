// Relative motions that loads and supports alone give the pairs, without contact forces.
//
// They are linear in the factors of loads and supports:
//
//     q = sum_g c_g q_g                                                                                            (1)
//
// A group g: loads and supports whose factors are equal at every time of the run, c_g. Its motions q_g at factor 1 take
// a solve with the stiffness of every part when they are first needed and are kept, so that a next increment needs none
// for them. They do not depend on what came before: a run that goes on after it was killed gets the same bits.
#pragma once

#include <memory>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/model/model.hpp"

namespace scabo::analysis {

struct Prepared;
struct Factors;

class FreeMotions {
 public:
  /// Of pairs that move (2N) and of held ones, [n, t] each.
  struct OfPairs {
    Vector moving, held;
  };
  explicit FreeMotions(const model::Model& model);

  OfPairs at(const Prepared& prepared, const Factors& factors);

  std::size_t groups() const { return groups_.size(); }

 private:
  struct Group {
    std::vector<std::size_t> loads, supports;
    bool known = false;
    OfPairs motions;  ///< q_g
    double factor(const Factors& factors) const;
  };
  void find(const Prepared& prepared, Group& group) const;

  std::vector<Group> groups_;
};

/// Where (1) holds and pays: bodies and pairs stay as they are, and there are more increments than groups. Otherwise
/// null.
std::shared_ptr<FreeMotions> free_motions_worth_keeping(const model::Model& model);

}  // namespace scabo::analysis

// Interruption points: places within long work at which its caller may end it.
//
// A caller of long work makes an `Interruptible` with a function that every point in its thread calls while the object
// exists, and that ends the work by throwing what the same caller catches. linalg::parallel_for passes the function on
// to its threads: it is called by several at once. Without an `Interruptible` a point costs a nanosecond.
#pragma once

#include <functional>

namespace scabo {

class Interruptible {
 public:
  using Ask = std::function<void()>;

  /// `ask` must live as long. Null: nothing is asked, as in work that must not end halfway.
  explicit Interruptible(const Ask* ask);
  ~Interruptible();  ///< what was asked before is asked again
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// What is asked in this thread, for another one that works for it; null: nothing.
  static const Ask* asked();

 private:
  const Ask* before_;
};

/// May throw.
void interruption_point();

}  // namespace scabo

#include "scabo/base/interruption.hpp"

namespace scabo {

namespace {

thread_local const Interruptible::Ask* asked_here = nullptr;

}  // namespace

Interruptible::Interruptible(const Ask* ask) : before_(asked_here) { asked_here = ask; }

Interruptible::~Interruptible() { asked_here = before_; }

const Interruptible::Ask* Interruptible::asked() { return asked_here; }

void interruption_point() {
  if (asked_here) (*asked_here)();
}

}  // namespace scabo

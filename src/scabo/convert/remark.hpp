// What of a deck does not become part of a model.
#pragma once

#include <string>
#include <vector>

#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

struct Remark {
  files::DeckPlace at;
  std::string text;        ///< one sentence
  bool essential = false;  ///< without it the model would be another one
};

class Remarks {
 public:
  void essential(const files::DeckPlace& at, std::string text) { add(at, std::move(text), true); }
  void note(const files::DeckPlace& at, std::string text) { add(at, std::move(text), false); }
  const std::vector<Remark>& all() const { return all_; }
  std::vector<Remark> take() { return std::move(all_); }

 private:
  /// The same sentence about one line counts once, and the same warning about lines of one file too.
  void add(const files::DeckPlace& at, std::string text, bool essential) {
    constexpr std::size_t most = 500;  // more are not read; what matters is whether one is essential
    if (all_.size() >= most && (!essential || lost_)) return;
    lost_ = lost_ || essential;
    for (const Remark& known : all_)
      if ((known.at.line == at.line || !essential) && known.at.file == at.file && known.text == text) return;
    all_.push_back({at, std::move(text), essential});
  }
  std::vector<Remark> all_;
  bool lost_ = false;
};

}  // namespace scabo::convert

// Values as bytes, for messages between processes of the same program on the same kind of machine.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::mpi {

using Bytes = std::vector<char>;

template <typename T>
inline constexpr bool is_plain = std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec2>;

class Packer {
 public:
  template <typename T>
  void add(const T& value) {
    static_assert(is_plain<T>);
    const auto* const from = reinterpret_cast<const char*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof value);
  }
  void add(const std::string& text) { add_list(std::vector<char>(text.begin(), text.end())); }
  template <typename T>
  void add_list(const std::vector<T>& values) {
    static_assert(is_plain<T>);
    add(values.size());
    const auto* const from = reinterpret_cast<const char*>(values.data());
    bytes_.insert(bytes_.end(), from, from + values.size() * sizeof(T));
  }
  void add(const Vector& values) { add_list(std::vector<double>(values.begin(), values.end())); }
  Bytes take() && { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Reads them in the order in which they were added.
class Unpacker {
 public:
  explicit Unpacker(const Bytes& bytes) : bytes_(bytes) {}
  template <typename T>
  T get() {
    T value;
    read(&value, sizeof value);
    return value;
  }
  template <typename T>
  std::vector<T> get_list() {
    std::vector<T> values(get<std::size_t>());
    read(values.data(), values.size() * sizeof(T));
    return values;
  }
  std::string get_text() {
    const std::vector<char> text = get_list<char>();
    return {text.begin(), text.end()};
  }
  Vector get_vector() {
    const std::vector<double> values = get_list<double>();
    return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

 private:
  void read(void* to, std::size_t size) {
    ensure(at_ + size <= bytes_.size(), "a message is shorter than what is read from it");
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

}  // namespace scabo::mpi

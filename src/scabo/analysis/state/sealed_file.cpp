#include "scabo/analysis/state/sealed_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

namespace scabo::analysis {

namespace {

/// Before each name and each value stands how many bytes it has.
using Size = std::uint64_t;

std::string_view bytes_of(const Size& value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }

Size take_size(std::string_view& from) {
  Size value = 0;
  if (from.size() < sizeof value) throw std::out_of_range("the file is too short");
  std::memcpy(&value, from.data(), sizeof value);
  from.remove_prefix(sizeof value);
  return value;
}

std::string_view take_sized(std::string_view& from) {
  const Size size = take_size(from);
  if (size > from.size()) throw std::out_of_range("the file is too short");
  const std::string_view taken = from.substr(0, size);
  from.remove_prefix(size);
  return taken;
}

}  // namespace

void Sealing::add(std::string_view name, const void* values, std::size_t size) {
  bytes_.append(bytes_of(name.size())).append(name);
  bytes_.append(bytes_of(size)).append(static_cast<const char*>(values), size);
}

void Sealing::write(const std::filesystem::path& file) {
  bytes_.append(bytes_of(digest(bytes_)));
  int error = 0;
  const auto failed = [&] { error = error != 0 ? error : errno; };
  std::FILE* const out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) failed();
  if (out != nullptr && std::fwrite(bytes_.data(), 1, bytes_.size(), out) != bytes_.size()) failed();
  if (out != nullptr && std::fclose(out) != 0) failed();
  if (error == 0) return;
  if (out != nullptr) std::remove(file.c_str());
  throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(), std::system_category().message(error)));
}

Unsealing::Unsealing(const std::filesystem::path& file, std::string_view mark) {
  std::ifstream stream(file, std::ios::binary);
  bytes_.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream.is_open() || stream.bad()) throw InputError(file.string(), {{{}, "cannot be read"}});
  left_ = bytes_;
  if (!left_.starts_with(mark)) throw std::out_of_range("the file is another one");
  left_.remove_prefix(mark.size());
}

std::string Unsealing::first_text() const {
  std::string_view left = left_;
  take_sized(left);
  return std::string(take_sized(left));
}

std::string_view Unsealing::next(std::string_view name) {
  if (take_sized(left_) != name) throw std::out_of_range("a value is missing");
  return take_sized(left_);
}

template <typename T>
void Unsealing::take(std::string_view name, std::vector<T>& values) {
  const std::string_view bytes = next(name);
  if (bytes.size() % sizeof(T) != 0) throw std::out_of_range("a value is cut off");
  values.resize(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
}
template void Unsealing::take(std::string_view, std::vector<double>&);
template void Unsealing::take(std::string_view, std::vector<int>&);

void Unsealing::finish() const {
  std::string_view left = left_;
  const Size expected = take_size(left);
  if (!left.empty() || digest(std::string_view(bytes_).substr(0, bytes_.size() - sizeof expected)) != expected)
    throw std::out_of_range("the file has changed");
}

}  // namespace scabo::analysis

#include "scabo/input/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "scabo/base/impossible_path.hpp"

namespace scabo::input {

void refuse_file(const std::string& file, std::string message) {
  Diagnostic diagnostic;
  diagnostic.message = std::move(message);
  throw InputError(file, std::vector<Diagnostic>(1, diagnostic));
}

std::string read_text_file(const std::string& file, const YamlLimits& limits) {
  const auto fail = [&](const std::string& message) { refuse_file(file, message); };
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (const std::string why = impossible_path(file); !why.empty()) fail(why);
  if (!std::filesystem::exists(status) && code && code != std::errc::no_such_file_or_directory &&
      code != std::errc::not_a_directory)
    fail(fmt::format("cannot be read: {}", code.message()));
  if (!std::filesystem::exists(status)) fail("no such file");
  if (std::filesystem::is_directory(status)) fail("is a directory, not a model file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(fmt::format("cannot be read: {}", std::strerror(errno)));
  // Read in pieces, because pipes have no size.
  std::string text;
  std::vector<char> piece(1 << 16);
  while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())) || stream.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (static_cast<long>(text.size()) > limits.bytes) {
      fail(fmt::format("the file is larger than {} MB, which is too large for a model file", limits.bytes >> 20));
    }
  }
  if (stream.bad()) fail("cannot be read completely");
  return text;
}

}  // namespace scabo::input

#include "scabo/files/vtu_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

struct VtuType {
  const char* name;
  std::size_t bytes;
  bool integer, with_sign;
};
constexpr std::array<VtuType, 10> vtu_types{{{"Int8", 1, true, true},
                                             {"UInt8", 1, true, false},
                                             {"Int16", 2, true, true},
                                             {"UInt16", 2, true, false},
                                             {"Int32", 4, true, true},
                                             {"UInt32", 4, true, false},
                                             {"Int64", 8, true, true},
                                             {"UInt64", 8, true, false},
                                             {"Float32", 4, false, true},
                                             {"Float64", 8, false, true}}};

class VtuDecoder {
 public:
  VtuDecoder(const VtuSource& source, const VtuEncoding& encoding, const std::string& file)
      : source_(source), encoding_(encoding), file_(file), bytes_(source.data) {}

  [[noreturn]] void fail(const std::string& message) const {
    fail_in_file(file_, source_.line, 1, source_.what + " " + message);
  }

  /// The bytes of the array, at most `most`.
  std::string decode(std::size_t most) {
    if (encoding_.zlib) return inflate_blocks(most);
    const std::uint64_t size = header();
    if (size > most) fail(too_many);
    std::string all = take(size);
    if (all.size() < size) fail(truncated);
    return all;
  }

 private:
  static constexpr const char* truncated = "ends before the size that it announces; write it again";
  static constexpr const char* too_many =
      "has more values than NumberOfPoints and NumberOfCells allow; write the file again";

  std::uint64_t header() {
    const std::size_t width = encoding_.wide_header ? 8 : 4;
    const std::string bytes = take(width);
    if (bytes.size() < width) fail(truncated);
    std::uint64_t value = 0;
    for (std::size_t i = width; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  }

  /// The next `count` decoded bytes, or fewer at the end.
  std::string take(std::uint64_t count) {
    if (source_.form == VtuSource::Form::raw) {
      const std::string part(bytes_.substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(count, bytes_.size()))));
      bytes_.remove_prefix(part.size());
      return part;
    }
    std::string part = pending_.substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(count, pending_.size())));
    pending_.erase(0, part.size());
    part.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(count, bytes_.size())));
    while (part.size() < count && next_group()) {
      const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count - part.size(), pending_.size()));
      part.append(pending_, 0, wanted);
      pending_.erase(0, wanted);
    }
    return part;
  }

  /// Four characters of base64 are three bytes; `=` at the end of a group: fewer.
  bool next_group() {
    std::uint32_t bits = 0;
    int characters = 0, padding = 0;
    while (characters < 4 && !bytes_.empty()) {
      const char c = bytes_.front();
      if (static_cast<unsigned char>(c) <= ' ') {
        bytes_.remove_prefix(1);
        continue;
      }
      int six = 0;
      if (c >= 'A' && c <= 'Z') {
        six = c - 'A';
      } else if (c >= 'a' && c <= 'z') {
        six = c - 'a' + 26;
      } else if (c >= '0' && c <= '9') {
        six = c - '0' + 52;
      } else if (c == '+') {
        six = 62;
      } else if (c == '/') {
        six = 63;
      } else if (c == '=') {
        ++padding;
      } else if (c == '<') {
        break;  // the end of appended data
      } else {
        fail(fmt::format("has the character '{}', which base64 does not; write the file again",
                         printable(std::string_view(&c, 1))));
      }
      bytes_.remove_prefix(1);
      bits = bits << 6 | static_cast<std::uint32_t>(six);
      ++characters;
    }
    if (characters == 0) return false;
    if (characters < 4 || padding > 2) fail(truncated);
    for (int i = 0; i < 3 - padding; ++i) pending_ += static_cast<char>(bits >> (16 - 8 * i) & 255);
    return true;
  }

  /// Count of blocks, bytes of each but the last, of the last (0: as the others), compressed bytes of each; then the
  /// blocks.
  std::string inflate_blocks(std::size_t most) {
    const std::uint64_t blocks = header();
    const std::uint64_t block = header();
    const std::uint64_t last = header();
    std::vector<std::uint64_t> compressed;
    for (std::uint64_t i = 0; i < blocks; ++i) compressed.push_back(header());
    pending_.clear();  // the header is padded to a whole group
    std::string all;
    for (std::size_t i = 0; i < compressed.size(); ++i) {
      const std::uint64_t size = i + 1 == compressed.size() && last != 0 ? last : block;
      if (size > most - all.size()) fail(too_many);
      const std::string part = take(compressed[i]);
      if (part.size() < compressed[i]) fail(truncated);
      inflate(part, size, all);
    }
    return all;
  }

  /// Appends exactly `size` bytes. Memory grows as they come.
  void inflate(const std::string& from, std::uint64_t size, std::string& to) const {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) fail("cannot be decompressed: out of memory");
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(from.data()));
    std::array<char, 65536> buffer;
    std::uint64_t done = 0;
    std::size_t left = from.size();
    int status = Z_OK;
    while (status == Z_OK) {
      if (stream.avail_in == 0 && left > 0) {
        const std::size_t chunk = std::min<std::size_t>(left, 1u << 30);
        stream.avail_in = static_cast<uInt>(chunk);
        left -= chunk;
      }
      stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream.avail_out = static_cast<uInt>(buffer.size());
      status = ::inflate(&stream, Z_NO_FLUSH);
      const std::size_t produced = buffer.size() - stream.avail_out;
      done += produced;
      if (done > size) break;
      to.append(buffer.data(), produced);
    }
    inflateEnd(&stream);
    if (status != Z_STREAM_END || done != size) {
      fail(fmt::format("zlib gives {}{} bytes with status {}, and the file says {}; write it again",
                       done > size ? "more than " : "", std::min(done, size), status, size));
    }
  }

  const VtuSource& source_;
  const VtuEncoding& encoding_;
  const std::string& file_;
  std::string_view bytes_;
  std::string pending_;  // decoded, not yet taken: less than three bytes
};

template <class T>
T vtu_value(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class T, class To>
void append_as(const std::string& bytes, std::vector<To>& values) {
  values.reserve(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i + sizeof(T) <= bytes.size(); i += sizeof(T)) {
    values.push_back(static_cast<To>(vtu_value<T>(bytes.data() + i)));
  }
}

void read_vtu_text(const VtuSource& source, std::size_t most, const std::string& file, VtuValues& values) {
  TextCursor in(source.data, file, source.line);
  const std::string what = (values.integers ? "an integer of " : "a number of ") + source.what;
  while (in.skip_white()) {
    if (values.size() >= most) {
      in.fail(source.what + " has more values than NumberOfPoints and NumberOfCells allow; write the file again");
    }
    values.lines.push_back(in.line());
    if (values.integers) {
      values.whole.push_back(in.integer(what.c_str()));
    } else {
      values.real.push_back(in.number(what.c_str()));
    }
  }
}

}  // namespace

VtuValues read_vtu_values(const VtuSource& source, const std::string& type, const VtuEncoding& encoding,
                          std::size_t most, const std::string& file) {
  static_assert(std::endian::native == std::endian::little, "files are written with the least byte first");
  const auto known = std::find_if(vtu_types.begin(), vtu_types.end(), [&](const VtuType& t) { return type == t.name; });
  const VtuDecoder name_only(source, encoding, file);
  if (known == vtu_types.end()) {
    name_only.fail(
        fmt::format("has the type '{}'; it is Int8 to Int64, UInt8 to UInt64, Float32 or Float64", printable(type)));
  }
  VtuValues values;
  values.integers = known->integer;
  if (source.form == VtuSource::Form::text) {
    read_vtu_text(source, most, file, values);
    return values;
  }
  VtuDecoder decoder(source, encoding, file);
  const std::string bytes = decoder.decode(most > SIZE_MAX / 16 ? SIZE_MAX / 2 : most * known->bytes);
  if (bytes.size() % known->bytes != 0) {
    decoder.fail(fmt::format("has {} bytes, which is no whole number of values of type {}; write the file again",
                             bytes.size(), type));
  }
  if (!known->integer) {
    known->bytes == 4 ? append_as<float>(bytes, values.real) : append_as<double>(bytes, values.real);
  } else if (known->bytes == 1) {
    known->with_sign ? append_as<std::int8_t>(bytes, values.whole) : append_as<std::uint8_t>(bytes, values.whole);
  } else if (known->bytes == 2) {
    known->with_sign ? append_as<std::int16_t>(bytes, values.whole) : append_as<std::uint16_t>(bytes, values.whole);
  } else if (known->bytes == 4) {
    known->with_sign ? append_as<std::int32_t>(bytes, values.whole) : append_as<std::uint32_t>(bytes, values.whole);
  } else {
    append_as<std::int64_t>(bytes, values.whole);
  }
  return values;
}

}  // namespace scabo::files

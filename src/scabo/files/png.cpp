#include "scabo/files/png.hpp"

#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "scabo/base/error.hpp"
#include "scabo/files/bytes_of_file.hpp"

namespace scabo::files {

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// What libpng reports through its callbacks. They must not throw, because libpng is C: they jump.
struct PngMessage {
  char text[200] = "";
};

[[noreturn]] void keep_error(png_structp png, png_const_charp text) {
  PngMessage* message = static_cast<PngMessage*>(png_get_error_ptr(png));
  std::snprintf(message->text, sizeof message->text, "%s", text);
  std::longjmp(png_jmpbuf(png), 1);
}

void ignore_warning(png_structp, png_const_charp) {}

constexpr std::uint64_t most_pixels = std::uint64_t(1) << 28;

struct PngHeader {
  png_uint_32 width = 0, height = 0;
  int channels = 0;  // after conversion: 1 or 3, and one of transparency
  int bytes = 0;     // of a sample: 1 or 2
  std::size_t row_bytes = 0;
};

/// The part up to the size of the image. Nothing here has a destructor, as libpng may jump out of it.
bool read_header(png_structp png, png_infop info, std::FILE* file, PngHeader* header) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_init_io(png, file);
  png_set_user_limits(png, 1u << 20, 1u << 20);
  png_read_info(png, info);
  header->width = png_get_image_width(png, info);
  header->height = png_get_image_height(png, info);
  if (std::uint64_t(header->width) * header->height > most_pixels) png_error(png, "more than 2^28 pixels");
  const int colours = png_get_color_type(png, info);
  if (colours == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
  if (colours == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png, info) < 8) png_set_expand_gray_1_2_4_to_8(png);
  if (png_get_valid(png, info, PNG_INFO_tRNS)) png_set_tRNS_to_alpha(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  header->channels = png_get_channels(png, info);
  header->bytes = png_get_bit_depth(png, info) / 8;
  header->row_bytes = png_get_rowbytes(png, info);
  if (header->row_bytes != std::size_t(header->width) * header->channels * header->bytes || header->channels < 1 ||
      header->channels > 4) {
    png_error(png, "an unknown arrangement of samples");
  }
  return true;
}

bool read_rows(png_structp png, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

PngImage read_png(const std::string& file) {
  const auto refuse = [&](const std::string& reason) -> InputError {
    return InputError(file, {{{}, "the image cannot be read: " + reason}});
  };
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(file, error);
  const std::unique_ptr<std::FILE, CloseFile> input(is_file ? std::fopen(file.c_str(), "rb") : nullptr);
  if (!input) throw refuse(why_unreadable(file));
  unsigned char signature[8] = {};
  if (std::fread(signature, 1, 8, input.get()) != 8 || png_sig_cmp(signature, 0, 8) != 0)
    throw refuse("it is not a PNG file");
  std::rewind(input.get());

  struct Reader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  } reader;
  PngMessage message;
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, keep_error, ignore_warning);
  if (reader.png) reader.info = png_create_info_struct(reader.png);
  if (!reader.info) throw refuse("not enough memory");
  PngHeader header;
  if (!read_header(reader.png, reader.info, input.get(), &header)) throw refuse(message.text);
  std::vector<unsigned char> bytes(header.row_bytes * header.height);
  std::vector<png_bytep> rows(header.height);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = bytes.data() + y * header.row_bytes;
  if (!read_rows(reader.png, rows.data())) throw refuse(message.text);

  PngImage image;
  image.width = int(header.width);
  image.height = int(header.height);
  image.largest_label = header.bytes == 2 ? 65535 : 255;
  image.labels.resize(std::size_t(header.width) * header.height);
  const unsigned char* at = bytes.data();
  const auto sample = [&]() {
    int value = *at++;
    if (header.bytes == 2) value = 256 * value + *at++;
    return value;
  };
  for (int& label : image.labels) {
    if (header.channels <= 2) {
      label = sample();
    } else {
      const std::int64_t red = sample(), green = sample(), blue = sample();
      label = int((299 * red + 587 * green + 114 * blue + 500) / 1000);
    }
    if (header.channels % 2 == 0 && sample() < image.largest_label) ++image.transparent;
  }
  return image;
}

}  // namespace scabo::files

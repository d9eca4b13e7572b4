#include "ibmfair/picture/png.h"

#include <png.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

static_assert(sizeof(Rgb) == 3, "rows are handed to libpng as they are");

std::string encode_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0) {
    throw BadOption("a picture needs at least one pixel");
  }
  // libpng's simplified interface reports failures in the struct, whereas the full interface would
  // jump over our destructors.
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;

  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) ==
      0) {
    throw OutOfMemory(std::string("cannot encode the picture: ") + header.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace ibmfair

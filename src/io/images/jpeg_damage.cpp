// src/io/images/jpeg_damage.cpp: warnings of libjpeg.
#include "io/images/jpeg_damage.h"

#include <jerror.h>
#include <jpeglib.h>
#include <stdio.h>  // before jpeglib.h, which needs its types

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>

#include "core/error.h"

namespace softscope {
namespace {

struct Listener {
  jpeg_error_mgr manager;  // first member: libjpeg passes its address
  jmp_buf way_out;
  std::array<char, JMSG_LENGTH_MAX> complaint{};  // empty: none
};

Listener& listenerOf(j_common_ptr jpeg) { return *reinterpret_cast<Listener*>(jpeg->err); }

[[noreturn]] void fail(j_common_ptr jpeg) {
  Listener& listener = listenerOf(jpeg);
  listener.manager.format_message(jpeg, listener.complaint.data());
  longjmp(listener.way_out, 1);
}

/// The first warning about the data stops the reading; unusual header versions are not damage.
void listen(j_common_ptr jpeg, int level) {
  constexpr std::array<int, 5> kOfData{JWRN_HIT_MARKER, JWRN_HUFF_BAD_CODE, JWRN_JPEG_EOF,
                                       JWRN_EXTRANEOUS_DATA, JWRN_MUST_RESYNC};
  const int code = jpeg->err->msg_code;
  if (level < 0 && std::find(kOfData.begin(), kOfData.end(), code) != kOfData.end()) fail(jpeg);
}

void staySilent(j_common_ptr) {}

/// No object here has a destructor that longjmp would skip. use(jpeg) works on the header that was
/// read.
template <class Use>
void readJpeg(std::string_view bytes, Listener& listener, const Use& use) {
  jpeg_decompress_struct jpeg;
  jpeg.err = jpeg_std_error(&listener.manager);
  listener.manager.error_exit = fail;
  listener.manager.emit_message = listen;
  listener.manager.output_message = staySilent;
  jpeg_create_decompress(&jpeg);
  if (setjmp(listener.way_out) == 0) {
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&jpeg, TRUE);
    use(jpeg);
  }
  jpeg_destroy_decompress(&jpeg);
}

void requireNoComplaint(const Listener& listener, const std::string& name) {
  if (listener.complaint[0] != '\0')
    throw InputError(name + ": the image is damaged inside (" + listener.complaint.data() +
                     "); copy or export it again.");
}

bool isUsual(const jpeg_decompress_struct& jpeg, int width_px, int height_px) {
  return (jpeg.jpeg_color_space == JCS_GRAYSCALE || jpeg.jpeg_color_space == JCS_YCbCr) &&
         jpeg.image_width == static_cast<unsigned>(width_px) &&
         jpeg.image_height == static_cast<unsigned>(height_px);
}

}  // namespace

void requireSoundJpeg(std::string_view bytes, const std::string& name) {
  Listener listener;
  readJpeg(bytes, listener, [](jpeg_decompress_struct& jpeg) {
    jpeg_read_coefficients(&jpeg);
    jpeg_finish_decompress(&jpeg);
  });
  requireNoComplaint(listener, name);
}

bool decodeSoundJpeg(std::string_view bytes, const std::string& name, int width_px, int height_px,
                     unsigned char* bgr) {
  Listener listener;
  bool decoded = false;
  readJpeg(bytes, listener, [&](jpeg_decompress_struct& jpeg) {
    if (!isUsual(jpeg, width_px, height_px)) return;
    jpeg.out_color_space = JCS_EXT_BGR;
    jpeg_start_decompress(&jpeg);
    const std::size_t stride = 3 * static_cast<std::size_t>(width_px);
    while (jpeg.output_scanline < jpeg.output_height) {
      JSAMPROW row = bgr + stride * jpeg.output_scanline;
      jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    decoded = true;
  });
  if (!decoded && listener.complaint[0] == '\0') return false;
  requireNoComplaint(listener, name);
  return true;
}

}  // namespace softscope
